#include "surface/measured_spectrum.hpp"

#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "surface/height_distribution.hpp"

namespace rsc {
std::array<double, kWindowReach + 1> squared_transform(bool periodic) {
    std::array<double, kWindowReach + 1> window{};
    for (int u = 0; u <= kWindowReach; ++u) {
        const auto sinc = [](double x) { return x == 0 ? 1.0 : std::sin(pi * x) / (pi * x); };
        const double amplitude =
            0.5 * sinc(0.5 * u) + 0.25 * (sinc(0.5 * u - 1) + sinc(0.5 * u + 1));
        window[at(u)] = periodic ? (u == 0 ? 1.0 : 0.0) : amplitude * amplitude;
    }
    return window;
}

namespace {

std::vector<double> hann(int n, bool none) {
    std::vector<double> w(at(n), 1.0);
    if (none) return w;
    for (const int i : indices(n)) w[at(i)] = 0.5 - 0.5 * std::cos(2 * pi * (i + 0.5) / n);
    return w;
}

// The nearest whole number. On maps with commensurate sides many modes lie midway between two
// rings: rounding must not divide them.
std::size_t nearest(double q) { return at(q * (1 + 1e-12) + 0.5); }

// Accumulates the power of modes by ring and angle.
class Plane {
public:
    explicit Plane(std::size_t rings) : group_(rings + 1), power_{}, count_{} {
        // Rings are grouped: single rings first, then groups as wide as a tenth of their
        // wavenumber. first_ holds the first ring of every group.
        for (std::size_t r = 1; r <= rings;) {
            const std::size_t next = std::min(rings + 1, r + std::max<std::size_t>(1, r / 10));
            // The last ring is a group of its own, so that the table ends with the spectrum.
            const std::size_t end = r < rings && next == rings + 1 ? rings : next;
            for (std::size_t i = r; i < end; ++i) group_[i] = first_.size();
            first_.push_back(r);
            last_.push_back(end - 1);
            r = end;
        }
        power_.resize(first_.size() * kAngles);
        count_.resize(first_.size() * kAngles);
    }
    void add(std::size_t ring, double kx, double ky, double power, double copies) {
        if (ring == 0) return;
        const double turn = std::atan2(ky, kx) / pi * kAngles;
        const auto angle = at(std::floor(turn + 0.5) + kAngles) % kAngles;
        power_[group_[ring] * kAngles + angle] += power;
        count_[group_[ring] * kAngles + angle] += copies;
    }
    void finish(MeasuredSpectrum& s, double ring, double scale) const {
        for (std::size_t g = 0; g < first_.size(); ++g) {
            const double middle = std::sqrt(double(first_[g]) * double(last_[g]));
            s.plane_wavenumber.push_back(middle * ring);
            for (const auto a : indices(kAngles)) {
                // Angles spanned by two modes; the half circle has middle*pi modes.
                auto wide = at(kAngles / (pi * middle));
                double power = 0, count = 0;
                for (; count == 0 && wide < kAngles; ++wide) {
                    const std::size_t reach = std::min(wide, kAngles / 2 - 1);
                    for (std::size_t t = 0; t <= 2 * reach; ++t) {
                        const std::size_t place = g * kAngles + (a + kAngles + t - reach) % kAngles;
                        power += power_[place];
                        count += count_[place];
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

using Buffer = std::unique_ptr<double[], HeightMap::Free>;

// The window of a map, and the modes of the windowed heights.
class WindowedMap {
public:
    explicit WindowedMap(const HeightMap& map)
        : map_(map), wx_(hann(map.nx, map.periodic)), wy_(hann(map.ny, map.periodic)) {}

    int columns() const { return map_.nx / 2 + 1; }
    double squares() const { return squares_; }  // of the window; after modes()

    // Modes (i, j), i < columns(), are numbers j * columns() + i of the buffer.
    Buffer modes() {
        const int nx = map_.nx, ny = map_.ny;
        const double mean = subtracted_mean();
        Buffer buffer(allocate_doubles(2 * at(columns()) * at(ny), "the spectrum of a height map"));
        double* const z = buffer.get();
        FftwPlan plan;
        {
            const auto lock = fftw_planning();
            plan.reset(
                fftw_plan_dft_r2c_2d(ny, nx, z, reinterpret_cast<fftw_complex*>(z), FFTW_ESTIMATE));
        }
        if (!plan) throw Error(Failure::internal, "spectrum: FFTW made no plan");
        for (const int j : indices(ny))
            for (const int i : indices(nx))
                z[static_cast<std::ptrdiff_t>(j) * 2 * columns() + i] =
                    weight(i, j) * (map_(i, j) - mean);
        fftw_execute(plan.get());
        return buffer;
    }

private:
    double weight(int i, int j) const { return wx_[at(i)] * wy_[at(j)]; }
    // The windowed mean is subtracted, because the window turns a constant into a wave as long as
    // the map.
    double subtracted_mean() {
        double sum = 0, weights = 0;
        squares_ = 0;
        for (const int j : indices(map_.ny)) {
            double row = 0, row_w = 0, row_s = 0;
            for (const int i : indices(map_.nx)) {
                const double w = weight(i, j);
                row += w * map_(i, j);
                row_w += w;
                row_s += w * w;
            }
            sum += row;
            weights += row_w;
            squares_ += row_s;
        }
        return sum / weights;
    }

    const HeightMap& map_;
    std::vector<double> wx_, wy_;
    double squares_ = 0;
};

// The rings of modes: ellipses of constant stretched wavenumber with a lay.
struct Rings {
    double step_x, step_y, ring;
    double stretch, along, aside;
    std::size_t count;

    Rings(const HeightMap& map, double aspect, double direction)
        : step_x(2 * pi / map.Lx()),
          step_y(2 * pi / map.Ly()),
          ring(std::min(step_x, step_y)),
          stretch(std::sqrt(aspect)),
          along(std::cos(direction)),
          aside(std::sin(direction)) {
        // Up to this stretched wavenumber the grid holds waves of all directions.
        const double nyquist = pi / (std::max(map.dx, map.dy) * stretch);
        count = at(std::max(1.0, std::floor(nyquist / ring * (1 + 1e-12) + 0.5)));
    }

    // The stretched wavenumber of a mode, in rings.
    double of(double kx, double ky) const {
        return std::hypot(stretch * (kx * along + ky * aside),
                          (ky * along - kx * aside) / stretch) /
               ring;
    }
};

// The sensitivity of the rings of long waves to each wavenumber, from the squared transform of the
// window.
std::vector<std::map<std::size_t, double>> sensitivity(const HeightMap& map, const Rings& rings) {
    const int nx = map.nx, ny = map.ny;
    const std::array<double, kWindowReach + 1> window = squared_transform(map.periodic);
    constexpr std::size_t long_rings = 32;
    std::vector<std::map<std::size_t, double>> seen(std::min(rings.count, long_rings) + 1);
    const int half = map.periodic ? 0 : kWindowReach;
    const int far = int(std::ceil((long_rings + 0.5) * rings.stretch * rings.ring /
                                  std::min(rings.step_x, rings.step_y)));
    for (int j = -std::min(far, ny / 2); j <= std::min(far, ny / 2); ++j)
        for (int i = 0; i <= std::min(far, nx / 2); ++i) {
            const std::size_t r = nearest(rings.of(rings.step_x * i, rings.step_y * j));
            if (r == 0 || r >= seen.size()) continue;
            for (int v = -half; v <= half; ++v)
                for (int u = -half; u <= half; ++u) {
                    const double share = window[at(std::abs(u))] * window[at(std::abs(v))];
                    const double q =
                        rings.of(rings.step_x * (i + 0.5 * u), rings.step_y * (j + 0.5 * v));
                    seen[r][nearest(q * MeasuredSpectrum::kPlaces)] += (i == 0 ? 1 : 2) * share;
                }
        }
    return seen;
}

// The power of all modes, summed by ring and by direction.
struct ModePower {
    std::vector<double> power, count;   // by ring
    Plane plane;                        // of isotropic rings
    std::complex<double> directed = 0;  // mean direction of the power, at twice the angle

    ModePower(const HeightMap& map, const Rings& rings, bool isotropic, int columns,
              const std::complex<double>* modes)
        : power(rings.count + 1, 0.0), count(rings.count + 1, 0.0), plane(rings.count) {
        const int nx = map.nx, ny = map.ny;
        for (const int j : indices(ny)) {
            const double ky = rings.step_y * (j <= ny / 2 ? j : j - ny);
            for (const int i : indices(columns)) {
                const double kx = rings.step_x * i;
                const std::size_t r = nearest(rings.of(kx, ky));
                if (r > rings.count) continue;
                // Counts the mirror image in the other half plane.
                const double copies = i == 0 || 2 * i == nx ? 1 : 2;
                const double of_mode =
                    copies * std::norm(modes[static_cast<std::ptrdiff_t>(j) * columns + i]);
                power[r] += of_mode;
                count[r] += copies;
                if (!isotropic) continue;
                plane.add(r, kx, ky, of_mode, copies);
                if (r > 0) directed += std::polar(of_mode, 2 * std::atan2(ky, kx));
            }
        }
    }
};

}  // namespace

MeasuredSpectrum measure_spectrum(const HeightMap& map, double aspect, double direction) {
    const Rings rings(map, aspect, direction);
    WindowedMap windowed(map);
    const Buffer buffer = windowed.modes();
    const ModePower modes(map, rings, aspect == 1, windowed.columns(),
                          reinterpret_cast<const std::complex<double>*>(buffer.get()));
    const auto seen = sensitivity(map, rings);
    // By Parseval's theorem the squared modes add up to nx ny times the sum of the squared windowed
    // heights.
    const double scale =
        1 / (double(map.nx) * map.ny * windowed.squares() * rings.step_x * rings.step_y);
    MeasuredSpectrum s;
    s.ring = rings.ring;
    // For a Hann window (sum w^2)^2/(n sum w^4) = 0.514 in each direction, so a share 0.27 of the
    // modes in a ring is independent. Half of that is used: it also compensates for the blur by the
    // window and gave more accurate Hurst exponents for 100 known spectra.
    constexpr double kHann = 0.514;
    s.independent = map.periodic ? 0.5 : 0.5 * kHann * kHann;
    s.coupled = map.periodic ? 1 : 1 / kHann;
    for (std::size_t r = 1; r <= rings.count; ++r) {
        if (modes.count[r] == 0) continue;  // rings of a narrow map may have no modes
        s.wavenumber.push_back(double(r) * rings.ring);
        s.psd.push_back(scale * modes.power[r] / modes.count[r]);
        s.modes.push_back(modes.count[r]);
        if (r >= seen.size()) continue;
        double sum = 0;
        for (const auto& [place, share] : seen[r]) sum += share;
        s.seen.emplace_back();
        for (const auto& [place, share] : seen[r]) {
            s.seen.back().emplace_back(place, share / sum);
            s.places = std::max(s.places, place + 1);
        }
    }
    s.lost = map.periodic ? 0 : 1.5;
    if (aspect == 1) modes.plane.finish(s, rings.ring, scale);
    const double across = 90 / pi * std::arg(modes.directed) + 90;
    s.lay = across < 180 ? across : across - 180;
    return s;
}

ModePowers mode_powers(const HeightMap& profile) {
    WindowedMap windowed(profile);
    const Buffer buffer = windowed.modes();
    const auto* const modes = reinterpret_cast<const std::complex<double>*>(buffer.get());
    ModePowers powers;
    powers.step = 2 * pi / profile.Lx();
    for (int i = 0; i < windowed.columns(); ++i)
        powers.power.push_back(std::norm(modes[i]) / (profile.nx * windowed.squares()));
    return powers;
}

HeightParameters height_parameters(const HeightMap& map) {
    const double level = mean_height(map);
    const auto mean_power = [&](int power) {
        return mean_present(map, [&](double z, int, int) { return std::pow(z - level, power); });
    };
    HeightParameters p;
    p.sq = std::sqrt(mean_power(2));
    // of equal heights neither exists
    p.ssk = p.sq > 0 ? mean_power(3) / std::pow(p.sq, 3) : std::nan("");
    p.sku = p.sq > 0 ? mean_power(4) / std::pow(p.sq, 4) : std::nan("");
    p.sdq = grid_moments(map).rms_slope();
    double all = 0, high = 0, high_points = 0;
    for (int j = 0; j + 1 < map.ny; ++j)
        for (int i = 0; i + 1 < map.nx; ++i) {
            const double sx = (map(i + 1, j) - map(i, j)) / map.dx;
            const double sy = (map(i, j + 1) - map(i, j)) / map.dy;
            const double square = sx * sx + sy * sy;
            all += square;
            if (map(i, j) > level + p.sq) {
                high += square;
                high_points += 1;
            }
        }
    if (all > 0 && high_points > 0)
        p.high_slope = std::sqrt(high / high_points * (map.nx - 1.0) * (map.ny - 1.0) / all);
    return p;
}

double twin_exponent(const std::function<double(double, double)>& psd,
                     const std::vector<double>& wavenumber, const HeightMap& map,
                     const HeightParameters& parameters, double most) {
    constexpr int parts = 4, angles = 4 * int(MeasuredSpectrum::kAngles);
    std::vector<std::array<double, 3>> rings;  // ln k, shares of the mean square height and slope
    const auto difference = [](double k, double step) { return 2 * std::sin(k * step / 2) / step; };
    for (std::size_t g = 1; g < wavenumber.size(); ++g) {
        const double width = std::log(wavenumber[g] / wavenumber[g - 1]) / parts;
        for (const int p : indices(parts)) {
            const double log_k = std::log(wavenumber[g - 1] / wavenumber[0]) + (p + 0.5) * width,
                         k = wavenumber[0] * std::exp(log_k);
            double height = 0, slope = 0;
            for (const int a : indices(angles)) {
                const double kx = k * std::cos(pi * a / angles), ky = k * std::sin(pi * a / angles);
                const double sx = difference(kx, map.dx), sy = difference(ky, map.dy),
                             power = k * k * width * psd(kx, ky);
                height += power;
                slope += power * (sx * sx + sy * sy);
            }
            rings.push_back({log_k, height, slope});
        }
    }
    const double ratio = parameters.sdq * parameters.sdq / (parameters.sq * parameters.sq);
    double low = -kMostExponent, high = most;
    for (int step = 0; step < 50; ++step) {
        const double e = 0.5 * (low + high);
        double height = 0, slope = 0;
        for (const auto& [log_k, h, s] : rings) {
            height += h * std::exp(e * log_k);
            slope += s * std::exp(e * log_k);
        }
        (slope > ratio * height ? high : low) = e;
    }
    return high;
}

std::vector<double> tilted(std::vector<double> psd, const std::vector<double>& wavenumber,
                           double exponent) {
    if (exponent == 0 || psd.empty() || wavenumber.empty() || psd.size() % wavenumber.size() != 0)
        return psd;
    const std::size_t across = psd.size() / wavenumber.size();
    for (const auto i : indices(psd))
        psd[i] *= std::pow(wavenumber[i / across] / wavenumber[0], exponent);
    return psd;
}

Isotropy isotropy(const HeightMap& map) {
    double xx = 0, xy = 0, yy = 0;
    for (int j = 0; j + 1 < map.ny; ++j) {
        double row_xx = 0, row_xy = 0, row_yy = 0;
        for (int i = 0; i + 1 < map.nx; ++i) {
            // Gradient at the centre of four points.
            const double a = map(i, j), b = map(i + 1, j), c = map(i, j + 1), d = map(i + 1, j + 1);
            const double zx = 0.5 * (b - a + d - c) / map.dx, zy = 0.5 * (c - a + d - b) / map.dy;
            row_xx += zx * zx;
            row_xy += zx * zy;
            row_yy += zy * zy;
        }
        xx += row_xx;
        xy += row_xy;
        yy += row_yy;
    }
    const double mean = 0.5 * (xx + yy), apart = std::hypot(0.5 * (xx - yy), xy);
    if (!(mean + apart > 0)) return {};
    return {std::sqrt(std::max(0.0, mean - apart) / (mean + apart)),
            0.5 * (std::atan2(xy, 0.5 * (xx - yy)) + pi)};
}

HeightQuantiles height_quantiles(const HeightMap& map) {
    std::vector<double> heights;
    heights.reserve(map.points());
    const double mean = mean_height(map);
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) heights.push_back(map(i, j) - mean);
    HeightQuantiles q;
    for (int i = 0; i < HeightQuantiles::kScores; ++i)
        q.score.push_back(-5 + 10.0 * i / (HeightQuantiles::kScores - 1));
    q.height = quantiles(std::move(heights), q.score);
    return q;
}

}  // namespace rsc
