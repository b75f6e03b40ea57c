// The whole test framework: checks that say what failed and go on, and a summary as the exit
// status. `test_rooms NAME` runs every TEST(what) { ... } of the file test_NAME.cpp, in their
// order.
#pragma once

#include <iterator>
#include <random>

#include "base/std.hpp"

using rsc::indices;
using rsc::kInfinity;
using std::numbers::pi;

namespace check {

inline std::atomic<int> failures = 0, checks = 0;  // also from threads of a test
void that(bool ok, const char* what, const char* file, int line);
void close(double a, double b, double tolerance, const char* what, const char* file,
           int line);  // |a - b| <= tolerance

// The larger of two errors, and not a number if either is: std::max would drop it.
inline double worse(double worst, double error) {
    return std::isnan(worst) || error <= worst ? worst : error;
}
inline double worse(double worst, std::initializer_list<double> errors) {
    for (double error : errors) worst = worse(worst, error);
    return worst;
}

template <class Type, class Act>
bool throws(Act&& act) try {
    act();
    return false;
} catch (const Type&) {
    return true;
}

bool add(const char* file, void (*run)());  // to the tests of the file

}  // namespace check

#define TEST(name)                                                  \
    static void name();                                             \
    static const bool name##_is_added = check::add(__FILE__, name); \
    static void name()
#define CHECK(condition) check::that((condition), #condition, __FILE__, __LINE__)
#define CHECK_CLOSE(a, b, tolerance) \
    check::close((a), (b), (tolerance), #a " = " #b, __FILE__, __LINE__)
#define CHECK_RELATIVE(a, b, tolerance) \
    check::close((a), (b), (tolerance)*std::abs(b), #a " = " #b " (relative)", __FILE__, __LINE__)
#define CHECK_THROWS(expression, type)                                                          \
    check::that(check::throws<type>([&] { (void)(expression); }), #expression " throws " #type, \
                __FILE__, __LINE__)
