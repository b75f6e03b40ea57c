// The flow through a periodic gap by conjugate gradients over all its points, and the clusters of
// the gap by walking through them: slow second implementations of src/physics/flow, which share
// nothing with it.
#pragma once

#include <deque>

#include "check.hpp"

namespace truth {

struct Gap {
    int nx, ny;
    double dx, dy;
    std::vector<double> g;  // row by row, 0: closed
    double at(int i, int j) const {
        const int x = (i % nx + nx) % nx, y = (j % ny + ny) % ny;
        return g[y * nx + x];
    }
};

// Resistors between neighbours: two halves of a pixel in series.
inline double conductance(double a, double b, double side, double distance) {
    if (!(a > 0 && b > 0)) return 0;
    const double halves = 0.5 * 12 / (a * a * a) + 0.5 * 12 / (b * b * b);
    return side / distance / halves;
}

// What the smooth face drags at unit velocity through the face between two open neighbours.
inline double dragged(double a, double b, double side) {
    return a > 0 && b > 0 ? side * 0.5 * (a + b) / 2 : 0;
}

// Sum of the fluxes that leave each point for pressures p, a mean gradient (gx, gy), and a velocity
// (ux, uy) of the smooth face.
inline std::vector<double> outflow(const Gap& m, const std::vector<double>& p, double gx, double gy,
                                   double ux = 0, double uy = 0) {
    std::vector<double> out(m.g.size(), 0.0);
    for (const int j : indices(m.ny))
        for (const int i : indices(m.nx)) {
            const std::array<std::array<int, 2>, 4> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
            for (const auto& [a, b] : steps) {
                const int x = (i + a + m.nx) % m.nx, y = (j + b + m.ny) % m.ny;
                const double c = a != 0 ? conductance(m.at(i, j), m.at(x, y), m.dy, m.dx)
                                        : conductance(m.at(i, j), m.at(x, y), m.dx, m.dy);
                const double drop =
                    p[j * m.nx + i] - p[y * m.nx + x] - (gx * a * m.dx + gy * b * m.dy);
                out[j * m.nx + i] +=
                    c * drop + (a != 0 ? a * ux * dragged(m.at(i, j), m.at(x, y), m.dy)
                                       : b * uy * dragged(m.at(i, j), m.at(x, y), m.dx));
            }
        }
    return out;
}

// Pressures without net outflow anywhere, by conjugate gradients with the diagonal as
// preconditioner.
inline std::vector<double> pressures(const Gap& m, double gx, double gy, double ux = 0,
                                     double uy = 0) {
    const std::size_t n = m.g.size();
    std::vector<double> p(n, 0.0), zero = outflow(m, p, gx, gy, ux, uy), r(n), z(n), d(n, 0.0),
                                   diagonal(n);
    for (const int j : indices(m.ny))
        for (const int i : indices(m.nx))
            diagonal[j * m.nx + i] = conductance(m.at(i, j), m.at(i + 1, j), m.dy, m.dx) +
                                     conductance(m.at(i, j), m.at(i - 1, j), m.dy, m.dx) +
                                     conductance(m.at(i, j), m.at(i, j + 1), m.dx, m.dy) +
                                     conductance(m.at(i, j), m.at(i, j - 1), m.dx, m.dy);
    double before = 0, first = 0;
    for (const std::size_t k : indices(n)) r[k] = -zero[k];
    for (const int step : indices(200 * (m.nx + m.ny))) {
        double rz = 0;
        for (const std::size_t k : indices(n)) {
            z[k] = diagonal[k] > 0 ? r[k] / diagonal[k] : 0;
            rz += r[k] * z[k];
        }
        if (step == 0) first = rz;
        if (!(rz > 1e-28 * first)) break;
        for (const std::size_t k : indices(n)) d[k] = z[k] + (step > 0 ? rz / before * d[k] : 0);
        const std::vector<double> Ad = outflow(m, d, 0, 0);
        double dAd = 0;
        for (const std::size_t k : indices(n)) dAd += d[k] * Ad[k];
        for (const std::size_t k : indices(n)) {
            p[k] += rz / dAd * d[k];
            r[k] -= rz / dAd * Ad[k];
        }
        before = rz;
    }
    return p;
}

// -K of a gradient along x (y): the flux through all links along x (xx), along y (yy), and that
// along y for the gradient along x (xy).
inline std::array<double, 3> permeability(const Gap& m) {
    std::array<double, 3> K{};
    const double area = m.nx * m.dx * m.ny * m.dy;
    for (const bool along_x : {true, false}) {
        const std::vector<double> p = pressures(m, along_x ? 1 : 0, along_x ? 0 : 1);
        for (const int j : indices(m.ny))
            for (const int i : indices(m.nx)) {
                const double here = p[j * m.nx + i];
                const double right = p[j * m.nx + (i + 1) % m.nx];
                const double up = p[(j + 1) % m.ny * m.nx + i];
                const double qx = conductance(m.at(i, j), m.at(i + 1, j), m.dy, m.dx) *
                                  (right - here + (along_x ? m.dx : 0)) * m.dx / area;
                const double qy = conductance(m.at(i, j), m.at(i, j + 1), m.dx, m.dy) *
                                  (up - here + (along_x ? 0 : m.dy)) * m.dy / area;
                K[along_x ? 0 : 1] += along_x ? qx : qy;
                if (along_x) K[2] += qy;
            }
    }
    return K;
}

// The mean flux per width (xx, yx) of a velocity along x, (xy, yy) of one along y, by solving
// div(U g/2 - g^3/12 grad P) = 0 for each: in the order xx, xy, yx, yy.
inline std::array<double, 4> shear_flow(const Gap& m) {
    std::array<double, 4> S{};
    const double area = m.nx * m.dx * m.ny * m.dy;
    for (const int s : {0, 1}) {
        const std::vector<double> p = pressures(m, 0, 0, 1 - s, s);
        for (const int j : indices(m.ny))
            for (const int i : indices(m.nx)) {
                const double here = p[j * m.nx + i], g = m.at(i, j);
                const double right = m.at(i + 1, j), above = m.at(i, j + 1);
                S[s] += m.dx / area *
                        ((1 - s) * dragged(g, right, m.dy) +
                         conductance(g, right, m.dy, m.dx) * (here - p[j * m.nx + (i + 1) % m.nx]));
                S[2 + s] +=
                    m.dy / area *
                    (s * dragged(g, above, m.dx) +
                     conductance(g, above, m.dx, m.dy) * (here - p[(j + 1) % m.ny * m.nx + i]));
            }
    }
    return S;
}

// True if a walk through open points from some point ends at its own image in another period along
// x (along y). Walks in the plane of all periods, which no walk has to leave by more periods than
// the cell has points along its other side.
inline std::array<bool, 2> percolates(const Gap& m) {
    std::array<bool, 2> winds{false, false};
    std::vector<char> done(m.g.size(), 0);
    for (const int start : indices(m.nx * m.ny)) {
        if (!(m.g[start] > 0) || done[start]) continue;
        std::map<std::pair<int, int>, std::set<std::pair<int, int>>> seen;  // point: its periods
        std::deque<std::array<int, 2>> walk{{start % m.nx, start / m.nx}};
        while (!walk.empty()) {
            const auto [x, y] = walk.front();
            walk.pop_front();
            const auto floor_of = [](int v, int n) { return v >= 0 ? v / n : -((n - 1 - v) / n); };
            const std::pair<int, int> period{floor_of(x, m.nx), floor_of(y, m.ny)},
                cell{x - period.first * m.nx, y - period.second * m.ny};
            auto& periods = seen[cell];
            if (periods.size() > 2 || !periods.insert(period).second) continue;
            done[cell.second * m.nx + cell.first] = 1;
            for (const auto& other : periods) {
                winds[0] = winds[0] || other.first != period.first;
                winds[1] = winds[1] || other.second != period.second;
            }
            for (const auto& [a, b] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                if (m.at(x + a, y + b) > 0) walk.push_back({x + a, y + b});
        }
    }
    return winds;
}

}  // namespace truth
