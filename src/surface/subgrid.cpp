#include "surface/subgrid.hpp"

#include "base/dispatch.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

constexpr int kTaps = Stencil::kTaps;
constexpr int kOrders = Stencil::kOrders;
constexpr int kLanes = 8;  // partial sums, fixed so that a sum has the same bits on every machine

// derivative[p][q]: orders p in x and q in y from a square of `points` x `points` heights at
// `corner`.
RSC_ALWAYS_INLINE void contract_body(const double* corner, int points, int orders,
                                     const double (*wx)[kTaps], const double (*wy)[kTaps],
                                     double (*derivative)[kOrders]) {
    for (const int q : indices(orders)) {
        double line[kTaps] = {};
        for (const int j : indices(points)) {
            const double* const z = corner + j * Patch::kStride;
            const double w = wy[q][j];
            for (const int i : indices(kTaps)) line[i] += w * z[i];
        }
        for (const int p : indices(orders)) {
            double lanes[kLanes] = {};
            for (int i = 0; i < kTaps; i += kLanes)
                for (const int l : indices(kLanes)) lanes[l] += wx[p][i + l] * line[i + l];
            double sum = 0;
            for (const int l : indices(kLanes)) sum += lanes[l];
            derivative[p][q] = sum;
        }
    }
}

RSC_DISPATCH(contract, contract_body,
             (const double* corner, int points, int orders, const double (*wx)[kTaps],
              const double (*wy)[kTaps], double (*derivative)[kOrders]),
             (corner, points, orders, wx, wy, derivative))

struct Step {
    double x = 0, y = 0;
    bool peak = false;  // the step is Newton's, and the surface is concave
};

Step step_to_summit(const PointDifferences& d) {
    const double determinant = d.determinant();
    Step s;
    if (determinant > 0 && d.zxx + d.zyy < 0) {
        s = {d.step_x() / determinant, d.step_y() / determinant, true};
        const double longest = std::max(std::abs(s.x), std::abs(s.y));
        if (longest > 1) s = {s.x / longest, s.y / longest, true};
    } else if (const double slope = std::hypot(d.zx, d.zy); slope > 0) {
        s = {0.5 * d.zx / slope, 0.5 * d.zy / slope, false};
    }
    return s;
}

// First step from second differences about the middle point; saves one or two evaluations.
Step first_step(const Patch& patch) {
    constexpr int m = Patch::kMargin;
    return step_to_summit(differences(patch.z[m - 1], patch.z[m], patch.z[m + 1], m - 1, m, m + 1));
}

}  // namespace

std::optional<RefinedSummit> refine(const Stencil& stencil, const Patch& patch, int travel) {
    constexpr int kMostSteps = 40;  // three or four are usual; more along a ridge
    // The last step changes position and height only; the derivatives are those of the last
    // evaluation.
    // after a shorter step the next evaluation is the last, with an error of kNear^2
    constexpr double kNear = 1e-4;
    constexpr double kArrived = 1e-7;  // longest accepted step after the last evaluation
    const Step start = first_step(patch);
    double x = start.peak ? start.x : 0, y = start.peak ? start.y : 0;
    bool last = false;
    for (int k = 0; k < kMostSteps; ++k) {
        const double rx = std::round(x), ry = std::round(y);
        if (!(std::abs(rx) <= travel && std::abs(ry) <= travel)) return {};
        if (!(rx >= patch.first_x && rx <= patch.last_x && ry >= patch.first_y &&
              ry <= patch.last_y))
            return {};
        const int orders = last ? kOrders : 3;
        alignas(64) double wx[kOrders][kTaps], wy[kOrders][kTaps];
        stencil.weights(x - rx, orders, wx);
        stencil.weights(y - ry, orders, wy);
        double d[kOrders][kOrders];
        const int corner = Patch::kMargin - stencil.reach();
        contract(&patch.z[corner + int(ry)][corner + int(rx)], 2 * stencil.reach() + 1, orders, wx,
                 wy, d);
        const Step s = step_to_summit({d[1][0], d[0][1], d[2][0], d[1][1], d[0][2]});
        const double length = std::max(std::abs(s.x), std::abs(s.y));
        if (last && s.peak && length <= kArrived) {
            // The remaining height to the top is half of gradient times step.
            return RefinedSummit{x + s.x, y + s.y, d[0][0] + 0.5 * (d[1][0] * s.x + d[0][1] * s.y),
                                 d[2][0], d[1][1], d[0][2],
                                 d[4][0], d[3][1], d[2][2],
                                 d[1][3], d[0][4]};
        }
        last = s.peak && length <= kNear;
        x += s.x;
        y += s.y;
        if (!s.peak && length == 0) return {};  // stationary, but no peak
    }
    return {};
}

namespace {

// The search for a summit may also start at a grid point that is not a maximum, if the top of its
// paraboloid is within one step; largest distance of the summit from such a start [grid steps].
constexpr int kShortTravel = 1;

// Maps u, at most a few steps outside, to [0, n) on a periodic line of n steps.
double wrapped(double u, int n) {
    u -= n * std::floor(u / n);
    return u < n ? u : 0.0;  // a tiny negative u may be rounded to n
}

}  // namespace

SummitClimber::SummitClimber(const std::vector<Stencil>& stencils, const RowPlace& place, int ny,
                             double y0, Curvature curvature, const Breaks* breaks)
    : stencils_(stencils),
      breaks_(breaks),
      place_(place),
      ny_(ny),
      y0_(y0),
      curvature_(curvature) {}

// Largest reach of a stencil at (i, j), limited by the border of the map and the nearest break; 0
// at a break.
int SummitClimber::clear_reach(int i, int j) const {
    int reach = stencils_.back().reach();
    if (!place_.periodic) reach = std::min({reach, i, j, place_.nx - 1 - i, ny_ - 1 - j});
    if (breaks_ && !breaks_->clear.empty())
        reach = std::min<int>(reach, breaks_->clear[at(j) * at(place_.nx) + at(i)]);
    return reach;
}

// Restricts the centre of the stencil so that the stencil stays within a map that is not periodic.
void SummitClimber::keep_within(int i, int j, int reach) {
    if (place_.periodic) return;
    patch_.first_x = std::max(-Patch::kTravel, reach - i);
    patch_.last_x = std::min(Patch::kTravel, place_.nx - 1 - reach - i);
    patch_.first_y = std::max(-Patch::kTravel, reach - j);
    patch_.last_y = std::min(Patch::kTravel, ny_ - 1 - reach - j);
}

// Copies the heights around (i, j) to the patch.
void SummitClimber::cut_out(int i, int, const Rows& row) {
    const int span = margin(), nx = place_.nx;
    for (const int side : {1, -1})
        for (int d = 0; d <= span; ++d) {
            const double* const from = row(side * d);
            double* const to = patch_.z[Patch::kMargin + side * d] + Patch::kMargin;
            if (!from) {  // beyond the border, its values are repeated
                std::copy(to - side * Patch::kStride - span, to - side * Patch::kStride + span + 1,
                          to - span);
            } else if (i >= span && i + span < nx) {
                std::copy(from + i - span, from + i + span + 1, to - span);
            } else {
                for (int di = -span; di <= span; ++di)
                    to[di] =
                        from[place_.periodic ? wrapped(i + di, nx) : std::clamp(i + di, 0, nx - 1)];
            }
        }
}

// True if a grid maximum beside (i, j) leads to the same summit, so that (i, j) need not be a
// start.
bool SummitClimber::seen_from_maximum(int i, int j, const Rows& row) const {
    constexpr double kSameTop = 0.75;  // grid steps; second differences locate a top to some tenths
    const int nx = place_.nx;
    if (!place_.periodic && (i < 2 || j < 2 || i + 2 >= nx || j + 2 >= ny_)) return false;
    double z[5][5];  // around (i, j)
    for (int dj = -2; dj <= 2; ++dj) {
        const double* const from = row(dj);
        for (int di = -2; di <= 2; ++di)
            z[dj + 2][di + 2] = from[place_.periodic ? wrapped(i + di, nx) : i + di];
    }
    struct Top {
        double x, y;
    };
    // top of the paraboloid about the point in row l, column k
    const auto top = [&](int l, int k) -> Top {
        const PointDifferences d = differences(z[l - 1], z[l], z[l + 1], k - 1, k, k + 1);
        return {k + d.step_x() / d.determinant(), l + d.step_y() / d.determinant()};
    };
    const Top own = top(2, 2);
    for (int l = 1; l <= 3; ++l)
        for (int k = 1; k <= 3; ++k) {
            if (!above_neighbours(z[l - 1], z[l], z[l + 1], k - 1, k, k + 1)) continue;
            const Top its = top(l, k);
            if (std::abs(its.x - own.x) < kSameTop && std::abs(its.y - own.y) < kSameTop)
                return true;
        }
    return false;
}

// Typical second difference around the middle of the patch: the sum of the medians along x and
// along y. Pits, grooves and steps affect a minority of the points and do not change it.
double SummitClimber::usual_bend() const {
    constexpr int reach = 3, around = reach + 1, side = 2 * around + 1,
                  points = (2 * reach + 1) * (2 * reach + 1);
    double along_x[points], along_y[points], z[side][side];
    for (const int l : indices(side))
        for (const int k : indices(side)) z[l][k] = height(k - around, l - around);
    int n = 0;
    for (int l = 1; l + 1 < side; ++l)
        for (int k = 1; k + 1 < side; ++k, ++n) {
            along_x[n] = std::abs(z[l][k - 1] - 2 * z[l][k] + z[l][k + 1]);
            along_y[n] = std::abs(z[l - 1][k] - 2 * z[l][k] + z[l + 1][k]);
        }
    std::nth_element(along_x, along_x + points / 2, along_x + points);
    std::nth_element(along_y, along_y + points / 2, along_y + points);
    return along_x[points / 2] + along_y[points / 2];
}

// True if the summit is no higher above the points around it than the second differences `bend`
// permit. A polynomial through a pit, step or seam overshoots by some tenths of its depth.
bool SummitClimber::smooth_around(const RefinedSummit& summit, double bend) const {
    // A summit half a step from its grid point in both directions rises by bend/8, and its
    // curvature may be several times the median.
    constexpr double most = 0.75;
    const int ci = int(std::lround(summit.x)), cj = int(std::lround(summit.y));
    double highest = -kInfinity;
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) highest = std::max(highest, height(ci + di, cj + dj));
    return summit.z <= highest + most * bend;
}

// The grid maximum in the middle of the patch as a summit with second differences. If one of these
// is that of a pit or a step, the smallest one at the point and its neighbours is used.
RefinedSummit SummitClimber::of_grid(double bend, bool& broken) const {
    constexpr double usual = 8;
    const auto z = [&](int di, int dj) { return height(di, dj); };
    bool bends_usually = true;
    const auto second = [&](int ex, int ey) {
        const auto bent = [&](int k) {
            return z((k - 1) * ex, (k - 1) * ey) - 2 * z(k * ex, k * ey) +
                   z((k + 1) * ex, (k + 1) * ey);
        };
        const double here = bent(0);
        if (here >= -usual * bend) return here;
        bends_usually = false;
        broken = true;
        double least = here;
        for (const int k : {-1, 1})
            if (const double other = bent(k); other < 0) least = std::max(least, other);
        return least;
    };
    RefinedSummit s;
    s.z = z(0, 0);
    s.zxx = second(1, 0);
    s.zyy = second(0, 1);
    if (bends_usually) s.zxy = 0.25 * (z(1, 1) - z(-1, 1) - z(1, -1) + z(-1, -1));
    return s;
}

std::optional<RefinedSummit> SummitClimber::summit_from(int i, int j, bool maximum,
                                                        const Rows& row) {
    const int travel = maximum ? Patch::kTravel : kShortTravel, clear = clear_reach(i, j);
    const Stencil& longest = stencils_.back();
    if (longest.band_known()) {
        if (clear < longest.reach()) return {};
        cut_out(i, j, row);
        keep_within(i, j, clear);
        return refine(longest, patch_, travel);
    }
    cut_out(i, j, row);
    const double bend = usual_bend();
    bool broken = clear == 0;
    for (int reach = clear; reach > 0; --reach) {
        keep_within(i, j, reach);
        const auto s = refine(stencils_[at(reach - 1)], patch_, travel);
        if (s && smooth_around(*s, bend)) return s;
        if (!s && clear == longest.reach()) break;  // no break is near
        broken |= s.has_value();
    }
    if (!maximum) return {};
    // near a break the grid maximum itself is the summit
    const RefinedSummit point = of_grid(bend, broken);
    if (broken) return point;
    return {};
}

// Biharmonic of the round profile that flattens like an elongated summit. To first order, contact
// depends on the mean of the quartic over the rim of the contact ellipse: (3/8)(c_LL r + c_SS/r) +
// c_LS/8 for an ellipse of area pi with the axis ratio sqrt(r), long over short. c_LL, c_LS and
// c_SS are the coefficients of the quartic along the long and short axes.
// Also appends the plain one (THEORY.rst, Contact laws of an asperity).
double SummitClimber::append_biharmonic(const RefinedSummit& s, Asperities& a) const {
    const double dx = place_.dx, dy = place_.dy;
    const double z40 = s.zxxxx / (dx * dx * dx * dx);
    const double z31 = s.zxxxy / (dx * dx * dx * dy);
    const double z22 = s.zxxyy / (dx * dx * dy * dy);
    const double z13 = s.zxyyy / (dx * dy * dy * dy);
    const double z04 = s.zyyyy / (dy * dy * dy * dy);
    const double c = std::cos(a.angle.back()), t = std::sin(a.angle.back()), cc = c * c, tt = t * t,
                 ct = c * t;
    const double along =
        z40 * cc * cc + 4 * z31 * cc * ct + 6 * z22 * cc * tt + 4 * z13 * ct * tt + z04 * tt * tt;
    const double across =
        z40 * tt * tt - 4 * z31 * ct * tt + 6 * z22 * cc * tt - 4 * z13 * cc * ct + z04 * cc * cc;
    const double both = (z40 + z04 - 4 * z22) * cc * tt + 2 * (z13 - z31) * ct * (cc - tt) +
                        z22 * (cc * cc + tt * tt);
    const double k1 = a.kappa1.back(), k2 = a.kappa2.back();
    // exponent of the axis ratio of a Hertz contact, (kappa1/kappa2)^0.636 (Brewe and Hamrock 1977)
    constexpr double kAxes = 0.636;
    const double r = std::pow(k1 / k2, 2 * kAxes);
    a.biharmonic.push_back(z40 + 2 * z22 + z04);
    return (r * along + across / r + 2 * both) * (k1 + k2) / (2 * std::sqrt(k1 * k2));
}

void SummitClimber::climb(int j, const Rows& row, RefinedSummits& to) {
    find_starts(place_, row(-1), row(0), row(1), starts_);
    for (const auto [i, maximum] : starts_)
        if (maximum || !seen_from_maximum(i, j, row)) climb_from(i, j, maximum, row, to);
}

void SummitClimber::climb_from(int i, int j, bool maximum, const Rows& row, RefinedSummits& to) {
    const auto s = summit_from(i, j, maximum, row);
    double u = 0, v = 0;
    bool valid = s.has_value();
    if (valid) {
        u = i + s->x;
        v = j + s->y;
        if (place_.periodic) {
            u = wrapped(u, place_.nx);
            v = wrapped(v, ny_);
        }
        const SecondOrder second{0.5 * s->zxx / (place_.dx * place_.dx),
                                 0.5 * s->zyy / (place_.dy * place_.dy),
                                 0.5 * s->zxy / (place_.dx * place_.dy)};
        valid = append_summit(place_.x0 + u * place_.dx, y0_ + v * place_.dy, s->z, second,
                              curvature_, to.found);
    }
    if (!valid) {
        to.saddles += maximum;
        return;
    }
    const double elongated = append_biharmonic(*s, to.found);
    to.from.push_back({j, i, maximum, u, v, std::max(std::abs(s->x), std::abs(s->y)), elongated});
}

long drop_repeated(RefinedSummits& s, int nx, int ny, bool periodic) {
    using From = RefinedSummits::From;
    // grid steps; summits are located to 1e-7, and different ones are farther apart
    constexpr double kSame = 1e-3;
    constexpr int kReach = Patch::kTravel + 1;  // largest distance of a start from its summit
    const auto apart = [&](double a, double b, int n) {
        const double d = std::abs(a - b);
        return periodic ? std::min(d, n - d) : d;
    };
    const auto better = [](const From& f, const From& e) {
        if (f.maximum != e.maximum) return f.maximum;
        return f.moved < e.moved || (f.moved == e.moved && &f < &e);
    };
    const auto same = [&](const From& f, const From& e) {
        return apart(f.u, e.u, nx) < kSame && apart(f.v, e.v, ny) < kSame;
    };
    // The first start at or after (row, column).
    const auto place = [&](int row, int column) {
        return std::lower_bound(
            s.from.begin(), s.from.end(), std::pair(row, column),
            [](const From& f, std::pair<int, int> at) { return std::pair(f.row, f.column) < at; });
    };
    const auto is_best = [&](std::size_t k) {
        const From& e = s.from[k];
        bool keep = true;
        const int u = int(e.u), v = int(e.v);
        const auto look = [&](int row, int first, int last) {
            for (auto f = place(row, first), end = place(row, last + 1); f < end && keep; ++f)
                keep = !(better(*f, e) && same(*f, e));
        };
        for (int d = -kReach; d <= kReach && keep; ++d) {
            if (!periodic && (v + d < 0 || v + d >= ny)) continue;
            const int row = wrapped(v + d, ny), first = u - kReach, last = u + kReach;
            look(row, std::max(first, 0), std::min(last, nx - 1));
            if (periodic && first < 0) look(row, std::max(nx + first, 0), nx - 1);
            if (periodic && last >= nx) look(row, 0, std::min(last - nx, nx - 1));
        }
        return keep;
    };
    const auto maxima = [&] { return std::ranges::count(s.from, true, &From::maximum); };
    constexpr int kStarts = 256;  // that a thread takes at a time
    std::vector<int> best;
    find_all(s.from.size(), kStarts, 0, is_best, best);
    const auto before = maxima();
    const std::vector<std::size_t> chosen(best.begin(), best.end());
    for (const auto k : indices(chosen)) s.from[k] = s.from[chosen[k]];
    s.from.resize(chosen.size());
    s.found = selected(s.found, chosen);
    return before - maxima();
}

}  // namespace rsc
