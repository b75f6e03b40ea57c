// Values as they lie in memory, one after another in a string of bytes, and back: for files of this
// machine and this version. A class whose members do not lie in one piece, or with gaps between
// them, has a function archive(archive, object), which calls the archive with its members.
#pragma once

#include "base/error.hpp"

namespace rsc {

// The bytes of one value, and back. Throws Error(internal) for bytes of another length.
template <class T>
std::string bytes_of(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return {reinterpret_cast<const char*>(&value), sizeof value};
}
template <class T>
T from_bytes(std::string_view bytes) {
    T value{};
    if (bytes.size() != sizeof value)
        throw Error(Failure::internal, "a message between processes has the wrong length");
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
}

class ArchiveWriter {
public:
    static constexpr bool writing = true;
    void operator()(const auto&... values) { (put(values), ...); }
    std::string bytes;

private:
    template <class T>
    void put(const T& value) {
        if constexpr (requires { T::archive(*this, value); })
            T::archive(*this, value);
        else
            bytes += bytes_of(value);
    }
    template <class T>
    void put(const std::optional<T>& value) {
        put(char(value.has_value()));
        if (value) put(*value);
    }
    template <class T, class Memory>
    void put(const std::vector<T, Memory>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        put(std::uint64_t(values.size()));
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }
    template <class T>
    void put(const std::deque<T>& values) {
        put(std::uint64_t(values.size()));
        for (const T& value : values) put(value);
    }
};

// Reads what a writer wrote, in the same order. `bytes` must outlive it. Throws Error(failure,
// broken) where they end too early, or late.
class ArchiveReader {
public:
    static constexpr bool writing = false;
    ArchiveReader(std::string_view bytes, Failure failure, const char* broken)
        : bytes_(bytes), failure_(failure), broken_(broken) {}
    void operator()(auto&... values) { (get(values), ...); }
    void end() const {
        if (!bytes_.empty()) throw Error(failure_, broken_);
    }

private:
    template <class T>
    void get(T& value) {
        if constexpr (requires { T::archive(*this, value); }) {
            T::archive(*this, value);
        } else {
            static_assert(std::is_trivially_copyable_v<T>);
            std::memcpy(&value, take(sizeof value), sizeof value);
        }
    }
    template <class T>
    void get(std::optional<T>& value) {
        char some = 0;
        get(some);
        value.reset();
        if (some != 0) get(value.emplace(T()));
    }
    template <class T, class Memory>
    void get(std::vector<T, Memory>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        std::uint64_t size = 0;
        get(size);
        if (size > bytes_.size() / sizeof(T)) throw Error(failure_, broken_);
        values.resize(at(size));
        const std::size_t length = values.size() * sizeof(T);
        const char* from = take(length);
        if (length > 0) std::memcpy(values.data(), from, length);
    }
    // Items are appended one by one: a wrong size fails at the end of the bytes, before much memory
    // is allocated.
    template <class T>
    void get(std::deque<T>& values) {
        std::uint64_t size = 0;
        get(size);
        values.clear();
        for (; size > 0; --size) get(values.emplace_back());
    }
    const char* take(std::size_t n) {
        if (n > bytes_.size()) throw Error(failure_, broken_);
        const char* p = bytes_.data();
        bytes_.remove_prefix(n);
        return p;
    }
    std::string_view bytes_;
    Failure failure_;
    const char* broken_;
};

}  // namespace rsc
