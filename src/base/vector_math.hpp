// Elementary functions without branches or calls, so that loops over them vectorise. They use IEEE
// operations only, so that every compiler and instruction set gives the same bits (provided that
// products and sums are not contracted). Errors stay below 1 ulp (log, sin, cos) and 2 ulp (exp) in
// the ranges stated. Polynomials: FreeBSD msun (e_log.c, k_sin.c, k_cos.c).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace rsc::vector_math {

// Natural logarithm of a normal x > 0.
inline double log_positive(double x) {
    constexpr std::uint64_t kSqrtHalf = 0x3fe6a09e667f3bcdULL;  // bits of sqrt(1/2)
    constexpr std::uint64_t kMantissa = 0x000fffffffffffffULL;
    const std::uint64_t shifted =
        std::bit_cast<std::uint64_t>(x) + (0x3ff0000000000000ULL - kSqrtHalf);
    // The exponent k as a double: its bits become the low bits of 2^52, which is then subtracted.
    const double k = std::bit_cast<double>((shifted >> 52) | 0x4330000000000000ULL) -
                     (4503599627370496.0 + 1023.0);
    // x = 2^k (1 + f)
    const double f = std::bit_cast<double>((shifted & kMantissa) + kSqrtHalf) - 1.0;
    const double s = f / (2.0 + f);
    const double z = s * s;
    const double w = z * z;
    const double t1 = w * (3.999999999940941908e-01 +
                           w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
    const double t2 = z * (6.666666666666735130e-01 +
                           w * (2.857142874366239149e-01 +
                                w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
    const double half_square = 0.5 * f * f;
    return k * 6.93147180369123816490e-01 -
           ((half_square - (s * (half_square + (t1 + t2)) + k * 1.90821492927058770002e-10)) - f);
}

// exp(x) for -700 < x < 700.
inline double exp_moderate(double x) {
    // 1.5 * 2^52: adding it rounds x to an integer, stored in the low bits
    constexpr double kShift = 6755399441055744.0;
    const double shifted = x * 1.44269504088896338700e+00 + kShift;
    const double k = shifted - kShift;
    // |r| <= ln(2)/2
    const double r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
    double p = 1.0 / 6227020800.0;
    p = p * r + 1.0 / 479001600.0;
    p = p * r + 1.0 / 39916800.0;
    p = p * r + 1.0 / 3628800.0;
    p = p * r + 1.0 / 362880.0;
    p = p * r + 1.0 / 40320.0;
    p = p * r + 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    p = p * r + 1.0;
    p = p * r + 1.0;
    const double power =
        std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);  // 2^k
    return p * power;
}

// x[i] <- sqrt(x[i]), x[i] >= 0, count even, x aligned to 16 bytes. Compilers keep std::sqrt scalar
// for the sake of errno.
inline void square_roots(double* x, int count) {
#if defined(__SSE2__)
    for (int i = 0; i < count; i += 2) _mm_store_pd(x + i, _mm_sqrt_pd(_mm_load_pd(x + i)));
#else
    for (int i = 0; i < count; ++i) x[i] = std::sqrt(x[i]);
#endif
}

// The same for a count that is a multiple of 4.
inline void square_roots(float* x, int count) {
#if defined(__SSE2__)
    for (int i = 0; i < count; i += 4) _mm_store_ps(x + i, _mm_sqrt_ps(_mm_load_ps(x + i)));
#else
    for (int i = 0; i < count; ++i) x[i] = std::sqrt(x[i]);
#endif
}

// cos and sin of 2 pi u for 0 <= u < 1 (u in turns: the reduction to a quarter turn is exact).
inline void cos_sin_turns(double u, double& cosine, double& sine) {
    constexpr double kShift = 6755399441055744.0;
    const double t = 4.0 * u;
    const double shifted = t + kShift;
    // low bits: the nearest quarter turn
    const std::uint64_t quarter = std::bit_cast<std::uint64_t>(shifted);
    const double y = (t - (shifted - kShift)) * 1.57079632679489661923;  // |y| <= pi/4
    const double z = y * y;
    const double s =
        y +
        y * z *
            (-1.66666666666666324348e-01 +
             z * (8.33333333332248946124e-03 +
                  z * (-1.98412698298579493134e-04 +
                       z * (2.75573137070700676789e-06 +
                            z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
    const double c =
        1.0 - (0.5 * z - z * z *
                             (4.16666666666666019037e-02 +
                              z * (-1.38888888888741095749e-03 +
                                   z * (2.48015872894767294178e-05 +
                                        z * (-2.75573143513906633035e-07 +
                                             z * (2.08757232129817482790e-09 +
                                                  z * -1.13596475577881948265e-11))))));
    const std::uint64_t sb = std::bit_cast<std::uint64_t>(s), cb = std::bit_cast<std::uint64_t>(c);
    // all ones in odd quarters, where sine and cosine are exchanged
    const std::uint64_t swap = 0 - (quarter & 1);
    const std::uint64_t re = (cb & ~swap) | (sb & swap);
    const std::uint64_t im = (sb & ~swap) | (cb & swap);
    cosine = std::bit_cast<double>(re ^ (((quarter + 1) & 2) << 62));
    sine = std::bit_cast<double>(im ^ ((quarter & 2) << 62));
}

}  // namespace rsc::vector_math
