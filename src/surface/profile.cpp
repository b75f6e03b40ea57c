#include "surface/profile.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "base/error.hpp"
#include "base/format.hpp"
#include "surface/form.hpp"

namespace rsc {
namespace {

constexpr double kPi = pi;
constexpr int kFewestPoints = 16;

double mean_of(const double* z, int n) { return std::accumulate(z, z + n, 0.0) / n; }

}  // namespace

ProfileParameters profile_parameters(const HeightMap& profile, double cutoff_long) {
    const int n = profile.nx;
    const double* const z = profile.row(0);
    const double level = mean_of(z, n);
    ProfileParameters p;
    p.length = profile.Lx();
    p.sampling_length = cutoff_long > 0 && cutoff_long < p.length ? cutoff_long : p.length;
    // Rounding must not lose the last of whole sampling lengths.
    p.samplings = std::max(1, int(p.length / p.sampling_length * (1 + 1e-9)));
    double absolute = 0, square = 0, cube = 0, fourth = 0;
    for (const int i : indices(n)) {
        const double h = z[i] - level;
        absolute += std::abs(h);
        square += h * h;
        cube += h * h * h;
        fourth += h * h * h * h;
    }
    p.ra = absolute / n;
    p.rq = std::sqrt(square / n);
    p.rsk = p.rq > 0 ? cube / n / std::pow(p.rq, 3) : std::nan("");
    p.rku = p.rq > 0 ? fourth / n / std::pow(p.rq, 4) : std::nan("");
    const double points = p.sampling_length / profile.dx;
    for (const int k : indices(p.samplings)) {
        const int first = int(std::lround(k * points)),
                  end = std::min(n, int(std::lround((k + 1) * points)));
        const auto [low, high] = std::minmax_element(z + first, z + end);
        p.rz += (*high - *low) / p.samplings;
    }
    double slopes = 0;
    for (int i = 3; i + 3 < n; ++i) {
        const double slope =
            (z[i + 3] - z[i - 3] - 9 * (z[i + 2] - z[i - 2]) + 45 * (z[i + 1] - z[i - 1])) /
            (60 * profile.dx);
        slopes += slope * slope / (n - 6);
    }
    p.rdq = std::sqrt(slopes);
    return p;
}

void cut_ends(HeightMap& profile, int points, std::vector<std::uint8_t>& mask) {
    const int left = profile.nx - 2 * points;
    if (left < kFewestPoints)
        bad_input(
            format("surface%%cutoff_long: half a cutoff is lost at each end of the profile, "
                   "of which %d of %d points remain; at least %d are needed",
                   std::max(left, 0), profile.nx, kFewestPoints));
    HeightMap part;
    part.allocate(left, 1, left);
    part.dx = profile.dx;
    part.dy = profile.dy;
    part.x0 = profile.x(points);
    part.y0 = profile.y0;
    std::copy_n(profile.row(0) + points, left, part.row(0));
    profile = std::move(part);
    if (mask.empty()) return;
    mask = {mask.begin() + points, mask.begin() + points + left};
    if (std::ranges::find(mask, 1) == mask.end()) mask.clear();
}

void remove_long_waves(HeightMap& profile, double cutoff) {
    HeightMap mean_line = profile.copy();
    gaussian_filter(mean_line, cutoff);
    for (const int i : indices(profile.nx)) profile.row(0)[i] -= mean_line(i, 0);
}

ProfileSpectrum profile_spectrum(const HeightMap& profile, double cutoff_long, double cutoff_short,
                                 Detrend form) {
    // Modes by themselves, then bands as wide as this share of their wavenumber.
    constexpr std::size_t single = 16;
    constexpr double wide = 0.08;
    const ModePowers modes = mode_powers(profile);
    ProfileSpectrum s;
    s.step = modes.step;
    const bool bent = form == Detrend::quadratic || form == Detrend::sphere;
    s.lowest = std::max((bent ? 2.5 : 1.5) * s.step, cutoff_long > 0 ? 2 * kPi / cutoff_long : 0);
    s.highest = std::min(kPi / profile.dx, cutoff_short > 0 ? 2 * kPi / cutoff_short : HUGE_VAL);
    for (std::size_t j = 1; j < modes.power.size();) {
        const std::size_t end =
            std::min(modes.power.size(),
                     j + (j < single ? 1 : std::max<std::size_t>(1, at(wide * double(j)))));
        double sum = 0, logs = 0, count = 0, first = 0;
        for (; j < end; ++j) {
            const double q = double(j) * s.step;
            if (q < s.lowest || q > s.highest) continue;
            double gain = 1;
            if (cutoff_long > 0) gain *= 1 - gaussian_transmission(cutoff_long, q);
            if (cutoff_short > 0) gain *= gaussian_transmission(cutoff_short, q);
            if (count == 0) first = q;
            sum += modes.power[j] / (gain * gain);
            logs += std::log(q);
            count += 1;
        }
        if (count == 0) continue;
        s.wavenumber.push_back(std::exp(logs / count));
        s.psd.push_back(sum / count / s.step);
        s.modes.push_back(count);
        s.middle.push_back(first + 0.5 * (count - 1) * s.step);
    }
    return s;
}

std::vector<double> isotropic_spectrum(const std::vector<double>& wavenumber,
                                       const std::vector<double>& c1) {
    using Rule = boost::math::quadrature::gauss<double, 15>;
    const std::size_t n = wavenumber.size();
    std::vector<double> phi(n, 0.0);
    constexpr double beyond = 1e3;  // the last power law is continued to this multiple
    for (const auto j : indices(n)) {
        const double k = wavenumber[j];
        double sum = 0;
        for (std::size_t i = j; i < n; ++i) {
            const bool last = i + 1 == n;
            const std::size_t a = last ? i - 1 : i;
            if (n < 2 || !(c1[a] > 0 && c1[a + 1] > 0)) continue;
            const double slope =
                std::log(c1[a + 1] / c1[a]) / std::log(wavenumber[a + 1] / wavenumber[a]);
            if (last && !(slope < 0)) continue;
            const double from = wavenumber[i], to = last ? beyond * from : wavenumber[i + 1];
            // C1' dq/sqrt(q^2 - k^2) = slope C1(from)/from^2 (q/from)^(slope - 2) dt with q^2 = k^2
            // + t^2, without a singularity; several pieces where the power law falls far.
            const double t0 = std::sqrt(std::max(from * from - k * k, 0.0)),
                         t1 = std::sqrt(to * to - k * k);
            const int pieces = last ? 40 : 1;
            double low = t0;
            for (int piece = 1; piece <= pieces; ++piece) {
                const double high =
                    last ? t0 + (t1 - t0) * std::pow(double(piece) / pieces, 4) : t1;
                sum += slope * c1[i] / (from * from) *
                       Rule::integrate(
                           [&](double t) {
                               return std::pow((k * k + t * t) / (from * from), 0.5 * slope - 1);
                           },
                           low, high);
                low = high;
            }
        }
        phi[j] = std::max(0.0, -sum / kPi);
    }
    return phi;
}

}  // namespace rsc
