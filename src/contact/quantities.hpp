// Quantities of a level. Each is defined by one member of LevelValues (contact/level.hpp) and one
// row, in quantities.cpp or with its physics: name, unit, meaning, how it is computed if it does
// not come with the solution, and how its error depends on the resolution. Result files,
// checkpoints, screen output, means of campaigns, rsc_contact_value() and rsc_contact_error() use
// this table.
#pragma once

#include "base/array.hpp"
#include "contact/path.hpp"
#include "surface/surface.hpp"

namespace rsc {

struct Case;

// What the quantities of a level are computed from.
struct LevelSource {
    Path& contact;  // that solved the level
    Level& level;
    std::array<double, 2> resistivity = {};  // of the bodies; 0: not known
    const BodyPhysics* physics = nullptr;    // parameters of the bodies; null: not known
    const HeightMap* map = nullptr;          // of elements, before any change; null for asperities
    // Fields of the level are asked for: what is computed gives also what only they need.
    bool for_fields = false;
    std::vector<double> flux = {};  // of the permeability (physics/flow/permeability.hpp)
    // Two flats: their gap is counted in so many bins of this width [length]; 0: it is not.
    int gap_bins = 0;
    double gap_bin = 0;
    Array<double> gap = {};  // of two flats at all points; empty: not yet computed [length]
};

struct LevelQuantity {
    using Member = std::variant<double LevelValues::*, std::int32_t LevelValues::*,
                                std::int64_t LevelValues::*, LevelStatus LevelValues::*,
                                Method LevelValues::*, Fallback LevelValues::*>;
    const char* name;  // of the variable in files and in calls by name
    Member member;     // NaN (double): not computed
    // second component of a vector, whose first is `member`; adds a dimension in files
    double LevelValues::*y = nullptr;
    // third component of a symmetric tensor: member, y and z are xx, yy and xy
    double LevelValues::*z = nullptr;
    // fourth component of a tensor that is not symmetric: xx, yy, xy and yx
    double LevelValues::*yx = nullptr;
    int length_power = 0, force_power = 0;  // powers in its unit
    bool per_time = false;                  // over the unit of times
    const char* unit = nullptr;  // unit that replaces these powers; "time": the unit of times
    bool of_step = false;        // has the same value in every realization
    const char* meaning = "";    // long_name
    const char* comment = "";
    // Sets it in the level unless it is known. Returns null, or why the level has none; for levels
    // with a state only. Null: it comes with the solution, or from the judge or the map.
    const char* (*compute)(LevelSource&) = nullptr;
    // Whether each level of a run computes it; null: yes. If not, it is computed by name only.
    bool (*in_run)(const Case&) = nullptr;
    // Boundary elements: the expected relative error of a component, from other values of the
    // level. Null: by the resolution of the contacts, if trust/grid_error_table.hpp has this
    // quantity.
    double (*own_error)(const LevelValues&, std::size_t component) = nullptr;
    // The quantity that is its expected error, if that has a row and a meaning of its own.
    double LevelValues::*error_member = nullptr;
    bool separate = false;  // an axis of files, which they write before the others
    bool of_map = false;    // of the maps of a run: not available by name
    bool always = true;     // false: written only if some level has it
    // Whether the screen has its column, if it has a heading; null: if `always`.
    bool (*shown)(const Case&) = nullptr;
    // A count: written with this quantity, even if it is 0 at all levels.
    double LevelValues::*written_with = nullptr;
    // The variable of files that has its smallest value over the levels of a realization, missing
    // if a level has no state; null: none.
    const char *least = nullptr, *least_meaning = "", *least_comment = "";
    bool answers = false;     // the line of a member of a study has its value
    bool statistics = false;  // files also have name_mean and name_std over realizations
    // these are of its logarithm, name_log_mean ..., over the realizations where it is positive
    bool logarithm = false;
    const char* plain = "";
    const char* heading = nullptr;  // of its column on the screen; null: not shown
    int width = 0, digits = 0;      // of the column; significant digits of a double, 0: "%.1e"

    std::size_t components() const { return yx ? 4 : z ? 3 : y ? 2 : 1; }
    // The value of a component as a double; NaN if it was not computed.
    double of(const LevelValues& level, std::size_t component = 0) const;
    // Stores a value returned by of().
    void put(LevelValues& level, double value, std::size_t component = 0) const;
    bool integer() const { return !std::holds_alternative<double LevelValues::*>(member); }
    // Expected error of a component: relative, unless error_member is another one; NaN: none is
    // stated.
    double error(const LevelValues& level, std::size_t component = 0) const;
    std::string unit_in(const std::string& length, const std::string& force,
                        const std::string& time) const;
    std::string error_name() const;  // of this error in files: name_error_expected

    std::size_t slot = 0;  // of its first component in LevelValues::errors; set by the table
};

// All quantities in the order of files and screen.
std::span<const LevelQuantity> level_quantities();

// A quantity, or one component of it.
struct QuantityComponent {
    const LevelQuantity* quantity;
    std::size_t component;
    double of(const LevelValues& level) const { return quantity->of(level, component); }
    double error(const LevelValues& level) const { return quantity->error(level, component); }
};

// The scalars available by name: components of vectors are "lateral_force_x", of tensors
// "permeability_xx", ...
std::optional<QuantityComponent> find_quantity(std::string_view name);
std::string names_of_quantities();  // separated by commas

// Expected relative error of the smallest force of a realization: that of N at the level of the
// smallest N. NaN: none is stated, e.g. where a later level is outside the range of validity: its
// contacts may come apart too early, and would pull harder if they did not.
double error_of_least_force(std::span<const LevelValues> levels);

// Computes the quantities of a level that no case needs to ask for, and in a run also those that
// its case asks for.
void compute_quantities(LevelSource& source, const Case* run = nullptr);

}  // namespace rsc
