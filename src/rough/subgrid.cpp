#include "rough/subgrid.hpp"

#include <algorithm>
#include <cmath>

#include "rough/neighbours.hpp"

namespace rsc {
namespace {

// How many grid steps a summit may lie from a start that is no maximum; its paraboloid has its top within one step.
constexpr int kShortTravel = 1;

template <class T>
void join(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

template <class T>
void keep_marked(std::vector<T>& values, const std::vector<char>& keep) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (keep[i]) values[kept++] = values[i];
    values.resize(kept);
}

// u in [0, n) of a periodic line of n steps; u is at most a few steps outside.
double wrapped(double u, int n) {
    u -= n * std::floor(u / n);
    return u < n ? u : 0.0;  // rounding may make a tiny negative u a whole n
}

int wrapped(int i, int n) { return (i % n + n) % n; }

}  // namespace

void RefinedSummits::append(const RefinedSummits& other) {
    join(found.x, other.found.x), join(found.y, other.found.y), join(found.z, other.found.z);
    join(found.radius, other.found.radius), join(found.angle, other.found.angle);
    join(found.kappa1, other.found.kappa1), join(found.kappa2, other.found.kappa2);
    join(found.biharmonic, other.found.biharmonic);
    join(row, other.row), join(column, other.column), join(maximum, other.maximum);
    join(u, other.u), join(v, other.v), join(moved, other.moved);
    saddles += other.saddles;
}

SummitClimber::SummitClimber(const Stencil& stencil, const RowPlace& place, int ny, double y0, Curvature curvature)
    : stencil_(stencil), place_(place), ny_(ny), y0_(y0), curvature_(curvature) {}

// The patch around (i, j); false where the stencil does not fit into a map that is not periodic.
bool SummitClimber::cut_out(int i, int j, const std::function<const double*(int)>& row) {
    const int reach = stencil_.reach(), span = margin(), nx = place_.nx;
    if (!place_.periodic) {
        if (i < reach || j < reach || i + reach >= nx || j + reach >= ny_) return false;
        patch_.first_x = std::max(-Patch::kTravel, reach - i);
        patch_.last_x = std::min(Patch::kTravel, nx - 1 - reach - i);
        patch_.first_y = std::max(-Patch::kTravel, reach - j);
        patch_.last_y = std::min(Patch::kTravel, ny_ - 1 - reach - j);
    }
    for (int dj = -span; dj <= span; ++dj) {
        const double* const from = row(dj);
        if (!from) continue;
        double* const to = patch_.z[Patch::kMargin + dj] + Patch::kMargin;
        if (i >= span && i + span < nx) {
            std::copy(from + i - span, from + i + span + 1, to - span);
        } else {
            for (int di = -span; di <= span; ++di)
                if (place_.periodic || (i + di >= 0 && i + di < nx)) to[di] = from[wrapped(i + di, nx)];
        }
    }
    return true;
}

// Whether a maximum of the grid beside (i, j) sees the same top: nothing else is to be found from (i, j) then.
bool SummitClimber::seen_from_maximum(int i, int j, const std::function<const double*(int)>& row) const {
    constexpr double kSameTop = 0.75;  // grid steps; second differences place a top to some tenths
    const int nx = place_.nx;
    if (!place_.periodic && (i < 2 || j < 2 || i + 2 >= nx || j + 2 >= ny_)) return false;
    double z[5][5];  // around (i, j)
    for (int dj = -2; dj <= 2; ++dj) {
        const double* const from = row(dj);
        for (int di = -2; di <= 2; ++di) z[dj + 2][di + 2] = from[place_.periodic ? wrapped(i + di, nx) : i + di];
    }
    struct Top {
        double x, y;
    };
    const auto top = [&](int l, int k) -> Top {  // of the paraboloid about point (k, l) of z
        const Differences d = differences(z[l - 1], z[l], z[l + 1], k - 1, k, k + 1);
        return {k + d.step_x() / d.determinant(), l + d.step_y() / d.determinant()};
    };
    const Top own = top(2, 2);
    for (int l = 1; l <= 3; ++l)
        for (int k = 1; k <= 3; ++k) {
            if (!above_neighbours(z[l - 1], z[l], z[l + 1], k - 1, k, k + 1)) continue;
            const Top its = top(l, k);
            if (std::abs(its.x - own.x) < kSameTop && std::abs(its.y - own.y) < kSameTop) return true;
        }
    return false;
}

void SummitClimber::climb(int j, const std::function<const double*(int)>& row, RefinedSummits& to) {
    find_starts(place_, row(-1), row(0), row(1), starts_);
    const double dx2 = place_.dx * place_.dx, dy2 = place_.dy * place_.dy;
    for (const auto [i, maximum] : starts_) {
        if (!maximum && seen_from_maximum(i, j, row)) continue;
        if (!cut_out(i, j, row)) continue;
        const auto s = refine(stencil_, patch_, maximum ? Patch::kTravel : kShortTravel);
        double u = 0, v = 0;
        bool kept = s.has_value();
        if (kept) {
            u = i + s->x, v = j + s->y;
            if (place_.periodic) u = wrapped(u, place_.nx), v = wrapped(v, ny_);
            const SecondOrder second{0.5 * s->zxx / dx2, 0.5 * s->zyy / dy2, 0.5 * s->zxy / (place_.dx * place_.dy)};
            kept = append_summit(place_.x0 + u * place_.dx, y0_ + v * place_.dy, s->z, second, curvature_, to.found);
        }
        if (!kept) {
            to.saddles += maximum;
            continue;
        }
        to.found.biharmonic.push_back(s->zxxxx / (dx2 * dx2) + 2 * s->zxxyy / (dx2 * dy2) + s->zyyyy / (dy2 * dy2));
        to.row.push_back(j);
        to.column.push_back(i);
        to.maximum.push_back(maximum);
        to.u.push_back(u);
        to.v.push_back(v);
        to.moved.push_back(std::max(std::abs(s->x), std::abs(s->y)));
    }
}

long drop_repeated(RefinedSummits& s, int nx, int ny, bool periodic) {
    constexpr double kSame = 1e-3;              // grid steps; one summit is reached to 1e-7, two are never that near
    constexpr int kReach = Patch::kTravel + 1;  // a start lies no further from its summit
    const auto apart = [&](double a, double b, int n) {
        const double d = std::abs(a - b);
        return periodic ? std::min(d, n - d) : d;
    };
    const auto better = [&](std::size_t f, std::size_t e) {
        if (s.maximum[f] != s.maximum[e]) return s.maximum[f] > s.maximum[e];
        return s.moved[f] < s.moved[e] || (s.moved[f] == s.moved[e] && f < e);
    };
    const auto same = [&](std::size_t f, std::size_t e) { return apart(s.u[f], s.u[e], nx) < kSame && apart(s.v[f], s.v[e], ny) < kSame; };
    // Index of the first start at or after (row, column).
    const auto place = [&](int row, int column) {
        const auto [first, end] = std::equal_range(s.row.begin(), s.row.end(), row);
        const auto base = s.column.begin();
        return static_cast<std::size_t>(std::lower_bound(base + (first - s.row.begin()), base + (end - s.row.begin()), column) - base);
    };
    std::vector<char> keep(s.row.size(), 1);
    long dropped = 0, maxima = 0;
    for (std::size_t e = 0; e < s.row.size(); ++e) {
        const int u = static_cast<int>(s.u[e]), v = static_cast<int>(s.v[e]);
        const auto look = [&](int row, int first, int last) {
            for (std::size_t f = place(row, first), end = place(row, last + 1); f < end && keep[e]; ++f)
                if (f != e && better(f, e) && same(f, e)) keep[e] = 0;
        };
        for (int d = -kReach; d <= kReach && keep[e]; ++d) {
            if (!periodic && (v + d < 0 || v + d >= ny)) continue;
            const int row = wrapped(v + d, ny), first = u - kReach, last = u + kReach;
            look(row, std::max(first, 0), std::min(last, nx - 1));
            if (periodic && first < 0) look(row, std::max(nx + first, 0), nx - 1);
            if (periodic && last >= nx) look(row, 0, std::min(last - nx, nx - 1));
        }
        if (keep[e]) continue;
        ++dropped;
        maxima += s.maximum[e];
    }
    if (dropped == 0) return 0;
    Asperities& a = s.found;
    for (auto* values : {&a.x, &a.y, &a.z, &a.radius, &a.kappa1, &a.kappa2, &a.angle, &a.biharmonic, &s.u, &s.v, &s.moved})
        keep_marked(*values, keep);
    keep_marked(s.row, keep), keep_marked(s.column, keep), keep_marked(s.maximum, keep);
    return maxima;
}

}  // namespace rsc
