#include "asperities/most_loaded.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "asperities/ellipse.hpp"

namespace rsc {
namespace {

// centre x and y, and the symmetric matrix M (xx, xy, yy) that maps the unit disc to the ellipse
constexpr int kUnknowns = 5;
using Unknowns = std::array<double, kUnknowns>;

double dot(const Unknowns& a, const Unknowns& b) {
    double sum = 0;
    for (std::size_t k = 0; k < kUnknowns; ++k) sum += a[k] * b[k];
    return sum;
}

double agm(double a, double b) { return std::numbers::pi * a / (2 * complete_K(b / a)); }

// Points of the unit disc with weights for the mean with the pressure of a flat punch: uniform in
// sqrt(1 - r^2) and in the angle. Exact for polynomials of degree 11.
struct DiscPoints {
    static constexpr int kRings = 4, kOnRing = 12, kCount = kRings * kOnRing;
    double p[kCount], q[kCount], weight[kCount];
    DiscPoints() {
        const auto &point = boost::math::quadrature::gauss<double, 2 * kRings>::abscissa(),
                   &share = boost::math::quadrature::gauss<double, 2 * kRings>::weights();
        for (int k = 0; k < kCount; ++k) {
            const auto ring = static_cast<std::size_t>(k / kOnRing);
            const double r = std::sqrt(1 - point[ring] * point[ring]);
            const double angle = 2 * std::numbers::pi * (k % kOnRing + 0.5) / kOnRing;
            p[k] = r * std::cos(angle), q[k] = r * std::sin(angle),
            weight[k] = share[ring] / kOnRing;
        }
    }
};

// Load of an ellipse that reaches down to the level Z (height of the summit minus u), and its
// gradient.
struct Load {
    double force = 0, stiffness = 0, highest = 0;
    Unknowns gradient{};
};

bool load_of(const HeightsAround& heights, double E_star, double Z, const Unknowns& e, Load& load) {
    static const DiscPoints disc;
    const double t = 0.5 * (e[2] + e[4]), determinant = e[2] * e[4] - e[3] * e[3];
    if (!(t > 0 && determinant > 1e-4 * t * t)) return false;
    double mean = 0, highest = -kInfinity;
    Unknowns slope{};
    for (int k = 0; k < DiscPoints::kCount; ++k) {
        const double p = disc.p[k], q = disc.q[k], w = disc.weight[k];
        double z, zx, zy;
        if (!heights.at(e[0] + e[2] * p + e[3] * q, e[1] + e[3] * p + e[4] * q, z, zx, zy))
            return false;
        mean += w * z;
        highest = std::max(highest, z);
        slope[0] += w * zx, slope[1] += w * zy;
        slope[2] += w * zx * p, slope[3] += w * (zx * q + zy * p), slope[4] += w * zy * q;
    }
    // agm(a, b) of the eigenvalues t +- d of M is agm(t, sqrt(t^2 - d^2)), smooth also where a = b.
    const double g = std::sqrt(determinant), h = 1e-5;
    const double S = 2 * E_star * agm(t, g),
                 by_t = E_star * (agm(t * (1 + h), g) - agm(t * (1 - h), g)) / (h * t),
                 by_g = E_star * (agm(t, g * (1 + h)) - agm(t, g * (1 - h))) / (h * g);
    const double above = mean - Z;
    const Unknowns rise = {0, 0, 0.5 * by_t + by_g * e[4] / (2 * g), -by_g * e[3] / g,
                           0.5 * by_t + by_g * e[2] / (2 * g)};
    for (std::size_t k = 0; k < kUnknowns; ++k) load.gradient[k] = rise[k] * above + S * slope[k];
    load.force = S * above, load.stiffness = S, load.highest = highest;
    return true;
}

using Matrix = std::array<Unknowns, kUnknowns>;

Matrix first_inverse() {
    Matrix inverse{};
    for (std::size_t k = 0; k < kUnknowns; ++k) inverse[k][k] = 0.3;
    return inverse;
}

// Local maximum of the load by the method of Broyden, Fletcher, Goldfarb and Shanno, in units of
// the ellipse's size. Steps are short, so that the maximum is that of the hill on which they begin.
// `inverse`: of the negative second derivatives, approximately.
bool climb(const HeightsAround& heights, double E_star, double Z, Unknowns& e, Matrix& inverse,
           Load& load, double accuracy = 1e-6) {
    constexpr int most = 60;
    constexpr double longest = 0.1, rounding = 1e-14;
    const double unit = std::sqrt(e[2] * e[4] - e[3] * e[3]);
    if (!load_of(heights, E_star, Z, e, load) || !(load.force > 0)) return false;
    const double scale = 1 / load.force;
    Unknowns gradient;
    for (std::size_t k = 0; k < kUnknowns; ++k) gradient[k] = load.gradient[k] * unit * scale;
    for (int i = 0; i < most && dot(gradient, gradient) > accuracy * accuracy; ++i) {
        Unknowns way;
        for (std::size_t k = 0; k < kUnknowns; ++k) way[k] = dot(inverse[k], gradient);
        double rate = dot(way, gradient);
        if (!(rate > 0)) inverse = first_inverse(), way = gradient, rate = dot(gradient, gradient);
        double length = std::min(1.0, longest / std::sqrt(dot(way, way)));
        Load next;
        Unknowns to;
        bool risen = false;
        for (int cut = 0; cut < 12 && !risen; ++cut, length *= 0.5) {
            for (std::size_t k = 0; k < kUnknowns; ++k) to[k] = e[k] + length * way[k] * unit;
            risen = load_of(heights, E_star, Z, to, next) &&
                    (next.force - load.force) * scale >= 1e-4 * length * rate - rounding;
        }
        if (!risen) break;
        length *= 2;
        Unknowns step, change, product;
        for (std::size_t k = 0; k < kUnknowns; ++k) {
            step[k] = length * way[k];
            const double fresh = next.gradient[k] * unit * scale;
            change[k] = gradient[k] - fresh, gradient[k] = fresh;
        }
        e = to, load = next;
        const double curvature = dot(step, change);
        if (!(curvature > 1e-12 * dot(step, step))) continue;
        for (std::size_t k = 0; k < kUnknowns; ++k) product[k] = dot(inverse[k], change);
        const double factor = (1 + dot(change, product) / curvature) / curvature;
        for (std::size_t k = 0; k < kUnknowns; ++k)
            for (std::size_t l = 0; l < kUnknowns; ++l)
                inverse[k][l] += factor * step[k] * step[l] -
                                 (product[k] * step[l] + step[k] * product[l]) / curvature;
    }
    return true;
}

// Share of the load that the ellipse misses because the true spot is none. The ellipse of largest
// load balances the angular harmonics 0, 1 and 2 of the profile along its rim; the others move the
// rim of the true spot, which adds load in proportion to their square, relative to the depth. The
// factor was fitted to boundary elements.
double missing_share(const HeightsAround& heights, const Unknowns& e, double depth) {
    constexpr double factor = 1.4, most = 0.15;
    static const DiscPoints disc;
    double sum = 0;
    for (int ring = 0; ring < DiscPoints::kRings; ++ring) {
        double square = 0, harmonic[5] = {};
        for (int k = ring * DiscPoints::kOnRing; k < (ring + 1) * DiscPoints::kOnRing; ++k) {
            const double p = disc.p[k], q = disc.q[k], r2 = p * p + q * q,
                         c2 = (p * p - q * q) / r2, s2 = 2 * p * q / r2;
            double z = 0, zx, zy;
            heights.at(e[0] + e[2] * p + e[3] * q, e[1] + e[3] * p + e[4] * q, z, zx, zy);
            square += z * z;
            harmonic[0] += z, harmonic[1] += z * p / std::sqrt(r2),
                harmonic[2] += z * q / std::sqrt(r2), harmonic[3] += z * c2, harmonic[4] += z * s2;
        }
        constexpr int n = DiscPoints::kOnRing;
        square -= harmonic[0] * harmonic[0] / n;
        for (int m = 1; m < 5; ++m) square -= harmonic[m] * harmonic[m] * 2 / n;
        sum += disc.weight[ring * n] * std::max(square, 0.0);
    }
    return std::min(factor * sum / (depth * depth), most);
}

// Adds the shares that the ellipses miss.
void add_missing(std::vector<LoadedEllipse>& found, const std::vector<double>& missing) {
    // The missing shares grow with u; their slope is the smaller of those to both sides, 0 at an
    // extremum.
    for (std::size_t k = 0; k < found.size(); ++k) {
        const auto slope = [&](std::size_t m) {
            return (missing[m] - missing[m - 1]) / (found[m].u - found[m - 1].u);
        };
        const double before = k > 0 ? slope(k) : 0, after = k + 1 < found.size() ? slope(k + 1) : 0;
        const double growth_of_share =
            before * after > 0 ? std::copysign(std::min(std::abs(before), std::abs(after)), before)
                               : 0;
        found[k].stiffness =
            (1 + missing[k]) * found[k].stiffness + growth_of_share * found[k].force;
        found[k].force *= 1 + missing[k];
    }
}

Unknowns unknowns_of(const Spot& spot) {
    const double c = std::cos(spot.angle), s = std::sin(spot.angle);
    return {spot.x, spot.y, spot.major * c * c + spot.minor * s * s,
            (spot.major - spot.minor) * c * s, spot.major * s * s + spot.minor * c * c};
}

Spot spot_of(const Unknowns& e) {
    const double t = 0.5 * (e[2] + e[4]), d = std::hypot(0.5 * (e[2] - e[4]), e[3]);
    return {e[0], e[1], t + d, t - d, 0.5 * std::atan2(2 * e[3], e[2] - e[4])};
}

}  // namespace

HeightsAround::HeightsAround(const FoundSummits& found, const Stencil& stencil,
                             const Indenter& indenter, double x0, double y0, double half_width,
                             int steps) {
    const HeightMap& map = *found.map;
    const int reach = stencil.reach();
    // Coarse points of the window, counted from the map's first point.
    const double x = (x0 - map.x0) / map.dx, y = (y0 - map.y0) / map.dy;
    int i0 = static_cast<int>(std::floor(x - half_width / map.dx)),
        i1 = static_cast<int>(std::ceil(x + half_width / map.dx));
    int j0 = static_cast<int>(std::floor(y - half_width / map.dy)),
        j1 = static_cast<int>(std::ceil(y + half_width / map.dy));
    if (!map.periodic) {
        i0 = std::max(i0, reach), i1 = std::min(i1, map.nx - 1 - reach);
        j0 = std::max(j0, reach), j1 = std::min(j1, map.ny - 1 - reach);
    }
    const Vec2 place = indenter.from_tip(
        x0, y0);  // all points are seen beside it, also half a period from the tip
    nx_ = (i1 - i0) * steps + 1, ny_ = (j1 - j0) * steps + 1;
    if (i1 - i0 < 3 || j1 - j0 < 3) return;
    hx_ = map.dx / steps, hy_ = map.dy / steps;
    left_ = (i0 - x) * map.dx, low_ = (j0 - y) * map.dy;
    // Weights for every position between two points, along both sides alike.
    std::vector<std::array<double, Stencil::kTaps>> weights(static_cast<std::size_t>(steps));
    for (int s = 0; s < steps; ++s) {
        const double t = static_cast<double>(s) / steps;
        double line_weights[1][Stencil::kTaps] = {};
        stencil.weights(t > 0.5 ? t - 1 : t, 1, line_weights);
        std::copy_n(line_weights[0], Stencil::kTaps, weights[static_cast<std::size_t>(s)].begin());
    }
    const auto nearest = [&](int k) { return k / steps + (2 * (k % steps) > steps ? 1 : 0); };
    const int rows = j1 - j0 + 1 + 2 * reach, taps = 2 * reach + 1;
    std::vector<double> along(static_cast<std::size_t>(rows) * static_cast<std::size_t>(nx_)),
        line(static_cast<std::size_t>(i1 - i0 + 1 + 2 * reach));
    for (int j = 0; j < rows; ++j) {
        const int row = j0 - reach + j;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const int column = i0 - reach + static_cast<int>(i);
            line[i] = map(map.periodic ? wrapped(column, map.nx) : column,
                          map.periodic ? wrapped(row, map.ny) : row);
        }
        for (int k = 0; k < nx_; ++k) {
            const auto& w = weights[static_cast<std::size_t>(k % steps)];
            double sum = 0;
            for (int tap = 0; tap < taps; ++tap)
                sum += w[static_cast<std::size_t>(tap)] *
                       line[static_cast<std::size_t>(nearest(k) + tap)];
            along[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) +
                  static_cast<std::size_t>(k)] = sum;
        }
    }
    z_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), 0.0);
    for (int l = 0; l < ny_; ++l) {
        double* to = z_.data() + static_cast<std::ptrdiff_t>(l) * nx_;
        const auto& w = weights[static_cast<std::size_t>(l % steps)];
        for (int tap = 0; tap < taps; ++tap) {
            const double* from = along.data() + static_cast<std::ptrdiff_t>(nearest(l) + tap) * nx_;
            for (int k = 0; k < nx_; ++k) to[k] += w[static_cast<std::size_t>(tap)] * from[k];
        }
        for (int k = 0; k < nx_; ++k) {
            to[k] -= indenter.shape->height(place.x + left_ + k * hx_, place.y + low_ + l * hy_);
            if (!std::isfinite(to[k])) return;
        }
    }
    usable_ = true;
}

bool HeightsAround::at(double dx, double dy, double& height, double& hx, double& hy) const {
    const double s = (dx - left_) / hx_, t = (dy - low_) / hy_;
    if (!(s >= 1 && t >= 1 && s < nx_ - 2 && t < ny_ - 2)) return false;
    const int i = static_cast<int>(s), j = static_cast<int>(t);
    // Catmull and Rom's cubics and their derivatives.
    const auto cubic = [](double f, double(&value)[4], double(&slope)[4]) {
        const double f2 = f * f, f3 = f2 * f;
        value[0] = 0.5 * (-f + 2 * f2 - f3), slope[0] = 0.5 * (-1 + 4 * f - 3 * f2);
        value[1] = 0.5 * (2 - 5 * f2 + 3 * f3), slope[1] = 0.5 * (-10 * f + 9 * f2);
        value[2] = 0.5 * (f + 4 * f2 - 3 * f3), slope[2] = 0.5 * (1 + 8 * f - 9 * f2);
        value[3] = 0.5 * (-f2 + f3), slope[3] = 0.5 * (-2 * f + 3 * f2);
    };
    double wx[4], sx[4], wy[4], sy[4];
    cubic(s - i, wx, sx), cubic(t - j, wy, sy);
    const double* row = z_.data() + static_cast<std::ptrdiff_t>(j - 1) * nx_ + (i - 1);
    double z = 0, zx = 0, zy = 0;
    for (int l = 0; l < 4; ++l, row += nx_) {
        const double value = wx[0] * row[0] + wx[1] * row[1] + wx[2] * row[2] + wx[3] * row[3];
        z += wy[l] * value, zy += sy[l] * value;
        zx += wy[l] * (sx[0] * row[0] + sx[1] * row[1] + sx[2] * row[2] + sx[3] * row[3]);
    }
    height = z, hx = zx / hx_, hy = zy / hy_;
    return true;
}

std::vector<LoadedEllipse> most_loaded_ellipses(const HeightsAround& heights, double E_star,
                                                double curvature, double ratio, double angle,
                                                double widest) {
    constexpr double first = 0.05, step = 1.05,
                     // size of the first ellipse over the widest; ratio of penetrations
        tolerance = 0.02;
    std::vector<LoadedEllipse> found;
    std::vector<double> missing;
    double top, zx, zy;
    if (!heights.usable() || !heights.at(0, 0, top, zx, zy)) return found;
    const double a = first * widest, elongation = std::cbrt(std::min(ratio, 8.0)),
                 major = a * std::sqrt(elongation), minor = a / std::sqrt(elongation);
    Unknowns e = unknowns_of({0, 0, major, minor, angle});
    const double growth = std::pow(step, 0.45);
    double u = curvature * a * a;
    Matrix inverse = first_inverse();
    for (int k = 0; k < 280; ++k, u *= step) {
        for (std::size_t l = 2; l < kUnknowns && k > 0; ++l) e[l] *= growth;
        Load load;
        if (!climb(heights, E_star, top - u, e, inverse, load)) break;
        const Spot spot = spot_of(e);
        if (spot.major > widest || load.highest > top + tolerance * u) break;
        missing.push_back(missing_share(heights, e, load.force / load.stiffness));
        found.push_back({u, load.force, load.stiffness, spot});
    }
    add_missing(found, missing);
    return found;
}

std::vector<LoadedEllipse> ellipses_like(const HeightsAround& heights, double E_star, double ratio,
                                         std::span<const LoadedEllipse> like) {
    std::vector<LoadedEllipse> found;
    std::vector<double> missing;
    double top, zx, zy;
    if (!heights.usable() || !heights.at(0, 0, top, zx, zy)) return {like.begin(), like.end()};
    Matrix inverse = first_inverse();
    Unknowns change{};  // from those alike, about the same for the next
    for (const LoadedEllipse& near : like) {
        const Unknowns from = unknowns_of(near.spot);
        Unknowns e;
        for (std::size_t l = 0; l < kUnknowns; ++l) e[l] = from[l] + change[l];
        Load load;
        if (!climb(heights, E_star, top - ratio * near.u, e, inverse, load, 1e-7) &&
            !climb(heights, E_star, top - ratio * near.u, e = from, inverse, load, 1e-7))
            return {like.begin(), like.end()};
        for (std::size_t l = 0; l < kUnknowns; ++l) change[l] = e[l] - from[l];
        missing.push_back(missing_share(heights, e, load.force / load.stiffness));
        found.push_back({ratio * near.u, load.force, load.stiffness, spot_of(e)});
    }
    add_missing(found, missing);
    return found;
}

}  // namespace rsc
