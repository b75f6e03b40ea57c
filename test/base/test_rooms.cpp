// The rooms of src/ include only what lies below them (src/README), so that the code can be read
// from the bottom up.

#include "check.hpp"

namespace test_rooms {

namespace fs = std::filesystem;

// From the bottom to the top; rooms of equal rank do not include each other.
int rank_of(const std::string& room) {
    static const std::map<std::string, int> ranks = {
        {"base", 0},     {"surface", 1}, {"interaction", 2},  {"contact", 3}, {"asperities", 4},
        {"elements", 4}, {"physics", 5}, {"contact/make", 6}, {"trust", 7},   {"observe", 8},
        {"case", 9},     {"io", 10},     {"run", 11},         {"api", 12}};
    const bool physics = room.starts_with("physics/");
    const auto found = ranks.find(physics ? "physics" : room);
    return found == ranks.end() ? -1 : found->second;
}

// Each folder of physics/ is a room of its own; so are the files that know all of them.
std::string room_of(const std::string& path) {
    const auto first = path.find('/');
    if (first == std::string::npos) return "";
    if (path.starts_with("contact/make.") || path == "contact/quantities.cpp")
        return "contact/make";
    if (path.substr(0, first) != "physics") return path.substr(0, first);
    return path.substr(0, path.find('/', first + 1));
}

// What still breaks the rule: elements make their memory of loads themselves.
const std::set<std::pair<std::string, std::string>> kExceptions = {
    {"elements", "physics/relaxation"},
};

TEST(includes) {
    const fs::path src = fs::path(RSC_TEST_DATA) / "../../src";
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(src)) {
        const std::string path = fs::relative(entry.path(), src).generic_string();
        const std::string room = room_of(path);
        if (!entry.is_regular_file() || room.empty()) continue;
        CHECK(rank_of(room) >= 0);
        ++files;
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
            if (!line.starts_with("#include \"")) continue;
            const std::string name = line.substr(10, line.find('"', 10) - 10);
            const std::string other = room_of(name);
            if (other.empty() || other == room || kExceptions.contains({room, other})) continue;
            const bool below = rank_of(other) >= 0 && rank_of(other) < rank_of(room);
            if (!below) std::printf("%s includes %s\n", path.c_str(), name.c_str());
            CHECK(below);
        }
    }
    CHECK(files > 100);
}

}  // namespace test_rooms
