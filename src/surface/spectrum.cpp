#include "surface/spectrum.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "surface/asperities.hpp"

namespace rsc {
namespace {

// relative to q2: a rounded cutoff such as 0.1*240 includes the modes on it
constexpr double kEdgeTolerance = 1e-12;
// largest L / lambda_s: integer wavevectors and their squares stay in 32 bits
constexpr double kMostModes = 46340.0;

[[noreturn]] void refuse(const std::string& what, double value) {
    bad_input("surface: " + what + ", not " + text_of(value));
}

// (zeta^e - 1)/e, the integral of t^(e-1) from 1 to zeta; accurate also near e = 0, where it is the
// logarithm.
double power_integral(double log_zeta, double e) {
    const double x = e * log_zeta;
    return x == 0.0 ? log_zeta : log_zeta * std::expm1(x) / x;
}

// (1 - xi^q)/q: contribution of the plateau.
double plateau_integral(double xi, double q) { return (1.0 - std::pow(xi, q)) / q; }

}  // namespace

SpectrumTable::SpectrumTable(std::vector<double> wavenumber, std::vector<double> psd,
                             std::size_t angles)
    : k_(std::move(wavenumber)), psd_(std::move(psd)), angles_(angles) {
    const auto wrong = [](std::size_t entry, const std::string& what) {
        bad_input("spectrum: entry " + std::to_string(entry + 1) + ": " + what);
    };
    if (k_.size() < 2 || angles_ < 1 || psd_.size() != k_.size() * angles_)
        bad_input(
            "spectrum: " + std::to_string(k_.size()) + " wavenumbers and " +
            std::to_string(psd_.size()) + " values" +
            (angles_ == 1
                 ? "; equal numbers of them were expected, at least two"
                 : " at " + std::to_string(angles_) +
                       " angles; one for each pair, and at least two wavenumbers, were expected"));
    bool some = false;
    for (std::size_t i = 0; i < k_.size(); ++i) {
        if (!usable_positive(k_[i])) wrong(i, std::string("the wavenumber ") + kPositiveBounds);
        if (i > 0 && !(k_[i] > k_[i - 1])) wrong(i, "wavenumbers must increase");
        for (std::size_t at = i * angles_; at < (i + 1) * angles_; ++at) {
            if (!(psd_[at] >= 0 && usable(psd_[at])))
                wrong(at, "the power spectral density must be finite and not negative");
            some = some || (i > 0 && psd_[at] > 0 && psd_[at - angles_] > 0);
            largest_ = std::max(largest_, psd_[at]);
        }
    }
    if (!some) bad_input("spectrum: the power spectral density is zero everywhere");
}

double SpectrumTable::along(std::size_t ring, double turn) const {
    const double whole = std::floor(turn);
    const auto first = at(whole) % angles_;
    return std::lerp(psd_[ring * angles_ + first], psd_[ring * angles_ + (first + 1) % angles_],
                     turn - whole);
}

double SpectrumTable::operator()(double kx, double ky) const {
    const double k = std::hypot(kx, ky);
    if (!(k >= k_.front() * (1 - kEdgeTolerance) && k <= k_.back() * (1 + kEdgeTolerance)))
        return 0;
    const double angle = std::atan2(ky, kx) / pi,
                 turn = (angle < 0 ? angle + 1 : angle) * double(angles_);
    const auto i = at(std::upper_bound(k_.begin() + 1, k_.end() - 1, k) - k_.begin());
    const double low = along(i - 1, turn), high = along(i, turn);
    if (low == 0 || high == 0) return 0;
    const double t = std::clamp(std::log(k / k_[i - 1]) / std::log(k_[i] / k_[i - 1]), 0.0, 1.0);
    return low * std::pow(high / low, t);
}

// In closed form over the rings, and over the angles by the midpoint rule, which is exact for a
// spectrum that does not depend on them.
double SpectrumTable::integral(int p, int q) const {
    constexpr int parts = 8;  // subdivisions of the step between two angles
    const double step = pi / (parts * double(angles_));
    double sum = 0;
    for (std::size_t a = 0; a < parts * angles_; ++a) {
        const double turn = (double(a) + 0.5) / parts, angle = (double(a) + 0.5) * step;
        double radial = 0;
        for (std::size_t i = 1; i < k_.size(); ++i) {
            const double low = along(i - 1, turn), high = along(i, turn);
            if (low == 0 || high == 0) continue;
            const double log_ratio = std::log(k_[i] / k_[i - 1]), power = p + q + 2;
            radial += low * std::pow(k_[i - 1], power) *
                      power_integral(log_ratio, power + std::log(high / low) / log_ratio);
        }
        sum += radial * std::pow(std::cos(angle), p) * std::pow(std::sin(angle), q);
    }
    return 2 * step * sum;
}

double SpectrumTable::sigma() const { return std::sqrt(integral(0, 0)); }

Spectrum tabulated_spectrum(std::shared_ptr<const SpectrumTable> table, double L, double sigma) {
    Spectrum s;
    s.L = L;
    s.L_lambda_l = table->lowest() * L / (2 * pi);
    s.L_lambda_s = table->highest() * L / (2 * pi);
    s.sigma = sigma;
    s.table = std::move(table);
    return s;
}

double MomentTensor::gentlest_slope() const {
    constexpr double rounding = 1e-12;  // straight ridges
    return std::sqrt(2 * std::max(m2() - std::hypot(0.5 * (m20 - m02), m11), rounding * m2()));
}

double Moments::rms_slope() const { return std::sqrt(2.0 * m2); }
double Moments::summit_density() const {
    double second = m2, fourth = m4;
    // Stretching at constant area leaves the number of summits. With the inverse of the second
    // moments as the metric a stretched isotropic surface is isotropic again, and k.k has the
    // moment 8/3 m4.
    const MomentTensor& t = tensor;
    const double determinant = t.m20 * t.m02 - t.m11 * t.m11;
    const bool waves_of_all_directions = determinant > 1e-6 * t.m20 * t.m02;
    if (waves_of_all_directions && (t.m20 != t.m02 || t.m11 != 0)) {
        second = std::sqrt(determinant);
        fourth = 3.0 / 8.0 / determinant *
                 (t.m02 * t.m02 * t.m40 + t.m20 * t.m20 * t.m04 +
                  (4 * t.m11 * t.m11 + 2 * t.m02 * t.m20) * t.m22 -
                  4 * t.m11 * (t.m02 * t.m31 + t.m20 * t.m13));
    }
    return std::sqrt(3.0) * fourth / (18.0 * pi * second);
}
double Moments::mean_spacing() const { return 1.0 / std::sqrt(summit_density()); }
double Moments::mean_radius() const { return 0.737 / std::sqrt(m4); }

namespace {

// Throws unless some mode of the square lies in the band. A power law has no gaps, so the two ends
// of each column are tested.
void require_modes(const Spectrum& s, const std::string& otherwise) {
    const Band b = band(s);
    for (int kx = 0; kx <= b.highest_kx; ++kx) {
        const auto [first, last] = b.column(kx);
        for (int ky = last; ky >= first; --ky) {
            if (relative_psd(s, kx, ky) > 0.0) return;
            if (!s.table && ky == last) ky = std::min(ky, first + 1);
        }
    }
    refuse(otherwise, s.L_lambda_s);
}

void require_distribution(HeightShape shape) {
    constexpr double near = 1.05;
    const double least = shape.skewness * shape.skewness + 1;
    const auto no = [&](const std::string& bound) {
        bad_input("surface: kurtosis = " + text_of(shape.kurtosis) + " with skewness = " +
                  text_of(shape.skewness) + ": no height distribution has these values; " + bound);
    };
    const std::string value = "skewness^2 + 1 = " + text_of(least);
    if (!(shape.kurtosis > least)) no("the kurtosis must be greater than " + value);
    if (!(shape.kurtosis > near * least))
        no("the kurtosis is too close to its bound " +
           value);  // nearly all heights have one of two values
}

}  // namespace

void validate(const Spectrum& s) {
    if (!(shortest_wave(s) <= kMostModes))
        refuse("the shortest wave in any direction, as L/lambda, must be at most 46340",
               shortest_wave(s));
    if (!s.gaussian() && !s.heights) require_distribution(s.shape);
    require_modes(
        s, s.table ? "no mode of the square lies within the spectrum; its largest wavenumber times "
                     "L over 2 pi must be larger"
                   : "no mode of the square lies between L_lambda_l = " + text_of(s.L_lambda_l) +
                         " and L_lambda_s; choose a larger L_lambda_s");
}

Stretch stretch(const Spectrum& s) {
    if (s.aspect == 1) return {};
    const double angle = s.direction * pi / 180, c = std::cos(angle), d = std::sin(angle);
    const double along = s.aspect, across = 1 / s.aspect;
    return {along * c * c + across * d * d, (along - across) * c * d,
            along * d * d + across * c * c};
}

double shortest_wave(const Spectrum& s) {
    return s.L_lambda_s * std::sqrt(std::max(s.aspect, 1 / s.aspect));
}

Band::Run Band::column(int kx) const {
    const double rest = stretched.yy * highest_q2 - double(kx) * kx;
    if (rest < 0.0) return {};
    const double root = std::sqrt(rest), middle = -stretched.xy * kx;
    return {int(std::ceil((middle - root) / stretched.yy)),
            int(std::floor((middle + root) / stretched.yy))};
}

Band band(const Spectrum& s) {
    Band b;
    b.stretched = stretch(s);
    b.lowest_q2 = s.L_lambda_l * s.L_lambda_l * (1.0 - kEdgeTolerance);
    b.highest_q2 = s.L_lambda_s * s.L_lambda_s * (1.0 + kEdgeTolerance);
    b.highest_kx = int(std::sqrt(b.stretched.yy * b.highest_q2));
    b.highest_ky = int(std::sqrt(b.stretched.xx * b.highest_q2));
    return b;
}

double relative_psd(const Spectrum& s, double kx, double ky) {
    const double step = 2 * pi / s.L;
    if (s.by_direction()) return (*s.table)(step * kx, step * ky) / s.table->largest();
    const Band b = band(s);
    const double q2 = b.stretched(kx, ky);
    if (s.table) return (*s.table)(step * std::sqrt(q2)) / s.table->largest();
    if (!(q2 > 0.0 && q2 <= b.highest_q2)) return 0.0;
    if (q2 < b.lowest_q2) return s.plateau ? 1.0 : 0.0;
    return std::pow(q2 / (s.L_lambda_l * s.L_lambda_l), -(1.0 + s.hurst));
}

// k = A k' with k' of an isotropic surface, i.e. kx = a.k' and ky = b.k'; <(a.k')^4> = m4 |a|^4 and
// <(k1' k2')^2> = m4/3.
MomentTensor directional_moments(double m2, double m4, double aspect, double direction) {
    if (aspect == 1) direction = 0;  // makes the moments along x and y exactly equal
    const double angle = direction * pi / 180, c = std::cos(angle), s = std::sin(angle);
    const double aa = c * c / aspect + s * s * aspect, bb = s * s / aspect + c * c * aspect,
                 ab = c * s * (1 / aspect - aspect);
    return {m2 * aa,      m2 * ab,      m2 * bb,
            m4 * aa * aa, m4 * aa * ab, m4 / 3 * (aa * bb + 2 * ab * ab),
            m4 * bb * ab, m4 * bb * bb};
}

namespace {

// m_p = T(p) times the integral of K^(p+1) Phi(K) over K, where T(p) is the integral of cos^p over
// the circle; in units of kl.
Moments isotropic_moments(const Spectrum& s) {
    if (s.table) {
        const double scale = s.sigma * s.sigma / s.table->integral(0, 0);
        return {s.sigma * s.sigma,
                scale * s.table->integral(2, 0),
                scale * s.table->integral(4, 0),
                {},
                {}};
    }
    const double kl = 2.0 * pi * s.L_lambda_l / s.L;
    const double log_zeta = std::log(s.L_lambda_s / s.L_lambda_l);
    const double xi = 1.0 / s.L_lambda_l;
    const auto radial = [&](double p) {
        return (s.plateau ? plateau_integral(xi, p + 2.0) : 0.0) +
               power_integral(log_zeta, p - 2.0 * s.hurst);
    };
    const double scale = s.sigma * s.sigma / (2.0 * radial(0.0));  // pi Phi0 kl^2
    Moments m;
    m.m0 = s.sigma * s.sigma;
    m.m2 = scale * kl * kl * radial(2.0);
    m.m4 = scale * 0.75 * kl * kl * kl * kl * radial(4.0);
    return m;
}

}  // namespace

Moments theoretical_moments(const Spectrum& s) {
    validate(s);
    if (s.by_direction()) {
        const double scale = s.sigma * s.sigma / s.table->integral(0, 0);
        const auto moment = [&](int p, int q) { return scale * s.table->integral(p, q); };
        const MomentTensor tensor{moment(2, 0), moment(1, 1), moment(0, 2), moment(4, 0),
                                  moment(3, 1), moment(2, 2), moment(1, 3), moment(0, 4)};
        return {s.sigma * s.sigma, tensor.m2(), tensor.m4(), tensor, {}};
    }
    Moments m = isotropic_moments(s);
    m.tensor = directional_moments(m.m2, m.m4, s.aspect, s.direction);
    if (s.aspect != 1) {
        m.m2 = m.tensor.m2();
        m.m4 = m.tensor.m4();
    }
    return m;
}

Moments discrete_moments(const Spectrum& s) {
    validate(s);
    const Band b = band(s);
    const double step = 2.0 * pi / s.L;
    double s0 = 0, s2 = 0, s4 = 0;
    for (int kx = 0; kx <= b.highest_kx; ++kx) {
        const double x2 = double(kx) * kx;
        const auto [first, last] = b.column(kx);
        for (int ky = first; ky <= last; ++ky) {
            const double y2 = double(ky) * ky;
            const double w = (kx > 0 ? 2.0 : 1.0) * relative_psd(s, kx, ky);
            s0 += w;
            s2 += w * (x2 + y2) / 2.0;
            s4 += w * (!s.directional() ? (x2 * x2 + y2 * y2 + 3.0 * x2 * y2) / 3.0
                                        : 3.0 / 8.0 * (x2 + y2) * (x2 + y2));
        }
    }
    const double scale = s.sigma * s.sigma / s0;
    return {s.sigma * s.sigma,
            scale * step * step * s2,
            scale * step * step * step * step * s4,
            {},
            {}};
}

}  // namespace rsc
