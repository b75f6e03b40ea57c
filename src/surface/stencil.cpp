#include "surface/stencil.hpp"

#include "base/dispatch.hpp"
#include "base/error.hpp"
#include "base/format.hpp"

namespace rsc {
namespace {

constexpr int kHalf = Stencil::kHalf;

// Parts of the weights of the points i >= 0 that are symmetric and antisymmetric in i.
struct Halves {
    alignas(64) double part[2][Stencil::kOrders][kHalf];
};

RSC_ALWAYS_INLINE void add_series_body(const double (*centre)[kHalf], int derivatives,
                                       const double* power, int orders, Halves& halves) {
    for (const int p : indices(orders)) {
        double even[kHalf] = {}, odd[kHalf] = {};
        for (int q = (p + 1) / 2 * 2; q < derivatives; q += 2)
            for (const int i : indices(kHalf)) even[i] += power[q - p] * centre[q][i];
        for (int q = p / 2 * 2 + 1; q < derivatives; q += 2)
            for (const int i : indices(kHalf)) odd[i] += power[q - p] * centre[q][i];
        for (const int i : indices(kHalf)) {
            halves.part[0][p][i] = even[i] + odd[i];
            halves.part[1][p][i] = even[i] - odd[i];
        }
    }
}

RSC_DISPATCH(add_series, add_series_body,
             (const double (*centre)[kHalf], int derivatives, const double* power, int orders,
              Halves& halves),
             (centre, derivatives, power, orders, halves))

// Least squares by modified Gram-Schmidt: the columns become orthonormal in place, R is stored in
// the upper triangle.
class LeastSquares {
public:
    LeastSquares(std::vector<std::vector<double>> columns)
        : q_(std::move(columns)), r_(q_.size(), std::vector<double>(q_.size())) {
        for (std::size_t j = 0; j < q_.size(); ++j) {
            r_[j][j] = std::sqrt(dot(q_[j], q_[j]));
            for (double& v : q_[j]) v /= r_[j][j];
            for (std::size_t k = j + 1; k < q_.size(); ++k) r_[j][k] = take_out(q_[j], q_[k]);
        }
    }

    // Returns the solution and replaces `b` by the residual.
    std::vector<double> solve(std::vector<double>& b) const {
        std::vector<double> x(q_.size());
        for (const auto j : indices(q_)) x[j] = take_out(q_[j], b);
        for (std::size_t j = q_.size(); j-- > 0;) {
            for (std::size_t k = j + 1; k < q_.size(); ++k) x[j] -= r_[j][k] * x[k];
            x[j] /= r_[j][j];
        }
        return x;
    }

    static double dot(const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (const auto i : indices(a)) sum += a[i] * b[i];
        return sum;
    }

private:
    static double take_out(const std::vector<double>& q, std::vector<double>& b) {
        const double part = dot(q, b);
        for (const auto i : indices(b)) b[i] -= part * q[i];
        return part;
    }

    std::vector<std::vector<double>> q_, r_;
};

}  // namespace

// A wave exp(iks) gives w_0 + 2 sum w_i cos(ki) with a symmetric stencil and 2i sum w_i sin(ki)
// with an antisymmetric one. The weights are fitted to (ik)^q for 0 < k < cutoff.
double Stencil::fit(double cutoff) {
    constexpr int kWaves = 160;
    // wavenumber, relative to the cutoff, below which the weight is constant
    constexpr double kLongest = 1.0 / 256;
    constexpr double kExponent = -2.6;  // of the profile spectrum for H = 0.8
    // Weights that the band does not determine are kept small, so that rounding errors of the
    // heights are not amplified.
    constexpr double kRidge = 1e-15;
    std::vector<double> k(kWaves), weight(kWaves);
    double energy = 0;
    for (const int j : indices(kWaves)) {
        const double angle = 0.5 * pi * (j + 0.5) / kWaves;
        const auto at = std::size_t(j);
        k[at] = cutoff * std::sin(angle);
        const double square =
            std::pow(std::max(std::sin(angle), kLongest), kExponent) * std::cos(angle);
        weight[at] = std::sqrt(square);
        energy += square;
    }
    double left4 = 0, left5 = 0, size4 = 1;  // squared residuals of the fits of W_4 and W_5
    for (const int odd : indices(2)) {
        const int unknowns = reach_ + 1 - odd;
        std::vector<std::vector<double>> columns(at(unknowns));
        for (const int u : indices(unknowns)) {
            auto& column = columns[at(u)];
            const int i = u + odd;
            for (const auto j : indices(k))
                column.push_back(
                    weight[j] *
                    (i == 0 ? 1.0 : 2.0 * (odd ? std::sin(k[j] * i) : std::cos(k[j] * i))));
            for (const int v : indices(unknowns))
                column.push_back(v == u ? kRidge * std::sqrt(energy) : 0.0);
        }
        const LeastSquares fit(std::move(columns));
        for (int q = odd; q < kDerivatives; q += 2) {
            const double sign = q / 2 % 2 == 0 ? 1.0 : -1.0;
            std::vector<double> target;
            for (const auto j : indices(k)) target.push_back(sign * weight[j] * std::pow(k[j], q));
            target.resize(target.size() + at(unknowns), 0.0);
            const double size = LeastSquares::dot(target, target);
            const std::vector<double> w = fit.solve(target);
            for (const int u : indices(unknowns)) centre_[q][u + odd] = w[at(u)];
            if (q == 4) {
                left4 = LeastSquares::dot(target, target);
                size4 = size;
            }
            if (q == 5) left5 = LeastSquares::dot(target, target);
        }
    }
    return std::sqrt((left4 + 0.25 * left5) /
                     size4);  // of the Taylor series at t = 1/2, where the error is largest
}

Stencil Stencil::band_limited(double points_per_wave) {
    if (!(points_per_wave >= 4 * (1 - 1e-12)))
        bad_input(
            "summits between grid points require at least 4 points in the shortest wavelength, "
            "not " +
            text_of(points_per_wave));
    constexpr double kWanted = 1e-8;
    thread_local std::pair<double, Stencil> last{
        0, Stencil(0)};  // the same one serves every place of a tip
    for (int reach = 4; last.first != points_per_wave; ++reach) {
        last.second = Stencil(reach);
        last.second.band_known_ = true;
        if (last.second.fit(2 * pi / points_per_wave) < kWanted || reach == kMostReach)
            last.first = points_per_wave;
    }
    return last.second;
}

// The polynomial that is 1 at point i and 0 at the others is prod (t - v)/(i - v); its coefficients
// are products of integers.
Stencil Stencil::polynomial(int reach) {
    Stencil stencil(reach);
    stencil.derivatives_ = std::min(2 * reach + 1, kDerivatives);
    for (int i = 0; i <= reach; ++i) {
        std::array<double, kTaps> c{1};
        double scale = 1;
        for (int v = -reach; v <= reach; ++v) {
            if (v == i) continue;
            for (std::size_t k = c.size() - 1; k > 0; --k) c[k] = c[k - 1] - v * c[k];
            c[0] *= -v;
            scale *= i - v;
        }
        double factorial = 1;
        for (int q = 0; q < stencil.derivatives_; factorial *= ++q)
            stencil.centre_[q][i] = factorial * c[at(q)] / scale;
    }
    return stencil;
}

void Stencil::weights(double t, int orders, double (*weight)[kTaps]) const {
    double power[kDerivatives];  // t^r/r!
    power[0] = 1;
    for (int r = 1; r < derivatives_; ++r) power[r] = power[r - 1] * t / r;
    Halves halves;
    add_series(centre_, derivatives_, power, orders, halves);
    for (const int o : indices(orders)) {
        const double* const right = halves.part[0][o];
        const double* const left = halves.part[1][o];
        for (int i = 1; i <= reach_; ++i) weight[o][reach_ - i] = left[i];
        for (int i = 0; i <= reach_; ++i) weight[o][reach_ + i] = right[i];
        for (int i = 2 * reach_ + 1; i < kTaps; ++i) weight[o][i] = 0;
    }
}

}  // namespace rsc
