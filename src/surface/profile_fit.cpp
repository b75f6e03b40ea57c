#include <boost/math/special_functions/beta.hpp>

#include "base/error.hpp"
#include "surface/profile.hpp"

namespace rsc {
namespace {

constexpr double kPi = pi;
constexpr long kFewest = 8;        // smallest number of bands for a fit
constexpr double kHann = 0.514;    // share of independent modes under a Hann window
constexpr double kNinety = 1.645;  // half width of a 90 % interval in standard deviations
// Differences of the misfit below this, times the excess scatter, are within the 90 % interval.
constexpr double kAllowed = 0.5 * kNinety * kNinety;
constexpr std::size_t kBlurred = 12;  // modes whose blur by the window is computed

enum Parameter { hurst, log_kl, log_ks, log_noise, kParameters };
using Point = std::array<double, kParameters>;

// int of u^(H - 1/2) (1 - u)^(-1/2) du from 0 to (q/k)^2: the part of C1 from the waves beyond k.
double part_beyond(double q, double k, double h) {
    using namespace boost::math::policies;
    constexpr policy<promote_double<false>> in_double;
    const double u = std::min(q * q / (k * k), 1.0);
    return boost::math::beta(h + 0.5, 0.5, u, in_double);
}

// C1/(Phi0 kl): the band, and the plateau below it.
double shape(double q, double kl, double ks, double h, bool plateau) {
    if (q >= ks) return 0;
    const double x = q / kl, band = std::pow(x, -1 - 2 * h) *
                                    (part_beyond(q, std::max(q, kl), h) - part_beyond(q, ks, h));
    return band + (plateau && x < 1 ? 2 * std::sqrt(1 - x * x) : 0.0);
}

// -ln of Whittle's likelihood of a spectrum, with the best Phi0.
class Likelihood {
public:
    explicit Likelihood(const ProfileSpectrum& s) : s_(s), window_(squared_transform(false)) {
        for (const double m : s.modes) weights_ += kHann * m;
    }

    // C1/(Phi0 kl) of each band, without noise.
    std::vector<double> expected(const Point& x, bool plateau) const {
        const double kl = std::exp(x[log_kl]), ks = std::exp(x[log_ks]);
        std::vector<double> e(s_.psd.size());
        for (const auto i : indices(e)) {
            const double q = s_.wavenumber[i], mode = q / s_.step;
            if (mode > double(kBlurred)) {
                e[i] = of_band(i, kl, ks, x[hurst], plateau);
                continue;
            }
            double sum = 0, shares = 0;
            const int reach = int(window_.size()) - 1;
            for (int u = -reach; u <= reach; ++u) {
                const double share = window_[std::size_t(std::abs(u))];
                sum += share * shape(std::max(std::abs(mode + 0.5 * u), 0.25) * s_.step, kl, ks,
                                     x[hurst], plateau);
                shares += share;
            }
            e[i] = sum / shares;
        }
        return e;
    }
    // The mean over a band, which the window makes wider; in the middle unless there is an end of
    // the self-affine band near it, where C1 has a corner.
    double of_band(std::size_t i, double kl, double ks, double h, bool plateau) const {
        constexpr int points = 8;
        constexpr double near = 1.3;
        const auto [low, high] = borders(i);
        if (high * near < ks && low / near > kl) return shape(s_.wavenumber[i], kl, ks, h, plateau);
        double sum = 0;
        for (const int k : indices(points))
            sum += shape(low + (k + 0.5) / points * (high - low), kl, ks, h, plateau) / points;
        return sum;
    }
    // The share of the modes of a band that its mean depends on: where C1 ends, only those before
    // the end.
    double evenness(std::size_t i, const Point& x, bool plateau) const {
        constexpr int points = 64;
        const auto [low, high] = borders(i);
        double sum = 0, squares = 0;
        for (const int k : indices(points)) {
            const double c =
                shape(std::max(low + (k + 0.5) / points * (high - low), 0.25 * s_.step),
                      std::exp(x[log_kl]), std::exp(x[log_ks]), x[hurst], plateau) +
                std::exp(x[log_noise]) + kLeast;
            sum += c;
            squares += c * c;
        }
        return std::max(sum * sum / (points * squares), 1 / s_.modes[i]);
    }
    // The misfit, and ln(Phi0 kl).
    std::pair<double, double> misfit(std::vector<double> e, double noise) const {
        double ratio = 0, logs = 0;
        for (const auto i : indices(e)) {
            e[i] += noise + kLeast;
            const double m = kHann * s_.modes[i];
            ratio += m * s_.psd[i] / e[i];
            logs += m * std::log(e[i]);
        }
        const double scale = std::log(ratio / weights_);
        return {weights_ * scale + logs, scale};
    }
    std::pair<double, double> misfit(const Point& x, bool plateau) const {
        if (x[hurst] < -0.45 || x[hurst] > kMostHurst || !(x[log_ks] > x[log_kl] + 0.05))
            return {HUGE_VAL, 0};
        return misfit(expected(x, plateau), std::exp(x[log_noise]));
    }
    const ProfileSpectrum& spectrum() const { return s_; }
    static constexpr double kLeast = 1e-30;  // relative to C1 at kl: no logarithm of 0

private:
    // Of a band, with what the window adds to it.
    std::pair<double, double> borders(std::size_t i) const {
        constexpr double window = 4;  // squared width, in modes
        const double width = s_.step * std::sqrt(s_.modes[i] * s_.modes[i] + window),
                     low = s_.middle[i] - 0.5 * width;
        return {low, low + width};
    }

    const ProfileSpectrum& s_;
    std::array<double, 6> window_;
    double weights_ = 0;
};

struct Model {
    Point x{};
    bool plateau = false;
    double misfit = HUGE_VAL, scale = 0;  // ln(Phi0 kl)
};

// Nelder and Mead's simplex over the parameters that are not `held`.
Model minimise(const Likelihood& likelihood, Model start, const std::array<bool, kParameters>& held,
               double size) {
    std::vector<Model> simplex{start};
    const auto at = [&](Point x) {
        Model m{x, start.plateau};
        std::tie(m.misfit, m.scale) = likelihood.misfit(x, start.plateau);
        return m;
    };
    simplex[0] = at(start.x);
    for (int k = 0; k < kParameters; ++k) {
        if (held[std::size_t(k)]) continue;
        Point x = start.x;
        x[std::size_t(k)] += (k == hurst ? 0.3 : 1.0) * size;
        simplex.push_back(at(x));
    }
    const std::size_t n = simplex.size() - 1;
    constexpr int most = 600;
    constexpr double arrived = 1e-7;
    for (int step = 0; step < most; ++step) {
        std::ranges::sort(simplex, {}, &Model::misfit);
        if (simplex[n].misfit - simplex[0].misfit < arrived) break;
        Point middle{};
        for (const auto i : indices(n))
            for (std::size_t k = 0; k < kParameters; ++k) middle[k] += simplex[i].x[k] / double(n);
        const auto along = [&](double t) {
            Point x;
            for (std::size_t k = 0; k < kParameters; ++k)
                x[k] = middle[k] + t * (simplex[n].x[k] - middle[k]);
            return at(x);
        };
        const Model turned = along(-1);
        if (turned.misfit < simplex[0].misfit) {
            const Model farther = along(-2);
            simplex[n] = farther.misfit < turned.misfit ? farther : turned;
        } else if (turned.misfit < simplex[n - 1].misfit) {
            simplex[n] = turned;
        } else {
            const Model nearer = along(turned.misfit < simplex[n].misfit ? -0.5 : 0.5);
            if (nearer.misfit < std::min(turned.misfit, simplex[n].misfit)) {
                simplex[n] = nearer;
                continue;
            }
            for (std::size_t i = 1; i <= n; ++i) {
                Point x;
                for (std::size_t k = 0; k < kParameters; ++k)
                    x[k] = 0.5 * (simplex[0].x[k] + simplex[i].x[k]);
                simplex[i] = at(x);
            }
        }
    }
    return *std::ranges::min_element(simplex, {}, &Model::misfit);
}

// The parts of C1/(Phi0 kl) that end at each of the wavenumbers `ends`, in the middle of each band.
std::vector<std::vector<double>> parts_beyond(const std::vector<double>& ends,
                                              const std::vector<double>& q, double h) {
    std::vector<std::vector<double>> parts;
    for (const double end : ends) {
        parts.emplace_back();
        for (const double wave : q)
            parts.back().push_back(part_beyond(wave, std::max(wave, end), h));
    }
    return parts;
}

// The best of a coarse grid of models, with and without a plateau.
std::array<Model, 2> best_of_grid(const Likelihood& likelihood) {
    const ProfileSpectrum& s = likelihood.spectrum();
    const double low = std::log(0.5 * s.wavenumber.front()), high = std::log(s.wavenumber.back());
    constexpr int kls = 20, kss = 14;
    std::vector<double> kl, ks{std::exp(high + 5)};
    for (const int k : indices(kls)) kl.push_back(std::exp(low + (high - low) * 0.8 * k / kls));
    for (const int k : indices(kss)) ks.push_back(std::exp(high - (high - low) * 0.8 * k / kss));
    std::array<Model, 2> best;
    best[1].plateau = true;
    // Noise as high as the last band, or none.
    const double last = s.psd.back() / *std::ranges::max_element(s.psd);
    std::vector<double> e(s.psd.size());
    for (double h = -0.2; h < 1.45; h += 0.2) {
        const auto first = parts_beyond(kl, s.wavenumber, h),
                   beyond = parts_beyond(ks, s.wavenumber, h);
        for (const auto l : indices(kl))
            for (const auto r : indices(ks)) {
                if (!(std::log(ks[r] / kl[l]) > 0.5)) continue;
                for (const bool plateau : {false, true}) {
                    for (const auto i : indices(e)) {
                        const double x = s.wavenumber[i] / kl[l];
                        e[i] = std::pow(x, -1 - 2 * h) * (first[l][i] - beyond[r][i]) +
                               (plateau && x < 1 ? 2 * std::sqrt(1 - x * x) : 0.0);
                    }
                    const double top = *std::ranges::max_element(e);
                    for (const double noise : {1e-9 * top, last * top}) {
                        Model m{{h, std::log(kl[l]), std::log(ks[r]), std::log(noise)}, plateau};
                        std::tie(m.misfit, m.scale) = likelihood.misfit(e, noise);
                        if (m.misfit < best[plateau].misfit) best[plateau] = m;
                    }
                }
            }
    }
    return best;
}

// Mean square height and mean square slope of a profile, over Phi0 kl.
std::pair<double, double> moments(const Point& x, bool plateau) {
    const double kl = std::exp(x[log_kl]), ratio = x[log_ks] - x[log_kl];
    const auto power = [&](double e) { return e * ratio == 0 ? ratio : std::expm1(e * ratio) / e; };
    const double m0 = 2 * kPi * kl * (power(-2 * x[hurst]) + (plateau ? 0.5 : 0)),
                 m2 = kPi * kl * kl * kl * (power(2 - 2 * x[hurst]) + (plateau ? 0.25 : 0));
    return {m0, m2};
}

// Standard deviations from Fisher's information, over ln(Phi0 kl) and the parameters that are free.
class Errors {
public:
    Errors(const Likelihood& likelihood, const Model& best,
           const std::array<bool, kParameters>& held)
        : best_(best), held_(held) {
        const ProfileSpectrum& s = likelihood.spectrum();
        const auto logs = [&](const Point& x) {
            std::vector<double> e = likelihood.expected(x, best.plateau);
            for (double& v : e) v = std::log(v + std::exp(x[log_noise]) + Likelihood::kLeast);
            return e;
        };
        const std::vector<double> here = logs(best.x);
        std::vector<std::vector<double>> slopes{std::vector<double>(here.size(), 1.0)};
        for (std::size_t k = 0; k < kParameters; ++k) {
            Point up = best.x, down = best.x;
            up[k] += kStep;
            down[k] -= kStep;
            const std::vector<double> a = logs(up), b = logs(down);
            slopes.emplace_back(here.size(), 0.0);
            for (std::size_t i = 0; !held[k] && i < a.size(); ++i)
                slopes.back()[i] = (a[i] - b[i]) / (2 * kStep);
        }
        double square = 0;
        for (const auto i : indices(here)) {
            const double m = kHann * s.modes[i] * likelihood.evenness(i, best.x, best.plateau),
                         off = s.psd[i] / std::exp(here[i] + best.scale) - 1;
            for (std::size_t a = 0; a <= kParameters; ++a)
                for (std::size_t b = 0; b <= kParameters; ++b)
                    information_[a][b] += m * slopes[a][i] * slopes[b][i];
            square += m * std::min(off * off, 25.0);
        }
        excess_ = std::max(1.0, square / (double(here.size()) - double(kParameters) - 1));
        factorise();
    }
    // Of a quantity with these derivatives by ln(Phi0 kl) and the parameters.
    double of(const std::array<double, kParameters + 1>& slope) const {
        std::array<double, kParameters + 1> y{};
        double sum = 0;
        for (std::size_t i = 0; i <= kParameters; ++i) {
            y[i] = slope[i];
            for (const auto k : indices(i)) y[i] -= factor_[i][k] * y[k];
            y[i] = factor_[i][i] > 0 ? y[i] / factor_[i][i] : 0.0;
            sum += y[i] * y[i];
        }
        return std::sqrt(excess_ * sum);
    }
    double of(Parameter parameter) const {
        std::array<double, kParameters + 1> slope{};
        slope[std::size_t(parameter) + 1] = 1;
        return of(slope);
    }
    // Relative, of the root of a function of the parameters times Phi0 kl.
    double of_root(const std::function<double(const Point&)>& square) const {
        std::array<double, kParameters + 1> slope{0.5};
        for (std::size_t k = 0; k < kParameters; ++k) {
            if (held_[k]) continue;
            Point up = best_.x, down = best_.x;
            up[k] += kStep;
            down[k] -= kStep;
            slope[k + 1] = 0.5 * std::log(square(up) / square(down)) / (2 * kStep);
        }
        return of(slope);
    }
    double excess() const { return excess_; }

private:
    static constexpr double kStep = 1e-3;
    void factorise() {
        constexpr double none = 1e-9;  // a parameter that changes nothing
        for (std::size_t i = 0; i <= kParameters; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = information_[i][j];
                for (const auto k : indices(j)) sum -= factor_[i][k] * factor_[j][k];
                if (i == j)
                    factor_[i][i] = sum > none * information_[0][0] ? std::sqrt(sum) : 0.0;
                else
                    factor_[i][j] = factor_[j][j] > 0 ? sum / factor_[j][j] : 0.0;
            }
    }

    Model best_;
    std::array<bool, kParameters> held_;
    std::array<std::array<double, kParameters + 1>, kParameters + 1> information_{}, factor_{};
    double excess_ = 1;
};

// Profiles without short waves have rounding errors there, of which noise could not be told.
ProfileSpectrum with_rounding(ProfileSpectrum spectrum) {
    constexpr double rounding = 1e-12;
    const double highest = *std::ranges::max_element(spectrum.psd);
    for (double& p : spectrum.psd) p = std::max(p, rounding * highest);
    return spectrum;
}

// Sets rms height and slope of the fitted band, whose ends are those of `band` where they are not
// seen.
void rms_of_band(const Model& best, const Point& band, const Errors& errors, ProfileFit& fit) {
    const SelfAffineFit& s = fit.surface;
    const auto square = [&](const Point& x, bool slope) {
        Point limits = x;
        if (!s.kl_seen) limits[log_kl] = band[log_kl];
        if (!s.ks_seen) limits[log_ks] = band[log_ks];
        // Phi0 kl belongs to the fitted kl.
        const double moved = std::pow(std::exp(limits[log_kl] - x[log_kl]), -1 - 2 * x[hurst]);
        const auto [m0, m2] = moments(limits, s.plateau);
        return moved * (slope ? m2 : m0);
    };
    for (const bool slope : {false, true}) {
        const double value = std::sqrt(std::exp(best.scale) * square(best.x, slope));
        const double error = errors.of_root([&](const Point& x) { return square(x, slope); });
        (slope ? fit.slope : fit.sigma) = {value, value * kNinety * error};
    }
}

}  // namespace

double profile_of_self_affine(const SelfAffineFit& s, double q) {
    return s.Phi0.value * s.kl.value *
           shape(std::max(std::abs(q), 1e-9 * s.kl.value), s.kl.value, s.ks.value, s.hurst.value,
                 s.plateau);
}

bool can_fit(const ProfileSpectrum& spectrum) {
    return std::ranges::count_if(spectrum.psd, [](double p) { return p > 0; }) >= kFewest;
}

ProfileFit fit_profile(const ProfileSpectrum& spectrum) {
    if (!can_fit(spectrum))
        bad_input("the profile is too short for a spectrum: it has ", spectrum.psd.size(),
                  " bands of waves");
    const ProfileSpectrum rounded = with_rounding(spectrum);
    const Likelihood likelihood(rounded);
    std::array<bool, kParameters> held{};
    std::array<Model, 2> models = best_of_grid(likelihood);
    for (Model& m : models)
        for (const double size : {1.0, 0.2}) m = minimise(likelihood, m, held, size);
    Model best = models[models[1].misfit < models[0].misfit];
    const double allowed = kAllowed * Errors(likelihood, best, held).excess();
    ProfileFit fit;
    SelfAffineFit& s = fit.surface;
    // Seen is what cannot be moved beyond the spectrum within the interval.
    const auto seen = [&](Parameter parameter, double elsewhere) {
        std::array<bool, kParameters> fixed = held;
        fixed[std::size_t(parameter)] = true;
        Model moved = best;
        moved.x[std::size_t(parameter)] = elsewhere;
        for (const double size : {1.0, 0.2}) moved = minimise(likelihood, moved, fixed, size);
        if (moved.misfit > best.misfit + allowed) return true;
        held = fixed;
        best = moved;
        return false;
    };
    s.ks_seen = seen(log_ks, std::log(30 * spectrum.highest));
    s.kl_seen = seen(log_kl, std::log(0.3 * spectrum.wavenumber.front()));
    s.plateau = s.kl_seen && best.plateau;
    s.plateau_seen = s.kl_seen && std::abs(models[0].misfit - models[1].misfit) > allowed;
    const Errors errors(likelihood, best, held);
    s.hurst = {best.x[hurst], kNinety * errors.of(hurst)};
    const double scale = std::exp(best.scale), fitted_kl = std::exp(best.x[log_kl]);
    // The band of the surface ends where the spectrum does.
    Point band = best.x;
    if (!s.kl_seen) band[log_kl] = std::log(spectrum.lowest);
    if (!s.ks_seen) band[log_ks] = std::log(spectrum.highest);
    const auto fitted = [&](Parameter parameter, bool is_seen) {
        const double value = std::exp(band[std::size_t(parameter)]);
        // An end is not known better than half the main lobe of a Hann window.
        constexpr double lobe = 2;  // modes
        const double error = value * kNinety * errors.of(parameter);
        return Fitted{value, is_seen ? std::max(error, lobe * spectrum.step) : 0.0};
    };
    s.kl = fitted(log_kl, s.kl_seen);
    s.ks = fitted(log_ks, s.ks_seen);
    const double phi0 =
        scale / fitted_kl * std::pow(s.kl.value / fitted_kl, -2 - 2 * best.x[hurst]);
    s.Phi0 = {phi0, phi0 * kNinety * errors.of({1, 0, -1, 0, 0})};
    const double noise = scale * std::exp(best.x[log_noise]);
    fit.noise = noise > 0.1 * *std::ranges::min_element(spectrum.psd) ? noise : 0.0;
    rms_of_band(best, band, errors, fit);
    return fit;
}

}  // namespace rsc
