// A rough surface pressed by an indenter: the problem (paper, section 4).
#pragma once

#include "contact/indenter/shape.hpp"
#include "contact/law/relaxation.hpp"
#include "contact/period.hpp"
#include "rough/asperities.hpp"

namespace rsc {

// Enumerations with their spellings, in their order, as the namelist and result files have them.
enum class Method : std::int32_t { automatic, dgesv, direct, mesh };
inline constexpr std::array kMethodNames = {"auto", "dgesv", "direct", "mesh"};
// asperity_contact.hpp, element_contact.hpp; automatic: elements for heights read from files, asperities for made surfaces.
enum class Model : std::int32_t { asperities, elements, automatic };
inline constexpr std::array kModelNames = {"asperities", "elements", "auto"};
enum class Selection { overlap, paper };
inline constexpr std::array kSelectionNames = {"overlap", "paper"};
enum class Interaction { point, none };
inline constexpr std::array kInteractionNames = {"point", "none"};
enum class LawKind { hertz, elliptic, fourth_order };  // law/law.hpp
inline constexpr std::array kLawNames = {"hertz", "elliptic", "fourth_order"};

// Layers of body 1, from the top, bonded to each other and to a half-space of E, nu (interaction/layers.hpp).
inline constexpr int kMostLayers = 8;
struct Layer {
    double thickness = 0, E = 0, nu = 0;  // [length], Young's modulus [force/length^2], Poisson's ratio
    friend bool operator==(const Layer&, const Layer&) = default;
};
struct LayeredBody {
    std::int64_t count = 0;  // 0: a homogeneous half-space
    std::array<Layer, kMostLayers> layer{};
    double E = 0, nu = 0;  // E = Infinity: rigid
    friend bool operator==(const LayeredBody&, const LayeredBody&) = default;
};

// The equivalent problem: elastic half-space E_star (with layers, that of the topmost), rigid indenter of some shape with its tip above
// (x0, y0).
struct Indenter {
    double E_star = 0;  // [force/length^2]
    Shape shape;        // a number is a sphere of that radius, Infinity a flat
    double x0 = 0, y0 = 0;
    Period period = {};  // finite: surface and contact repeat (two flats, boundary='periodic')
    LayeredBody layers = {};
    // Finite `repeats`: the surface repeats although the bodies do not, as a ball on a made surface. It ends at its border until the tip is
    // moved; from then on `around` is the same, and of each point the image nearest to the tip counts.
    Period repeats = {}, around = {};

    void move(double x, double y) { x0 = x, y0 = y, around = repeats; }

    Vec2 from_tip(double x, double y) const { return {around.nearest_x(x - x0), around.nearest_y(y - y0)}; }
    // The image of a point that is nearest to the tip.
    Vec2 image(double x, double y) const {
        const Vec2 d = from_tip(x, y);
        return {x + (d.x - (x - x0)), y + (d.y - (y - y0))};
    }

    // A point of the surface less the indenter's face above it, z - s; the penetration without interaction is g0 = clearance - Z0.
    // -Infinity where the indenter does not reach.
    double clearance(double x, double y, double z) const {
        const Vec2 d = from_tip(x, y);
        return z - shape->height(d.x, d.y);
    }
};

// Throws Error(bad_input) unless E* is positive and finite, there is a shape, and with a finite period one that repeats with it.
void require_sound(const Indenter& indenter);

// The rectangle of a free surface.
struct Rectangle {
    double x0 = 0, y0 = 0, Lx = 0, Ly = 0;  // [length]
    bool known() const { return Lx > 0 && Ly > 0; }
};

// No pressure above H = H0 sqrt(1 + length/r), r an asperity's radius (law/hardness.hpp).
struct Hardness {
    double H0 = __builtin_huge_val();  // [force/length^2]; Infinity: elastic
    double length = 0;                 // of the size effect [length]
};

// Bodies that stick (law/sticking.hpp).
struct Adhesion {
    double work = 0;   // w [force/length]; 0: they do not
    double range = 0;  // z0 of the attraction [length]; 0: JKR
};

struct SolverOptions {
    Method method = Method::automatic;
    LawKind law = LawKind::hertz;
    Hardness hardness;
    Relaxation relaxation;
    Adhesion adhesion;
    Interaction interaction = Interaction::point;
    Selection selection = Selection::overlap;
    double selection_factor = 1.5;
    double sigma = 0;         // rms height: unit of delta0 and of selection='paper' [length]
    double tolerance = 1e-6;  // relative residual of F - C<G0 - B F>^(3/2)
    int max_iterations = 100;
    double delta0 = 0.01;        // initial regularisation of the paper's method, in sigma
    double delta_cut = 5.0;      // the paper's method divides delta by this each iteration (the paper: 2 to 10)
    double mean_spacing = 0;     // <d> = 1/sqrt(D), for counting contacts with a > <d>/4 or near the border; 0: not counted
    double points_per_wave = 0;  // of the grid that the asperities were found on, in the shortest wave; 0: not known
    double rms_slope = 0;        // of the surface, sqrt(2 m2), which the indenter's slopes are measured by; 0: not known
    Rectangle surface;           // the free surface, for counting contacts near its border; not known: not counted
};

}  // namespace rsc
