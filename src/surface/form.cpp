#include "surface/form.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "surface/defects.hpp"

namespace rsc {
namespace {

[[noreturn]] void refuse(const std::string& what) { bad_input("form: " + what); }

// Of at most six functions u^i v^j and their coefficients.
using Terms = std::array<double, 6>;

// Normal equations, summed row by row: short partial sums keep rounding errors small.
struct Normal {
    std::array<Terms, 6> a{};
    Terms b{};

    void add(const Terms& basis, double value, int unknowns) {
        for (const int i : indices(unknowns)) {
            for (int j = i; j < unknowns; ++j) a[i][j] += basis[i] * basis[j];
            b[i] += basis[i] * value;
        }
    }
    void add(const Normal& other, int unknowns) {
        for (const int i : indices(unknowns)) {
            for (int j = i; j < unknowns; ++j) a[i][j] += other.a[i][j];
            b[i] += other.b[i];
        }
    }
    // Solves by Cholesky factorisation. A vanishing pivot means that the points do not determine
    // the coefficient; that of a function which vanishes along a profile is 0.
    Terms solve(const char* form, int unknowns, bool profile) const {
        // relative to the diagonal before elimination; maps without missing points have at least
        // 0.1
        constexpr double kSingular = 1e-11;
        std::array<Terms, 6> l{};
        Terms x{};
        for (const int j : indices(unknowns))
            for (int i = j; i < unknowns; ++i) {
                double sum = a[j][i];
                for (const int k : indices(j)) sum -= l[i][k] * l[j][k];
                if (i == j && profile && a[j][j] == 0) sum = 1;
                if (i == j && !(sum > kSingular * a[j][j]))
                    refuse("the points of the map do not determine a " + std::string(form) +
                           ": too few of them, or all on one line");
                l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
            }
        for (const int i : indices(unknowns)) {
            double sum = b[i];
            for (const int k : indices(i)) sum -= l[i][k] * x[k];
            x[i] = sum / l[i][i];
        }
        for (int i = unknowns; i-- > 0;) {
            for (int k = i + 1; k < unknowns; ++k) x[i] -= l[k][i] * x[k];
            x[i] /= l[i][i];
        }
        return x;
    }
};

// Scaled coordinates u, v from the middle of the map, |u|, |v| <= 1; `scale` times u or v is a
// length.
struct Frame {
    double mid_x, mid_y, step_u, step_v, scale;
    explicit Frame(const HeightMap& map) : mid_x(0.5 * (map.nx - 1)), mid_y(0.5 * (map.ny - 1)) {
        scale = 0.5 * std::max((map.nx - 1) * map.dx, (map.ny - 1) * map.dy);
        if (!(scale > 0)) scale = std::max(map.dx, map.dy);
        step_u = map.dx / scale;
        step_v = map.dy / scale;
    }
    double u(int i) const { return (i - mid_x) * step_u; }
    double v(int j) const { return (j - mid_y) * step_v; }
};

// Fits value(i, j) at all points that are not missing by the first functions of basis(u, v).
template <class Basis, class Value>
Terms fit(const HeightMap& map, const Frame& frame, const char* form, int unknowns, Basis basis,
          Value value) {
    Normal all;
    for (const int j : indices(map.ny)) {
        Normal row;
        for (const int i : indices(map.nx)) {
            const double z = value(i, j);
            if (!std::isnan(z)) row.add(basis(frame.u(i), frame.v(j)), z, unknowns);
        }
        all.add(row, unknowns);
    }
    return all.solve(form, unknowns, map.ny == 1);
}

// Subtracts `level` and a polynomial of the first terms of 1, u, v, u^2, u v, v^2, whose
// coefficients are returned. The second round removes rounding errors of large forms.
Terms subtract_polynomial(HeightMap& map, const Frame& frame, const char* form, double level,
                          int unknowns) {
    const auto basis = [](double u, double v) { return Terms{1, u, v, u * u, u * v, v * v}; };
    Terms total{};
    for (const int round : indices(2)) {
        const double below =
            round == 0 ? level
                       : 0;  // subtracted first, so that a large level does not cause cancellation
        const Terms c =
            fit(map, frame, form, unknowns, basis, [&](int i, int j) { return map(i, j) - below; });
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx)) {
                const Terms f = basis(frame.u(i), frame.v(j));
                double sum = 0;
                for (const int k : indices(unknowns)) sum += c[k] * f[k];
                map.row(j)[i] = (map(i, j) - below) - sum;
            }
        for (const int k : indices(unknowns)) total[k] += c[k];
    }
    return total;
}

// The sphere through (0, 0, level) with gradient (p, q) there and curvature 1/radius = bend/sqrt(1
// + p^2 + q^2): its height w above `level` solves w + bend w^2/2 + g = 0, g = bend (x^2 + y^2)/2 -
// p x - q y. bend = 0 is a plane and not singular.
struct Sphere {
    double level = 0, p = 0, q = 0, bend = 0;
    // NaN outside the sphere.
    double above(double x, double y) const {
        const double g = 0.5 * bend * (x * x + y * y) - p * x - q * y;
        const double root = 1 - 2 * bend * g;
        return root > 0 ? -2 * g / (1 + std::sqrt(root)) : std::nan("");
    }
    double operator()(double x, double y) const { return level + above(x, y); }
    Sphere stepped(const Terms& by, double share) const {
        return {level + share * by[0], p + share * by[1], q + share * by[2], bend + share * by[3]};
    }
};

// Mean square residual of the sphere; NaN if the map is wider than the sphere.
double left_by(const Sphere& s, const HeightMap& map, const Frame& f, double level) {
    return mean_present(map, [&](double z, int i, int j) {
        const double e = z - level - s(f.u(i) * f.scale, f.v(j) * f.scale);
        return e * e;
    });
}

// Fits a sphere, or to a profile a circle, to the heights above `level`.
Sphere fit_sphere(const HeightMap& map, const Frame& frame, double level) {
    const double a = frame.scale;
    const char* const form = map.ny > 1 ? "sphere" : "arc";
    const Terms start = fit(
        map, frame, form, 4,
        [](double u, double v) {
            return Terms{1, u, v, u * u + v * v};
        },
        [&](int i, int j) { return map(i, j) - level; });
    Sphere s{start[0], start[1] / a, start[2] / a, -2 * start[3] / (a * a)};
    double left = left_by(s, map, frame, level);
    // The fitted paraboloid may be more strongly curved than any sphere as wide as the map.
    for (int k = 0; k < 60 && std::isnan(left); ++k) {
        s.bend *= 0.8;
        left = left_by(s, map, frame, level);
    }
    constexpr int kMostSteps = 200;
    constexpr double kArrived = 1e-13;  // relative to the extent of the form
    for (int step = 0; step < kMostSteps; ++step) {
        if (std::isnan(left)) break;
        // Unknowns are scaled to heights: level, a p, a q, a^2 bend.
        const Terms change = fit(
            map, frame, form, 4,
            [&](double u, double v) {
                const double w = s.above(u * a, v * a), slope = 1 / (1 + s.bend * w);
                return Terms{1, u * slope, v * slope,
                             -0.5 * slope * (u * u + v * v + w * w / (a * a))};
            },
            [&](int i, int j) { return map(i, j) - level - s(frame.u(i) * a, frame.v(j) * a); });
        const Terms by{change[0], change[1] / a, change[2] / a, change[3] / (a * a)};
        double share = 1;
        Sphere next = s.stepped(by, share);
        double next_left = left_by(next, map, frame, level);
        const double largest = std::max(
            {std::abs(change[0]), std::abs(change[1]), std::abs(change[2]), std::abs(change[3])});
        const double extent = std::max(
            {std::abs(s.p) * a, std::abs(s.q) * a, std::abs(s.bend) * a * a, std::sqrt(left)});
        if (largest <= kArrived * extent)
            return std::isnan(next_left) || next_left > left ? s : next;
        while (!(next_left <= left) && share > 1e-6) {
            share *= 0.5;
            next = s.stepped(by, share);
            next_left = left_by(next, map, frame, level);
        }
        if (!(next_left < left)) return s;  // no further improvement: what remains is rounding
        s = next;
        left = next_left;
    }
    refuse("no sphere as wide as the map fits it; use detrend = 'quadratic'");
}

}  // namespace

Form detrend(HeightMap& map, Detrend how) {
    Form form;
    form.how = how;
    const double level = mean_height(map);
    if (std::isnan(level)) refuse("all points of the map are missing");
    if (how != Detrend::none) form.level = level;
    if (how == Detrend::mean)
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx)) map.row(j)[i] -= level;
    const Frame frame(map);
    const double a = frame.scale;
    const bool row = map.ny == 1, bent = how == Detrend::quadratic;
    if (how == Detrend::plane || bent) {
        const char* const names[2][2] = {{"plane", "quadratic"}, {"line", "parabola"}};
        const Terms c = subtract_polynomial(map, frame, names[row][bent], level, bent ? 6 : 3);
        form.level += c[0];
        form.slope_x = c[1] / a;
        form.slope_y = c[2] / a;
        form.zxx = 2 * c[3] / (a * a);
        form.zxy = c[4] / (a * a);
        form.zyy = 2 * c[5] / (a * a);
    } else if (how == Detrend::sphere) {
        const Sphere s = fit_sphere(map, frame, level);
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx))
                map.row(j)[i] = (map(i, j) - level) - s(frame.u(i) * a, frame.v(j) * a);
        form.level += s.level;
        form.slope_x = s.p;
        form.slope_y = s.q;
        // From w + bend w^2/2 + g = 0, differentiated twice in the middle.
        form.zxx = -s.bend * (1 + s.p * s.p);
        form.zxy = -s.bend * s.p * s.q;
        form.zyy = -s.bend * (1 + s.q * s.q);
        form.radius = s.bend != 0 ? std::sqrt(1 + s.p * s.p + s.q * s.q) / s.bend : HUGE_VAL;
    }
    const double middle = mean_height(map);
    form.rms = std::sqrt(
        mean_present(map, [&](double z, int, int) { return (z - middle) * (z - middle); }));
    return form;
}

namespace {

// Transmission of the waves of a transform of n points along one axis: half waves on n steps
// (cosine transform), or whole waves if periodic, in the order of FFTW's half-complex format (r0,
// r1, ..., i2, i1). The filter is a product of a function of kx and one of ky.
std::vector<double> transmissions(int n, double step, double cutoff, bool periodic) {
    std::vector<double> t(at(n));
    for (const int i : indices(n)) {
        const double k = periodic ? 2 * pi * std::min(i, n - i) / (n * step) : pi * i / (n * step);
        t[at(i)] = gaussian_transmission(cutoff, k);
    }
    return t;
}

}  // namespace

double gaussian_transmission(double cutoff, double k) {
    const double ratio = cutoff * k / (2 * pi);
    return std::exp2(-ratio * ratio);  // exp(-pi alpha^2 x^2) with pi alpha^2 = ln 2
}

void gaussian_filter(HeightMap& map, double cutoff) {
    if (!(cutoff > 0 && std::isfinite(cutoff)))
        bad_input("filter_cutoff must be positive and finite, not " + text_of(cutoff));
    const std::vector<double> tx = transmissions(map.nx, map.dx, cutoff, map.periodic);
    const std::vector<double> ty = transmissions(map.ny, map.dy, cutoff, map.periodic);
    damp_waves(map, map.periodic, "a filtered height map", [&](double* z, double scale) {
        for (const double y : ty)
            for (const double x : tx) *z++ *= scale * y * x;
    });
}

}  // namespace rsc
