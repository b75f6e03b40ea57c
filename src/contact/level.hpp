// Level: the solution at one separation, returned by contact models and used by observations, files
// and libraries.
#pragma once

#include "contact/indentation.hpp"
#include "contact/spots.hpp"

namespace rsc {

// Outcome of a level, with the values of `status` in the result file (trust/judge.hpp). If several
// apply, the most serious is stored, in the order converged, overlapping, not_unique,
// out_of_validity, not_converged.
enum class LevelStatus : std::int32_t {
    converged = 0,
    out_of_validity = 1,
    overlapping = 2,
    not_unique = 3,
    not_converged = 4
};
inline constexpr std::array kLevelStatusNames = {"converged", "out_of_validity", "overlapping",
                                                 "not_unique", "not_converged"};

// Reason why a level was solved by another method than requested, with the values of `fallback` in
// the result file.
enum class Fallback : std::int32_t {
    none = 0,
    no_interaction = 1,       // mesh: there is no interaction
    dgesv_not_converged = 2,  // the paper's iteration did not reach the tolerance in max_iterations
    dgesv_singular = 3,       // its matrix was singular
    not_unique =
        4,  // it converged, but the solution is not proved unique, and the default method was used
    // adhesion: no state has the requested force; the level is the last stable state, of the
    // smallest force
    held = 5,
    // the force jumps over the requested one at a separation; the level is the state at one side of
    // the jump
    jump = 6,
};
inline constexpr std::array kFallbackNames = {
    "none", "no_interaction", "dgesv_not_converged", "dgesv_singular", "not_unique", "held",
    "jump"};
// No metal is elastic at mean pressures above this share of E*.
inline constexpr double kExtreme = 0.1,
                        kExtremeShare = 0.01;  // reported above this share of the contact area

inline constexpr double kNotComputed = std::numeric_limits<double>::quiet_NaN();

template <std::size_t n>
constexpr std::array<double, n> none_computed() {
    std::array<double, n> all{};
    all.fill(kNotComputed);
    return all;
}

// At least as many as all quantities have components.
inline constexpr std::size_t kMostComponents = 112;

// Scalars of a level, written to checkpoints as they are. One row of the table in
// contact/quantities.cpp declares each to files, screen and libraries.
struct LevelValues {
    double separation = 0;  // Z0 [length]
    double force = 0;       // N = sum f [force]
    // A = sum pi a^2 (hertz), or the area of the union of elliptic spots [length^2] boundary
    // elements: all pixels under pressure, without border correction [length^2]
    double area = 0;
    double area_pixels = kNotComputed;
    double pressure = kNotComputed;          // two flats: nominal pressure N/A0 [force/length^2]
    double area_fraction = kNotComputed;     // two flats: A/A0
    double force_per_length = kNotComputed;  // line contact: N/L [force/length]
    double residual = 0;  // |F - C<G0 - B F>^(3/2)| / |F|, unregularised, over all candidates
    // boundary elements: largest violation of the contact conditions by the returned pressures
    double certificate = kNotComputed;
    double pressure_max = kNotComputed;  // largest pressure at a point [force/length^2]
    // boundary elements: median pixels per contact, weighted by area
    double pixels_per_contact = kNotComputed;
    // boundary elements: sides of pixels on the borders of contacts over pixels under pressure (of
    // two flats, or over those of the gap if these are fewer), 2.5 over the radius of a round
    // contact in pixels; the errors of the grid depend on it
    double border_share = kNotComputed;
    // likewise the root of the sum of the squares of the lengths of the straight parts of borders,
    // in pixels, over these pixels
    double border_runs = kNotComputed;
    // Expected relative errors of N and A, and under a prescribed force the error of Z0 [length]
    // (trust/judge.hpp).
    double force_error_expected = kNotComputed, area_error_expected = kNotComputed;
    double separation_error_expected = kNotComputed;
    std::int32_t doubts = 0;  // bits of Cause (trust/doubts.hpp)
    // What the solver says: the tolerance is reached, and the solution is known to be the only one.
    bool converged = true, unique = true;
    // asperities: largest slope of the indenter at a contact over the gentlest slope of the surface
    double slope_ratio = kNotComputed;
    // rms slope of the indenter's face over the contacts, weighted by the forces; not for flats
    double indenter_slope = kNotComputed;
    double filled_share = kNotComputed;  // share of the contact area in holes of a measured map
    // Computed on request (contact/answers.hpp):
    double stiffness = kNotComputed;  // dN/dZ0, negative [force/length]
    double energy = kNotComputed;     // elastic energy W, dW/dZ0 = -N [force length]
    double lateral_x = kNotComputed,
           lateral_y = kNotComputed;  // lateral force on the indenter, -dW/d(x0, y0) [force]
    double moment_x = kNotComputed,
           moment_y = kNotComputed;  // moment of the contact forces about the tip [force length]
    double conductance_length = kNotComputed;    // -2 (dN/dZ0)/E* [length]
    double conductance_per_area = kNotComputed;  // two flats: over A0 [1/length]
    double resistance =
        kNotComputed;           // constriction resistance; NaN without contact or resistivities
    std::int64_t products = 0;  // products with B (matrix-free methods) or linear solves (dgesv)
    std::int64_t overlapping_pairs = 0;  // pairs with d < a_i + a_j
    std::int64_t beyond_law = 0;         // contacts beyond the range of validity of the law
    // share of the contact area whose mean pressure exceeds kExtreme E*
    double extreme_area_fraction = 0;
    double plastic_work = kNotComputed;    // plastic work since the first level [force length]
    double yielding_share = kNotComputed;  // share of the contact area at the hardness
    // Adhesion:
    double least_force = kNotComputed;  // smallest force since the beginning [force]
    // area of the points that attract without contact [length^2]
    double cohesive_area = kNotComputed;
    double cohesive_resolution =
        kNotComputed;  // boundary elements: cohesive length over the side of a pixel
    // Two flats by elements: the gap (physics/flow/flow.hpp).
    double gap_mean = kNotComputed;       // over the whole cell [length]
    double gap_mean_open = kNotComputed;  // where the bodies do not touch [length]
    // 1 if openings wind around the cell along the axis, otherwise 0
    double percolates_x = kNotComputed, percolates_y = kNotComputed;
    // with output%flow [length^3], [length]
    double permeability_xx = kNotComputed, permeability_yy = kNotComputed;
    double permeability_xy = kNotComputed;
    // xx and yy of the same gap on every second point, for the error (not in files)
    double coarse_permeability_x = kNotComputed, coarse_permeability_y = kNotComputed;
    double hydraulic_gap_x = kNotComputed, hydraulic_gap_y = kNotComputed;
    // flow of a sliding smooth face [length]; coarse: as above
    double shear_xx = kNotComputed, shear_yy = kNotComputed;
    double shear_xy = kNotComputed, shear_yx = kNotComputed;
    double coarse_shear_x = kNotComputed, coarse_shear_y = kNotComputed;
    double pressure_factor_x = kNotComputed, pressure_factor_y = kNotComputed;  // 12 K/h^3
    double shear_factor_x = kNotComputed, shear_factor_y = kNotComputed;        // (h - 2 S)/sigma
    double leak_rate = kNotComputed;                                            // [length^3/time]
    std::int32_t jumps = 0;             // number of jumps since the previous level
    std::int32_t plastic_contacts = 0;  // yielding contacts at this level
    double time = kNotComputed;         // time of the level, relaxing bodies [time]
    // Bodies that wear: sliding distance of the level [length]; volume and largest depth that are
    // worn off, rms height of the worn points without their form [length^3], [length]; change of N,
    // or under a force of the depth of the separation below first touch, relative to these, when
    // the steps of the distance are halved.
    double distance = kNotComputed;
    double worn_volume = kNotComputed, wear_depth_max = kNotComputed, worn_rms = kNotComputed;
    double sliding_error = kNotComputed;
    double energy_lost = kNotComputed;  // energy dissipated since the first level [force length]
    std::int32_t contacts = 0;
    std::int32_t candidates = 0;  // asperities or pixels passed to the solver
    std::int32_t iterations = 0;  // Newton steps
    LevelStatus status = LevelStatus::converged;
    Method method = Method::direct;      // method that found the solution
    Fallback fallback = Fallback::none;  // reason if it is not the requested one
    std::int32_t large_contacts = 0;     // contacts with a > <d>/4
    // Layers, asperities: share of the contacts with a > h/5, h the top layer's thickness.
    double wide_contacts = kNotComputed;
    // Contacts within <d> of the border of a free surface, or crossing it.
    std::int32_t edge_contacts = 0;
    // Smallest disc about the tip that contains all contacts, at most the area of the surface
    // [length^2].
    double nominal_area = 0;
    // Of the coarse map (observe/map.hpp):
    std::int32_t crowded_cells = 0;  // cells with an area fraction above pi/16
    std::int32_t outside_map = 0;    // contacts outside the map
    // Expected relative errors of quantities, by LevelQuantity::slot (contact/quantities.hpp); NaN:
    // none is stated.
    std::array<double, kMostComponents> errors = none_computed<kMostComponents>();
};

// Boundary elements: pixels under pressure, row by row. Empty for asperities.
struct LevelPixels {
    int columns = 0;                  // columns of the map
    double x0 = 0, y0 = 0;            // centre of the first pixel of the map [length]
    double dx = 0, dy = 0;            // sides of a pixel [length]
    std::vector<std::int32_t> index;  // row * columns + column, 0-based
    // index of the contact to which it belongs; empty: not known, as for loads that last
    std::vector<std::int32_t> contact;
    std::vector<double> pressure;  // [force/length^2]
    // Adhesion: pixels that are attracted without contact, row by row, and their negative pressure.
    std::vector<std::int32_t> cohesive;
    std::vector<double> attraction;  // [force/length^2]
    double x_of(std::int32_t pixel) const { return x0 + pixel % columns * dx; }
    double y_of(std::int32_t pixel) const { return y0 + pixel / columns * dy; }
    double x(std::size_t k) const { return x_of(index[k]); }
    double y(std::size_t k) const { return y_of(index[k]); }
    // Calls visit(pixel, pressure, contact) for all, with -1 for those without contact.
    template <class Visit>
    void each(Visit&& visit) const {
        for (const auto k : indices(index))
            visit(index[k], pressure[k], contact.empty() ? 0 : contact[k]);
        for (const auto k : indices(cohesive)) visit(cohesive[k], attraction[k], -1);
    }
    bool empty() const { return index.empty() && cohesive.empty(); }
    // The smallest range of columns and rows with all of them, {first column, last column, first
    // row, last row}; inverted if there are none.
    std::array<int, 4> range() const {
        constexpr int most = std::numeric_limits<int>::max();
        std::array<int, 4> all{most, -1, most, -1};
        each([&](std::int32_t pixel, double, int) {
            const int column = pixel % columns, row = pixel / columns;
            all = {std::min(all[0], column), std::max(all[1], column), std::min(all[2], row),
                   std::max(all[3], row)};
        });
        return all;
    }
};

// Plastic residual of boundary elements: the points that are permanently lowered, row by row.
struct ResidualProfile {
    std::vector<double> x, y, depth;  // [length]
    double dx = 0, dy = 0;            // sides of a pixel [length]
};

// Adhesive asperities, in contact or attracted before it: the traction of each is a Hertz pressure
// of the force `pressed` over the contact radius a, and a tension of the force `pulled` (negative)
// up to the radius c >= a: that of a flat punch if c = a (JKR), otherwise that of a cohesive ring
// (contact/deflection.hpp). Empty without adhesion.
struct LevelTractions {
    std::vector<double> x, y, a, c, pressed, pulled;
};

// Two flats by elements: the points where the bodies do not touch, by their gap, in bins of equal
// width from 0. Empty where it was not asked for.
struct GapCounts {
    std::vector<std::int32_t> of_bin;
    std::int32_t beyond = 0;        // the last bin
    std::array<double, 4> power{};  // sums of the powers 1 to 4 of the gap
};

// A level with its contacts, by increasing index: spots of asperities, or connected sets of pixels.
struct Level : LevelValues {
    std::vector<int>
        // index of the asperity (0-based), or of the pixel of the spot with the highest pressure
        asperity;
    std::vector<double> x, y;  // position of the summit, or centroid of the pressure [length]
    std::vector<double> f;     // force [force]
    std::vector<double>
        // contact radius: the spot's area is pi a^2; of an ellipse, the root of the product of its
        // semi-axes [length]
        a;
    std::vector<double> u;  // penetration with interaction [length]
    LevelPixels pixels;
    LevelTractions tractions;
    GapCounts gaps;
    // Fields of the physics at all points of the map (LevelRecorder::fields_at); empty: not asked
    // for.
    std::vector<std::vector<std::vector<double>>> fields;
    std::vector<double>
        // area of an elliptic spot not covered by earlier spots; the sum is the area of the union;
        // empty: pi a^2
        own_area;
    // Laws with elliptic spots: the spots whose union is the contact area; that of a contact within
    // the spot of another one is the other's.
    // Empty: circles of radius a.
    std::vector<Spot> spots;
    // Bodies that wear: the values that half as many steps of sliding give.
    std::optional<LevelValues> with_half_the_steps;
    std::vector<int> yields;   // nonzero if the contact yields (hardness); empty or one per contact
    bool provisional = false;  // a trial of force control (contact/model.hpp), without contacts

    void add_contact(int index, double x_, double y_, double force_, double radius,
                     double penetration) {
        asperity.push_back(index);
        x.push_back(x_), y.push_back(y_);
        f.push_back(force_), a.push_back(radius), u.push_back(penetration);
        ++contacts;
    }
};

// What accepted levels leave in the bodies.
struct Remains {
    std::vector<double> residual_depths = {};  // of each asperity [length]; empty: none yielded
    ResidualProfile residual_profile = {};     // of boundary elements
    // Relaxing bodies: the loads that would give an elastic body with the instantaneous moduli the
    // present deflections, which still contain those of earlier loads. They act on all pixels, or
    // contacts, that ever carried load.
    std::optional<Level> lasting_loads = {};
};

}  // namespace rsc
