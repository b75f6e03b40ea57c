// What the grid leaves uncertain where elements attract each other.

#include "base/error.hpp"
#include "contact/grid_bodies.hpp"
#include "physics/adhesion/adhesion.hpp"
#include "physics/adhesion/sticking.hpp"
#include "surface/form.hpp"

namespace rsc {
namespace {

// Smallest cohesive resolution. Error of N over the force of the traction s0 on a strip of one
// pixel along the edge of what attracts: edges are resolved to a pixel only, and errors of separate
// contacts cancel on average (smooth spheres: 0.25 to 1.05 for Maugis's lambda from 0.3 to 4).
// Error of A: of w on the area, times the inverse of the resolution, and of edges, times h over the
// radius. Found by hand; test_adhesive_elements checks that 90 % are within.
constexpr double kResolved = 4, kEdgeError = 1.1, kWorkError = 0.8, kRadiusError = 0.8;
// Ranges above this share of the rms height under the contact are a doubt, except for bodies that
// are smoother than a share of the range.
constexpr double kBridged = 0.5, kSmooth = 1e-3;
// Without a range: the error of the place of edges in pixels (JKR's sphere with 6 to 64 pixels to
// the contact radius at zero force: 0.12).
constexpr double kEdgeShift = 0.2;

// Attraction without a range: the edge of a contact of radius a is known to a part of a pixel, by
// which N, at a separation, changes with dN/da = -sqrt(8 pi w E* a); the errors of all contacts
// have one sign.
GridError error_without_range(const Level& level, const Indenter& indenter, double h,
                              const GridError& few, double work) {
    if (level.contacts == 0) return {kNotComputed, kNotComputed};
    double dN = 0, length = 0;
    for (const double a : level.a) {
        dN += kEdgeShift * h * std::sqrt(8 * std::numbers::pi * work * indenter.E_star * a);
        length += 2 * std::numbers::pi * a;
    }
    return {dN / std::abs(level.force) + few.force,
            few.area + kEdgeShift * h * length / level.area};
}

// Whether the range of an attraction is not small beside the rms height of the rough body where it
// touches, beside its form there, so that it and not the bodies decides how far gaps are bridged.
// Bodies without roughness have none.
bool bridges_roughness(const Level& level, const HeightMap& map, double range) {
    LevelPixels pixels = level.pixels;
    pixels.cohesive.clear();
    if (pixels.empty()) return false;
    const auto [left, right, low, high] = pixels.range();
    HeightMap part;
    part.allocate(right - left + 1, high - low + 1, right - left + 1);
    part.dx = map.dx;
    part.dy = map.dy;
    for (const int j : indices(part.ny)) std::fill_n(part.row(j), part.nx, kNotComputed);
    const auto number = [](double x, double step, int n) {
        const int k = int(std::lround(x / step)) % n;
        return k < 0 ? k + n : k;
    };
    for (const auto k : indices(pixels.index))
        part.row(pixels.index[k] / pixels.columns - low)[pixels.index[k] % pixels.columns - left] =
            map(number(pixels.x(k) - map.x0, map.dx, map.nx),
                number(pixels.y(k) - map.y0, map.dy, map.ny));
    try {
        const double rms = detrend(part, Detrend::quadratic).rms;
        return rms > kSmooth * range && range > kBridged * rms;
    } catch (const Error&) {  // too few points for a form
        return false;
    }
}

}  // namespace

GridError adhesion_grid_error(const Level& level, const HeightMap& map, const Indenter& indenter,
                              const BodyPhysics& bodies, const GridError& few) {
    if (level.force == 0) return {kNotComputed, kNotComputed};
    const auto& [work, range] = bodies.of<Adhesion>();
    if (!(range > 0)) return error_without_range(level, indenter, map.step(), few, work);
    const double traction = work / range, attracting = level.area + level.cohesive_area,
                 pulled = traction * attracting;
    const int contacts = std::max(level.contacts, 1);
    // Of n equal contacts the edges are longer by sqrt(n), and their errors cancel as much.
    double dN = kEdgeError * traction * map.step() * 2 * std::sqrt(std::numbers::pi * attracting);
    double area = kNotComputed;
    if (level.contacts > 0) {
        dN += few.force * std::max(level.force + pulled, 0.0);
        area =
            few.area +
            (kWorkError / level.cohesive_resolution +
             kRadiusError * std::sqrt(std::numbers::pi * map.dx * map.dy * contacts / level.area)) /
                std::sqrt(contacts);
    }
    return {dN / std::abs(level.force), area};
}

bool adhesion_range_in_doubt(const Level& level, const HeightMap& map, const BodyPhysics& bodies) {
    const double range = bodies.of<Adhesion>().range;
    return range > 0 &&
           (level.cohesive_resolution < kResolved || bridges_roughness(level, map, range));
}

}  // namespace rsc
