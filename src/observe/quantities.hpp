// The quantities of a level. A quantity is one row in quantities.cpp and one member of LevelValues (contact/level.hpp); result files,
// checkpoints, the screen, means of campaigns and rsc_contact_value follow from it.
#pragma once

#include "contact/level.hpp"

namespace rsc {

struct LevelQuantity {
    using Member = std::variant<double LevelValues::*, std::int32_t LevelValues::*, std::int64_t LevelValues::*, LevelStatus LevelValues::*,
                                Method LevelValues::*, Fallback LevelValues::*>;
    const char* name;                       // of the variable in the file, and in calls by name
    Member member;                          // doubles may be NaN: not computed
    double LevelValues::*y = nullptr;       // of a vector: `member` is x, files have a dimension more
    int length_power = 0, force_power = 0;  // of its unit
    const char* unit = nullptr;             // a unit of its own instead; "time": that of times
    bool of_step = false;                   // the same in every realization
    const char* meaning = "";               // long_name
    const char* comment = "";
    bool always = true;       // false: files hold it only if some level has it (computed; a count: not 0)
    bool statistics = false;  // files have name_mean and name_std over realizations, too: of the `plain` name
    const char* plain = "";
    const char* heading = nullptr;  // of its column on the screen; none: not shown
    int width = 0, digits = 0;      // of that column; significant digits of a double, 0 for "%.1e"

    // Its value as a number, NaN if it was not computed.
    double of(const LevelValues& level) const;
    // Stores a value returned by of().
    void put(LevelValues& level, double value) const;
    bool integer() const { return !std::holds_alternative<double LevelValues::*>(member); }
};

// In the order of files and screen.
std::span<const LevelQuantity> level_quantities();

// Null if there is none of that name.
const LevelQuantity* find_quantity(std::string_view name);

}  // namespace rsc
