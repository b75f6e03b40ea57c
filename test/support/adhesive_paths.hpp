// What the tests of adhesive contacts share: random systems of asperities, the work of a cycle, and
// PathMinimiser.
//
// PathMinimiser is a slow and independent way to follow the path of a few adhesive asperities: at
// every small step of the separation, the edge of one contact after the other moves to the nearest
// minimum of the energy along its own radius, the forces being in equilibrium, until none moves.
#pragma once

#include "check.hpp"
#include "contact/make.hpp"
#include "support/asperities.hpp"
#include "support/bodies.hpp"
#include "truth/elimination.hpp"

// Asperities on the unit square at distances of at least `apart`, and a work of adhesion.
struct RandomAsperities {
    rsc::Asperities asperities;
    double w;
};
inline RandomAsperities random_asperities(int n, unsigned seed, double apart) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    rsc::Asperities a;
    while (int(a.x.size()) < n) {
        const double px = uniform(generator), py = uniform(generator);
        bool close = false;
        for (const auto k : indices(a.x))
            close = close || std::hypot(px - a.x[k], py - a.y[k]) < apart;
        if (close) continue;
        a.x.push_back(px);
        a.y.push_back(py);
        a.z.push_back(0.02 * uniform(generator));
        a.radius.push_back(0.1 + 0.3 * uniform(generator));
    }
    return {a, std::pow(10.0, -3.5 + 1.5 * uniform(generator))};
}

inline rsc::SolverOptions sticky(double w, double range) {
    return {.tolerance = 1e-12, .physics = bodies_with(rsc::Adhesion{w, range})};
}

inline constexpr double kE = 5.0;  // E* of these contacts
inline std::unique_ptr<rsc::Path> under_flat(const rsc::Asperities& asperities,
                                             const rsc::SolverOptions& options) {
    return rsc::make_asperity_contact(asperities, {kE, kInfinity, 0.5, 0.5}, options);
}
// Three times the penetration at which an asperity of the radius 0.25 lets go.
inline double reach(double w) { return 3 * std::cbrt(std::pow(pi * w / 8 / kE, 2) * 0.25); }

// Maugis (1992) on a sphere of radius r by m = c/a: the contact radius from its equation, a
// quadratic one, then force and penetration.
struct Maugis {
    double r, w, lambda, E;
    double range() const { return w / (lambda / 2 * std::cbrt(16 * pi * w * E * E / (9 * r))); }
    struct State {
        double a, f, u, c;
    };
    State at(double m) const {
        const double q = std::sqrt(m * m - 1), t = std::atan(q);
        const double b = lambda / 2 * (q + (m * m - 2) * t),
                     d = 4 * lambda * lambda / 3 * (q * t - m + 1);
        const double a = 2 / (std::sqrt(d * d + 4 * b) + d),
                     unit = std::cbrt(4 * E / (3 * pi * w * r * r));
        return {
            a / unit, (a * a * a - lambda * a * a * (q + m * m * t)) * pi * w * r,
            (a * a - 4.0 / 3 * a * lambda * q) / std::cbrt(16 * E * E / (9 * pi * pi * w * w * r)),
            m * a / unit};
    }
};

// Sets the heights of `under` to the clearances of `asperities` with the tip at (x, y):
// PathMinimiser presses them by a flat.
inline void set_clearances(rsc::Asperities& under, const rsc::Asperities& asperities,
                           rsc::Indenter tip, double x, double y) {
    tip.move(x, y);
    for (const auto i : indices(under))
        under.z[i] = tip.clearance(asperities.x[i], asperities.y[i], asperities.z[i]);
}

// Checks that int N dZ0 from `top`, where nothing is attached, to `bottom` and back is the energy
// lost. Jumps are found by going back to the state and halving the way; between them the integral
// is refined until Simpson's rule and the one with end slopes agree.
inline void check_work_of_cycle(rsc::Path& contact, double top, double bottom) {
    rsc::Level level = contact.at_separation(top);
    double work = 0;
    constexpr double
        least = 1e-9,
        step = 2e-4,
        precise = 1e-12;  // shortest steps, longest steps, and the error of the work in a step
    const std::function<void(double, int)> go = [&](double Z, int depth) {
        const rsc::Path::State memory = contact.state();
        const rsc::Level before = level;
        const double slope = contact.stiffness(), width = before.separation - Z;
        const rsc::Level end = contact.at_separation(Z);
        const double mean = 0.5 * (before.force + end.force);
        const double whole = width * mean + width * width / 12 * (slope - contact.stiffness());
        contact.restore(memory);
        level = contact.at_separation(before.separation - 0.5 * width);
        const double better = width * (before.force + 4 * level.force + end.force) / 6;
        const bool jumps = end.energy_lost != before.energy_lost;
        if ((jumps && std::abs(width) > least) ||
            (!jumps && std::abs(whole - better) > precise && depth < 40)) {
            contact.restore(memory);
            level = before;
            go(before.separation - 0.5 * width, depth + 1);
            go(Z, depth + 1);
            return;
        }
        level = contact.at_separation(Z);
        work += jumps ? width * mean : better;
    };
    for (const double end : {bottom, top})
        while (level.separation != end) {
            const double rest = end - level.separation;
            go(std::abs(rest) < step ? end : level.separation + std::copysign(step, rest), 0);
        }
    CHECK(level.contacts == 0);
    CHECK_RELATIVE(work, level.energy_lost, 1e-6);
}

// Edge: force(i, c, u, slope), the force of asperity i with an edge at the radius c and the
// penetration u, which grows with u, and its slope; growth(i, c, u), what the energy gains when the
// edge's area grows by a unit area, with the sign changed: positive if the edge advances;
// touches(), the penetration at which a free asperity attaches; start(i, u), the radius from which
// it grows then; seed(i), a radius far below that of any stable contact.
template <class Edge>
class PathMinimiser {
public:
    PathMinimiser(const rsc::Asperities& asperities, double E, Edge edge,
                  const rsc::Kernel* repeats = nullptr)
        : a_(asperities),
          E_(E),
          edge_(edge),
          repeats_(repeats),
          radius_(a_.size(), 0.0),
          u_(a_.size(), 0.0),
          f_(a_.size(), 0.0) {}

    double Z = 1;  // the present separation

    void go_to(double end, double step) {
        const int steps = int(std::ceil(std::abs(end - Z) / step));
        const double from = Z;
        for (int k = 1; k <= steps; ++k) {
            Z = from + (end - from) * k / steps;
            relax();
        }
    }
    double force() {
        solve();
        double sum = 0;
        for (double f : f_) sum += f;
        return sum;
    }
    int attached() const {
        return int(std::ranges::count_if(radius_, [](double c) { return c > 0; }));
    }

private:
    double compliance(std::size_t i, std::size_t j) const {
        if (repeats_)
            return (i == j ? repeats_->self()
                           : repeats_->at(a_.x[i] - a_.x[j], a_.y[i] - a_.y[j])) -
                   repeats_->shift();
        return i == j ? 0 : 1 / (pi * E_ * std::hypot(a_.x[i] - a_.x[j], a_.y[i] - a_.y[j]));
    }
    // Equilibrium at given radii, u = g0 - B f(u), by Newton's method and elimination.
    void solve() {
        const std::size_t n = radius_.size();
        for (int step = 0; step < 60; ++step) {
            std::vector<double> slope(n), m(n * n), rest(n);
            for (const std::size_t i : indices(n))
                f_[i] = radius_[i] > 0 ? edge_.force(i, radius_[i], u_[i], slope[i]) : 0.0;
            double worst = 0;
            for (const std::size_t i : indices(n)) {
                rest[i] = a_.z[i] - Z - u_[i];
                for (const std::size_t j : indices(n)) {
                    rest[i] -= compliance(i, j) * f_[j];
                    m[i * n + j] = (i == j ? 1 : 0) + compliance(i, j) * slope[j];
                }
                worst = std::max(worst, std::abs(rest[i]));
            }
            const std::vector<double> change = solved(m, rest);
            for (const std::size_t i : indices(n)) u_[i] += change[i];
            if (worst < 1e-17) break;
        }
        for (const std::size_t i : indices(n)) {
            double slope;
            f_[i] = radius_[i] > 0 ? edge_.force(i, radius_[i], u_[i], slope) : 0.0;
        }
    }
    double growth(std::size_t i, double radius) {
        radius_[i] = radius;
        solve();
        return edge_.growth(i, radius, u_[i]);
    }
    // The edge of contact i moves in the direction in which the energy falls, to the nearest
    // minimum. Returns the distance.
    double move(std::size_t i) {
        const double begin = radius_[i], seed = edge_.seed(i);
        double last = begin;
        if (begin == 0) {
            solve();
            if (!(u_[i] > edge_.touches())) return 0;
            last = std::max(seed, edge_.start(i, u_[i]));
        }
        double here = growth(i, last);
        const bool grows = here > 0;
        for (double step = 0.01 * last;;
             step *= 1.2) {  // a step too long would pass the minimum and the next maximum
            const double next = last + (grows ? step : -step);
            if (next < seed && !grows) {
                (void)growth(i, 0);
                return begin;
            }
            double value = growth(i, next);
            if ((value > 0) == grows) {
                last = next;
                here = value;
                continue;
            }
            double end = next;
            for (int k = 0; k < 60 && std::abs(end - last) > 1e-14 * end; ++k) {  // Illinois
                const double middle = (last * value - end * here) / (value - here),
                             now = growth(i, middle);
                if (now == 0) break;
                if ((now > 0) != (value > 0)) {
                    last = end;
                    here = value;
                } else {
                    here *= 0.5;
                }
                end = middle;
                value = now;
            }
            return std::abs(radius_[i] - begin);
        }
    }
    void relax() {
        for (int sweep = 0; sweep < 10000; ++sweep) {
            double moved = 0;
            for (const auto i : indices(radius_))
                moved = std::max(moved, move(i) / std::max(radius_[i], 1e-6));
            if (moved < 1e-11) return;
        }
    }
    const rsc::Asperities& a_;
    double E_;
    Edge edge_;
    const rsc::Kernel* repeats_;  // of flats; null: a free surface
    std::vector<double> radius_, u_, f_;
};
