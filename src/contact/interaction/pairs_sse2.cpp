// Pair loops with SSE2, which every x86-64 processor has: 2 lanes in double, 4 in single precision.
#include "contact/interaction/pairs_kernel.hpp"

#if defined(__SSE2__)

#include <emmintrin.h>

#define FOR_ROWS _Pragma("GCC unroll 8") for (int k = 0; k < rows; ++k)

namespace rsc {
namespace {

struct Double {
    using Real = double;
    using Coordinate = double;
    using V = __m128d;
    using C = __m128d;
    static constexpr std::size_t W = 2;
    static constexpr int rows = 4;
    static C load(const double* p) { return _mm_loadu_pd(p); }
    static C splat(double a) { return _mm_set1_pd(a); }
    static V difference(C a, C b) { return _mm_sub_pd(a, b); }
    static V load_real(const double* p) { return _mm_loadu_pd(p); }
    static void store(double* p, V a) { _mm_storeu_pd(p, a); }
    static V splat_real(double a) { return _mm_set1_pd(a); }
    static V mul(V a, V b) { return _mm_mul_pd(a, b); }
    static V fma(V a, V b, V c) { return _mm_add_pd(_mm_mul_pd(a, b), c); }
    static double sum(V a) { return _mm_cvtsd_f64(_mm_add_sd(a, _mm_unpackhi_pd(a, a))); }
    // 12 bits from rsqrtps; 0 for points that coincide.
    static V root_estimate(V d2) {
        const __m128 a = _mm_cvtpd_ps(d2);
        return _mm_cvtps_pd(_mm_and_ps(_mm_rsqrt_ps(a), _mm_cmpgt_ps(a, _mm_set1_ps(0x1p-120f))));
    }
    // As with AVX2; d2 r^2 is rounded here before it is taken from 1, which costs half a unit of the last place.
    static void refine(V* d2, const V* r) {
        V p[rows];
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
        FOR_ROWS d2[k] = _mm_sub_pd(splat(1), mul(d2[k], r[k]));
        FOR_ROWS p[k] = fma(d2[k], splat(35.0 / 128), splat(5.0 / 16));
        FOR_ROWS p[k] = fma(p[k], d2[k], splat(3.0 / 8));
        FOR_ROWS p[k] = fma(p[k], d2[k], splat(0.5));
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
        FOR_ROWS d2[k] = fma(p[k], d2[k], r[k]);
    }
    // w - smooth where `inside` is positive.
    static V difference_where_positive(V w, V smooth, V inside) {
        return _mm_and_pd(_mm_sub_pd(w, smooth), _mm_cmpgt_pd(inside, _mm_setzero_pd()));
    }
};

struct Single {
    using Real = float;
    using Coordinate = std::int32_t;
    using V = __m128;
    using C = __m128i;
    static constexpr std::size_t W = 4;
    static constexpr int rows = 4;
    static C load(const std::int32_t* p) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p)); }
    static C splat(std::int32_t a) { return _mm_set1_epi32(a); }
    static V difference(C a, C b) { return _mm_cvtepi32_ps(_mm_sub_epi32(a, b)); }
    static V load_real(const float* p) { return _mm_loadu_ps(p); }
    static void store(float* p, V a) { _mm_storeu_ps(p, a); }
    static V splat_real(float a) { return _mm_set1_ps(a); }
    static V mul(V a, V b) { return _mm_mul_ps(a, b); }
    static V fma(V a, V b, V c) { return _mm_add_ps(_mm_mul_ps(a, b), c); }
    static float sum(V a) {
        const V b = _mm_add_ps(a, _mm_movehl_ps(a, a));
        return _mm_cvtss_f32(_mm_add_ss(b, _mm_shuffle_ps(b, b, 1)));
    }
    static V root_estimate(V d2) { return _mm_and_ps(_mm_rsqrt_ps(d2), _mm_cmpgt_ps(d2, _mm_setzero_ps())); }
    // Twice 1/d (kSingleWeight): one Newton step without its factor 1/2.
    static void refine(V* d2, const V* r) {
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
        FOR_ROWS d2[k] = _mm_sub_ps(splat_real(3), mul(d2[k], r[k]));
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
    }
};

#include "contact/interaction/mesh_kernel.inl"
#include "contact/interaction/pairs_kernel.inl"

constexpr PairKernels table = make_table<Double, Single>("sse2");

}  // namespace

const PairKernels* pair_kernels_sse2() { return &table; }

}  // namespace rsc

#else

const rsc::PairKernels* rsc::pair_kernels_sse2() { return nullptr; }

#endif
