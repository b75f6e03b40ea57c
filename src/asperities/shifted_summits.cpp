#include "asperities/shifted_summits.hpp"

#include "surface/summits.hpp"

namespace rsc {
namespace {

// Curvatures of a summit.
Tensor curvatures_of(const Asperities& a, std::size_t i) {
    const double c = std::cos(a.angle[i]), s = std::sin(a.angle[i]), high = a.kappa1[i],
                 low = a.kappa2[i];
    return {high * s * s + low * c * c, (low - high) * s * c, high * c * c + low * s * s};
}

// Maximum of -g'd - d'H d/2 over |d| <= radius for a positive definite H: d = -(H + m)^-1 g, with
// m = 0 within the range and on its border the m > 0 at which |d| = radius.
Vec2 highest_within(const Tensor& H, const Vec2& g, double radius) {
    if (!(radius > 0)) return {};
    const auto at = [&](double m) {
        const double xx = H.xx + m, yy = H.yy + m, determinant = xx * yy - H.xy * H.xy;
        return Vec2{-(yy * g.x - H.xy * g.y) / determinant, -(xx * g.y - H.xy * g.x) / determinant};
    };
    Vec2 d = at(0);
    if (!(d.x * d.x + d.y * d.y > radius * radius)) return d;
    // 1/|d(m)| is a concave function of m between two straight lines: Newton's method on it
    // converges monotonically from below.
    const double mean = 0.5 * (H.xx + H.yy),
                 half = std::hypot(0.5 * (H.xx - H.yy), H.xy);  // eigenvalues mean +- half
    double m = std::max(0.0, std::hypot(g.x, g.y) / radius - (mean + half));
    constexpr int most = 30;
    for (int k = 0; k < most; ++k) {
        d = at(m);
        const double length = std::hypot(d.x, d.y);
        const double xx = H.xx + m, yy = H.yy + m, determinant = xx * yy - H.xy * H.xy;
        const double fall =
            (yy * d.x * d.x - 2 * H.xy * d.x * d.y + xx * d.y * d.y) / (determinant * length);
        const double more = (length / radius - 1) * length / fall;
        if (!(more > 4 * std::numeric_limits<double>::epsilon() * (m + mean))) break;
        m += more;
    }
    return d;
}

}  // namespace

ShiftedSummits::ShiftedSummits(const Asperities& of_surface, const Indenter& indenter,
                               double farthest)
    : of_surface_(of_surface),
      indenter_(indenter),
      farthest_(farthest),
      geometric_(
          of_surface.size() == 0 ||
          std::abs(of_surface.radius[0] * std::sqrt(of_surface.kappa1[0] * of_surface.kappa2[0]) -
                   1) <
              std::abs(of_surface.radius[0] * 0.5 * (of_surface.kappa1[0] + of_surface.kappa2[0]) -
                       1)),
      highest_(of_surface.size() == 0
                   ? -kInfinity
                   : *std::max_element(of_surface.z.begin(), of_surface.z.end())),
      shifted_(of_surface),
      own_(of_surface.size(), {kNotComputed, 0, 0}),
      bent_(of_surface.size()),
      done_(of_surface.size()) {}

void ShiftedSummits::forget() {
    for (const std::size_t i : which_) done_[i] = kNothing;
    which_.clear();
}

void ShiftedSummits::shift(std::size_t i) {
    if (done_[i] != kNothing) return;
    which_.push_back(i);
    done_[i] = kShifted;
    const Asperities& a = of_surface_;
    const IndenterShape& shape = *indenter_.shape.operator->();
    if (std::isnan(own_[i].xx)) own_[i] = curvatures_of(a, i);
    const Tensor H = own_[i];
    const Vec2 at = indenter_.from_tip(a.x[i], a.y[i]);
    Vec2 d;
    Tensor bent = H;
    double flattened = 0;
    if (std::isfinite(shape.height(at.x, at.y))) {
        const Tensor C = shape.curvature(at.x, at.y);
        const Tensor both{H.xx + C.xx, H.xy + C.xy, H.yy + C.yy};
        if (both.xx > 0 && both.xx * both.yy - both.xy * both.xy > 0) {
            double range = farthest_;
            if (!a.biharmonic.empty() && a.biharmonic[i] > 0)
                range = std::min(range, std::sqrt((a.kappa1[i] + a.kappa2[i]) / a.biharmonic[i]));
            d = highest_within(both, shape.gradient(at.x, at.y), range);
            bent = both;
            flattened = shape.biharmonic(at.x, at.y);
        }
    }
    bent_[i] = bent;
    shifted_.x[i] = a.x[i] + d.x;
    shifted_.y[i] = a.y[i] + d.y;
    shifted_.z[i] = a.z[i] - 0.5 * (H.xx * d.x * d.x + 2 * H.xy * d.x * d.y + H.yy * d.y * d.y);
    if (!a.biharmonic.empty()) shifted_.biharmonic[i] = a.biharmonic[i] - flattened;
}

void ShiftedSummits::shift_and_prepare(std::size_t i) {
    shift(i);
    if (done_[i] == kPrepared) return;
    done_[i] = kPrepared;
    const Tensor& bent = bent_[i];
    for (const AsperityColumn& column : kAsperityColumns) (one_.*column.values).clear();
    append_summit(0, 0, 0, {-0.5 * bent.xx, -0.5 * bent.yy, -0.5 * bent.xy},
                  geometric_ ? Curvature::geometric : Curvature::algebraic, one_);
    for (const auto column :
         {&Asperities::radius, &Asperities::kappa1, &Asperities::kappa2, &Asperities::angle})
        if (!(one_.*column).empty()) (shifted_.*column)[i] = (one_.*column)[0];
}

// The face above the shifted place is at most highest_ - Z0; from there to the summit it rises by
// no more than it may fall in a move of the tip over the range.
double ShiftedSummits::most_gained(double Z0) const {
    return indenter_.shape->most_fallen(farthest_, highest_ - Z0);
}

double steepest_contact(const Level& level, const Indenter& indenter) {
    Vec2 steepest;
    double square = 0;
    for (const auto k : indices(level.x)) {
        const Vec2 slope =
            indenter.shape->gradient(level.x[k] - indenter.x0, level.y[k] - indenter.y0);
        if (const double here = slope.x * slope.x + slope.y * slope.y; here > square) {
            square = here;
            steepest = slope;
        }
    }
    return std::hypot(steepest.x, steepest.y);
}

}  // namespace rsc
