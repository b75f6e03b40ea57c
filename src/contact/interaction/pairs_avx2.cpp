// Pair loops with AVX2 and FMA: 4 lanes in double, 8 in single precision. Compiled with flags of its own: includes nothing that
// could leave an inline function in this object for others to link to.
#include "contact/interaction/pairs_kernel.hpp"

#if defined(__AVX2__) && defined(__FMA__)

#include <immintrin.h>

#define FOR_ROWS _Pragma("GCC unroll 8") for (int k = 0; k < rows; ++k)

namespace rsc {
namespace {

struct Double {
    using Real = double;
    using Coordinate = double;
    using V = __m256d;
    using C = __m256d;
    static constexpr std::size_t W = 4;
    static constexpr int rows = 4;
    static C load(const double* p) { return _mm256_loadu_pd(p); }
    static C splat(double a) { return _mm256_set1_pd(a); }
    static V difference(C a, C b) { return _mm256_sub_pd(a, b); }
    static V load_real(const double* p) { return _mm256_loadu_pd(p); }
    static void store(double* p, V a) { _mm256_storeu_pd(p, a); }
    static V splat_real(double a) { return _mm256_set1_pd(a); }
    static V mul(V a, V b) { return _mm256_mul_pd(a, b); }
    static V fma(V a, V b, V c) { return _mm256_fmadd_pd(a, b, c); }
    static double sum(V a) {
        const __m128d b = _mm_add_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1));
        return _mm_cvtsd_f64(_mm_add_sd(b, _mm_unpackhi_pd(b, b)));
    }
    // 12 bits from rsqrtps; 0 for points that coincide.
    static V root_estimate(V d2) {
        const __m128 a = _mm256_cvtpd_ps(d2);
        return _mm256_cvtps_pd(_mm_and_ps(_mm_rsqrt_ps(a), _mm_cmpgt_ps(a, _mm_set1_ps(0x1p-120f))));
    }
    // The binomial series of (1 - h)^(-1/2), h = 1 - d2 r^2, |h| < 7.4e-4: the first term left out is 6e-17. r = 0 stays 0.
    static void refine(V* d2, const V* r) {
        V p[rows];
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
        FOR_ROWS d2[k] = _mm256_fnmadd_pd(d2[k], r[k], splat(1));
        FOR_ROWS p[k] = fma(d2[k], splat(35.0 / 128), splat(5.0 / 16));
        FOR_ROWS p[k] = fma(p[k], d2[k], splat(3.0 / 8));
        FOR_ROWS p[k] = fma(p[k], d2[k], splat(0.5));
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
        FOR_ROWS d2[k] = fma(p[k], d2[k], r[k]);
    }
    // w - smooth where `inside` is positive.
    static V difference_where_positive(V w, V smooth, V inside) {
        return _mm256_and_pd(_mm256_sub_pd(w, smooth), _mm256_cmp_pd(inside, _mm256_setzero_pd(), _CMP_GT_OQ));
    }
};

struct Single {
    using Real = float;
    using Coordinate = std::int32_t;
    using V = __m256;
    using C = __m256i;
    static constexpr std::size_t W = 8;
    static constexpr int rows = 2;
    static C load(const std::int32_t* p) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)); }
    static C splat(std::int32_t a) { return _mm256_set1_epi32(a); }
    static V difference(C a, C b) { return _mm256_cvtepi32_ps(_mm256_sub_epi32(a, b)); }
    static V load_real(const float* p) { return _mm256_loadu_ps(p); }
    static void store(float* p, V a) { _mm256_storeu_ps(p, a); }
    static V splat_real(float a) { return _mm256_set1_ps(a); }
    static V mul(V a, V b) { return _mm256_mul_ps(a, b); }
    static V fma(V a, V b, V c) { return _mm256_fmadd_ps(a, b, c); }
    static float sum(V a) {
        __m128 b = _mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
        b = _mm_add_ps(b, _mm_movehl_ps(b, b));
        return _mm_cvtss_f32(_mm_add_ss(b, _mm_movehdup_ps(b)));
    }
    static V root_estimate(V d2) { return _mm256_and_ps(_mm256_rsqrt_ps(d2), _mm256_cmp_ps(d2, _mm256_setzero_ps(), _CMP_GT_OQ)); }
    // Twice 1/d (kSingleWeight): one Newton step without its factor 1/2.
    static void refine(V* d2, const V* r) {
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
        FOR_ROWS d2[k] = _mm256_fnmadd_ps(d2[k], r[k], splat_real(3));
        FOR_ROWS d2[k] = mul(d2[k], r[k]);
    }
};

#include "contact/interaction/mesh_kernel.inl"
#include "contact/interaction/pairs_kernel.inl"

constexpr PairKernels table = make_table<Double, Single>("avx2");

}  // namespace

const PairKernels* pair_kernels_avx2() { return &table; }

}  // namespace rsc

#else

const rsc::PairKernels* rsc::pair_kernels_avx2() { return nullptr; }

#endif
