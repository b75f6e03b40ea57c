#include "rough/noise.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <bit>

#include "rough/dispatch.hpp"
#include "rough/vector_math.hpp"

namespace rsc {
namespace {

constexpr int kBatch = 32;

// The noise of kBatch consecutive modes, in three loops that vectorise. Philox is written out over the batch (Random123's is
// one counter at a time); the constants are Random123's, and so are the bits.
RSC_ALWAYS_INLINE void noise_batch(const NoiseKey& key, std::int32_t kx, std::int32_t ky_first, double* re, double* im) {
    const auto seed = static_cast<std::uint64_t>(key.seed);
    const auto realization = static_cast<std::uint64_t>(key.realization);
    const auto k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32);
    const auto r0 = static_cast<std::uint32_t>(realization), r1 = static_cast<std::uint32_t>(realization >> 32);
    alignas(64) std::uint32_t w0[kBatch], w1[kBatch], w2[kBatch], w3[kBatch];
    for (int i = 0; i < kBatch; ++i) {
        std::uint32_t c0 = static_cast<std::uint32_t>(kx);
        std::uint32_t c1 = static_cast<std::uint32_t>(ky_first) + static_cast<std::uint32_t>(i);
        std::uint32_t c2 = r0, c3 = r1;
#pragma GCC unroll 10
        for (std::uint32_t round = 0; round < 10; ++round) {
            const std::uint64_t p0 = static_cast<std::uint64_t>(PHILOX_M4x32_0) * c0;
            const std::uint64_t p1 = static_cast<std::uint64_t>(PHILOX_M4x32_1) * c2;
            c0 = static_cast<std::uint32_t>(p1 >> 32) ^ c1 ^ (k0 + round * PHILOX_W32_0);
            c1 = static_cast<std::uint32_t>(p1);
            c2 = static_cast<std::uint32_t>(p0 >> 32) ^ c3 ^ (k1 + round * PHILOX_W32_1);
            c3 = static_cast<std::uint32_t>(p0);
        }
        w0[i] = c0, w1[i] = c1, w2[i] = c2, w3[i] = c3;
    }
    alignas(64) double radius[kBatch];
    for (int i = 0; i < kBatch; ++i) {
        // 52 random bits behind the exponent of 1: a uniform number in [1, 2).
        const std::uint64_t b1 = w0[i] | (static_cast<std::uint64_t>(w1[i] & 0xfffffu) << 32) | 0x3ff0000000000000ULL;
        const std::uint64_t b2 = w2[i] | (static_cast<std::uint64_t>(w3[i] & 0xfffffu) << 32) | 0x3ff0000000000000ULL;
        const double u1 = 2.0 - std::bit_cast<double>(b1);  // (0, 1]
        const double u2 = std::bit_cast<double>(b2) - 1.0;  // [0, 1)
        // Box and Muller with -ln u1 in place of -2 ln u1: the two components have variance 1/2 each.
        radius[i] = -vector_math::log_positive(u1);
        vector_math::cos_sin_turns(u2, re[i], im[i]);
    }
    vector_math::square_roots(radius, kBatch);
    for (int i = 0; i < kBatch; ++i) {
        re[i] *= radius[i];
        im[i] *= radius[i];
    }
}

RSC_ALWAYS_INLINE void column_noise_body(const NoiseKey& key, std::int32_t kx, std::int32_t ky_first, int count, double* re, double* im) {
    int done = 0;
    for (; done + kBatch <= count; done += kBatch) noise_batch(key, kx, ky_first + done, re + done, im + done);
    if (done < count) {
        alignas(64) double last_re[kBatch], last_im[kBatch];
        noise_batch(key, kx, ky_first + done, last_re, last_im);
        std::copy_n(last_re, count - done, re + done);
        std::copy_n(last_im, count - done, im + done);
    }
}

RSC_DISPATCH(column_noise_for, column_noise_body,
             (const NoiseKey& key, std::int32_t kx, std::int32_t ky_first, int count, double* re, double* im),
             (key, kx, ky_first, count, re, im))

}  // namespace

std::complex<double> mode_noise(const NoiseKey& key, std::int32_t kx, std::int32_t ky) {
    double re, im;
    column_noise(key, kx, ky, 1, &re, &im);
    return {re, im};
}

void column_noise(const NoiseKey& key, std::int32_t kx, std::int32_t ky_first, int count, double* re, double* im) {
    column_noise_for(key, kx, ky_first, count, re, im);
}

}  // namespace rsc
