// The physics beyond elastic contact, a row each. A row says everything that other rooms need to
// know of its physics; what it does not say is not there. Rows stand in the rooms physics/NAME, and
// physics.cpp lists them: case/, contact/make, trust/, io/ and run/ go through this list.
#pragma once

#include "asperities/asperity_history.hpp"
#include "case/key.hpp"
#include "contact/quantities.hpp"
#include "elements/deformed.hpp"
#include "elements/element_physics.hpp"

namespace rsc {

struct Physics;

// What physics may exclude: the bodies with all their physics, their model and its methods.
struct Combination {
    const BodyPhysics& bodies;
    bool elements = false;  // otherwise asperities
    bool compares = false;  // asperities with elements
    bool line = false, layers = false;
    Method method = Method::automatic;
    Selection selection = Selection::overlap;
    LawKind law = LawKind::hertz;
};

// A physics is not available together with the physics of this name, or with what this key asks
// for where `when` holds.
struct Exclusion {
    const char* other;
    const char* why = "";
    bool (*when)(const Combination&) = nullptr;
    const char* key = nullptr;  // the key to blame, if it is not that of the physics
};

// A contradiction between keys; the first key is to blame.
using Complain = std::function<void(std::initializer_list<std::string_view>, const std::string&)>;

// What is known before the first level.
struct PreparedFacts {
    const Case& settings;
    const Indenter& indenter;
    const std::optional<Moments>& theory;  // closed forms of the surface
    double sigma;                          // its rms height [length]
    double side;                           // of a pixel of elements; 0: not known [length]
    double points;                         // of elements; 0: not known
    double step, width;                    // of the grid of the surface, 0: none; its shorter side
    bool elements;
};

// What the remarks of a run are about.
struct RunFacts {
    const Case& settings;
    std::span<const LevelValues> levels;
    const Indenter& indenter;
    const std::optional<Moments>& theory;  // closed forms of the surface
    double summit_radius;                  // mean radius of its summits; NaN: not known [length]
    bool elements;
    std::function<std::string(const LevelValues&)> place_of;  // "N = 3 N": names a level
    // The axis of the curves of this physics, and their values at the last level of a single run;
    // empty: there are none.
    std::span<const double> axis, curves;
};

// A variable of the result beyond the quantities: at each level values along the axis of its
// physics, such as stresses over the depth, or a single value.
struct LevelCurve {
    std::string name;
    bool along = true;  // the axis
    int length_power = 0, force_power = 0;
    std::string meaning = "", comment = "";
    std::string error = "";  // the curve that holds its expected relative error
    bool if_known = false;   // written only if some level has it
    bool of_single = false;  // of one realization only: without that dimension in files
    int components = 1;      // 2: x and y, the last dimension in files
    bool repeated = false;   // along CurveAxis::repeats instead
    std::size_t count(const struct CurveAxis& axis) const;
};

// The axis of the curves of a case.
struct CurveAxis {
    const char *name = "", *meaning = "";  // of its dimension and variable
    std::size_t size = 0;                  // number of its values, 0: there are no curves
    std::vector<double> values = {};       // [length]; empty: the numbers from 1
    // further attributes in files
    std::vector<std::pair<const char*, std::vector<std::int32_t>>> parts = {};
    const char* comment = "";
    // A second axis, of values that are numbered from 1: its name, size and meaning.
    const char* repeats_name = "";
    std::size_t repeats = 0;
    const char* repeats_meaning = "";
};

inline std::size_t LevelCurve::count(const CurveAxis& axis) const {
    return (repeated ? axis.repeats : along ? axis.size : 1) * at(components);
}

// A variable at the points of the surface for the levels of output%field_levels.
struct PointField {
    const char *name, *meaning;  // in output%fields; the variable is field_NAME
    int length_power, force_power;
    bool along = false;  // one for each value of the axis
};
using FieldValues = std::vector<std::vector<double>>;  // of the fields of a physics, in their order

// The pressures of a level, on the part of the map where fields are asked for.
struct WindowPressures {
    const HeightMap& map;
    const LevelPixels& pixels;
    const PointWindow& window;
};

// What the recorder of a realization works on.
struct GridBodies;  // contact/grid_bodies.hpp
struct GridError;

struct RecordedBodies {
    const Case& settings;
    const Indenter& indenter;
    const HeightMap* map;          // of elements; null: asperities
    std::span<const double> axis;  // CurveAxis::values
    // Another contact of the bodies; its path is not that of the levels.
    std::function<std::unique_ptr<Path>()> another;
};

// Takes the curves and fields of a physics off the levels of a realization.
class LevelRecorder {
public:
    virtual ~LevelRecorder() = default;
    // Appends the values of all curves at a level, one curve after the other; NaN: missing. False:
    // a level that they need did not converge.
    virtual bool record(const Level&, std::vector<double>&) { return true; }
    // True if the levels of a run must come one after the other.
    virtual bool in_order() const { return false; }
    // The fields of a level on all points of the map, when it is solved; or later those in the
    // window, from its pressures. Both empty: none.
    virtual FieldValues fields_at(LevelSource&) { return {}; }
    virtual FieldValues fields_below(const WindowPressures&) { return {}; }
};

struct Physics {
    const char* name;
    const char* key;  // that asks for it
    // Its rows of the registry, each in the group it names.
    std::vector<Key> (*keys)();
    // Takes its parameters from the keys, and whether these ask for it.
    void (*take)(const Case&, BodyPhysics&);
    bool (*asked)(const BodyPhysics&);
    // All that it cannot be combined with; the only place where a pair is refused.
    std::vector<Exclusion> excludes = {};
    // Relations between its keys.
    void (*check)(const Case&, const Complain&) = nullptr;
    // Why a case with it needs a model; empty: it does not.
    const char* (*needs_elements)(const Case&) = nullptr;
    const char* (*needs_asperities)(const Case&) = nullptr;
    // Why each level depends on the levels before; null: none does.
    const char* path = nullptr;
    std::vector<LevelQuantity> quantities = {};  // of a level
    std::vector<LevelCurve> curves = {};         // of a level, along an axis of a case
    CurveAxis (*axis)(const PreparedFacts&) = nullptr;
    std::vector<PointField> fields = {};
    std::unique_ptr<LevelRecorder> (*recorder)(const RecordedBodies&) = nullptr;  // of these
    // Boundary elements: sets the errors among the curves of a level, from its share of border
    // pixels; `step` is a side of a pixel [length]. Called by trust/.
    void (*curve_errors)(std::span<double> curves, std::span<const double> axis, double step,
                         const Case&, const LevelValues&, const GridBodies&) = nullptr;
    bool lowers = false;    // points of the surface, for good
    bool reshapes = false;  // the surface after each level is a result
    bool pulls = false;     // forces may be negative
    // A warning of elastic pressures above what metals bear would be wrong: this physics limits
    // the pressures, or describes other materials.
    bool mends_extreme_pressures = false;
    // Why two flats with it may have no solution; null: that is not known to happen.
    const char* may_close_gap = nullptr;
    bool closed_forms = true;  // those of an elastic half-space hold
    // Throws Error(bad_input) for what cannot be solved.
    void (*require_feasible)(const PreparedFacts&) = nullptr;
    // The largest mean pressure that an asperity of this radius bears, or with Infinity an element.
    double (*largest_pressure)(const BodyPhysics&, double radius) = nullptr;
    // What elements need in addition, for advice: " with a solids%..."; empty: nothing.
    const char* (*for_elements)(const Case&) = nullptr;
    // Whether asperities with it were compared with elements (input/trust); null: they were not.
    bool (*calibrated)(const BodyPhysics&, bool layers) = nullptr;
    // Elements under a prescribed force: how much farther the bodies approach for a force as large
    // again, beyond the elastic change that follows from the stiffness; NaN: not known. [length]
    double (*further_approach)(const Level&, const HeightMap&, const Indenter&,
                               const BodyPhysics&) = nullptr;
    // Throws Error(bad_input) for parameters out of range.
    void (*require_sound)(const BodyPhysics&) = nullptr;
    // Whether a run of asperities may compare some levels with elements of its own accord.
    bool (*compares_itself)(const Case&) = nullptr;
    // Elements: the errors of N and A by the grid, where other things than the sizes of the
    // contacts limit them; `few`: those by the sizes.
    GridError (*grid_error)(const Level&, const HeightMap&, const Indenter&, const BodyPhysics&,
                            const GridError& few) = nullptr;
    // Elements: whether the grid is too coarse for the length over which it acts, or the roughness
    // too small.
    bool (*doubts_range)(const Level&, const HeightMap&, const BodyPhysics&) = nullptr;
    double bytes_per_point = 0;                // of elements
    double (*bytes)(double points) = nullptr;  // of elements, beside these
    // Prints sentences after the levels of a run.
    void (*remark)(std::ostream&, const RunFacts&) = nullptr;

    // What it adds to a contact: a law around that of the asperities, how points of elements are
    // lowered or loads on them act on, or a model of its own.
    AsperityPhysics (*law)(const ContactBodies&, std::unique_ptr<Law>) = nullptr;
    std::unique_ptr<Lowering> (*lowering)(const BodyPhysics&) = nullptr;
    std::unique_ptr<LastingLoads> (*loads)(const BodyPhysics&) = nullptr;
    std::unique_ptr<Model> (*asperities)(const Asperities&, const Indenter&,
                                         const SolverOptions&) = nullptr;
    std::unique_ptr<Model> (*elements)(const HeightMap&, const Indenter&,
                                       const SolverOptions&) = nullptr;
};

// The curves of a physics in a case.
struct AskedCurves {
    const Physics* physics;
    CurveAxis axis;
    std::size_t values() const;  // of a level
};
std::size_t values_of(std::span<const AskedCurves> all);

std::span<const Physics* const> all_physics();
// Whether output%fields has this name.
bool has_field(const Case& settings, std::string_view name);
// The names for output%fields, in the order of their numbers there: first those of any contact.
std::span<const char* const> field_names();

// The parameters of all physics of a case, and the physics that it asks for.
BodyPhysics physics_of(const Case& settings);
std::vector<const Physics*> physics_asked(const BodyPhysics& bodies);
std::vector<const Physics*> physics_asked(const Case& settings);
// True if some physics of the case has this property.
bool any_physics(const Case& settings, bool Physics::*has);
// The largest pressure that the bodies of a case bear; Infinity: any.
double largest_pressure(const Case& settings, double radius = kInfinity);
// True if levels depend on the levels before.
bool path_dependent(const Case& settings);

// Calls refuse({key, other}, text) for each pair that is excluded.
void find_exclusions(const Combination& all, const Complain& refuse);

}  // namespace rsc
