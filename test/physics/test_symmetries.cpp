// The same contact given otherwise is the same contact: its plane moved, mirrored, turned over its diagonal, in other units of length and of
// force. Asperities with all laws, elements; spheres, flats, flats that repeat; elastic and yielding; all methods. Every number of every
// level of a path is compared, and all that a contact answers beside its levels.
//
// Nothing in the problems is symmetric itself: the plane's sides, the pixels' sides, the tip's place and both directions of the roughness differ.
#include "check.hpp"
#include "contact/answers.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/deflection.hpp"
#include "contact/element_contact.hpp"
#include "contact/law/law.hpp"
#include "physics/random_asperities.hpp"

using namespace rsc;

namespace {

constexpr double kFlat = __builtin_huge_val();
// Levels are asked for a residual of 1e-11, the condition of the problems is below 1e3; what follows from them by differences is coarser.
constexpr double kTolerance = 1e-11, kSame = 1e-7;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// (x, y) -> mirrored, then turned over, then moved and in other units; moduli in units of their own.
struct Map {
    bool mirror = false, turn = false;
    double right = 0, up = 0, length = 1, modulus = 1;
    Vec2 direction(double x, double y) const {
        if (mirror) x = -x;
        return turn ? Vec2{y, x} : Vec2{x, y};
    }
    Vec2 place(double x, double y) const {
        const Vec2 d = direction(x, y);
        return {length * (d.x + right), length * (d.y + up)};
    }
    // A moment is no arrow: it changes its sign in every mirror.
    Vec2 axial(double x, double y) const {
        const Vec2 d = direction(x, y);
        const double sign = mirror != turn ? -1 : 1;
        return {sign * d.x, sign * d.y};
    }
};

struct Problem {
    std::string name;
    Asperities asperities;
    std::shared_ptr<HeightMap> heights;  // elements
    Indenter tip;
    SolverOptions options;
    std::array<double, 4> path;  // separations, then a force after them
    Vec2 elsewhere;              // of the tip, for a level more

    std::unique_ptr<Contact> contact() const {
        if (heights) return make_element_contact(*heights, tip, options);
        return std::make_unique<AsperityContact>(asperities, tip, options);
    }
};

Problem given_otherwise(const Problem& p, const Map& m) {
    Problem q = p;
    const double s = m.length, half = std::numbers::pi / 2;
    for (std::size_t i = 0; i < p.asperities.size(); ++i) {
        const Vec2 place = m.place(p.asperities.x[i], p.asperities.y[i]);
        q.asperities.x[i] = place.x, q.asperities.y[i] = place.y, q.asperities.z[i] *= s, q.asperities.radius[i] *= s;
        double& angle = q.asperities.angle[i];
        if (m.mirror) angle = -angle;
        if (m.turn) angle = half - angle;
        angle -= 2 * half * std::ceil((angle - half) / (2 * half));
        q.asperities.kappa1[i] /= s, q.asperities.kappa2[i] /= s, q.asperities.biharmonic[i] /= s * s * s;
    }
    if (p.heights) {
        const HeightMap& from = *p.heights;
        auto to = std::make_shared<HeightMap>();
        const int nx = m.turn ? from.ny : from.nx, ny = m.turn ? from.nx : from.ny;
        to->allocate(nx, ny, nx + 3);
        to->dx = s * (m.turn ? from.dy : from.dx), to->dy = s * (m.turn ? from.dx : from.dy), to->periodic = from.periodic;
        const Vec2 origin = m.place(m.mirror ? from.x0 + (from.nx - 1) * from.dx : from.x0, from.y0);
        to->x0 = origin.x, to->y0 = origin.y;
        for (int j = 0; j < from.ny; ++j)
            for (int i = 0; i < from.nx; ++i) {
                const int k = m.mirror ? from.nx - 1 - i : i;
                (m.turn ? to->row(k)[j] : to->row(j)[k]) = s * from(i, j);
            }
        q.heights = to;
    }
    const Vec2 tip = m.place(p.tip.x0, p.tip.y0);
    q.tip = {m.modulus * p.tip.E_star, s * p.tip.shape->hertz_radius(), tip.x, tip.y, p.tip.period};
    if (p.tip.period.finite())
        q.tip.period = {s * (m.turn ? p.tip.period.y : p.tip.period.x), s * (m.turn ? p.tip.period.x : p.tip.period.y)};
    q.options.hardness = {m.modulus * p.options.hardness.H0, s * p.options.hardness.length};
    q.options.sigma *= s, q.options.mean_spacing *= s;
    const Rectangle& r = p.options.surface;
    const Vec2 a = m.place(r.x0, r.y0), b = m.place(r.x0 + r.Lx, r.y0 + r.Ly);
    q.options.surface = {std::min(a.x, b.x), std::min(a.y, b.y), std::abs(b.x - a.x), std::abs(b.y - a.y)};
    for (double& Z0 : q.path) Z0 *= s;
    q.elsewhere = m.place(p.elsewhere.x, p.elsewhere.y);
    return q;
}

// Units of the scalars of a level: powers of length and of modulus.
struct Scalar {
    const char* name;
    double LevelValues::*value;
    int length, modulus;
};
const Scalar kScalars[] = {{"separation", &LevelValues::separation, 1, 0},
                           {"force", &LevelValues::force, 2, 1},
                           {"area", &LevelValues::area, 2, 0},
                           {"area_pixels", &LevelValues::area_pixels, 2, 0},
                           {"pressure", &LevelValues::pressure, 0, 1},
                           {"area_fraction", &LevelValues::area_fraction, 0, 0},
                           {"stiffness", &LevelValues::stiffness, 1, 1},
                           {"energy", &LevelValues::energy, 3, 1},
                           {"conductance_length", &LevelValues::conductance_length, 1, 0},
                           {"resistance", &LevelValues::resistance, -1, 0},
                           {"extreme_area_fraction", &LevelValues::extreme_area_fraction, 0, 0},
                           {"plastic_work", &LevelValues::plastic_work, 3, 1},
                           {"nominal_area", &LevelValues::nominal_area, 2, 0}};
// Beside them: directions, counts, residual, products and iterations.

void same(double other, double own, double scale, const std::string& what) {
    if (std::isnan(own) && std::isnan(other)) return;
    check::close(other, own, kSame * std::abs(scale), what.c_str(), __FILE__, __LINE__);
}
void whole(long other, long own, const std::string& what) { check::close(double(other), double(own), 0, what.c_str(), __FILE__, __LINE__); }

// Where pixel (column, row) of the first problem's map lies in the other's.
int pixel_of(int index, const HeightMap& from, const Map& m) {
    int i = index % from.nx;
    const int j = index / from.nx;
    if (m.mirror) i = from.nx - 1 - i;
    return m.turn ? i * from.ny + j : j * from.nx + i;
}

void compare(const Level& own, const Level& other, const Problem& p, const Map& m, const std::string& where) {
    const double s = m.length, force = s * s * m.modulus;
    for (const Scalar& v : kScalars) {
        const double value = own.*v.value * std::pow(s, v.length) * std::pow(m.modulus, v.modulus);
        same(other.*v.value, value, v.value == &LevelValues::separation ? s * p.options.sigma : value, where + v.name);
    }
    const Vec2 sideways = m.direction(own.lateral_x, own.lateral_y), moment = m.axial(own.moment_x, own.moment_y);
    same(other.lateral_x, force * sideways.x, force * own.force, where + "lateral_x");
    same(other.lateral_y, force * sideways.y, force * own.force, where + "lateral_y");
    const double turning = s * force * own.force;  // a force at an arm of the order of 1
    same(other.moment_x, s * force * moment.x, turning, where + "moment_x");
    same(other.moment_y, s * force * moment.y, turning, where + "moment_y");
    CHECK(own.residual <= kTolerance && other.residual <= kTolerance);
    whole(other.overlapping_pairs, own.overlapping_pairs, where + "overlapping_pairs");
    whole(other.beyond_law, own.beyond_law, where + "beyond_law");
    whole(other.plastic_contacts, own.plastic_contacts, where + "plastic_contacts");
    whole(other.contacts, own.contacts, where + "contacts");
    whole(other.candidates, own.candidates, where + "candidates");
    whole(long(other.status), long(own.status), where + "status");
    whole(long(other.method), long(own.method), where + "method");
    whole(long(other.fallback), long(own.fallback), where + "fallback");
    whole(other.large_contacts, own.large_contacts, where + "large_contacts");
    whole(other.edge_contacts, own.edge_contacts, where + "edge_contacts");

    std::map<int, std::size_t> pixel;
    for (std::size_t k = 0; k < other.pixels.index.size(); ++k) pixel[other.pixels.index[k]] = k;
    // A contact of the other level: of the same asperity, or of the pixel that the first pixel of this one is there.
    const bool elements = p.heights != nullptr, elastic = std::isinf(p.options.hardness.H0);
    std::vector<std::size_t> of(own.asperity.size(), other.asperity.size());
    for (std::size_t k = own.pixels.index.size(); k-- > 0;) {
        const auto found = pixel.find(pixel_of(own.pixels.index[k], *p.heights, m));
        if (found != pixel.end()) of[at(own.pixels.contact[k])] = at(other.pixels.contact[found->second]);
    }
    for (std::size_t k = 0; k < own.asperity.size() && !elements; ++k)
        of[k] = at(static_cast<int>(std::find(other.asperity.begin(), other.asperity.end(), own.asperity[k]) - other.asperity.begin()));
    for (std::size_t k = 0; k < own.asperity.size(); ++k) {
        const std::size_t l = of[k];
        CHECK(l < other.asperity.size());
        if (l >= other.asperity.size()) continue;
        // Where pixels bear the hardness, several are the one with the highest pressure.
        if (elements && elastic) whole(other.asperity[l], pixel_of(own.asperity[k], *p.heights, m), where + "peak");
        Vec2 xy = m.place(own.x[k], own.y[k]);
        if (p.tip.period.finite()) {
            const Period period{s * (m.turn ? p.tip.period.y : p.tip.period.x), s * (m.turn ? p.tip.period.x : p.tip.period.y)};
            xy = {other.x[l] + period.nearest_x(xy.x - other.x[l]), other.y[l] + period.nearest_y(xy.y - other.y[l])};
        }
        same(other.x[l], xy.x, s, where + "x"), same(other.y[l], xy.y, s, where + "y");
        same(other.f[l], force * own.f[k], force * own.force, where + "f");
        same(other.a[l], s * own.a[k], s, where + "a");
        if (!elements || elastic) same(other.u[l], s * own.u[k], s * p.options.sigma, where + "u");
        CHECK(own.yields.empty() == other.yields.empty());
        if (!own.yields.empty()) whole(other.yields[l], own.yields[k], where + "yields");
    }
    CHECK(own.pixels.index.size() == other.pixels.index.size());
    for (std::size_t k = 0; k < own.pixels.index.size(); ++k) {
        const auto found = pixel.find(pixel_of(own.pixels.index[k], *p.heights, m));
        CHECK(found != pixel.end());
        if (found == pixel.end()) continue;
        const std::size_t l = found->second;
        const Vec2 xy = m.place(own.pixels.x(k), own.pixels.y(k));
        same(other.pixels.x(l), xy.x, s, where + "pixel x"), same(other.pixels.y(l), xy.y, s, where + "pixel y");
        same(other.pixels.pressure[l], m.modulus * own.pixels.pressure[k], m.modulus * own.force / own.area, where + "pixel pressure");
        whole(other.pixels.contact[l], static_cast<long>(of[at(own.pixels.contact[k])]), where + "whose pixel");
    }
}

void path(const Problem& p, const Problem& q, const Map& m, const std::string& name) {
    const auto own = p.contact(), other = q.contact();
    const double resistivity[2] = {2, 3}, s = m.length;
    const auto kernel = make_kernel(p.options.interaction, p.tip.E_star, p.tip.period),
               like = make_kernel(q.options.interaction, q.tip.E_star, q.tip.period);
    double force = 0;
    int number = 0, most = 0;
    const auto next = [&](auto&& go) {
        Level a = go(*own, p, 1.0), b = go(*other, q, s * s * m.modulus);
        add_answers(*own, a, resistivity), add_answers(*other, b, resistivity);
        CHECK(a.status != LevelStatus::not_converged && a.contacts > 0);
        compare(a, b, p, m, name + ", level " + std::to_string(++number) + ": ");
        for (const auto& [x, y] : {std::pair{0.31, 0.47}, {0.77, 0.2}}) {
            const Vec2 there = m.place(x, y);
            const double down = s * deflection(a, *kernel, x, y);
            same(deflection(b, *like, there.x, there.y), down, s * p.options.sigma, name + ": deflection");
        }
        same(other->first_touch(), s * own->first_touch(), s * p.options.sigma, name + ": first touch");
        force = std::max(force, a.force), most = std::max(most, a.contacts);
    };
    for (std::size_t k = 0; k < p.path.size(); ++k)
        next([&](Contact& c, const Problem& of, double) { return c.at_separation(of.path[k]); });
    next([&](Contact& c, const Problem&, double unit) { return c.at_force(1.1 * force * unit); });
    next([&](Contact& c, const Problem& of, double) {
        c.move_tip(of.elsewhere.x, of.elsewhere.y);
        return c.at_separation(of.path[1]);
    });
    CHECK(most > 2);
    const auto depths = own->residual_depths(), deep = other->residual_depths();
    CHECK(depths.size() == deep.size());
    double left = 0;
    for (std::size_t k = 0; k < depths.size() && k < deep.size(); ++k)
        same(deep[k], s * depths[k], s * p.options.sigma, name + ": residual depth"), left += depths[k];
    const ResidualProfile one = own->residual_profile(), two = other->residual_profile();
    CHECK(one.depth.size() == two.depth.size());
    std::map<std::pair<long, long>, double> profile;
    const auto key = [&](double x, double y) { return std::pair{std::lround(x / s * 1e5), std::lround(y / s * 1e5)}; };
    for (std::size_t k = 0; k < two.depth.size(); ++k) profile[key(two.x[k], two.y[k])] = two.depth[k];
    for (std::size_t k = 0; k < one.depth.size(); ++k) {
        const Vec2 xy = m.place(one.x[k], one.y[k]);
        const auto found = profile.find(key(xy.x, xy.y));
        CHECK(found != profile.end());
        if (found != profile.end()) same(found->second, s * one.depth[k], s * p.options.sigma, name + ": residual profile");
        left += one.depth[k];
    }
    if (p.heights) {
        same(two.dx, s * (m.turn ? one.dy : one.dx), s, name + ": dx of the profile");
        same(two.dy, s * (m.turn ? one.dx : one.dy), s, name + ": dy of the profile");
    }
    CHECK((left > 0) == std::isfinite(p.options.hardness.H0));
}

constexpr double kWide = 1.2, kHigh = 0.8, kSigma = 0.01;

Problem of_asperities(LawKind law, const char* name) {
    Problem p;
    p.name = name;
    p.asperities = random_asperities(120, 0.03, kSigma, 2e-3, 0.5, 17);
    for (std::size_t i = 0; i < p.asperities.size(); ++i) {
        const double k = static_cast<double>(i), root = std::sqrt(1 + 2 * std::fmod(0.618 * k, 1.0)), kappa = 1 / p.asperities.radius[i];
        p.asperities.x[i] *= kWide, p.asperities.y[i] *= kHigh;
        p.asperities.kappa1.push_back(kappa * root), p.asperities.kappa2.push_back(kappa / root);
        p.asperities.angle.push_back(std::fmod(1.7 * k, std::numbers::pi) - std::numbers::pi / 2 + 1e-3);
        p.asperities.biharmonic.push_back((i % 5 == 0 ? -200.0 : 60.0 * static_cast<double>(i % 7)) * 2 * kappa * (root + 1 / root));
    }
    p.tip = {3.0, 2.0, 0.55, 0.43, {}};
    p.options.law = law;
    p.options.tolerance = kTolerance;
    p.options.sigma = kSigma, p.options.mean_spacing = 0.06, p.options.surface = {0, 0, kWide, kHigh};
    p.path = {0.004, -0.008, -0.0065, -0.007};
    p.elsewhere = {0.21, 0.61};
    return p;
}

void keep(Asperities& a, std::size_t n) {
    for (const AsperityColumn& column : kAsperityColumns) (a.*column.values).resize(n);
}

Problem of_elements(bool repeats, const char* name) {
    Problem p;
    p.name = name;
    p.heights = std::make_shared<HeightMap>();
    HeightMap& map = *p.heights;
    const int nx = 28, ny = 22;
    map.allocate(nx, ny, nx);
    map.dx = kWide / nx, map.dy = kHigh / ny, map.periodic = repeats;
    if (!repeats) map.x0 = 0.03, map.y0 = -0.02;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            double z = 0;
            for (const auto& [a, b, phase] :
                 {std::array{3.0, 1.0, 0.3}, {2.0, -2.0, 1.1}, {5.0, 2.0, 2.0}, {1.0, 3.0, 0.7}, {4.0, -3.0, 1.9}})
                z += 0.02 / (a + std::abs(b)) * std::cos(2 * std::numbers::pi * (a * i / nx + b * j / ny) + phase);
            map.row(j)[i] = z;
        }
    p.tip = {3.0, 30.0, 0.55, 0.43, {}};
    if (repeats) p.tip = {3.0, kFlat, 0.55, 0.43, {kWide, kHigh}};
    p.options.tolerance = kTolerance, p.options.max_iterations = 500;
    p.options.sigma = kSigma, p.options.mean_spacing = 0.06, p.options.surface = {0.03, -0.02, kWide, kHigh};
    p.path = {0.009, 0.006, 0.008, 0.007};
    p.elsewhere = {0.31, 0.52};
    return p;
}

std::vector<Problem> problems() {
    std::vector<Problem> all;
    for (const LawKind law : {LawKind::hertz, LawKind::elliptic, LawKind::fourth_order}) {
        const std::string name = traits(law).name;
        const auto add = [&](const std::string& what, auto&& change) {
            Problem p = of_asperities(law, "");
            p.name = name + what;
            change(p);
            all.push_back(std::move(p));
        };
        add(", sphere", [](Problem& p) { p.options.method = Method::direct; });
        add(", flat, mesh", [](Problem& p) { p.tip.shape = kFlat, p.options.method = Method::mesh; });
        add(", paper", [](Problem& p) {
            p.options.method = Method::dgesv, p.options.selection = Selection::paper, p.options.selection_factor = 0.55;
        });
        add(", alone", [](Problem& p) { p.options.interaction = Interaction::none, p.options.method = Method::mesh; });
        add(", yielding", [](Problem& p) { p.options.hardness = {0.25, 2e-3}; });
        constexpr std::size_t few = 80;
        add(", repeating", [](Problem& p) {
            p.tip.shape = kFlat, p.tip.period = {kWide, kHigh}, p.options.method = Method::mesh, keep(p.asperities, few);
        });
        add(", repeating and yielding", [](Problem& p) {
            p.tip.shape = kFlat, p.tip.period = {kWide, kHigh}, p.options.hardness = {0.25, 2e-3}, p.options.method = Method::direct,
            keep(p.asperities, few);
        });
    }
    for (const bool repeats : {false, true})
        for (const bool yields : {false, true}) {
            all.push_back(of_elements(repeats, repeats ? (yields ? "elements, repeating and yielding" : "elements, repeating")
                                                       : (yields ? "elements, yielding" : "elements")));
            if (yields) all.back().options.hardness.H0 = 0.25;
        }
    return all;
}

}  // namespace

TESTS {
    const std::pair<const char*, Map> maps[] = {{" mirrored, moved, in other units", {true, false, 0.37, -1.9, 1e-6, 7e10}},
                                                {" turned over", {false, true, -0.4, 0.15}}};
    for (const Problem& p : problems())
        for (const auto& [how, m] : maps) {
            const int before = check::failures;
            path(p, given_otherwise(p, m), m, p.name + how);
            if (check::failures > before) std::printf("%s%s: %d failures\n", p.name.c_str(), how, check::failures - before);
        }
}
