// Numbers that are not finite never reach a result file. Obstacles of the file system: test/cli/faults.sh, files.sh.
#include "check.hpp"
#include "error.hpp"
#include "file/netcdf_writer.hpp"
#include "unit/sample_result.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;
namespace fs = std::filesystem;

namespace {

template <typename Call>
std::string message(Failure kind, Call call) {
    try {
        call();
    } catch (const Error& e) {
        return e.kind() == kind ? e.what() : std::string("another kind of failure: ") + e.what();
    }
    return "no failure";
}

bool says(const std::string& text, const std::string& words) {
    const bool found = text.find(words) != std::string::npos;
    if (!found) std::printf("message: %s\n", text.c_str());
    return found;
}

void test_not_finite(const Folder& folder) {
    const std::string path = folder / "never.nc";
    Result r = sample::result(1);
    r.contacts.force[5] = std::nan("");
    CHECK(says(message(Failure::internal, [&] { write_result(r, path, {}); }), "contact_force"));
    r = sample::result(1);
    r.observations.map_pressure[0] = 1.0 / 0.0;
    CHECK(says(message(Failure::internal, [&] { write_result(r, path, {}); }), "map_pressure"));
    r = sample::result(1);
    r.heights->row(2)[3] = std::nan("");
    CHECK(says(message(Failure::internal, [&] { write_result(r, path, {}); }), "height"));
    CHECK(!fs::exists(path));
}

}  // namespace

TESTS { test_not_finite(Folder()); }
