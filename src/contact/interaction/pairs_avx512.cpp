// Pair loops with AVX-512 (F, DQ, VL): 8 lanes in double, 16 in single precision. Compiled with flags of its own: includes
// nothing that could leave an inline function in this object for others to link to.
#include "contact/interaction/pairs_kernel.hpp"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)

#include <immintrin.h>

// GCC 12's own header passes registers it declares undefined (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#define FOR_ROWS _Pragma("GCC unroll 8") for (int k = 0; k < rows; ++k)

namespace rsc {
namespace {

struct Double {
    using Real = double;
    using Coordinate = double;
    using V = __m512d;
    using C = __m512d;
    static constexpr std::size_t W = 8;
    static constexpr int rows = 4;
    static C load(const double* p) { return _mm512_loadu_pd(p); }
    static C splat(double a) { return _mm512_set1_pd(a); }
    static V difference(C a, C b) { return _mm512_sub_pd(a, b); }
    static V load_real(const double* p) { return _mm512_loadu_pd(p); }
    static void store(double* p, V a) { _mm512_storeu_pd(p, a); }
    static V splat_real(double a) { return _mm512_set1_pd(a); }
    static V mul(V a, V b) { return _mm512_mul_pd(a, b); }
    static V fma(V a, V b, V c) { return _mm512_fmadd_pd(a, b, c); }
    static double sum(V a) {
        const __m256d b = _mm256_add_pd(_mm512_castpd512_pd256(a), _mm512_extractf64x4_pd(a, 1));
        const __m128d c = _mm_add_pd(_mm256_castpd256_pd128(b), _mm256_extractf128_pd(b, 1));
        return _mm_cvtsd_f64(_mm_add_sd(c, _mm_unpackhi_pd(c, c)));
    }
    // 14 bits; 0 for points that coincide.
    static V root_estimate(V d2) { return _mm512_maskz_rsqrt14_pd(_mm512_cmp_pd_mask(d2, splat(0x1p-120), _CMP_GT_OQ), d2); }
    // The binomial series of (1 - h)^(-1/2), h = 1 - d2 r^2, |h| < 1.3e-4: the first term left out is 7e-17. r = 0 stays 0.
    static void refine(V* d2, const V* r) {
        V p[rows];
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
        FOR_ROWS d2[k] = _mm512_fnmadd_pd(d2[k], r[k], splat(1));
        FOR_ROWS p[k] = fma(d2[k], splat(5.0 / 16), splat(3.0 / 8));
        FOR_ROWS p[k] = fma(p[k], d2[k], splat(0.5));
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
        FOR_ROWS d2[k] = fma(p[k], d2[k], r[k]);
    }
    // w - smooth where `inside` is positive.
    static V difference_where_positive(V w, V smooth, V inside) {
        return _mm512_maskz_sub_pd(_mm512_cmp_pd_mask(inside, splat(0), _CMP_GT_OQ), w, smooth);
    }
};

struct Single {
    using Real = float;
    using Coordinate = std::int32_t;
    using V = __m512;
    using C = __m512i;
    static constexpr std::size_t W = 16;
    static constexpr int rows = 4;
    static C load(const std::int32_t* p) { return _mm512_loadu_si512(p); }
    static C splat(std::int32_t a) { return _mm512_set1_epi32(a); }
    static V difference(C a, C b) { return _mm512_cvtepi32_ps(_mm512_sub_epi32(a, b)); }
    static V load_real(const float* p) { return _mm512_loadu_ps(p); }
    static void store(float* p, V a) { _mm512_storeu_ps(p, a); }
    static V splat_real(float a) { return _mm512_set1_ps(a); }
    static V mul(V a, V b) { return _mm512_mul_ps(a, b); }
    static V fma(V a, V b, V c) { return _mm512_fmadd_ps(a, b, c); }
    static float sum(V a) {
        const __m256 b = _mm256_add_ps(_mm512_castps512_ps256(a), _mm512_extractf32x8_ps(a, 1));
        __m128 c = _mm_add_ps(_mm256_castps256_ps128(b), _mm256_extractf128_ps(b, 1));
        c = _mm_add_ps(c, _mm_movehl_ps(c, c));
        return _mm_cvtss_f32(_mm_add_ss(c, _mm_movehdup_ps(c)));
    }
    static V root_estimate(V d2) { return _mm512_maskz_rsqrt14_ps(_mm512_cmp_ps_mask(d2, splat_real(0), _CMP_GT_OQ), d2); }
    // Twice 1/d (kSingleWeight): one Newton step without its factor 1/2.
    static void refine(V* d2, const V* r) {
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
        FOR_ROWS d2[k] = _mm512_fnmadd_ps(d2[k], r[k], splat_real(3));
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
    }
};

#include "contact/interaction/mesh_kernel.inl"
#include "contact/interaction/pairs_kernel.inl"

constexpr PairKernels table = make_table<Double, Single>("avx512");

}  // namespace

const PairKernels* pair_kernels_avx512() { return &table; }

}  // namespace rsc

#else

const rsc::PairKernels* rsc::pair_kernels_avx512() { return nullptr; }

#endif
