// Quantities of a level. Each is defined by one row in quantities.cpp and one member of LevelValues
// (contact/level.hpp); result files, checkpoints, screen output, means of campaigns and
// rsc_contact_value() use this table.
#pragma once

#include "contact/level.hpp"

namespace rsc {

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
    int length_power = 0, force_power = 0;  // powers in its unit
    const char* unit = nullptr;  // unit that replaces these powers; "time": the unit of times
    bool of_step = false;        // has the same value in every realization
    const char* meaning = "";    // long_name
    const char* comment = "";
    bool always = true;  // false: written only if some level has it
    // A count: written with this quantity, even if it is 0 at all levels.
    double LevelValues::*beside = nullptr;
    bool statistics = false;  // files also have name_mean and name_std over realizations
    // these are of its logarithm, name_log_mean ..., over the realizations where it is positive
    bool logarithm = false;
    bool of_flow = false;  // on the screen only with output%flow
    const char* plain = "";
    const char* heading = nullptr;  // of its column on the screen; null: not shown
    int width = 0, digits = 0;      // of the column; significant digits of a double, 0: "%.1e"

    std::size_t components() const { return z ? 3 : y ? 2 : 1; }
    // The value of a component as a double; NaN if it was not computed.
    double of(const LevelValues& level, std::size_t component = 0) const;
    // Stores a value returned by of().
    void put(LevelValues& level, double value, std::size_t component = 0) const;
    bool integer() const { return !std::holds_alternative<double LevelValues::*>(member); }
};

// All quantities in the order of files and screen.
std::span<const LevelQuantity> level_quantities();

// Returns null if there is no quantity of this name.
const LevelQuantity* find_quantity(std::string_view name);

}  // namespace rsc
