#include "physics/stress/stress.hpp"

namespace rsc {

StressTensor& StressTensor::operator+=(const StressTensor& other) {
    xx += other.xx;
    yy += other.yy;
    zz += other.zz;
    xy += other.xy;
    xz += other.xz;
    yz += other.yz;
    return *this;
}

StressTensor StressTensor::operator*(double factor) const {
    return {factor * xx, factor * yy, factor * zz, factor * xy, factor * xz, factor * yz};
}

// The eigenvalues of the deviator follow from its invariants J2 and J3 by Lode's angle.
StressMeasures measures_of(const StressTensor& s) {
    const double mean = (s.xx + s.yy + s.zz) / 3;
    const double a = s.xx - mean, b = s.yy - mean, c = s.zz - mean;
    const double J2 = 0.5 * (a * a + b * b + c * c) + s.xy * s.xy + s.xz * s.xz + s.yz * s.yz;
    const double J3 = a * (b * c - s.yz * s.yz) - s.xy * (s.xy * c - s.yz * s.xz) +
                      s.xz * (s.xy * s.yz - b * s.xz);
    if (!(J2 > 0)) return {0, 0, mean};
    const double radius = 2 * std::sqrt(J2 / 3);
    const double cosine = std::clamp(1.5 * std::sqrt(3.0) * J3 / (J2 * std::sqrt(J2)), -1.0, 1.0);
    const double angle = std::acos(cosine) / 3;  // 0 ... pi/3
    const double most = radius * std::cos(angle);
    const double least = radius * std::cos(angle + 2 * pi / 3);
    return {std::sqrt(3 * J2), 0.5 * (most - least), mean + most};
}

void LargestStress::Value::take(double other, double x_, double y_) {
    if (!(std::isnan(value) || other > value)) return;
    value = other;
    x = x_;
    y = y_;
}

void LargestStress::take(const StressMeasures& m, double x, double y) {
    mises.take(m.mises, x, y);
    shear.take(m.shear, x, y);
    tension.take(m.tension, x, y);
}

void LargestStress::take(const LargestStress& other) {
    mises.take(other.mises.value, other.mises.x, other.mises.y);
    shear.take(other.shear.value, other.shear.x, other.shear.y);
    tension.take(other.tension.value, other.tension.x, other.tension.y);
}

}  // namespace rsc
