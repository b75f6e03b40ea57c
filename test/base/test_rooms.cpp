// The rooms of src/ include only what lies below them (src/README), so that the code can be read
// from the bottom up.

#include <regex>

#include "check.hpp"

namespace test_rooms {

namespace fs = std::filesystem;

// From the bottom to the top; rooms of equal rank do not include each other.
int rank_of(const std::string& room) {
    static const std::map<std::string, int> ranks = {
        {"base", 0},       {"surface", 1},  {"interaction", 2}, {"contact", 3}, {"case/key", 4},
        {"asperities", 5}, {"elements", 5}, {"physics/row", 6}, {"physics", 7}, {"contact/make", 8},
        {"trust", 9},      {"observe", 10}, {"case", 11},       {"io", 12},     {"problem", 13},
        {"run", 14},       {"api", 15}};
    const bool physics = room.starts_with("physics/") && room != "physics/row";
    const auto found = ranks.find(physics ? "physics" : room);
    return found == ranks.end() ? -1 : found->second;
}

// Each folder of physics/ is a room of its own; so are the files that know all of them.
std::string room_of(const std::string& path) {
    const auto first = path.find('/');
    if (first == std::string::npos) return "";
    if (path.starts_with("contact/make.") || path == "contact/quantities.cpp" ||
        path == "physics/physics.cpp")
        return "contact/make";
    if (path == "physics/physics.hpp") return "physics/row";
    // What a case is, without its reader.
    if (path == "case/case.hpp" || path == "case/key.hpp" || path == "case/units.hpp")
        return "case/key";
    if (path.substr(0, first) != "physics") return path.substr(0, first);
    return path.substr(0, path.find('/', first + 1));
}

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
            if (other.empty() || other == room) continue;
            const bool below = rank_of(other) >= 0 && rank_of(other) < rank_of(room);
            if (!below) std::printf("%s includes %s\n", path.c_str(), name.c_str());
            CHECK(below);
        }
    }
    CHECK(files > 100);
}

// Every file that a comment names exists: a path, or a name within its own room.
TEST(files_named_in_comments) {
    const fs::path top = fs::path(RSC_TEST_DATA) / "../..";
    std::vector<std::string> files;
    for (const char* part : {"src", "test", "input", "modules", "output"})
        for (const auto& entry : fs::recursive_directory_iterator(top / part))
            files.push_back("/" + fs::relative(entry.path(), top).generic_string());
    const std::regex named(R"(([a-z_0-9/]+\.(hpp|cpp|inl|py)))");
    int found = 0;
    for (const std::string& file : files) {
        if (!file.ends_with(".hpp") && !file.ends_with(".cpp")) continue;
        std::ifstream in(top / file.substr(1));
        for (std::string line; std::getline(in, line);) {
            const auto comment = line.find("//");
            if (comment == std::string::npos) continue;
            const std::string text = line.substr(comment + 2);
            for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at) {
                const std::string name = "/" + (*at)[1].str();
                ++found;
                if (std::ranges::any_of(files, [&](const auto& f) { return f.ends_with(name); }))
                    continue;
                std::printf("%s names %s\n", file.c_str(), name.c_str());
                CHECK(false);
            }
        }
    }
    CHECK(found > 100);
}

}  // namespace test_rooms
