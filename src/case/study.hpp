// A &study: lists of values for keys, and the cases of their combinations.
#pragma once

#include "case/case.hpp"
#include "case/namelist.hpp"

namespace rsc {

// product: every combination, the first key varying slowest; zip: the k-th values of all lists
// together.
struct Study {
    struct Axis {
        std::string key;                  // "surface%sigma" or an element, "solids%R(2)"
        std::vector<std::string> values;  // in namelist syntax
        namelist::Position at;
        std::vector<namelist::Position> places;  // of the values
    };
    StudyMode mode = StudyMode::product;
    std::vector<Axis> axes;
    namelist::Position at;
};

struct Member {
    int index = 1;                                            // 1-based
    std::vector<std::pair<std::string, std::string>> values;  // key, value in namelist syntax
    Case settings;                                            // output%file is numbered by member
};

// "surface%sigma=0.001 solids%R(2)=1.0"
std::string values_text(const Member& member);

inline constexpr std::size_t kMostMembers = 10'000;
inline constexpr std::size_t kMostLevels = 10'000'000;  // of indentation%levels, over all members

// Reads a &study group; faults are added with their places.
Study read_study(const namelist::Group& group, std::vector<namelist::Fault>& faults);

// Faults in the study's keys, values and lengths, each checked alone on `base`.
std::vector<namelist::Fault> check_study(const Case& base, const Study& study);

// All members in order, each of them checked (check_case). Throws Error(bad_input) with the names
// of invalid members.
std::vector<Member> expand_study(const Case& base, const Study& study);

// "output/rsc.nc" -> "output/rsc_007.nc"; as many digits as `members` needs, three at least.
std::string member_file(const std::string& file, int index, std::size_t members);

// As namelist input.
std::string effective_namelist(const Study& study);

}  // namespace rsc
