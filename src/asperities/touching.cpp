#include "asperities/touching.hpp"

#include "surface/summits.hpp"

namespace rsc {

void Face::row(int n, double x0, double dx, double y, double* height) const {
    constexpr int block = 256;
    double x[block];
    for (int first = 0; first < n; first += block) {
        const int count = std::min(block, n - first);
        for (int k = 0; k < count; ++k)
            x[k] = indenter_.around.nearest_x(x0 + (first + k) * dx - indenter_.x0);
        indenter_.shape->heights(count, x, indenter_.around.nearest_y(y - indenter_.y0),
                                 height + first);
    }
}

std::unique_ptr<BodyAbove> Face::transposed() const {
    const Period &around = indenter_.around, &period = indenter_.period;
    if (!indenter_.shape->round() || around.x != around.y || period.x != period.y) return nullptr;
    Indenter other = indenter_;
    std::swap(other.x0, other.y0);
    return std::make_unique<Face>(other);
}

BodyAbove::Form Face::at(double x, double y) const {
    const auto [dx, dy] = indenter_.from_tip(x, y);
    Form form;
    form.height = indenter_.shape->height(dx, dy);
    if (!std::isfinite(form.height)) return form;
    const Vec2 slope = indenter_.shape->gradient(dx, dy);
    const Tensor curvature = indenter_.shape->curvature(dx, dy);
    form.x = slope.x, form.y = slope.y;
    form.xx = curvature.xx, form.xy = curvature.xy, form.yy = curvature.yy;
    form.biharmonic = indenter_.shape->biharmonic(dx, dy);
    return form;
}

Asperities moved_summits(const Asperities& of_surface, const Indenter& indenter) {
    const Face face(indenter);
    const Asperities& a = of_surface;
    Asperities moved;
    const bool geometric =
        a.size() == 0 || std::abs(a.radius[0] * std::sqrt(a.kappa1[0] * a.kappa2[0]) - 1) <
                             std::abs(a.radius[0] * 0.5 * (a.kappa1[0] + a.kappa2[0]) - 1);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double c = std::cos(a.angle[i]), s = std::sin(a.angle[i]), k1 = a.kappa1[i],
                     k2 = a.kappa2[i];
        const double hxx = k1 * s * s + k2 * c * c, hyy = k1 * c * c + k2 * s * s,
                     hxy = (k2 - k1) * s * c;
        BodyAbove::Form f = face.at(a.x[i], a.y[i]);
        if (!std::isfinite(f.height)) f = {};
        double xx = hxx + f.xx, yy = hyy + f.yy, xy = hxy + f.xy, determinant = xx * yy - xy * xy;
        if (!(determinant > 0 && xx > 0))
            f = {}, xx = hxx, yy = hyy, xy = hxy,
            determinant = k1 * k2;  // no summit under this face
        double dx = -(yy * f.x - xy * f.y) / determinant, dy = -(xx * f.y - xy * f.x) / determinant;
        // The displacement is limited to the range of the summit's profile (law.hpp: q^2 =
        // biharmonic/(kappa1 + kappa2)).
        const double q = a.biharmonic.empty()
                             ? 0
                             : std::sqrt(std::max(0.0, a.biharmonic[i] / (k1 + k2))),
                     way = q * std::hypot(dx, dy);
        if (way > 1) dx /= way, dy /= way;
        const double z = a.z[i] - 0.5 * (hxx * dx * dx + 2 * hxy * dx * dy + hyy * dy * dy);
        append_summit(a.x[i] + dx, a.y[i] + dy, z, {-0.5 * xx, -0.5 * yy, -0.5 * xy},
                      geometric ? Curvature::geometric : Curvature::algebraic, moved);
        if (!a.biharmonic.empty()) moved.biharmonic.push_back(a.biharmonic[i] - f.biharmonic);
    }
    return moved;
}

void add_flanks(Asperities& found, const Asperities& of_surface, double spacing,
                const Period& period) {
    constexpr double kNear = 0.4,
                     kWidest = 0.8;  // relative to the spacing; calibrated with boundary elements
    if (!(spacing > 0)) return;
    using Cell = std::pair<long, long>;
    const auto cell = [spacing](double x, double y) {
        return Cell{std::lround(std::floor(x / spacing)), std::lround(std::floor(y / spacing))};
    };
    std::multimap<Cell, std::size_t> places;
    for (std::size_t i = 0; i < found.size(); ++i) places.insert({cell(found.x[i], found.y[i]), i});
    const auto near = [&](double x, double y, double distance) {
        const auto [column, row] = cell(x, y);
        for (long c = column - 1; c <= column + 1; ++c)
            for (auto at = places.lower_bound({c, row - 1});
                 at != places.end() && at->first <= Cell{c, row + 1}; ++at)
                if (std::hypot(found.x[at->second] - x, found.y[at->second] - y) < distance)
                    return true;
        return false;
    };
    const std::vector<double> whole = {-1, 0, 1}, none = {0};
    const auto near_image = [&](double x, double y) {
        for (const double m : std::isfinite(period.x) ? whole : none)
            for (const double n : std::isfinite(period.y) ? whole : none)
                if (near(m == 0 ? x : x + m * period.x, n == 0 ? y : y + n * period.y,
                         kNear * spacing))
                    return true;
        return false;
    };
    for (std::size_t i = 0; i < of_surface.size(); ++i) {
        if (near_image(of_surface.x[i], of_surface.y[i])) continue;
        for (const AsperityColumn& column : kAsperityColumns)
            if (!(of_surface.*column.values).empty())
                (found.*column.values).push_back((of_surface.*column.values)[i]);
        // Limits the largest contact width, q a = pi (law/law.hpp), to the spacing of the summits.
        const double q = std::numbers::pi / (spacing * kWidest);
        if (!found.biharmonic.empty())
            found.biharmonic.back() = std::max(found.biharmonic.back(),
                                               q * q * (found.kappa1.back() + found.kappa2.back()));
    }
}

double steepest_above(const Asperities& asperities, const Indenter& indenter, double least) {
    double steepest = 0;
    for (std::size_t i = 0; i < asperities.size(); ++i) {
        if (!(indenter.clearance(asperities.x[i], asperities.y[i], asperities.z[i]) > least))
            continue;
        const Vec2 d = indenter.from_tip(asperities.x[i], asperities.y[i]),
                   slope = indenter.shape->gradient(d.x, d.y);
        steepest = std::max(steepest, std::hypot(slope.x, slope.y));
    }
    return steepest;
}

double steepest_contact(const Level& level, const Indenter& indenter) {
    Vec2 steepest;
    double square = 0;
    for (std::size_t k = 0; k < level.x.size(); ++k) {
        const Vec2 slope =
            indenter.shape->gradient(level.x[k] - indenter.x0, level.y[k] - indenter.y0);
        if (const double here = slope.x * slope.x + slope.y * slope.y; here > square)
            square = here, steepest = slope;
    }
    return std::hypot(steepest.x, steepest.y);
}

}  // namespace rsc
