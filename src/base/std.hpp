// The headers of the standard library that rsc uses, and what most files need. CMake compiles them
// once (RSC_PRECOMPILE); a file includes this one, or a header that does.
#pragma once

#include <algorithm>
#include <any>
#include <array>
#include <atomic>
#include <bit>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <complex>
#include <condition_variable>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <deque>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <tuple>
#include <type_traits>
#include <typeindex>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

namespace rsc {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
using std::numbers::pi;

// A number as an index, or as a size.
constexpr std::size_t at(auto k) { return std::size_t(k); }

// The indices 0, 1, ..., n - 1, for loops over them.
template <class Number>
class Indices {
public:
    explicit constexpr Indices(Number n) : n_(n) {}
    struct Index {
        Number k;
        constexpr Number operator*() const { return k; }
        constexpr Index& operator++() {
            ++k;
            return *this;
        }
        constexpr bool operator!=(const Index& end) const { return k < end.k; }
    };
    constexpr Index begin() const { return {0}; }
    constexpr Index end() const { return {n_}; }

private:
    Number n_;
};
// Of a number, or of the values that a container has now.
constexpr auto indices(const auto& n) {
    if constexpr (requires { n.size(); })
        return Indices(n.size());
    else
        return Indices(n);
}

template <class T>
void append(std::vector<T>& to, const auto& more) {
    to.insert(to.end(), more.begin(), more.end());
}
template <class T>
void append(std::vector<T>& to, std::initializer_list<T> more) {
    to.insert(to.end(), more);
}

bool contains(const auto& values, const auto& value) {
    return std::ranges::find(values, value) != values.end();
}

inline double sum_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// The time on the wall since `start` [s].
inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

}  // namespace rsc
