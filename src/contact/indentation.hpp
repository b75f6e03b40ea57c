// A rough surface pressed by an indenter: the problem (paper, section 4).
#pragma once

#include "contact/shape.hpp"
#include "interaction/kernel.hpp"
#include "interaction/layered_body.hpp"
#include "surface/asperities.hpp"

namespace rsc {

// Enumerations and their names in namelists and result files, in the same order.
enum class Method : std::int32_t { automatic, dgesv, direct, mesh };
inline constexpr std::array kMethodNames = {"auto", "dgesv", "direct", "mesh"};
// asperity_model.hpp, element_model.hpp; automatic: boundary elements for heights read from
// files, asperities for synthetic surfaces.
enum class ModelKind : std::int32_t { asperities, elements, automatic };
inline constexpr std::array kModelNames = {"asperities", "elements", "auto"};
enum class Selection { overlap, paper };
inline constexpr std::array kSelectionNames = {"overlap", "paper"};
enum class LawKind { hertz, elliptic, fourth_order };  // asperities/law.hpp
inline constexpr std::array kLawNames = {"hertz", "elliptic", "fourth_order"};

// Equivalent problem: elastic half-space E_star (with layers, that of the top layer) and a rigid
// indenter with its tip above (x0, y0).
struct Indenter {
    double E_star = 0;  // [force/length^2]
    Shape shape;        // a number is the radius of a sphere, Infinity a flat
    double x0 = 0, y0 = 0;
    // finite: surface and contact are periodic (two flats, boundary='periodic')
    Period period = {};
    LayeredBody layers = {};
    // `repeats`: finite if the surface is periodic although the bodies are not, for example a ball
    // on a synthetic surface. The surface ends at its border until the tip is moved; then `around`
    // is set to it, and the image of each point nearest to the tip is used.
    Period repeats = {}, around = {};

    void move(double x, double y) { x0 = x, y0 = y, around = repeats; }

    Vec2 from_tip(double x, double y) const {
        return {around.nearest_x(x - x0), around.nearest_y(y - y0)};
    }
    // The image of a point that is nearest to the tip.
    Vec2 image(double x, double y) const {
        const Vec2 d = from_tip(x, y);
        return {x + (d.x - (x - x0)), y + (d.y - (y - y0))};
    }

    // Height z of a point minus the indenter's face above it, z - s; -Infinity outside the
    // indenter. The penetration without interaction is g0 = clearance - Z0.
    double clearance(double x, double y, double z) const {
        const Vec2 d = from_tip(x, y);
        return z - shape->height(d.x, d.y);
    }
};

// Throws Error(bad_input) unless E* is positive and finite and there is a shape, which must be
// periodic if the period is finite.
void require_sound(const Indenter& indenter);

// The elastic body of the problem, including its layers.
Substrate substrate_of(const Indenter& indenter);

// Rectangle of a free surface.
struct Rectangle {
    double x0 = 0, y0 = 0, Lx = 0, Ly = 0;  // [length]
    bool known() const { return Lx > 0 && Ly > 0; }
};

// Points of a measured map that asperities do not represent.
struct MapMarks {
    std::vector<std::array<double, 3>>
        border;  // x, y, z of the outermost points of the map, where no summits are found [length]
    std::vector<std::array<double, 2>>
        spikes;        // x, y of the spikes one point wide (surface/defects.hpp) [length]
    double reach = 0;  // a grid step [length]
};

// The parameters of all that is computed beyond an elastic contact, by their types, which the rooms
// of physics/ declare. What was not set has the values that its type begins with.
class BodyPhysics {
public:
    template <class T>
    T& of() {
        std::any& place = all_[typeid(T)];
        if (!place.has_value()) place = T{};
        return *std::any_cast<T>(&place);
    }
    template <class T>
    const T& of() const {
        static const T unset{};
        const auto found = all_.find(typeid(T));
        return found == all_.end() ? unset : *std::any_cast<T>(&found->second);
    }

private:
    std::map<std::type_index, std::any> all_;
};

// What is known of the rough surface besides its asperities or heights. 0: unknown.
struct SurfaceFacts {
    double sigma = 0;            // rms height [length], the unit of delta0 and of selection='paper'
    double mean_spacing = 0;     // <d> = 1/sqrt(D) of the summits [length]
    double points_per_wave = 0;  // grid points in the shortest wave of the surface
    double grid_step = 0;        // of the grid on which the summits were found [length]
    // MomentTensor::gentlest_slope(), for comparison with slopes of the indenter; 0 also for
    // asperities of a list
    double gentlest_slope = 0;
    Rectangle extent = {};  // of a free surface, for counting contacts near its border
    // Heights of either body from a file or a caller, or not isotropic and Gaussian: their expected
    // errors are larger.
    bool measured = false;
    std::shared_ptr<const MapMarks> marks = nullptr;  // marks of a measured map, or null
    // Of a list of asperities, what law 'fourth_order' amounts to with what is given of them:
    // spheres (hertz) where only radii are known, and without the biharmonic elliptic.
    LawKind richest_law = LawKind::fourth_order;
};

struct SolverOptions {
    Method method = Method::automatic;
    LawKind law = LawKind::hertz;
    Interaction interaction = Interaction::point;
    Selection selection = Selection::overlap;
    double selection_factor = 1.5;
    double tolerance = 1e-6;  // relative residual of F - C<G0 - B F>^(3/2)
    int max_iterations = 100;
    double delta0 = 0.01;    // initial regularisation of the paper's method, in units of sigma
    double delta_cut = 5.0;  // the paper's method divides delta by this (the paper: 2 to 10)
    BodyPhysics physics = {};
    SurfaceFacts surface = {};
};

}  // namespace rsc
