#include "base/array.hpp"

#include "base/error.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace rsc {
namespace {

constexpr std::size_t kPage = 4096, kHugePage = std::size_t{2} << 20;

}  // namespace

void ask_for_pages([[maybe_unused]] void* p, [[maybe_unused]] std::size_t bytes,
                   [[maybe_unused]] bool huge) {
#if defined(__linux__)
    if (bytes < 2 * kHugePage) return;
    auto* const first =
        static_cast<char*>(p) + (kPage - reinterpret_cast<std::uintptr_t>(p) % kPage) % kPage;
    madvise(first, bytes - kPage, huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
#endif
}

void* allocate_bytes(std::size_t bytes, const char* purpose, bool zeros) {
    // Systems that overcommit memory may accept any size; sizes beyond the address space are
    // rejected here.
    constexpr std::size_t most = std::size_t{1} << 47;
    void* p = nullptr;
    if (bytes < most) {
        const bool large = bytes >= 2 * kHugePage;
        const std::size_t alignment = large ? kHugePage : 64,
                          whole = std::max(bytes + alignment - 1, alignment) / alignment;
        p = zeros ? std::calloc(std::max<std::size_t>(bytes, 1), 1)
                  : std::aligned_alloc(alignment, whole * alignment);
        if (p && large) ask_for_pages(p, bytes, !zeros);
    }
    if (!p)
        throw Error(Failure::no_memory,
                    "no memory for " + std::string(purpose) + ": " +
                        std::to_string(std::llround(static_cast<double>(bytes) / 1048576.0)) +
                        " MB requested");
    return p;
}

}  // namespace rsc
