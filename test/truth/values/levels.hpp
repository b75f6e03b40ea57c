// What a file says of itself, and of its levels.
#pragma once

#include "asperities/law.hpp"
#include "base/version.h"
#include "case/read_case.hpp"
#include "contact/spots.hpp"
#include "run/run.hpp"
#include "truth/values/truth.hpp"

namespace values {

using namespace rsc;

inline void header(CheckedFile& f, const Truth& t) {
    const std::string text = f.reader().text("", "case");
    CHECK(case_text(read_case_text(text, "case").settings) == text);
    if (t.c.run.seed <= 2147483647)
        f.attribute("", "seed", {double(t.c.run.seed)});
    else
        CHECK(f.reader().text("", "seed") == std::to_string(t.c.run.seed));
    if ((f.reader().text("", "path") != "") != std::isfinite(t.c.solids.hardness))
        check::that(false, "path", __FILE__, __LINE__);

    f.same("realization",
           t.each_surface([&](std::size_t k) { return t.c.run.first_realization + number(k); }));
    f.same("step", t.each_step([](std::size_t s) { return number(s) + 1; }));
    f.same("e_star", {t.E}, kRounding);
    f.same("r_star", {std::isinf(t.R) ? kNone : t.R}, kRounding);
    f.same("tip_x", {t.tip_x}, kRounding);
    f.same("tip_y", {t.tip_y}, kRounding);
    f.same("sigma_reference", {t.sigma}, kRounding);
}

// Separations: those asked for, or those at which the forces asked for are found.
inline void separations(CheckedFile& f, const Truth& t) {
    const auto& keys = t.c.indentation;
    Vector asked = keys.levels;
    for (int k = 0; asked.size() < t.steps; ++k) {
        const double share = k / (keys.steps - 1.0);
        asked.push_back(keys.spacing == Spacing::log
                            ? keys.start * std::pow(keys.stop / keys.start, share)
                            : keys.start * (1 - share) + keys.stop * share);
    }
    double unit = 1;
    if (keys.control == Control::separation && keys.unit == LevelUnit::sigma) unit = t.sigma;
    if (keys.control == Control::pressure) unit = t.Lx * t.Ly;
    if (keys.control == Control::pressure && keys.unit == LevelUnit::relative)
        unit *= t.E * std::sqrt(2 * t.m2_made);
    for (double& a : asked) a *= unit;
    const std::vector<std::string> shape = f.reader().dimensions("separation");
    CHECK(shape.size() == (keys.control == Control::separation ? 1 : 2) &&
          f.reader().dimensions("separation_sigma") == shape);
    if (keys.control == Control::separation) {
        f.same("separation", asked, 1e-14, 1e-15 * t.sigma);
        for (double& a : asked) a /= t.sigma;
        f.same("separation_sigma", asked, 1e-14, 1e-15);
        CHECK(!f.has("separation_mean"));
        return;
    }
    const Vector Z = t.rows([&](auto k, auto s) { return t.r[k].levels[s].separation; });
    f.same("separation", Z);
    f.same("separation_sigma", t.rows([&](auto k, auto s) { return Z[k * t.steps + s] / t.sigma; }),
           1e-15);
    f.same("separation_mean", t.each_step([&](std::size_t s) {
        double m = 0;
        for (const std::size_t k : indices(t.M)) m += Z[k * t.steps + s] / number(t.M);
        return m;
    }),
           1e-14);
    const Vector N = f.values("force");
    for (const auto i : indices(N))
        CHECK_RELATIVE(N[i], asked[i % t.steps], 10 * t.c.solver.tolerance);
}

// What yielding of paraboloids leaves (THEORY.rst, Hardness).
struct Pressed {
    double rest = 0, lost = 0;
};
inline Pressed pressed_flat(const Truth& t, std::int32_t i, double deepest) {
    const double r = t.r[0].asperities.radius[i], H = t.hardness(i),
                 uc = std::pow(3 * pi * H / (4 * t.E), 2) * r;
    if (!(deepest > uc)) return {};
    const double area = pi * r * (2 * deepest - uc), force = H * area, a = std::sqrt(area / pi),
                 back = 4 * t.E * a * a * a / (3 * force);
    const double elastic = 8.0 / 15 * t.E * std::sqrt(r) * std::pow(uc, 2.5);
    const double flow = H * pi * r * ((deepest * deepest - uc * uc) - uc * (deepest - uc));
    return {deepest - a * a / back, std::max(0.0, elastic + flow - 0.4 * force * a * a / back)};
}

// Cells of the map: the library's grid worked out again.
struct Cells {
    long nx, ny;
    double x0, y0, side;
    explicit Cells(const Truth& t)
        : nx(t.c.output.map_cells),
          ny(0),
          x0(t.x0),
          y0(t.y0),
          side(t.Lx / double(t.c.output.map_cells)) {
        while (double(ny) * side < t.Ly * (1 - 1e-14)) ++ny;
    }
    // -1: outside
    long cell(double x, double y) const {
        const auto i = long(std::floor((x - x0) / side)), j = long(std::floor((y - y0) / side));
        return i >= 0 && i < nx && j >= 0 && j < ny ? j * nx + i : -1;
    }
};
struct CellSums {
    Vector area, force;
    double outside = 0, crowded = 0;
};
inline CellSums cells_of(const Contacts2& c, const Cells& cells) {
    CellSums out{Vector(cells.nx * cells.ny), Vector(cells.nx * cells.ny), 0, 0};
    const auto put = [&](double x, double y, double area, double force) {
        const long cell = cells.cell(x, y);
        if (cell < 0) return;
        out.area[cell] += area;
        out.force[cell] += force;
    };
    // Pixels begin at their points; each cell has what lies in it, the last one also what sticks
    // out.
    const auto share = [](double from, double length, long i, long n) {
        const double low = i == 0 ? from : std::max(from, double(i));
        const double high = i == n - 1 ? from + length : std::min(from + length, double(i + 1));
        return std::max(0.0, high - low) / length;
    };
    const auto spread = [&](double x, double y, double area, double force) {
        if (cells.cell(x, y) < 0) return;
        const double u = (x - cells.x0) / cells.side, v = (y - cells.y0) / cells.side,
                     w = c.dx / cells.side;
        const double h = c.dy / cells.side;
        for (const long j : indices(cells.ny))
            for (const long i : indices(cells.nx)) {
                const double part = share(u, w, i, cells.nx) * share(v, h, j, cells.ny);
                out.area[j * cells.nx + i] += part * area;
                out.force[j * cells.nx + i] += part * force;
            }
    };
    Vector count(c.spots.size());
    for (const Pixel2& q : c.pixels) count[q.contact] += 1;
    for (const Pixel2& q : c.pixels)
        spread(q.x, q.y, c.spots[q.contact].area / count[q.contact], q.p * c.pixel);
    for (const Spot2& p : c.spots) {
        if (c.pixels.empty()) put(p.x, p.y, p.own, p.f);
        out.outside += cells.cell(p.x, p.y) < 0;
    }
    for (double a : out.area) out.crowded += a > pi / 16 * cells.side * cells.side;
    return out;
}

inline void levels(CheckedFile& f, const Truth& t) {
    const auto level = [&](std::size_t k, std::size_t s) -> const Level& {
        return t.r[k].levels[s];
    };
    const auto spots = [&](std::size_t k, std::size_t s) -> const std::vector<Spot2>& {
        return t.contacts[k][s].spots;
    };
    const bool yields = std::isfinite(t.c.solids.hardness);
    const bool paper = t.c.indentation.selection == Selection::paper;

    const Vector N = t.rows([&](auto k, auto s) {
        double n = 0;
        for (const Spot2& p : spots(k, s)) n += p.f;
        return n;
    });
    f.same("force", N, kRounding);
    const bool ellipses = !t.elements && !t.hertz;
    std::vector<std::unique_ptr<Law>> laws;
    for (std::size_t k = 0; k < t.M && !t.elements; ++k)
        laws.push_back(make_law(t.c.asperities.law, t.r[k].asperities, t.E));
    const auto law = [&](std::size_t k, std::int32_t i) -> const Law& {
        laws[k]->prepare(std::array{int(i)});
        return *laws[k];
    };
    const Vector A = t.rows([&](auto k, auto s) {
        std::vector<Spot> union_of;
        double a = 0;
        for (const Spot2& p : spots(k, s)) {
            a += p.area;
            if (!ellipses) continue;
            const double root = std::sqrt(law(k, p.index).footprint(p.index, 0).axes);
            union_of.push_back(
                {p.x, p.y, p.radius() / root, p.radius() * root, t.r[k].asperities.angle[p.index]});
        }
        return ellipses ? union_area(union_of, nullptr, t.periodic ? Period{t.Lx, t.Ly} : Period{})
                        : a;
    });
    f.same("contact_area", A, kRounding);
    if (t.elements)
        f.same("contact_area_pixels", t.rows([&](auto k, auto s) {
            return number(t.contacts[k][s].pixels.size()) * t.contacts[k][s].pixel;
        }),
               kRounding);
    const double A0 = t.Lx * t.Ly;
    if (t.periodic) {
        f.same("pressure", t.rows([&](auto k, auto s) { return N[k * t.steps + s] / A0; }),
               kRounding);
        f.same("area_fraction", t.rows([&](auto k, auto s) { return A[k * t.steps + s] / A0; }),
               kRounding);
    }
    f.same("contacts", t.rows([&](auto k, auto s) { return number(spots(k, s).size()); }));
    f.same("candidates", t.rows([&](auto k, auto s) -> double {
        const double Z = level(k, s).separation;
        if (t.elements && t.periodic) return number(t.heights[k].z.size());
        if (t.periodic || (yields && t.elements)) return level(k, s).candidates;
        double n = 0;
        const auto place = [&](double x, double y, double z) {
            const double reach = 2 * std::pow(t.c.indentation.selection_factor, 2) *
                                 std::max(0.0, 4 * t.sigma - Z) * t.R;
            n += z + t.top(x, y) - Z > 0 &&
                 (!paper || std::pow(std::hypot(x - t.tip_x, y - t.tip_y), 2) <= reach);
        };
        const Asperities& a = t.r[k].asperities;
        for (std::size_t i = 0; i < a.size() && !t.elements; ++i) place(a.x[i], a.y[i], a.z[i]);
        for (long j = 0; t.elements && j < t.heights[k].ny; ++j)
            for (const long i : indices(t.heights[k].nx))
                place(t.heights[k].x(i), t.heights[k].y(j), t.heights[k].at_point(i, j));
        return n;
    }));
    // How the solver went is its own.
    const auto of_level = [&](const char* name, auto LevelValues::*value) {
        f.same(name, t.rows([&](auto k, auto s) { return double(level(k, s).*value); }));
    };
    of_level("iterations", &Level::iterations);
    of_level("products", &Level::products);
    of_level("method", &Level::method);
    of_level("fallback", &Level::fallback);
    of_level("residual", &Level::residual);
    if (t.elements) of_level("certificate", &Level::certificate);
    if (std::isfinite(t.R))
        f.same("indenter_slope", t.rows([&](auto k, auto s) {
            double squares = 0, force = 0;
            const auto add = [&](double x, double y, double part) {
                const double rho = std::hypot(x - t.tip_x, y - t.tip_y);
                squares += part * std::pow(rho * t.slope_over_offset(rho * rho), 2);
                force += part;
            };
            for (const Pixel2& q : t.contacts[k][s].pixels) add(q.x, q.y, q.p);
            for (const Spot2& p : spots(k, s))
                if (!t.elements) add(p.x, p.y, p.f);
            return force > 0 ? std::sqrt(squares / force) : kNone;
        }),
               kRounding);
    f.attribute("method", "flag_values", {1, 2, 3});
    f.attribute("fallback", "flag_values", {0, 1, 2, 3, 4, 5, 6});
    f.attribute("status", "flag_values", {0, 1, 2, 3, 4});

    const Vector pairs = t.rows([&](auto k, auto s) {
        double n = 0;
        const auto& p = spots(k, s);
        for (std::size_t i = 0; i < p.size() && !t.elements; ++i)
            for (const std::size_t j : indices(i))
                n += t.distance(p[i].x, p[i].y, p[j].x, p[j].y) < p[i].radius() + p[j].radius();
        return n;
    });
    f.same("overlapping_pairs", pairs);
    const Vector large = t.rows([&](auto k, auto s) {
        double n = 0;
        for (const Spot2& p : spots(k, s)) n += t.spacing > 0 && p.radius() > t.spacing / 4;
        return n;
    });
    f.same("large_contacts", large);
    const Vector beyond = t.rows([&](auto k, auto s) {
        double n = 0;
        for (std::size_t i = 0; i < spots(k, s).size() && !t.elements; ++i) {
            const std::int32_t which = spots(k, s)[i].index;
            n += law(k, which).footprint(which, level(k, s).u[i]).beyond;
        }
        return n;
    });
    f.same("beyond_law", beyond);
    const Vector edges = t.rows([&](auto k, auto s) {
        double n = 0;
        for (const Spot2& p : spots(k, s)) {
            const double inside =
                std::min({p.x - t.x0, t.x0 + t.Lx - p.x, p.y - t.y0, t.y0 + t.Ly - p.y});
            n += !t.periodic && (p.cut || inside < std::max(t.spacing, p.radius()));
        }
        return n;
    });
    // and the border points that asperities leave out, where they would touch: test_map_marks,
    // test_trust
    Vector with_border = edges;
    for (std::size_t i = 0;
         i < edges.size() && t.c.surface.source != Source::asperities && !t.elements && !t.periodic;
         ++i)
        with_border[i] = std::max(edges[i], double(level(i / t.steps, i % t.steps).edge_contacts));
    f.same("edge_contacts", with_border);
    const Vector nominal = t.rows([&](auto k, auto s) {
        if (t.periodic) return A0;
        double reach = 0;
        for (const Pixel2& q : t.contacts[k][s].pixels)
            for (double a : {-0.5, 0.5})
                for (double b : {-0.5, 0.5})
                    reach = std::max(reach, std::hypot(q.x + a * t.heights[k].dx - t.tip_x,
                                                       q.y + b * t.heights[k].dy - t.tip_y));
        for (const Spot2& p : spots(k, s))
            if (!t.elements)
                reach = std::max(reach, std::hypot(p.x - t.tip_x, p.y - t.tip_y) + p.radius());
        return std::min(A0, pi * reach * reach);
    });
    f.same("nominal_area", nominal, kRounding);
    // What the doubts are raised by: test_trust.
    f.same("status", t.rows([&](auto k, auto s) -> double {
        const double given = double(level(k, s).status);
        if (given >= 3) return given;  // how the solver ended
        if (level(k, s).doubts != 0) return 1;
        return pairs[k * t.steps + s] > 0 ? 2 : 0;
    }));
    for (const auto i : indices(with_border))
        CHECK(!(with_border[i] > 0) ||
              level(i / t.steps, i % t.steps).status != LevelStatus::converged);

    // Yielding: at the hardness, and as deep as ever.
    Vector deepest(t.elements ? 0 : t.r[0].asperities.size());
    Vector plastic, work;
    for (std::size_t k = 0; k < t.M && yields; ++k) {
        std::ranges::fill(deepest, 0.0);
        for (const std::size_t s : indices(t.steps)) {
            double n = 0, lost = 0;
            for (std::size_t i = 0; i < spots(k, s).size(); ++i) {
                const Spot2& p = spots(k, s)[i];
                bool flows = p.yields;
                if (!t.elements) {
                    const double u = level(k, s).u[i];
                    flows =
                        p.pressure() > (1 - 1e-9) * t.hardness(p.index) && u >= deepest[p.index];
                    deepest[p.index] = std::max(deepest[p.index], u);
                }
                CHECK(flows == p.yields);
                n += flows;
            }
            for (const auto i : indices(deepest))
                lost += pressed_flat(t, std::int32_t(i), deepest[i]).lost;
            plastic.push_back(n);
            work.push_back(t.hertz ? lost : level(k, s).plastic_work);
        }
    }
    if (yields && sum(plastic) > 0) f.same("plastic_contacts", plastic);
    if (yields) f.same("plastic_work", work, 1e-9);
    if (yields && !t.elements) {
        Vector rest;
        for (const auto i : indices(deepest))
            rest.push_back(t.hertz ? pressed_flat(t, std::int32_t(i), deepest[i]).rest
                                   : t.r[0].remains.residual_depths[i]);
        f.same("asperity_residual_depth", rest, 1e-9);
    }
    const ResidualProfile& profile = t.r[0].remains.residual_profile;
    if (yields && t.elements && t.M == 1) {
        const Grid& g = t.heights[0];
        f.same("residual_pixel_x", profile.x);
        f.same("residual_pixel_y", profile.y);
        f.same("residual_pixel_depth", profile.depth);
        f.attribute("residual_pixel_x", "pixel_size", {g.dx}, kRounding);
        f.attribute("residual_pixel_y", "pixel_size", {g.dy}, kRounding);
        CHECK_RELATIVE(work.back(), t.c.solids.hardness * g.dx * g.dy * sum(profile.depth),
                       kRounding);
        CHECK(profile.depth.size() > 3);
    }

    f.same("extreme_area_fraction", t.rows([&](auto k, auto s) {
        double high = 0, all = 0;
        for (const Pixel2& q : t.contacts[k][s].pixels) {
            all += 1;
            high += q.p > t.E / 10;
        }
        for (const Spot2& p : spots(k, s))
            if (!t.elements) {
                all += p.area;
                high += p.pressure() > t.E / 10 ? p.area : 0;
            }
        return all > 0 ? high / all : 0;
    }),
           kRounding);
    const Cells cells(t);
    f.same("crowded_cells",
           t.rows([&](auto k, auto s) { return cells_of(t.contacts[k][s], cells).crowded; }));
    f.same("contacts_outside_map",
           t.rows([&](auto k, auto s) { return cells_of(t.contacts[k][s], cells).outside; }));

    // Stiffness and energy themselves: test_periodic, test_friction_contact, test_hardness,
    // test_element_levels.
    Vector S = t.rows([&](auto k, auto s) { return level(k, s).stiffness; }), W = S;
    for (const auto i : indices(W)) W[i] = level(i / t.steps, i % t.steps).energy;
    f.same("stiffness", S);
    f.same("energy", W);
    const auto pushed = [&](bool moment) {
        Vector v;
        for (const auto i : indices(N)) {
            double x = 0, y = 0;
            const auto add = [&](double px, double py, double force) {
                const double dx = px - t.tip_x, dy = py - t.tip_y;
                if (std::isinf(t.R)) {
                    if (moment) {
                        x += dy * force;
                        y -= dx * force;
                    }
                    return;
                }
                const double slope = t.slope_over_offset(dx * dx + dy * dy), dz = -t.top(px, py),
                             fx = -force * dx * slope;
                const double fy = -force * dy * slope;
                x += moment ? dy * force - dz * fy : fx;
                y += moment ? dz * fx - dx * force : fy;
            };
            const Contacts2& c = t.contacts[i / t.steps][i % t.steps];
            for (const Pixel2& q : c.pixels)
                if (!std::isinf(t.R)) add(q.x, q.y, q.p * c.pixel);
            for (const Spot2& p : c.spots)
                if (c.pixels.empty() || std::isinf(t.R)) add(p.x, p.y, p.f);
            v.push_back(x);
            v.push_back(y);
        }
        return v;
    };
    const double most = *std::ranges::max_element(N);
    // Summits between points also move with the tip (test_edges): shares of N.
    constexpr double kMotion = 0.01;
    f.same("lateral_force", pushed(false), kRounding,
           (t.elements || t.hertz ? kRounding : kMotion) * most);
    f.same("moment", pushed(true), kRounding, kRounding * most * t.Lx);
    f.same("component", {1, 2});
    f.attribute("component", "flag_values", {1, 2});
    const Vector length = t.rows([&](auto k, auto s) { return -2 * S[k * t.steps + s] / t.E; });
    f.same("conductance_length", length, kRounding);
    if (f.has("pressure"))
        f.same("conductance_per_area",
               t.rows([&](auto k, auto s) { return length[k * t.steps + s] / (t.Lx * t.Ly); }),
               kRounding);
    const double rho = t.c.solids.resistivity[0] + t.c.solids.resistivity[1];
    if (rho > 0)
        f.same("resistance", t.rows([&](auto k, auto s) {
            return length[k * t.steps + s] > 0 ? rho / length[k * t.steps + s] : kNone;
        }),
               kRounding);
    else
        CHECK(!f.has("resistance"));

    // Over realizations, of what the file has.
    for (const char* name :
         {"force", "contact_area", "pressure", "area_fraction", "stiffness", "energy",
          "lateral_force", "moment", "conductance_length", "resistance"}) {
        if (!f.has(name)) continue;
        const Vector all = f.values(name);
        const std::size_t n = all.size() / t.M;
        Vector middle(n), deviation(n);
        for (const std::size_t i : indices(n)) {
            for (const std::size_t k : indices(t.M)) middle[i] += all[k * n + i] / number(t.M);
            for (const std::size_t k : indices(t.M))
                deviation[i] += std::pow(all[k * n + i] - middle[i], 2);
            deviation[i] = t.M > 1 ? std::sqrt(deviation[i] / (number(t.M) - 1)) : kNone;
        }
        // A prescribed force has no spread but that of the solver's tolerance.
        if (name == std::string("force") && t.c.indentation.control != Control::separation &&
            t.M > 1)
            deviation.assign(n, 0.0);
        const double size = std::abs(*std::ranges::max_element(all));
        f.same(std::string(name) + "_mean", middle, 1e-13, 1e-15 * size);
        f.same(std::string(name) + "_std", deviation, 1e-9, 1e-14 * size);
    }
}

}  // namespace values
