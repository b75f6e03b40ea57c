// Compiles the pair loops of pairs_kernel.inl for each instruction set. Only root_estimate() uses
// intrinsics.
#include "interaction/pairs_kernel.hpp"

#include "base/dispatch.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace rsc {
namespace {

namespace baseline {
#define RSC_TARGET
#if defined(__SSE2__)
// Estimate of 1/sqrt(d2) with 12 bits; 0 for coinciding points.
RSC_TARGET inline __m128 root_estimate(__m128 d2) {
    return _mm_and_ps(_mm_rsqrt_ps(d2), _mm_cmpgt_ps(d2, _mm_set1_ps(0x1p-120f)));
}
RSC_TARGET inline __m128d root_estimate(__m128d d2) {
    return _mm_cvtps_pd(root_estimate(_mm_cvtpd_ps(d2)));
}
constexpr const char* name = "sse2";
#else
template <class V>
inline V root_estimate(V d2) {
    for (std::size_t k = 0; k < sizeof(V) / sizeof(d2[0]); ++k)
        d2[k] = d2[k] > 0x1p-120 ? 1 / __builtin_sqrt(d2[k]) : 0;
    return d2;
}
constexpr const char* name = "generic";
#endif
#include "interaction/pairs_kernel.inl"
constexpr PairKernels table =
    make_table<Pack<double, double, 2, 4>, Pack<float, std::int32_t, 4, 4>>(name);
#undef RSC_TARGET
}  // namespace baseline

#if defined(__x86_64__)
namespace avx2 {
#define RSC_TARGET [[gnu::target("avx2,fma")]]
RSC_TARGET inline __m256 root_estimate(__m256 d2) {
    return _mm256_and_ps(_mm256_rsqrt_ps(d2), _mm256_cmp_ps(d2, _mm256_setzero_ps(), _CMP_GT_OQ));
}
RSC_TARGET inline __m256d root_estimate(__m256d d2) {
    return _mm256_cvtps_pd(baseline::root_estimate(_mm256_cvtpd_ps(d2)));
}
#include "interaction/pairs_kernel.inl"
constexpr PairKernels table =
    make_table<Pack<double, double, 4, 4>, Pack<float, std::int32_t, 8, 2>>("avx2");
#undef RSC_TARGET
}  // namespace avx2

namespace avx512 {
#define RSC_TARGET [[gnu::target("avx512f,avx512dq,avx512vl,avx2,fma")]]
RSC_TARGET inline __m512 root_estimate(__m512 d2) {
    return _mm512_maskz_rsqrt14_ps(_mm512_cmp_ps_mask(d2, _mm512_setzero_ps(), _CMP_GT_OQ), d2);
}
RSC_TARGET inline __m512d root_estimate(__m512d d2) {
    return _mm512_maskz_rsqrt14_pd(_mm512_cmp_pd_mask(d2, _mm512_set1_pd(0x1p-120), _CMP_GT_OQ),
                                   d2);
}
#include "interaction/pairs_kernel.inl"
constexpr PairKernels table =
    make_table<Pack<double, double, 8, 4>, Pack<float, std::int32_t, 16, 4>>("avx512");
#undef RSC_TARGET
}  // namespace avx512
#endif

}  // namespace

const PairKernels* pair_kernels(const char* instruction_set) {
#if defined(__x86_64__)
    const InstructionSet best = rsc::instruction_set();
    if (best >= InstructionSet::avx2 && !__builtin_strcmp(instruction_set, "avx2"))
        return &avx2::table;
    if (best == InstructionSet::avx512 && !__builtin_strcmp(instruction_set, "avx512"))
        return &avx512::table;
#endif
    return __builtin_strcmp(instruction_set, baseline::name) ? nullptr : &baseline::table;
}

const PairKernels& pair_kernels() {
    static const PairKernels* best =
        pair_kernels("avx512") ? pair_kernels("avx512") : pair_kernels("avx2");
    return best ? *best : baseline::table;
}

}  // namespace rsc
