// Run-time choice of instruction set: one body in source, compiled for the baseline and for AVX2, the better one the machine
// has is called. AVX2 without FMA on purpose: products and sums are not contracted, so both give the same bits.
#pragma once

#define RSC_ALWAYS_INLINE [[gnu::always_inline]] inline

#if defined(__x86_64__) && defined(__GNUC__)
#define RSC_DISPATCH(name, body, parameters, arguments)                     \
    [[gnu::target("avx2")]] void name##_avx2 parameters { body arguments; } \
    void name##_baseline parameters { body arguments; }                     \
    void name parameters {                                                  \
        static const bool avx2 = __builtin_cpu_supports("avx2");            \
        if (avx2)                                                           \
            name##_avx2 arguments;                                          \
        else                                                                \
            name##_baseline arguments;                                      \
    }
#else
#define RSC_DISPATCH(name, body, parameters, arguments) \
    void name parameters { body arguments; }
#endif
