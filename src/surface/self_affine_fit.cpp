#include <boost/math/tools/minima.hpp>

#include "base/error.hpp"
#include "surface/measured_spectrum.hpp"

namespace rsc {
namespace {

constexpr long kFewest = 8;  // smallest number of rings for a fit

// Cumulative weighted sums of 1, x, y, x^2, xy, y^2, from which a line through any range of points
// is fitted at constant cost.
class Sums {
public:
    struct Six {
        double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
        Six operator-(const Six& o) const {
            return {n - o.n, x - o.x, y - o.y, xx - o.xx, xy - o.xy, yy - o.yy};
        }
    };
    Sums(const std::vector<double>& x, const std::vector<double>& y,
         const std::vector<double>& weight)
        : to_(x.size() + 1) {
        for (const auto i : indices(x)) {
            const Six& s = to_[i];
            const double w = weight[i], wx = w * x[i], wy = w * y[i];
            to_[i + 1] = {s.n + w,          s.x + wx,         s.y + wy,
                          s.xx + wx * x[i], s.xy + wx * y[i], s.yy + wy * y[i]};
        }
    }
    Six between(std::size_t first, std::size_t end) const {
        return first < end ? to_[end] - to_[first] : Six{};
    }

private:
    std::vector<Six> to_;
};

struct Line {
    double height = 0, slope = 0;  // y = height + slope x
    double left = 0;               // weighted sum of squared residuals
};

Line line_through(const Sums::Six& s) {
    Line line;
    const double mean_x = s.n > 0 ? s.x / s.n : 0, mean_y = s.n > 0 ? s.y / s.n : 0;
    const double xx = s.xx - s.n * mean_x * mean_x, xy = s.xy - s.n * mean_x * mean_y,
                 yy = s.yy - s.n * mean_y * mean_y;
    if (!(xx > 1e-9 * s.n)) {  // one point, or none
        line.height = mean_y;
        line.left = std::max(0.0, yy);
        return line;
    }
    line.slope = xy / xx;
    line.height = mean_y - line.slope * mean_x;
    line.left = std::max(0.0, yy - line.slope * xy);
    return line;
}

// The power law is fitted to the points from `low` to `high` - 1; a line of its own is fitted to
// those before, and one to those after.
struct Cut {
    std::size_t low = 0, high = 0;
};

class BandSearch {
public:
    BandSearch(const std::vector<double>& x, const std::vector<double>& y,
               const std::vector<double>& weight)
        : x_(x), sums_(x, y, weight), power_(x.size() + 1) {
        for (const auto i : indices(x)) power_[i + 1] = power_[i] + std::exp(x[i] + y[i]);  // k Phi
    }

    Line power_law(const Cut& c) const { return line_through(sums_.between(c.low, c.high)); }
    // Weighted sum of squared residuals, and the sum of weights.
    struct Left {
        double square = 0, weight = 0;
        double mean() const { return square / weight; }
    };
    Left left(const Cut& c) const {
        Left l;
        const auto add = [&](double square, const Sums::Six& s) {
            l.square += square;
            l.weight += s.n;
        };
        add(power_law(c).left, sums_.between(c.low, c.high));
        if (c.low > kBlurred) {
            const Sums::Six s = sums_.between(0, c.low - kBlurred);
            add(line_through(s).left, s);
        }
        if (c.high + kBlurred < x_.size()) {
            const Sums::Six s = sums_.between(c.high + kBlurred, x_.size());
            add(line_through(s).left, s);
        }
        return l;
    }
    // Bayesian information criterion, which penalises additional parameters. Infinite if the band
    // of the cut is not self-affine.
    double cost(const Cut& c) const {
        constexpr double kSteepest = -2 * (1 + 1.5), kFlattest = -2 * (1 - 0.5);
        const double slope = power_law(c).slope;
        // of the mean square height; a band with less is regarded as noise
        constexpr double kLeastPower = 0.01;
        if (slope < kSteepest || slope > kFlattest) return HUGE_VAL;
        if (power_[c.high] - power_[c.low] < kLeastPower * power_.back()) return HUGE_VAL;
        const auto n = double(x_.size());
        double parameters = 2;
        if (c.low > 0) parameters += 3;
        if (c.high < x_.size()) parameters += 3;
        return n * std::log(left(c).mean() + kScatter) + 2 * parameters * std::log(n);
    }
    static constexpr double kScatter = 1e-6;    // (0.1 %)^2: no spectrum is known more accurately
    static constexpr std::size_t kBlurred = 2;  // rings that a Hann window couples with a break

private:
    const std::vector<double>& x_;
    Sums sums_;
    std::vector<double> power_;
};

// Whittle's likelihood of a measured spectrum: the power of a ring is the mean of many independent
// squared amplitudes. The expected power includes the blur by the window. Wavenumbers are in rings.
class Likelihood {
public:
    // The rings from wavenumber `begin` on, before ring `end`.
    Likelihood(const MeasuredSpectrum& s, double begin, std::size_t end) : s_(s), end_(end) {
        while (first_ + 1 < end && s.wavenumber[first_] < begin) ++first_;
        for (std::size_t i = first_; i < end; ++i) weights_ += s.independent * s.modes[i];
    }

    struct Model {
        double kl = 0;
        bool plateau = false;
        double hurst = 0, log_phi0 = 0;
        double misfit = HUGE_VAL;  // -ln of the likelihood, up to a constant
    };
    // The best Hurst exponent and Phi0 of a model.
    Model best(double kl, bool plateau) const {
        Model m{.kl = kl, .plateau = plateau};
        std::uintmax_t rounds = 40;
        std::tie(m.hurst, m.misfit) = boost::math::tools::brent_find_minima(
            [&](double h) { return misfit(kl, plateau, h).first; }, -0.5, 1.5, 18, rounds);
        m.log_phi0 = misfit(kl, plateau, m.hurst).second;
        return m;
    }
    // -ln of the likelihood with the best Phi0, and ln of that Phi0.
    std::pair<double, double> misfit(double kl, bool plateau, double hurst) const {
        const std::vector<double> expected = blurred(kl, plateau, hurst);
        double ratio = 0, logs = 0;
        for (std::size_t i = first_; i < end_; ++i) {
            const double m = s_.independent * s_.modes[i], e = expected[i - first_];
            ratio += m * s_.psd[i] / e;
            logs += m * std::log(e);
        }
        const double log_phi0 = std::log(ratio / weights_);
        return {weights_ * log_phi0 + logs, log_phi0};
    }
    // Second derivative of the misfit by the Hurst exponent.
    double curvature(const Model& m) const {
        constexpr double step = 0.02;
        return (misfit(m.kl, m.plateau, m.hurst + step).first +
                misfit(m.kl, m.plateau, m.hurst - step).first - 2 * m.misfit) /
               (step * step);
    }
    // Mean square residual relative to the statistical scatter, at least 1. Real spectra are not
    // exact power laws.
    double excess(const Model& m) const {
        const std::vector<double> expected = blurred(m.kl, m.plateau, m.hurst);
        double sum = 0;
        for (std::size_t i = first_; i < end_; ++i) {
            const double off = s_.psd[i] / (expected[i - first_] * std::exp(m.log_phi0)) - 1;
            sum += s_.independent * s_.modes[i] * std::min(off * off, 25.0);
        }
        return std::max(1.0, sum / double(end_ - first_) * s_.coupled);
    }
    double lowest() const { return s_.wavenumber[first_]; }
    double highest() const { return s_.wavenumber[end_ - 1]; }

private:
    std::vector<double> blurred(double kl, bool plateau, double hurst) const {
        // of Phi0: leakage over many rings, and deviations from the model
        constexpr double floor = 1e-3;
        const double power = -2 * (1 + hurst), break_at = kl * (1 - 1e-9);
        const auto phi = [&](double q) {
            return q >= break_at ? std::pow(q / kl, power) : plateau ? 1.0 : 0.0;
        };
        std::vector<double> at(s_.places), expected;
        for (std::size_t p = 0; p < at.size(); ++p)
            at[p] = phi(std::max(double(p), 0.5) / MeasuredSpectrum::kPlaces);
        for (std::size_t i = first_; i < end_; ++i) {
            double sum = 0;
            if (i < s_.seen.size())
                for (const auto& [place, share] : s_.seen[i]) sum += share * at[place];
            else
                sum = phi(s_.wavenumber[i]);
            expected.push_back(sum + floor * std::min(1.0, phi(std::max(kl, s_.wavenumber[i]))));
        }
        return expected;
    }

    const MeasuredSpectrum& s_;
    std::size_t first_ = 0, end_;
    double weights_ = 0;
};

}  // namespace

double SelfAffineFit::operator()(double k) const {
    if (k > ks.value * (1 + 1e-12)) return 0;
    if (k < kl.value && kl_seen) return plateau ? Phi0.value : 0;
    return Phi0.value * std::pow(k / kl.value, -2 * (1 + hurst.value));
}

double SelfAffineFit::around(double k) const {
    constexpr int angles = 180;
    double sum = 0;
    for (const int a : indices(angles)) {
        const double angle = pi * (a + 0.5) / angles;
        sum += (*this)(k * std::hypot(std::sqrt(aspect) * std::cos(angle),
                                      std::sin(angle) / std::sqrt(aspect)));
    }
    return aspect == 1 ? (*this)(k) : sum / angles;
}

bool can_fit(const MeasuredSpectrum& spectrum) {
    return std::count_if(spectrum.psd.begin(), spectrum.psd.end(),
                         [](double p) { return p > 0; }) >= kFewest;
}

namespace {

// The rings of a spectrum that have power, their wavenumbers in rings, of which they are whole
// numbers: where a fit ends must not depend on the rounding of a unit of length.
struct PoweredRings {
    std::vector<double> k, x, y, weight;  // x = ln k, y = ln Phi

    explicit PoweredRings(const MeasuredSpectrum& spectrum) {
        double weights = 0;
        for (const auto i : indices(spectrum.psd))
            if (spectrum.psd[i] > 0) {
                const double independent = spectrum.independent * spectrum.modes[i];
                k.push_back(spectrum.wavenumber[i]);
                x.push_back(std::log(spectrum.wavenumber[i]));
                // Bias correction: the logarithm of a mean of M squared amplitudes lies on average
                // 1/(2M) below the logarithm of the expectation.
                y.push_back(std::log(spectrum.psd[i]) + 0.5 / independent);
                weight.push_back(independent);
                weights += independent;
            }
        for (double& w : weight) w *= double(weight.size()) / weights;
    }
};

constexpr std::size_t kShortest = 4;  // smallest number of rings of a power law

Cut best_cut(const BandSearch& search, std::size_t n) {
    Cut best{0, n};
    double least = HUGE_VAL;  // default: one power law over all rings
    const auto try_cut = [&](const Cut& c) {
        if (c.high < c.low + kShortest || c.high > n) return;
        if (const double cost = search.cost(c); cost < least) {
            least = cost;
            best = c;
        }
    };
    // Coarse search with about 60 places per decade, then a fine search around the best cut.
    std::vector<std::size_t> places;
    for (double place = 0; at(place) <= n; place = std::max(place + 1, place * 1.04))
        places.push_back(at(place));
    places.push_back(n);
    for (const std::size_t low : places)
        for (const std::size_t high : places) try_cut({low, high});
    for (int round = 0; round < 3; ++round) {
        const Cut around = best;
        const std::size_t wide = 3 + n / 40;
        for (std::size_t low = around.low > wide ? around.low - wide : 0; low <= around.low + wide;
             ++low)
            try_cut({low, around.high});
        for (std::size_t high = around.high > wide ? around.high - wide : 0;
             high <= around.high + wide; ++high)
            try_cut({best.low, high});
    }
    return best;
}

// Models with a larger misfit than this above the least are outside the 90 % interval.
double allowed_misfit(const Likelihood& likelihood, const Likelihood::Model& m) {
    return 0.5 * 1.645 * 1.645 * likelihood.excess(m);
}

double curvature_of(const Likelihood& likelihood, const Likelihood::Model& m) {
    return std::max(likelihood.curvature(m), 1e-3);
}

// Sets hurst, Phi0, kl and the plateau by the rings before `end`. Returns the model.
Likelihood::Model fit_power_law(const MeasuredSpectrum& spectrum, std::size_t end,
                                double highest_ring, SelfAffineFit& fit) {
    const Likelihood likelihood(spectrum, spectrum.lost, end);
    // kl in steps of a quarter of a ring, later of 4 %. Values below the lowest ring mean that
    // there is no break.
    std::vector<Likelihood::Model> models;
    const double lowest = likelihood.lowest(), highest = 0.5 * likelihood.highest();
    for (double kl = 0.25; kl <= std::max(highest, lowest);
         kl = std::max(kl + 0.25, std::floor(4 * 1.04 * kl) / 4))
        for (const bool plateau : {false, true}) models.push_back(likelihood.best(kl, plateau));
    Likelihood::Model found;
    std::array<double, 2> least_misfit{HUGE_VAL, HUGE_VAL};
    // Of models that differ only below the lowest ring the first one counts.
    constexpr double kEqual = 1e-6;
    for (const Likelihood::Model& m : models) {
        if (m.misfit < found.misfit - kEqual) found = m;
        least_misfit[m.plateau] = std::min(least_misfit[m.plateau], m.misfit);
    }
    const double allowed = allowed_misfit(likelihood, found),
                 curvature = curvature_of(likelihood, found);
    fit.plateau = found.plateau;
    fit.plateau_seen = std::abs(least_misfit[0] - least_misfit[1]) > allowed;
    double low = found.kl, high = found.kl;
    double log_error = 0;
    fit.hurst.value = found.hurst;
    for (const Likelihood::Model& m : models) {
        const double left = allowed - (m.misfit - found.misfit);
        if (left < 0) continue;
        low = std::min(low, m.kl);
        high = std::max(high, m.kl);
        fit.hurst.error = std::max(
            fit.hurst.error, std::abs(m.hurst - found.hurst) + std::sqrt(2 * left / curvature));
        log_error = std::max(log_error, std::abs(m.log_phi0 - found.log_phi0));
    }
    fit.kl_seen = low > std::max(lowest, 1.0);
    // Without a plateau the rings next to kl have fewer effective modes. The exponent is fitted to
    // the rings above them.
    const double above_break = found.kl + 1;
    if (fit.kl_seen && !found.plateau && highest_ring > above_break + kShortest) {
        const Likelihood upper(spectrum, above_break, end);
        const Likelihood::Model again = upper.best(found.kl, false);
        found.hurst = again.hurst;
        fit.hurst.value = again.hurst;
        found.log_phi0 = again.log_phi0;
        fit.hurst.error = std::sqrt(2 * allowed_misfit(upper, again) / curvature_of(upper, again));
    }
    if (fit.kl_seen)
        fit.kl = {found.kl, std::max(high - found.kl, found.kl - low) + 0.25};
    else
        fit.kl = {high, 0};
    // Phi0 belongs to kl.
    const double log_phi0 =
        found.log_phi0 - 2 * (1 + found.hurst) * std::log(fit.kl.value / found.kl);
    log_error +=
        std::abs(likelihood.misfit(found.kl, found.plateau, found.hurst + fit.hurst.error).second -
                 found.log_phi0);
    fit.Phi0 = {std::exp(log_phi0), std::exp(log_phi0) * std::expm1(log_error)};
    return found;
}

constexpr double kHalfRing = 0.5;

// ks is where the spectrum falls to half of the power law; its error is half the range over which
// the end of the power law can move before the residual grows by one variance.
Fitted end_of_power_law(const MeasuredSpectrum& spectrum, const PoweredRings& rings,
                        const BandSearch& search, const Cut& best, const Likelihood::Model& found) {
    const std::vector<double>& k = rings.k;
    const std::size_t n = k.size();
    const double variance =
        spectrum.coupled *
        std::max(search.power_law(best).left / std::max(double(best.high - best.low) - 2, 1.0),
                 BandSearch::kScatter);
    const double limit_left = search.left(best).square + variance;
    const auto may_end = [&](std::size_t to) {
        const Cut c{best.low, to};
        return c.low + kShortest <= c.high && c.high <= n && search.left(c).square <= limit_left;
    };
    std::size_t from = best.high, to = best.high;
    while (from > 0 && may_end(from - 1)) --from;
    while (to < n && may_end(to + 1)) ++to;
    std::size_t last = best.high - 1;
    const auto above = [&](std::size_t i) {  // > 0 if above half of it
        return rings.y[i] - 0.5 / (spectrum.independent * spectrum.modes[i]) - found.log_phi0 +
               2 * (1 + found.hurst) * std::log(k[i] / found.kl) + std::log(2.0);
    };
    const std::size_t limit = std::min(n - 1, best.high + 3);
    while (last < limit && above(last + 1) > 0) ++last;
    while (last > best.low && above(last) <= 0) --last;
    double ks = k[best.high - 1];
    if (last < limit && above(last) > 0 && above(last + 1) <= 0) {
        // Relative to half of the power law.
        const double share_last = std::exp(above(last)), share_next = std::exp(above(last + 1));
        ks = k[last] + (k[last + 1] - k[last]) *
                           std::clamp((share_last - 1) / (share_last - share_next), 0.0, 1.0);
    }
    return {ks, std::max(0.5 * (k[std::min(to, n - 1)] - k[std::min(from, n - 1)]), kHalfRing)};
}

SelfAffineFit fit_in_rings(const MeasuredSpectrum& spectrum) {
    const PoweredRings rings(spectrum);
    const std::size_t n = rings.k.size();
    if (n < kFewest)
        bad_input("the map is too small for a spectrum: it has " + std::to_string(n) +
                  " rings of modes");
    const BandSearch search(rings.x, rings.y, rings.weight);
    const Cut best = best_cut(search, n);
    SelfAffineFit fit;
    fit.ks_seen = best.high < n;
    // The rings next to ks, which the window blurs, are left out.
    const std::size_t blurred = fit.ks_seen ? (spectrum.coupled > 1 ? BandSearch::kBlurred : 1) : 0;
    const std::size_t end =
        best.high - std::min(blurred, best.high > kFewest ? best.high - kFewest : 0);
    const Likelihood::Model found = fit_power_law(spectrum, end, rings.k[end - 1], fit);
    fit.ks = fit.ks_seen ? end_of_power_law(spectrum, rings, search, best, found)
                         : Fitted{rings.k[n - 1], kHalfRing};
    return fit;
}

}  // namespace

SelfAffineFit fit_self_affine(const MeasuredSpectrum& spectrum) {
    MeasuredSpectrum s = spectrum;
    const double unit = s.psd.empty() ? 1 : *std::max_element(s.psd.begin(), s.psd.end());
    for (double& k : s.wavenumber) k = std::round(k / s.ring);
    // Rings of a map without short waves contain only rounding errors.
    constexpr double kRounding = 1e-24;
    for (double& p : s.psd) p = p > 0 ? std::max(p / unit, kRounding) : 0;
    SelfAffineFit fit = fit_in_rings(s);
    for (const auto& [fitted, scale] :
         {std::pair(&fit.kl, s.ring), std::pair(&fit.ks, s.ring), std::pair(&fit.Phi0, unit)}) {
        fitted->value *= scale;
        fitted->error *= scale;
    }
    return fit;
}

}  // namespace rsc
