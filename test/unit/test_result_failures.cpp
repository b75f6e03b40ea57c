// Obstacles to a result file: it is refused early, or writing it fails and leaves nothing behind.
#include <sys/resource.h>
#include <unistd.h>

#include "check.hpp"
#include "error.hpp"
#include "file/netcdf_writer.hpp"
#include "file/whole_file.hpp"
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

void test_failures(const Folder& folder) {
    const Result r = sample::result(1);
    const auto writing = [&](const std::string& path, Format format = Format::netcdf4) {
        return message(Failure::file_system, [&] { write_result(r, path, {format, 4, ""}); });
    };
    const auto checking = [&](const std::string& path) { return message(Failure::bad_input, [&] { check_output(path); }); };
    std::ofstream(folder / "plain") << "x";
    fs::create_directory(folder / "dir");
    // A folder that is a file, a file that is a folder.
    CHECK(says(writing(folder / "plain/rsc.nc"), "cannot be made"));
    CHECK(says(writing(folder / "dir"), "this is a folder"));
    CHECK(says(checking(""), "expected"));
    CHECK(says(checking("dir/"), "expected"));
    CHECK(::access("/proc", W_OK) == 0 || says(checking("/proc/rsc.nc"), "cannot be written to"));
    CHECK(checking("made/later/rsc.nc") == "no failure" && !fs::exists("made"));
    CHECK(checking(folder / "rsc.nc") == "no failure" && checking("rsc.nc") == "no failure");
    if (::geteuid() != 0) {
        fs::permissions(folder / "dir", fs::perms::owner_read | fs::perms::owner_exec);
        CHECK(says(checking(folder / "dir/rsc.nc"), "cannot be written to"));
        CHECK(says(writing(folder / "dir/rsc.nc"), "Permission denied"));
        fs::permissions(folder / "dir", fs::perms::owner_all);
    }
    // The system stops the write half way, as a full disk does: nothing under the final name, no work in progress, and an older
    // file stays.
    const std::string old = folder / "old.nc";
    write_result(sample::result(2), old, {});
    const std::string older = bytes(old);
    const std::size_t before = folder.files();
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{}, tight{};
    getrlimit(RLIMIT_FSIZE, &limit);
    for (const rlim_t size : {0u, 5000u, 30000u})
        for (Format format : {Format::netcdf4, Format::cdf5, Format::classic}) {
            tight = limit;
            tight.rlim_cur = size;
            setrlimit(RLIMIT_FSIZE, &tight);
            const std::string text = writing(old, format), fresh = writing(folder / "fresh.nc", format);
            setrlimit(RLIMIT_FSIZE, &limit);
            CHECK(says(text, "cannot write '" + old + "'") && says(fresh, "cannot write"));
            CHECK(folder.files() == before && bytes(old) == older);
        }
    // After the failures it still writes.
    write_result(r, folder / "fresh.nc", {});
    CHECK(folder.files() == before + 1 && bytes(folder / "fresh.nc").size() > 10000);
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

TESTS {
    test_failures(Folder());
    test_not_finite(Folder());
}
