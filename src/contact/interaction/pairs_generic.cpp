// Pair loops in plain C++ for processors without one of the others: one lane, square root and division.
#include "contact/interaction/pairs_kernel.hpp"

namespace rsc {
namespace {

template <class R, class X>
struct Lane {
    using Real = R;
    using Coordinate = X;
    using V = R;
    using C = X;
    static constexpr std::size_t W = 1;
    static constexpr int rows = 4;
    static C load(const X* p) { return *p; }
    static C splat(X a) { return a; }
    static V difference(C a, C b) { return static_cast<R>(a - b); }
    static V load_real(const R* p) { return *p; }
    static void store(R* p, V a) { *p = a; }
    static V splat_real(double a) { return static_cast<R>(a); }
    static V mul(V a, V b) { return a * b; }
    static V fma(V a, V b, V c) { return a * b + c; }
    static R sum(V a) { return a; }
};

struct Double : Lane<double, double> {
    static double root_estimate(double d2) { return d2 > 0x1p-120 ? 1 / __builtin_sqrt(d2) : 0; }
    static void refine(double* w, const double* r) {
        for (int k = 0; k < rows; ++k) w[k] = r[k];
    }
    static double difference_where_positive(double w, double smooth, double inside) { return inside > 0 ? w - smooth : 0; }
};

struct Single : Lane<float, std::int32_t> {
    static float root_estimate(float d2) { return d2 > 0 ? 1 / __builtin_sqrtf(d2) : 0; }
    static void refine(float* w, const float* r) {
        for (int k = 0; k < rows; ++k) w[k] = 2 * r[k];  // kSingleWeight
    }
};

#include "contact/interaction/mesh_kernel.inl"
#include "contact/interaction/pairs_kernel.inl"

constexpr PairKernels table = make_table<Double, Single>("generic");

}  // namespace

const PairKernels* pair_kernels_generic() { return &table; }

}  // namespace rsc
