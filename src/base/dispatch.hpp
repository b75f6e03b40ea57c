// Run-time choice of the instruction set. RSC_DISPATCH compiles one function body for the baseline
// and for AVX2 and calls the best version that the machine supports. AVX2 is used without FMA on
// purpose: products and sums are not contracted, so both versions give the same bits.
#pragma once

#define RSC_ALWAYS_INLINE [[gnu::always_inline]] inline

namespace rsc {

// Instruction sets for which hot loops are compiled, and the best one that this machine supports.
enum class InstructionSet { baseline, avx2, avx512 };  // avx2 with FMA; avx512 with F, DQ and VL

inline InstructionSet instruction_set() {
#if defined(__x86_64__) && defined(__GNUC__)
    static const InstructionSet best = [] {
        if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
            return InstructionSet::baseline;
        const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512vl");
        return wide ? InstructionSet::avx512 : InstructionSet::avx2;
    }();
    return best;
#else
    return InstructionSet::baseline;
#endif
}

// n numbers that an instruction processes together, read or written at the address of any
// number. Packed, because a reference to a vector type of reduced alignment loses that alignment
// in clang.
template <class Real, int n>
struct [[gnu::packed, gnu::may_alias]] Unaligned {
    using Vector [[gnu::vector_size(n * sizeof(Real))]] = Real;
    static constexpr int kCount = n;
    Vector v;
    RSC_ALWAYS_INLINE static const Unaligned& at(const Real* p) {
        return *reinterpret_cast<const Unaligned*>(p);
    }
    RSC_ALWAYS_INLINE static Unaligned& at(Real* const p) {
        return *reinterpret_cast<Unaligned*>(p);
    }
};

}  // namespace rsc

#if defined(__x86_64__) && defined(__GNUC__)
#define RSC_DISPATCH(name, body, parameters, arguments)                     \
    [[gnu::target("avx2")]] void name##_avx2 parameters { body arguments; } \
    void name##_baseline parameters { body arguments; }                     \
    void name parameters {                                                  \
        if (rsc::instruction_set() != rsc::InstructionSet::baseline)        \
            name##_avx2 arguments;                                          \
        else                                                                \
            name##_baseline arguments;                                      \
    }
#else
#define RSC_DISPATCH(name, body, parameters, arguments) \
    void name parameters { body arguments; }
#endif
