// The answer at one separation: what a contact model gives and observations, files and libraries take from it.
#pragma once

#include "contact/indentation.hpp"

namespace rsc {

// Outcome of a level, with the values of `status` in the result file. The more serious hides the less serious, in the order converged,
// overlapping, not_unique, out_of_validity, not_converged: that spots overlap, or that there may be other solutions, says nothing of size.
enum class LevelStatus : std::int32_t { converged = 0, out_of_validity = 1, overlapping = 2, not_unique = 3, not_converged = 4 };
inline constexpr std::array kLevelStatusNames = {"converged", "out_of_validity", "overlapping", "not_unique", "not_converged"};
constexpr LevelStatus graver(LevelStatus a, LevelStatus b) {
    constexpr int seriousness[] = {0, 3, 1, 2, 4};
    return seriousness[static_cast<std::size_t>(a)] < seriousness[static_cast<std::size_t>(b)] ? b : a;
}

// Why a level was solved by another method than asked for. Values are those of `fallback` in the result file.
enum class Fallback : std::int32_t {
    none = 0,
    no_interaction = 1,       // mesh: there is nothing to put on a mesh
    dgesv_not_converged = 2,  // the paper's iteration did not reach the tolerance in max_iterations
    dgesv_singular = 3,       // its matrix was singular
    not_unique = 4,           // it converged, but the solution could not be proved to be the only one, and the rule for such levels holds
    held = 5,                 // adhesion: no state carries the force asked for; this is the last stable one, of the smallest force
};
inline constexpr std::array kFallbackNames = {"none", "no_interaction", "dgesv_not_converged", "dgesv_singular", "not_unique", "held"};
// No metal bears mean pressures above this share of E* elastically.
inline constexpr double kExtreme = 0.1, kExtremeShare = 0.01;  // told from this share of the contact area on

inline constexpr double kNotComputed = std::numeric_limits<double>::quiet_NaN();

// The scalars of a level. A plain record: checkpoints hold it as it is. Each is declared to files, screen and libraries by one row
// of the table in observe/quantities.cpp.
struct LevelValues {
    double separation = 0;                     // Z0 [length]
    double force = 0;                          // N = sum f [force]
    double area = 0;                           // A = sum pi a^2 (hertz, the paper's), or of the union of the elliptic spots [length^2]
    double area_pixels = kNotComputed;         // elements: of all pixels under pressure, not corrected for their border [length^2]
    double pressure = kNotComputed;            // two flats: nominal, N/A0 [force/length^2]
    double area_fraction = kNotComputed;       // two flats: A/A0
    double residual = 0;                       // |F - C<G0 - B F>^(3/2)| / |F|, unregularised, over all candidates
    double pixels_per_contact = kNotComputed;  // elements: half the area belongs to contacts of fewer pixels than this
    // Expected relative errors of N and A: of asperities against elements (contact/expected_error.hpp), of elements against finer grids.
    double force_error_expected = kNotComputed, area_error_expected = kNotComputed;
    std::int32_t error_cause = 0;        // asperities: what raises that most (contact/expected_error.hpp); 0: nothing does
    double slope_ratio = kNotComputed;   // asperities: largest slope of the indenter at a contact over the surface's rms slope
    double filled_share = kNotComputed;  // of the contact area, on points of a measured map that were missing
    // By add_answers (contact/answers.hpp):
    double stiffness = kNotComputed;                            // dN/dZ0, negative [force/length]
    double energy = kNotComputed;                               // elastic energy W, dW/dZ0 = -N [force length]
    double lateral_x = kNotComputed, lateral_y = kNotComputed;  // what pushes the sphere sideways, -dW/d(x0, y0) [force]
    double moment_x = kNotComputed, moment_y = kNotComputed;    // of the contact's forces about the tip [force length]
    double conductance_length = kNotComputed;                   // -2 (dN/dZ0)/E* [length]
    double resistance = kNotComputed;                           // constriction; NaN without contact or resistivities
    std::int64_t products = 0;                                  // products with B (matrix-free methods), solves (dgesv)
    std::int64_t overlapping_pairs = 0;                         // pairs with d < a_i + a_j
    std::int64_t beyond_law = 0;                                // contacts past the range in which the law's profile describes a summit
    double extreme_area_fraction = 0;                           // share of the contact area whose mean pressure exceeds kExtreme E*
    double plastic_work = kNotComputed;                         // plastic work since the first level [force length]
    // Adhesion:
    double least_force = kNotComputed;          // the smallest met since the beginning [force]
    double cohesive_area = kNotComputed;        // of the points that attract without touching [length^2]
    double cohesive_resolution = kNotComputed;  // elements: z0 over the side of a pixel
    std::int32_t jumps = 0;                     // on the way from the level before
    std::int32_t plastic_contacts = 0;          // contacts that yield at this level
    double time = kNotComputed;                 // of bodies that relax [time]
    double energy_lost = kNotComputed;          // work that will not come back, since the first level [force length]
    std::int32_t contacts = 0;
    std::int32_t candidates = 0;  // asperities or pixels given to the solver
    std::int32_t iterations = 0;  // Newton steps
    LevelStatus status = LevelStatus::converged;
    Method method = Method::direct;      // the one whose answer this is
    Fallback fallback = Fallback::none;  // why it is not the one asked for
    std::int32_t large_contacts = 0;     // contacts with a > <d>/4
    // Layers, asperities: share of the contacts with a > h/5, h the top layer's thickness.
    double wide_contacts = kNotComputed;
    std::int32_t edge_contacts = 0;  // contacts within <d> of the border of a free surface, or cut by it
    double nominal_area = 0;         // smallest disc about the tip that holds all contacts, at most the surface [length^2]
    // Of the coarse map (observe/map.hpp):
    std::int32_t crowded_cells = 0;  // cells with an area fraction above pi/16
    std::int32_t outside_map = 0;    // contacts outside the map
};

// Elements: the pixels under pressure, row by row. Empty for asperities.
struct LevelPixels {
    int columns = 0;                    // of the map
    double x0 = 0, y0 = 0;              // middle of the map's first pixel [length]
    double dx = 0, dy = 0;              // sides of a pixel [length]
    std::vector<std::int32_t> index;    // row * columns + column, 0-based
    std::vector<std::int32_t> contact;  // which of the level's contacts it belongs to
    std::vector<double> pressure;       // [force/length^2]
    double x(std::size_t k) const { return x0 + index[k] % columns * dx; }
    double y(std::size_t k) const { return y0 + index[k] / columns * dy; }
};

// Elements that yielded: the points of the surface that are lower for good, row by row.
struct ResidualProfile {
    std::vector<double> x, y, depth;  // [length]
    double dx = 0, dy = 0;            // sides of a pixel [length]
};

// A level with its contacts, by increasing index: spots of asperities, or connected sets of pixels.
struct Level : LevelValues {
    std::vector<int> asperity;  // index of the asperity (0-based), or of the spot's pixel that carries the most
    std::vector<double> x, y;   // place: the summit, or the centroid of the pressure [length]
    std::vector<double> f;      // force [force]
    std::vector<double> a;      // contact radius: the spot's area is pi a^2 [length]
    std::vector<double> u;      // penetration with interaction [length]
    LevelPixels pixels;
    std::vector<double> own_area;  // of elliptic spots: what those before do not cover, in all the area of their union; empty: pi a^2
    std::vector<int> yields;       // whether the contact yields (hardness); empty or one a contact

    void add_contact(int index, double x_, double y_, double force_, double radius, double penetration) {
        asperity.push_back(index);
        x.push_back(x_), y.push_back(y_);
        f.push_back(force_), a.push_back(radius), u.push_back(penetration);
        ++contacts;
    }
};

}  // namespace rsc
