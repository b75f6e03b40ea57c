#include "surface/measured_spectrum.hpp"

#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "surface/height_distribution.hpp"

namespace rsc {
namespace {

constexpr double kFallen = 0.2;  // threshold of the autocorrelation (ISO 25178-2)
constexpr int kShown = 60;       // most lags stored to either side

// Autocorrelation of heights about their mean at lags up to half the map, averaged over all pairs
// of points with the lag.
class Autocorrelation {
public:
    explicit Autocorrelation(const HeightMap& map)
        : most_x_(map.nx / 2),
          most_y_(map.ny / 2),
          dx_(map.dx),
          dy_(map.dy),
          nx_(padded(map.nx, map.periodic)),
          ny_(padded(map.ny, map.periodic)) {
        const std::ptrdiff_t row = 2 * (nx_ / 2 + 1);
        data_.reset(allocate_doubles(static_cast<std::size_t>(row * ny_),
                                     "the autocorrelation of a height map"));
        double* const z = data_.get();
        auto* const modes = reinterpret_cast<fftw_complex*>(z);
        FftwPlan forward, backward;
        {
            const auto lock = fftw_planning();
            forward.reset(fftw_plan_dft_r2c_2d(ny_, nx_, z, modes, FFTW_ESTIMATE));
            backward.reset(fftw_plan_dft_c2r_2d(ny_, nx_, modes, z, FFTW_ESTIMATE));
        }
        if (!forward || !backward)
            throw Error(Failure::internal, "autocorrelation: FFTW made no plan");
        std::fill(z, z + row * ny_, 0.0);
        const double mean = mean_height(map);
        for (int j = 0; j < map.ny; ++j)
            for (int i = 0; i < map.nx; ++i) z[j * row + i] = map(i, j) - mean;
        fftw_execute(forward.get());
        for (std::ptrdiff_t k = 0; k < row / 2 * ny_; ++k) {
            auto& c = reinterpret_cast<std::complex<double>*>(z)[k];
            c = std::norm(c);
        }
        fftw_execute(backward.get());
        const double at_zero = z[0];
        lags_.resize(static_cast<std::size_t>(2 * most_y_ + 1) *
                     static_cast<std::size_t>(most_x_ + 1));
        for (int j = -most_y_; j <= most_y_; ++j)
            for (int i = 0; i <= most_x_; ++i) {
                const double pairs = map.periodic
                                         ? 1
                                         : (1 - static_cast<double>(i) / map.nx) *
                                               (1 - std::abs(static_cast<double>(j)) / map.ny);
                lag(i, j) = at_zero > 0 ? z[(j < 0 ? j + ny_ : j) * row + i] / (at_zero * pairs)
                                        : std::numeric_limits<double>::quiet_NaN();
            }
    }

    // Value at any lag up to half the map, by bilinear interpolation.
    double at(double x, double y) const {
        if (x < 0) x = -x, y = -y;
        const double u = x / dx_, v = y / dy_;
        const int i = std::min(static_cast<int>(u), most_x_ - 1),
                  j = std::clamp(static_cast<int>(std::floor(v)), -most_y_, most_y_ - 1);
        return std::lerp(std::lerp(of(i, j), of(i + 1, j), u - i),
                         std::lerp(of(i, j + 1), of(i + 1, j + 1), u - i), v - j);
    }

    // Lag at which the autocorrelation first falls to kFallen along a direction; if it does not,
    // minus the longest lag examined.
    double decay(double angle) const {
        const double c = std::cos(angle), s = std::sin(angle), step = 0.25 * std::min(dx_, dy_);
        const double end = std::min(std::abs(c) > 0 ? most_x_ * dx_ / std::abs(c) : HUGE_VAL,
                                    std::abs(s) > 0 ? most_y_ * dy_ / std::abs(s) : HUGE_VAL);
        double last = 1;
        for (double r = step; r <= end * (1 - 1e-12); r += step) {
            const double value = at(r * c, r * s);
            if (value <= kFallen) return r - step * (kFallen - value) / (last - value);
            last = value;
        }
        return -end;
    }

    int most_x() const { return most_x_; }
    int most_y() const { return most_y_; }

private:
    static int padded(int n, bool periodic) { return periodic ? n : n + n / 2 + 1; }
    double& lag(int i, int j) {
        return lags_[static_cast<std::size_t>(j + most_y_) * static_cast<std::size_t>(most_x_ + 1) +
                     static_cast<std::size_t>(i)];
    }
    double of(int i, int j) const { return const_cast<Autocorrelation*>(this)->lag(i, j); }

    int most_x_, most_y_;
    double dx_, dy_;
    int nx_, ny_;
    std::unique_ptr<double[], HeightMap::Free> data_;
    std::vector<double> lags_;
};

void measure_correlation(const HeightMap& map, Texture& t) {
    t.sal = t.str = std::numeric_limits<double>::quiet_NaN();
    if (map.nx < 4 || map.ny < 4) return;
    const Autocorrelation correlation(map);
    if (std::isnan(correlation.at(0, 0))) return;
    double shortest = HUGE_VAL, longest = 0;
    for (int degree = 0; degree < 180; ++degree) {
        const double lag = correlation.decay(degree * std::numbers::pi / 180);
        if (lag > 0) shortest = std::min(shortest, lag);
        t.str_bounded = t.str_bounded || lag < 0;
        longest = std::max(longest, std::abs(lag));
    }
    if (std::isfinite(shortest)) t.sal = shortest, t.str = shortest / longest;
    // The stored part of the plane contains the longest lag, in at most kShown steps to either
    // side.
    const double shown = std::isfinite(shortest) ? 1.5 * longest : HUGE_VAL;
    t.step_x = std::max(map.dx, std::min(shown, correlation.most_x() * map.dx) / kShown);
    t.step_y = std::max(map.dy, std::min(shown, correlation.most_y() * map.dy) / kShown);
    t.reach_x =
        static_cast<int>(std::min(shown, correlation.most_x() * map.dx) / t.step_x * (1 + 1e-12));
    t.reach_y =
        static_cast<int>(std::min(shown, correlation.most_y() * map.dy) / t.step_y * (1 + 1e-12));
    for (int j = -t.reach_y; j <= t.reach_y; ++j)
        for (int i = -t.reach_x; i <= t.reach_x; ++i)
            t.autocorrelation.push_back(correlation.at(i * t.step_x, j * t.step_y));
}

// ISO 13565-2: the line of least squares through the 40 % of the material ratio with the flattest
// secant, extended to 0 and 100 %, bounds the core. Spk and Svk are the heights of triangles with
// the areas of the curve above and below the core, as wide as the material ratios outside it.
void measure_heights(const HeightMap& map, Texture& t) {
    std::vector<double> heights;
    heights.reserve(map.points());
    const double mean = mean_height(map);
    for (int j = 0; j < map.ny; ++j)
        for (int i = 0; i < map.nx; ++i) heights.push_back(map(i, j) - mean);
    std::sort(heights.begin(), heights.end(), std::greater<>());
    constexpr int steps = 1000, secant = 400;
    std::vector<double> curve;
    for (int m = 0; m <= steps; ++m)
        curve.push_back(heights[std::min(heights.size() - 1,
                                         heights.size() * static_cast<std::size_t>(m) / steps)]);
    const auto at = [&](int m) { return curve[static_cast<std::size_t>(m)]; };
    int first = 0;
    for (int m = 0; m + secant <= steps; ++m)
        if (at(m) - at(m + secant) < at(first) - at(first + secant)) first = m;
    double sum = 0, product = 0, square = 0;
    for (int m = 0; m < secant; ++m) {
        const double height = 0.5 * (at(first + m) + at(first + m + 1)),
                     from_middle = m + 0.5 - secant / 2;
        sum += height, product -= from_middle * height, square += from_middle * from_middle;
    }
    const double slope = product / square;  // per quantile step
    const double upper = sum / secant + slope * (first + secant / 2), lower = upper - slope * steps;
    t.sk = upper - lower;
    double above = 0, below = 0;
    std::size_t i = 0, k = heights.size();
    for (; i < heights.size() && heights[i] > upper; ++i) above += heights[i] - upper;
    for (; k > 0 && heights[k - 1] < lower; --k) below += lower - heights[k - 1];
    t.spk = i > 0 ? 2 * above / static_cast<double>(i) : 0;
    t.svk = k < heights.size() ? 2 * below / static_cast<double>(heights.size() - k) : 0;
    for (int i = 0; i < Texture::kScores; ++i)
        t.score.push_back(-5 + 10.0 * i / (Texture::kScores - 1));
    t.height = quantiles(std::move(heights), t.score);
}

}  // namespace

Texture measure_texture(const HeightMap& map) {
    Texture t;
    measure_correlation(map, t);
    measure_heights(map, t);
    return t;
}

}  // namespace rsc
