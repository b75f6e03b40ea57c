// Pair loops with AVX2 and FMA: 4 lanes in double, 8 in single precision. Compiled with flags of its own: includes nothing that
// could leave an inline function in this object for others to link to.
#include "contact/pairs_kernel.hpp"

#if defined(__AVX2__) && defined(__FMA__)

#include <immintrin.h>

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
    // 12 bits from rsqrtps, then the binomial series of (1 - h)^(-1/2), h = 1 - d2 r^2, |h| < 7.4e-4: the first term left out is 6e-17.
    static V inverse_root(V d2) {
        const V r = _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(d2)));
        const V h = _mm256_fnmadd_pd(_mm256_mul_pd(d2, r), r, splat_real(1));
        V p = fma(h, splat_real(35.0 / 128), splat_real(5.0 / 16));
        p = fma(p, h, splat_real(3.0 / 8));
        p = fma(p, h, splat_real(0.5));
        return fma(mul(p, h), r, r);
    }
    static V inverse_distance(V d2) {
        const V apart = _mm256_cmp_pd(d2, splat_real(0x1p-120), _CMP_GT_OQ);
        return _mm256_and_pd(inverse_root(d2), apart);
    }
    static V near_difference(V d2, V cutoff2, V smooth) {
        const V apart = _mm256_cmp_pd(d2, splat_real(0x1p-120), _CMP_GT_OQ);
        const V close = _mm256_cmp_pd(d2, cutoff2, _CMP_LT_OQ);
        return _mm256_and_pd(_mm256_sub_pd(inverse_root(d2), smooth), _mm256_and_pd(apart, close));
    }
};

struct Single {
    using Real = float;
    using Coordinate = std::int32_t;
    using V = __m256;
    using C = __m256i;
    static constexpr std::size_t W = 8;
    static constexpr int rows = 4;
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
    // Twice 1/d (kSingleWeight): one Newton step on rsqrtps without its factor 1/2.
    static V inverse_distance(V d2) {
        const V apart = _mm256_cmp_ps(d2, _mm256_setzero_ps(), _CMP_GT_OQ);
        const V r = _mm256_rsqrt_ps(d2);
        const V e = _mm256_fnmadd_ps(mul(d2, r), r, splat_real(3));
        return _mm256_and_ps(mul(r, e), apart);
    }
};

#include "contact/pairs_kernel.inl"

constexpr PairKernels table = make_table<Double, Single>("avx2");

}  // namespace

const PairKernels* pair_kernels_avx2() { return &table; }

}  // namespace rsc

#else

const rsc::PairKernels* rsc::pair_kernels_avx2() { return nullptr; }

#endif
