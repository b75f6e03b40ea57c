#include "rough/measured_spectrum.hpp"

#include "error.hpp"
#include "rough/library_lock.hpp"

namespace rsc {
namespace {

constexpr long kFewest = 8;  // smallest number of rings for a fit

std::vector<double> hann(int n, bool none) {
    std::vector<double> w(static_cast<std::size_t>(n), 1.0);
    if (none) return w;
    for (int i = 0; i < n; ++i) w[static_cast<std::size_t>(i)] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (i + 0.5) / n);
    return w;
}

// Cumulative weighted sums of 1, x, y, x^2, xy, y^2, from which a line through any range of points is fitted at constant cost.
class Sums {
public:
    struct Six {
        double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
        Six operator-(const Six& o) const { return {n - o.n, x - o.x, y - o.y, xx - o.xx, xy - o.xy, yy - o.yy}; }
    };
    Sums(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& weight) : to_(x.size() + 1) {
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Six& s = to_[i];
            const double w = weight[i], wx = w * x[i], wy = w * y[i];
            to_[i + 1] = {s.n + w, s.x + wx, s.y + wy, s.xx + wx * x[i], s.xy + wx * y[i], s.yy + wy * y[i]};
        }
    }
    Six between(std::size_t first, std::size_t end) const { return first < end ? to_[end] - to_[first] : Six{}; }

private:
    std::vector<Six> to_;
};

struct Line {
    double height = 0, slope = 0;                                    // y = height + slope x
    double left = 0;                                                 // weighted sum of squared residuals
    double height_variance = 0, slope_variance = 0, covariance = 0;  // in units of the variance of y
};

Line line_through(const Sums::Six& s) {
    Line line;
    const double mean_x = s.n > 0 ? s.x / s.n : 0, mean_y = s.n > 0 ? s.y / s.n : 0;
    const double xx = s.xx - s.n * mean_x * mean_x, xy = s.xy - s.n * mean_x * mean_y, yy = s.yy - s.n * mean_y * mean_y;
    if (!(xx > 1e-9 * s.n)) {  // one point, or none
        line.height = mean_y;
        line.left = std::max(0.0, yy);
        return line;
    }
    line.slope = xy / xx;
    line.height = mean_y - line.slope * mean_x;
    line.left = std::max(0.0, yy - line.slope * xy);
    line.slope_variance = 1 / xx;
    line.height_variance = 1 / s.n + mean_x * mean_x / xx;
    line.covariance = -mean_x / xx;
    return line;
}

// The power law covers the points from `low` to `high` - 1. Points before `low` form a plateau at its height or have a separate line;
// points from `high` on have a separate line.
struct Cut {
    std::size_t low = 0, high = 0;
    bool plateau = false;
};

class BandSearch {
public:
    BandSearch(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& weight)
        : x_(x), sums_(x, y, weight), power_(x.size() + 1) {
        for (std::size_t i = 0; i < x.size(); ++i) power_[i + 1] = power_[i] + std::exp(x[i] + y[i]);  // k Phi
    }

    Line power_law(const Cut& c) const {
        Sums::Six s = sums_.between(c.low, c.high);
        if (c.plateau && c.low > 0) {
            // The points of the plateau are fitted as if they were at kl.
            const Sums::Six p = sums_.between(0, c.low);
            const double x = x_[c.low];
            s = {s.n + p.n, s.x + p.n * x, s.y + p.y, s.xx + p.n * x * x, s.xy + x * p.y, s.yy + p.yy};
        }
        return line_through(s);
    }
    // Weighted sum of squared residuals, and the sum of weights.
    struct Left {
        double square = 0, weight = 0;
        double mean() const { return square / weight; }
    };
    Left left(const Cut& c) const {
        Left l;
        const auto add = [&](double square, const Sums::Six& s) { l.square += square, l.weight += s.n; };
        add(power_law(c).left, sums_.between(c.plateau ? 0 : c.low, c.high));
        if (!c.plateau && c.low > kBlurred) {
            const Sums::Six s = sums_.between(0, c.low - kBlurred);
            add(line_through(s).left, s);
        }
        if (c.high + kBlurred < x_.size()) {
            const Sums::Six s = sums_.between(c.high + kBlurred, x_.size());
            add(line_through(s).left, s);
        }
        return l;
    }
    // Bayesian information criterion, which penalises additional parameters. Infinite if the band of the cut is not self-affine.
    double cost(const Cut& c) const {
        constexpr double kSteepest = -2 * (1 + 1.5), kFlattest = -2 * (1 - 0.5);
        const double slope = power_law(c).slope;
        constexpr double kLeastPower = 0.01;  // of the mean square height; a band with less is regarded as noise
        if (slope < kSteepest || slope > kFlattest) return HUGE_VAL;
        if (power_[c.high] - power_[c.low] < kLeastPower * power_.back()) return HUGE_VAL;
        const auto n = static_cast<double>(x_.size());
        double parameters = 2;
        if (c.low > 0) parameters += c.plateau ? 1 : 3;
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

}  // namespace

namespace {

// Accumulates the power of modes by ring and angle.
class Plane {
public:
    explicit Plane(std::size_t rings) : group_(rings + 1), power_{}, count_{} {
        // Rings are grouped: single rings first, then groups as wide as a tenth of their wavenumber. first_ holds the first ring of every
        // group.
        for (std::size_t r = 1; r <= rings;) {
            const std::size_t next = std::min(rings + 1, r + std::max<std::size_t>(1, r / 10));
            // The last ring is a group of its own, so that the table ends with the spectrum.
            const std::size_t end = r < rings && next == rings + 1 ? rings : next;
            for (std::size_t i = r; i < end; ++i) group_[i] = first_.size();
            first_.push_back(r), last_.push_back(end - 1);
            r = end;
        }
        power_.resize(first_.size() * kAngles), count_.resize(first_.size() * kAngles);
    }
    void add(std::size_t ring, double kx, double ky, double power, double copies) {
        if (ring == 0) return;
        const double turn = std::atan2(ky, kx) / std::numbers::pi * kAngles;
        const auto angle = static_cast<std::size_t>(std::floor(turn + 0.5) + kAngles) % kAngles;
        power_[group_[ring] * kAngles + angle] += power;
        count_[group_[ring] * kAngles + angle] += copies;
    }
    void finish(MeasuredSpectrum& s, double ring, double scale) const {
        for (std::size_t g = 0; g < first_.size(); ++g) {
            const double middle = std::sqrt(static_cast<double>(first_[g]) * static_cast<double>(last_[g]));
            s.plane_wavenumber.push_back(middle * ring);
            for (std::size_t a = 0; a < kAngles; ++a) {
                // Angles spanned by two modes; the half circle has middle*pi modes.
                auto wide = static_cast<std::size_t>(kAngles / (std::numbers::pi * middle));
                double power = 0, count = 0;
                for (; count == 0 && wide < kAngles; ++wide) {
                    const std::size_t reach = std::min(wide, kAngles / 2 - 1);
                    for (std::size_t t = 0; t <= 2 * reach; ++t) {
                        const std::size_t place = g * kAngles + (a + kAngles + t - reach) % kAngles;
                        power += power_[place], count += count_[place];
                    }
                }
                s.plane_psd.push_back(count > 0 ? scale * power / count : 0);
            }
        }
    }

private:
    static constexpr std::size_t kAngles = MeasuredSpectrum::kAngles;
    std::vector<std::size_t> group_, first_, last_;
    std::vector<double> power_, count_;
};

}  // namespace

double MeasuredSpectrum::lay() const {
    double best = -1, angle = 0;
    for (std::size_t a = 0; a < kAngles; ++a) {
        double power = 0;
        for (std::size_t g = 1; g < plane_wavenumber.size(); ++g)
            power += plane_psd[g * kAngles + a] * plane_wavenumber[g] * (plane_wavenumber[g] - plane_wavenumber[g - 1]);
        if (power > best) best = power, angle = 180.0 * static_cast<double>(a) / kAngles;
    }
    return angle < 90 ? angle + 90 : angle - 90;
}

double SelfAffineFit::operator()(double k) const {
    if (k > ks.value * (1 + 1e-12)) return 0;
    if (k < kl.value) return plateau ? Phi0.value : 0;
    return Phi0.value * std::pow(k / kl.value, -2 * (1 + hurst.value));
}

double SelfAffineFit::around(double k) const {
    constexpr int angles = 180;
    double sum = 0;
    for (int a = 0; a < angles; ++a) {
        const double angle = std::numbers::pi * (a + 0.5) / angles;
        sum += (*this)(k * std::hypot(std::sqrt(aspect) * std::cos(angle), std::sin(angle) / std::sqrt(aspect)));
    }
    return aspect == 1 ? (*this)(k) : sum / angles;
}

MeasuredSpectrum measure_spectrum(const HeightMap& map, double aspect, double direction) {
    const int nx = map.nx, ny = map.ny, columns = nx / 2 + 1;
    const std::vector<double> wx = hann(nx, map.periodic), wy = hann(ny, map.periodic);
    // The windowed mean is subtracted, because the window turns a constant into a wave as long as the map.
    double sum = 0, weights = 0, squares = 0;
    for (int j = 0; j < ny; ++j) {
        double row = 0, row_w = 0, row_s = 0;
        for (int i = 0; i < nx; ++i) {
            const double w = wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)];
            row += w * map(i, j), row_w += w, row_s += w * w;
        }
        sum += row, weights += row_w, squares += row_s;
    }
    const double mean = sum / weights;
    const std::unique_ptr<double[], HeightMap::Free> buffer(
        allocate_doubles(2 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(ny), "the spectrum of a height map"));
    double* const z = buffer.get();
    auto* const modes = reinterpret_cast<std::complex<double>*>(z);
    FftwPlan plan;
    {
        const auto lock = fftw_planning();
        plan.reset(fftw_plan_dft_r2c_2d(ny, nx, z, reinterpret_cast<fftw_complex*>(z), FFTW_ESTIMATE));
    }
    if (!plan) throw Error(Failure::internal, "spectrum: FFTW made no plan");
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            z[static_cast<std::ptrdiff_t>(j) * 2 * columns + i] =
                wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)] * (map(i, j) - mean);
    fftw_execute(plan.get());

    const double step_x = 2 * std::numbers::pi / map.Lx(), step_y = 2 * std::numbers::pi / map.Ly(), ring = std::min(step_x, step_y);
    // Up to this stretched wavenumber the grid holds waves of all directions.
    const double stretch = std::sqrt(aspect), nyquist = std::numbers::pi / (std::max(map.dx, map.dy) * stretch);
    const double along = std::cos(direction), across = std::sin(direction);
    const auto rings = static_cast<std::size_t>(std::max(1.0, std::floor(nyquist / ring * (1 + 1e-12) + 0.5)));
    std::vector<double> power(rings + 1, 0.0), count(rings + 1, 0.0);
    Plane plane(rings);
    for (int j = 0; j < ny; ++j) {
        const double ky = step_y * (j <= ny / 2 ? j : j - ny);
        for (int i = 0; i < columns; ++i) {
            const double kx = step_x * i, q = std::hypot(stretch * (kx * along + ky * across), (ky * along - kx * across) / stretch) / ring;
            if (!(q < static_cast<double>(rings) + 0.5)) continue;
            const auto r = static_cast<std::size_t>(q + 0.5);
            const double copies = i == 0 || 2 * i == nx ? 1 : 2;  // counts the mirror image in the other half plane
            const double of_mode = copies * std::norm(modes[static_cast<std::ptrdiff_t>(j) * columns + i]);
            power[r] += of_mode;
            count[r] += copies;
            if (aspect == 1) plane.add(r, kx, ky, of_mode, copies);
        }
    }
    // By Parseval's theorem the squared modes add up to nx ny times the sum of the squared windowed heights.
    const double scale = 1 / (static_cast<double>(nx) * ny * squares * step_x * step_y);
    MeasuredSpectrum s;
    // For a Hann window (sum w^2)^2/(n sum w^4) = 0.514 in each direction, so a share 0.27 of the modes in a ring is independent. Half of
    // that is used: it also compensates for the blur by the window and gave more accurate Hurst exponents for 100 known spectra.
    constexpr double kHann = 0.514;
    s.independent = map.periodic ? 0.5 : 0.5 * kHann * kHann;
    s.coupled = map.periodic ? 1 : 1 / kHann;
    for (std::size_t r = 1; r <= rings; ++r) {
        if (count[r] == 0) continue;  // rings of a narrow map may have no modes
        s.wavenumber.push_back(static_cast<double>(r) * ring);
        s.psd.push_back(scale * power[r] / count[r]);
        s.modes.push_back(count[r]);
    }
    if (aspect == 1) plane.finish(s, ring, scale);
    return s;
}

bool can_fit(const MeasuredSpectrum& spectrum) {
    return std::count_if(spectrum.psd.begin(), spectrum.psd.end(), [](double p) { return p > 0; }) >= kFewest;
}

SelfAffineFit fit_self_affine(const MeasuredSpectrum& spectrum) {
    std::vector<double> k, x, y, weight;
    double weights = 0;
    for (std::size_t i = 0; i < spectrum.psd.size(); ++i)
        if (spectrum.psd[i] > 0) {
            const double independent = spectrum.independent * spectrum.modes[i];
            k.push_back(spectrum.wavenumber[i]);
            x.push_back(std::log(spectrum.wavenumber[i]));
            // Bias correction: the logarithm of a mean of M squared amplitudes lies on average 1/(2M) below the logarithm of the
            // expectation.
            y.push_back(std::log(spectrum.psd[i]) + 0.5 / independent);
            weight.push_back(independent);
            weights += independent;
        }
    for (double& w : weight) w *= static_cast<double>(weight.size()) / weights;
    constexpr std::size_t kShortest = 4;  // smallest number of rings of a power law
    const std::size_t n = x.size();
    if (n < kFewest)
        throw Error(Failure::bad_input, "the map is too small for a spectrum: it has " + std::to_string(n) + " rings of modes");
    const BandSearch search(x, y, weight);
    Cut best{0, n, false};
    double least = HUGE_VAL;  // default: one power law over all rings
    const auto try_cut = [&](const Cut& c) {
        if (c.high < c.low + kShortest || c.high > n) return;
        if (c.plateau && c.low == 0) return;  // same as no plateau
        if (const double cost = search.cost(c); cost < least) least = cost, best = c;
    };
    // Coarse search with about 60 places per decade, then a fine search around the best cut.
    std::vector<std::size_t> places;
    for (double place = 0; static_cast<std::size_t>(place) <= n; place = std::max(place + 1, place * 1.04))
        places.push_back(static_cast<std::size_t>(place));
    places.push_back(n);
    for (const bool plateau : {false, true})
        for (const std::size_t low : places)
            for (const std::size_t high : places) try_cut({low, high, plateau});
    for (int round = 0; round < 3; ++round) {
        const Cut around = best;
        const std::size_t wide = 3 + n / 40;
        for (std::size_t low = around.low > wide ? around.low - wide : 0; low <= around.low + wide; ++low)
            try_cut({low, around.high, around.plateau});
        for (std::size_t high = around.high > wide ? around.high - wide : 0; high <= around.high + wide; ++high)
            try_cut({best.low, high, around.plateau});
    }

    // The line is fitted without the blurred rings at the breaks.
    const double half_ring = 0.5 * spectrum.wavenumber[0];
    Cut inner = best;
    if (best.high < n && inner.high > inner.low + kShortest) --inner.high;
    if (best.low > 0 && !best.plateau && inner.high > inner.low + kShortest) ++inner.low;
    const Line line = search.power_law(inner);
    SelfAffineFit fit;
    fit.plateau = best.plateau;
    fit.ks_seen = best.high < n;
    const double points = static_cast<double>(best.high - (best.plateau ? 0 : best.low));
    const double variance = spectrum.coupled * std::max(line.left / std::max(points - 2, 1.0), BandSearch::kScatter);
    fit.hurst = {-0.5 * line.slope - 1, 0.5 * std::sqrt(variance * line.slope_variance)};

    // Half the range over which a break can move before the residual grows by one variance.
    const auto reach = [&](auto moved, std::size_t at) {
        const double limit = search.left(best).square + variance;
        const auto allowed = [&](std::size_t to) {
            const Cut c = moved(to);
            return c.low + kShortest <= c.high && c.high <= n && search.left(c).square <= limit;
        };
        std::size_t low = at, high = at;
        while (low > 0 && allowed(low - 1)) --low;
        while (high < n && allowed(high + 1)) ++high;
        const double width = k[std::min(high, n - 1)] - k[std::min(low, n - 1)];
        return std::max(0.5 * width, half_ring / std::sqrt(3.0));
    };
    if (best.low == 0) {
        fit.kl = {k[0], half_ring};
    } else if (fit.plateau) {
        fit.kl = {k[best.low], reach([&](std::size_t low) { return Cut{low, best.high, true}; }, best.low)};
    } else {
        fit.kl = {k[best.low], reach([&](std::size_t low) { return Cut{low, best.high, false}; }, best.low)};
    }
    if (!fit.ks_seen) {
        fit.ks = {k[n - 1], half_ring};
    } else {
        // ks is where the spectrum falls to half of the fitted line.
        std::size_t last = best.high - 1;
        const double half = std::log(2.0);
        const auto above = [&](std::size_t i) { return y[i] - (line.height + line.slope * x[i]) + half; };  // > 0 if above half of the line
        const std::size_t limit = std::min(n - 1, best.high + 3);
        while (last < limit && above(last + 1) > 0) ++last;
        while (last > best.low && above(last) <= 0) --last;
        double ks = k[best.high - 1];
        if (last < limit && above(last) > 0 && above(last + 1) <= 0) {
            const double share_last = std::exp(above(last)), share_next = std::exp(above(last + 1));  // relative to half of the line
            ks = k[last] + (k[last + 1] - k[last]) * std::clamp((share_last - 1) / (share_last - share_next), 0.0, 1.0);
        }
        fit.ks = {ks, reach([&](std::size_t high) { return Cut{best.low, high, best.plateau}; }, best.high)};
    }
    const double xl = std::log(fit.kl.value), log_phi = line.height + line.slope * xl;
    const double log_variance = variance * (line.height_variance + 2 * xl * line.covariance + xl * xl * line.slope_variance);
    fit.Phi0 = {std::exp(log_phi), std::exp(log_phi) * std::sqrt(std::max(0.0, log_variance))};
    return fit;
}

HeightParameters height_parameters(const HeightMap& map) {
    const double points = static_cast<double>(map.nx) * map.ny;
    const auto mean_power = [&](double level, int power) {
        double sum = 0;
        for (int j = 0; j < map.ny; ++j) {
            double row = 0;
            for (int i = 0; i < map.nx; ++i) row += std::pow(map(i, j) - level, power);
            sum += row;
        }
        return sum / points;
    };
    const double level = mean_power(0, 1);
    HeightParameters p;
    p.sq = std::sqrt(mean_power(level, 2));
    p.ssk = mean_power(level, 3) / std::pow(p.sq, 3);
    p.sku = mean_power(level, 4) / std::pow(p.sq, 4);
    p.sdq = grid_moments(map).rms_slope();
    return p;
}

Isotropy isotropy(const HeightMap& map) {
    double xx = 0, xy = 0, yy = 0;
    for (int j = 0; j + 1 < map.ny; ++j) {
        double row_xx = 0, row_xy = 0, row_yy = 0;
        for (int i = 0; i + 1 < map.nx; ++i) {
            // Gradient at the centre of four points.
            const double a = map(i, j), b = map(i + 1, j), c = map(i, j + 1), d = map(i + 1, j + 1);
            const double zx = 0.5 * (b - a + d - c) / map.dx, zy = 0.5 * (c - a + d - b) / map.dy;
            row_xx += zx * zx, row_xy += zx * zy, row_yy += zy * zy;
        }
        xx += row_xx, xy += row_xy, yy += row_yy;
    }
    const double mean = 0.5 * (xx + yy), apart = std::hypot(0.5 * (xx - yy), xy);
    if (!(mean + apart > 0)) return {};
    return {std::sqrt(std::max(0.0, mean - apart) / (mean + apart)), 0.5 * (std::atan2(xy, 0.5 * (xx - yy)) + std::numbers::pi)};
}

}  // namespace rsc
