#include "file/output_path.hpp"

#include <fcntl.h>
#include <netcdf.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <system_error>

#include "error.hpp"
#include "file/netcdf_file.hpp"
#include "read/checksum.hpp"
#include "rough/library_lock.hpp"
#include "version.h"

namespace rsc {
namespace fs = std::filesystem;
namespace {

// The nearest folder above `path` that exists.
fs::path existing_ancestor(fs::path folder) {
    std::error_code error;
    while (!fs::exists(folder, error)) {
        const fs::path parent = folder.parent_path();
        if (parent.empty() || parent == folder) return ".";
        folder = parent;
    }
    return folder;
}

// By the first bytes, because NetCDF and HDF5 take long to open their first file.
bool begins_as_netcdf(const std::string& path) {
    char start[4] = {};
    std::ifstream file(path, std::ios::binary);
    return file.read(start, sizeof start) && (std::memcmp(start, "CDF", 3) == 0 || std::memcmp(start, "\x89HDF", 4) == 0);
}

// HDF5 may crash where it is refused memory: what it is going to need is asked for first.
void require_memory(const std::string& path) {
    constexpr std::size_t wanted = std::size_t{32} << 20;
    void* const probe = std::malloc(wanted);
    if (!probe) throw Error(Failure::no_memory, "no memory to look into '" + path + "' (some 32 MB)");
    std::free(probe);
}

// A writer holds its lock a moment longer than its file has no name yet, and HDF5 opens no file that another process has locked.
void wait_for_writer(const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return;
    for (int k = 0; k < 200 && ::flock(fd, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++k) ::usleep(10000);
    ::close(fd);
}

}  // namespace

bool ResultHead::this_version() const { return source.starts_with("rsc " RSC_VERSION ","); }

std::optional<ResultHead> head_of_result(const std::string& path) {
    const std::lock_guard lock(library_lock());
    std::error_code error;
    int file = -1;
    if (!fs::is_regular_file(path, error) || !begins_as_netcdf(path)) return std::nullopt;
    require_memory(path);
    require_sound(path);
    wait_for_writer(path);
    if (nc_open(path.c_str(), NC_NOWRITE, &file) != NC_NOERR) return std::nullopt;
    const auto text = [file](const char* name) {
        constexpr std::size_t longest = std::size_t{1} << 26;  // of a case: a damaged file may announce anything
        std::size_t length = 0;
        nc_type type = NC_NAT;
        std::string value;
        if (nc_inq_att(file, NC_GLOBAL, name, &type, &length) != NC_NOERR || type != NC_CHAR || length > longest) return value;
        value.resize(length);
        if (nc_get_att_text(file, NC_GLOBAL, name, value.data()) != NC_NOERR) value.clear();
        return value;
    };
    ResultHead head{text("source"), text("case")};
    nc_close(file);
    if (!head.source.starts_with("rsc ") || head.case_text.empty()) return std::nullopt;
    return head;
}

std::optional<std::string> case_in_result(const std::string& path) {
    std::optional<ResultHead> head = head_of_result(path);
    return head ? std::optional(std::move(head->case_text)) : std::nullopt;
}

const FileKind kResultFile{"result", [](const std::string& path) { return head_of_result(path).has_value(); }};

bool check_output(const std::string& path, const std::vector<std::string>& inputs) {
    const auto refuse = [&path](const std::string& why) { throw Error(Failure::bad_input, "&output file='" + path + "': " + why); };
    if (path.empty()) refuse("a file name is expected");
    if (path.back() == '/') refuse("a file name is expected after the last '/'");
    // NetCDF takes such names for data sets on the net or for folders of the zarr format.
    if (path.find("://") != std::string::npos || path.starts_with("http:") || path.find("#mode=") != std::string::npos)
        refuse("this is an address, not the name of a file; rsc writes to plain files alone");
    std::error_code error;
    const fs::path parent = fs::path(path).parent_path(), folder = parent.empty() ? fs::path(".") : parent,
                   ancestor = existing_ancestor(folder);
    if (!fs::is_directory(ancestor, error)) refuse("'" + ancestor.string() + "' is not a folder");
    if (fs::path(path).is_absolute() && ancestor != folder && !fs::exists(folder, error))
        refuse("folder '" + folder.string() + "' does not exist; make it first");
    if (::access(ancestor.c_str(), W_OK | X_OK) != 0)
        refuse("folder '" + ancestor.string() + "' cannot be written to: " + std::error_code(errno, std::generic_category()).message());
    for (const std::string& input : inputs)
        if (fs::is_regular_file(input, error) && fs::equivalent(input, path, error))
            refuse("this is an input of the run ('" + input + "'), which the result would overwrite; name another file");
    if (const std::string why = reason_to_leave(path, kResultFile); !why.empty()) refuse(why);
    return fs::exists(path, error);
}

}  // namespace rsc
