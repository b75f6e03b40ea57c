#include "api/handle_numbers.h"

#include "base/std.hpp"

namespace {

struct Numbers {
    std::mutex mutex;
    std::unordered_map<std::int64_t, void*> handles;
    std::int64_t last = 0x5253435f00000000;  // unlike typical values of uninitialised memory
};

// Never destroyed, because objects may be used while the program ends.
Numbers& numbers() {
    static Numbers* const all = new Numbers;
    return *all;
}

}  // namespace

int64_t rsc_number_of(void* handle) {
    try {
        const std::lock_guard lock(numbers().mutex);
        numbers().handles.emplace(numbers().last + 1, handle);
        return ++numbers().last;
    } catch (...) {
        return 0;
    }
}

void* rsc_handle_of(int64_t number) {
    static std::uint64_t released = 0;  // begins as a handle whose tag was cleared
    if (number == 0) return nullptr;
    const std::lock_guard lock(numbers().mutex);
    const auto at = numbers().handles.find(number);
    return at == numbers().handles.end() ? &released : at->second;
}

void* rsc_handle_taken(int64_t number) {
    const std::lock_guard lock(numbers().mutex);
    const auto entry = numbers().handles.extract(number);
    return entry.empty() ? nullptr : entry.mapped();
}
