#include "surface/mode_rotation.hpp"

#include "base/dispatch.hpp"
#include "base/vector_math.hpp"

namespace rsc {
namespace {

constexpr int kBatch = kRotatedModes;

// Eight sums at a time. Arrays of lanes would stay in memory.
using Eight = Unaligned<float, 8>::Vector;
RSC_ALWAYS_INLINE void add_powers_body(const float* z, std::ptrdiff_t count, double* total) {
    Eight second = {}, third = {}, fourth = {}, second2 = {}, third2 = {}, fourth2 = {};
    for (std::ptrdiff_t i = 0; i < count; i += 16) {
        const Eight a = Unaligned<float, 8>::at(z + i).v, b = Unaligned<float, 8>::at(z + i + 8).v;
        const Eight a2 = a * a, b2 = b * b;
        second += a2;
        third += a * a2;
        fourth += a2 * a2;
        second2 += b2;
        third2 += b * b2;
        fourth2 += b2 * b2;
    }
    second += second2;
    third += third2;
    fourth += fourth2;
    for (const int l : indices(8)) {
        total[0] += second[l];
        total[1] += third[l];
        total[2] += fourth[l];
    }
}

RSC_ALWAYS_INLINE void angles(const float* x, const float* y, const float* inverse, float p,
                              float q, float* tangent, float* cosine) {
    if (p == 0 && q == 0) {
        std::fill_n(tangent, kBatch, 0.0f);
        std::fill_n(cosine, kBatch, 1.0f);
        return;
    }
    for (const int i : indices(kBatch)) {
        tangent[i] = (p * x[i] + q * y[i]) * inverse[i];
        cosine[i] = 1 + tangent[i] * tangent[i];
    }
    vector_math::square_roots(cosine, kBatch);
    for (const int i : indices(kBatch)) cosine[i] = 1 / cosine[i];
}

RSC_ALWAYS_INLINE void add_rotated_body(const float* x, const float* y, const float* u,
                                        const float* v, const float* inverse, float p, float q,
                                        double* total) {
    alignas(64) float tangent[kBatch], cosine[kBatch];
    angles(x, y, inverse, p, q, tangent, cosine);
    const auto at = [](const float* numbers, int m) -> const auto& {
        return Unaligned<float, 8>::at(numbers + m);
    };
    Eight xx = {}, xy = {}, yy = {}, lost_u = {}, lost_v = {};
    for (int m = 0; m < kBatch; m += 8) {
        const Eight weight = at(cosine, m).v * at(inverse, m).v, wx = weight * at(x, m).v,
                    lost = 1 - at(cosine, m).v;
        xx += wx * at(x, m).v;
        xy += wx * at(y, m).v;
        yy += weight * at(y, m).v * at(y, m).v;
        lost_u += lost * at(u, m).v;
        lost_v += lost * at(v, m).v;
    }
    for (const int l : indices(8)) {
        total[0] += xx[l];
        total[1] += xy[l];
        total[2] += yy[l];
        total[3] += lost_u[l];
        total[4] += lost_v[l];
    }
}

}  // namespace

RSC_DISPATCH(add_powers, add_powers_body, (const float* z, std::ptrdiff_t count, double* total),
             (z, count, total))
RSC_DISPATCH(add_rotated, add_rotated_body,
             (const float* x, const float* y, const float* u, const float* v, const float* inverse,
              float p, float q, double* total),
             (x, y, u, v, inverse, p, q, total))

void rotation_angles(const float* x, const float* y, const float* inverse, float p, float q,
                     float* tangent, float* cosine) {
    angles(x, y, inverse, p, q, tangent, cosine);
}

}  // namespace rsc
