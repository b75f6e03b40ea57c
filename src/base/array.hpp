// Arrays of numbers over a grid, or over the points in contact.
#pragma once

#include "base/std.hpp"

namespace rsc {

// Memory that begins at a multiple of 64 bytes. From 4 MB on it begins at a huge page and the
// system is asked for huge pages: with small ones, large problems spend up to half of their time
// where the system sets new pages to 0. It is not set to 0 unless `zeros`; it then consists of
// small pages that take memory only when they are written. Throws Error(no_memory) with the
// purpose. To be freed by std::free().
void* allocate_bytes(std::size_t bytes, const char* purpose, bool zeros = false);

// Asks the system for huge or for small pages for some memory, from 4 MB on. A hint: failure costs
// time or memory.
void ask_for_pages(void* p, std::size_t bytes, bool huge);

// The same for n numbers.
template <class T>
T* allocate_numbers(std::size_t n, const char* purpose, bool zeros = false) {
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max() / sizeof(T);
    return static_cast<T*>(allocate_bytes(n < most ? n * sizeof(T) : most, purpose, zeros));
}

template <class T>
struct ArrayMemory {
    using value_type = T;
    ArrayMemory() = default;
    template <class U>
    ArrayMemory(const ArrayMemory<U>&) {}
    T* allocate(std::size_t n) { return allocate_numbers<T>(n, "an array of a large problem"); }
    void deallocate(T* p, std::size_t) noexcept { std::free(p); }
    // resize() does not set new elements.
    template <class U>
    void construct(U* p) {
        ::new (static_cast<void*>(p)) U;
    }
    template <class U, class... Args>
    void construct(U* p, Args&&... args) {
        ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
    }
    friend bool operator==(const ArrayMemory&, const ArrayMemory&) { return true; }
};

// A vector in such memory, whose resize() leaves new elements unset. It lives as long as its owner,
// and is resized rather than made anew.
template <class T>
using Array = std::vector<T, ArrayMemory<T>>;

// An ordinary vector of n zeros, on huge pages from 4 MB on.
template <class T>
std::vector<T> zeros_on_huge_pages(std::size_t n) {
    std::vector<T> zeros;
    zeros.reserve(n);
    ask_for_pages(zeros.data(), n * sizeof(T), true);
    zeros.resize(n);
    return zeros;
}

}  // namespace rsc
