#include "io/whole_file.hpp"

#include <fcntl.h>
#include <netcdf.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "base/version.h"
#include "io/input_netcdf.hpp"
#include "io/netcdf_file.hpp"

namespace rsc {
namespace fs = std::filesystem;
namespace {

constexpr int kPartsLookedAt = 16;  // more than one writer of the same file at a time is rare

std::string part_name(const std::string& path, int k) {
    return path + ".rsc-part-" + std::to_string(k);
}

}  // namespace

std::string folder_of(const std::string& path) {
    const std::string parent = fs::path(path).parent_path().string();
    return parent.empty() ? "." : parent;
}

std::string reason_to_leave(const std::string& path, const FileKind& kind) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return {};  // other errors are found on opening
    if (S_ISDIR(status.st_mode)) return "this is a folder; name a file in it";
    if (S_ISLNK(status.st_mode))
        return "this is a link to another file; give the name of that file, or remove the link "
               "first";
    if (!S_ISREG(status.st_mode)) return "this is not a plain file (but a device, a FIFO, ...)";
    if ((status.st_mode & 0222) == 0 || ::access(path.c_str(), W_OK) != 0)
        return "this file is read-only; give another name, or make it writable";
    if (!kind.is_one(path))
        return std::string("this file exists and is no ") + kind.name +
               " of rsc; it is left alone: give another name, or remove it first";
    return {};
}

void fail_to_write(const std::string& path, int error) {
    const std::string folder = folder_of(path);
    std::string why = std::error_code(error, std::generic_category()).message() +
                      "; check that folder '" + folder + "' is writable";
    if (error == ENOSPC)
        why = "the disk that holds folder '" + folder +
              "' is full; free some space, or give a file on another disk";
    if (error == EDQUOT)
        why = "the disk quota for folder '" + folder +
              "' is used up; free some space, or give a file on another disk";
    if (error == EFBIG)
        why =
            "the file grows beyond the limit of file sizes (see ulimit -f); raise the limit, or "
            "write less";
    throw Error(Failure::file_system, "cannot write '", path, "': ", why);
}

bool begins_with(const std::string& path, const std::string& start) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return false;
    std::string there(start.size(), '\0');
    std::ifstream in(path, std::ios::binary);
    return in.read(there.data(), std::streamsize(there.size())) && there == start;
}

int lock_file(int fd) {
    // Not flock(), which HDF5 uses on files that it reads: it would refuse a result whose writer
    // still holds the lock.
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    if (::fcntl(fd, F_OFD_SETLK, &whole) == 0) return 0;
    return errno == EACCES ? EAGAIN : errno;
}

int write_all(int fd, std::span<const char> bytes) {
    constexpr std::size_t most = std::size_t{1} << 30;  // one call writes less than 2 GiB
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd, bytes.data(), std::min(bytes.size(), most));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        bytes = bytes.subspan(at(n));
    }
    return 0;
}

// A temporary file that no process has locked was left by an interrupted writer. Without working
// locks it is kept.
void remove_parts_left(const std::string& path) {
    for (const int k : indices(kPartsLookedAt)) {
        const std::string name = part_name(path, k);
        const int fd = ::open(name.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (fd < 0) continue;
        struct stat status {};
        if (::fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && lock_file(fd) == 0)
            ::unlink(name.c_str());
        ::close(fd);
    }
}

WholeFile::WholeFile(const std::string& path, const FileKind& kind) : path_(path) {
    if (const std::string why = reason_to_leave(path, kind); !why.empty())
        throw Error(Failure::file_system, "cannot write '", path, "': ", why);
    remove_parts_left(path);
    for (int k = 0; !open_part(part_name(path, k));) ++k;
    struct stat before {};
    if (::stat(path.c_str(), &before) == 0)
        (void)::fchmod(fd_, before.st_mode & 0777);  // keep the permissions
}

// Creates and locks a new file of that name, so that no other writer removes it. False if there is
// one already.
bool WholeFile::open_part(const std::string& name) {
    fd_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd_ < 0 && errno == EEXIST) return false;
    if (fd_ < 0) fail_to_write(path_, errno);
    struct stat status {};
    // Between the two calls another writer may have removed it as an abandoned file.
    if (lock_file(fd_) == EAGAIN || ::fstat(fd_, &status) != 0 || status.st_nlink == 0) {
        ::close(std::exchange(fd_, -1));
        return false;
    }
    part_ = name;
    return true;
}

WholeFile::~WholeFile() {
    if (fd_ < 0) return;
    ::unlink(part_.c_str());  // while it is locked: afterwards another writer may use the name
    ::close(fd_);
}

void WholeFile::write(std::span<const char> bytes) {
    if (const int error = write_all(fd_, bytes); error != 0) fail_to_write(path_, error);
}

int WholeFile::finish(bool keep_open) {
    if (::fsync(fd_) != 0 && errno != EINVAL && errno != ENOSYS)
        fail_to_write(path_, errno);  // not supported by some file systems
    if (::rename(part_.c_str(), path_.c_str()) != 0) fail_to_write(path_, errno);
    const int fd = std::exchange(fd_, -1);
    if (!keep_open) ::close(fd);
    if (const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
    return keep_open ? fd : -1;
}

void write_whole(const std::string& path, const FileKind& kind, std::span<const char> bytes) {
    WholeFile file(path, kind);
    file.write(bytes);
    file.finish();
}

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

}  // namespace

bool ResultHead::this_version() const { return source.starts_with("rsc " RSC_VERSION ","); }

std::optional<ResultHead> head_of_result(const std::string& path) {
    const std::lock_guard lock(library_lock());
    // By the first bytes, because NetCDF and HDF5 take long to open their first file.
    if (!begins_with(path, "CDF") && !begins_with(path, "\x89HDF")) return std::nullopt;
    require_memory(32 << 20, "to read '" + path + "'");
    const int file = open_netcdf(path);
    ResultHead head{global_text(file, "source"), global_text(file, "case")};
    nc_close(file);
    if (!head.source.starts_with("rsc ") || head.case_text.empty()) return std::nullopt;
    return head;
}

// Only rsc writes the checksum; NetCDF takes longer to open a file of many variables.
const FileKind kResultFile{"result", [](const std::string& path) {
                               return ((begins_with(path, "CDF") || begins_with(path, "\x89HDF")) &&
                                       require_sound(path)) ||
                                      head_of_result(path).has_value();
                           }};

bool check_output(const std::string& path, const std::vector<std::string>& inputs) {
    const auto refuse = [&path](const auto&... why) {
        bad_input("&output file='", path, "': ", why...);
    };
    if (path.empty()) refuse("a file name is expected");
    if (path.back() == '/') refuse("a file name is expected after the last '/'");
    // NetCDF would treat such names as URLs or as zarr stores.
    if (path.find("://") != std::string::npos || path.starts_with("http:") ||
        path.find("#mode=") != std::string::npos)
        refuse("this is a URL; rsc writes to plain files only");
    std::error_code error;
    const fs::path folder = folder_of(path), ancestor = existing_ancestor(folder);
    if (!fs::is_directory(ancestor, error)) refuse("'", ancestor.string(), "' is not a folder");
    if (fs::path(path).is_absolute() && ancestor != folder && !fs::exists(folder, error))
        refuse("folder '", folder.string(), "' does not exist; create it first");
    if (::access(ancestor.c_str(), W_OK | X_OK) != 0)
        refuse("folder '", ancestor.string(), "' cannot be written to: ",
               std::error_code(errno, std::generic_category()).message());
    const bool there = fs::exists(path, error);
    for (std::size_t k = 0; there && k < inputs.size(); ++k)
        if (const std::string& input = inputs[k];
            fs::is_regular_file(input, error) && fs::equivalent(input, path, error))
            refuse("this is an input of the run ('", input,
                   "'), which the result would overwrite; name another file");
    if (const std::string why = reason_to_leave(path, kResultFile); !why.empty()) refuse(why);
    return there;
}

}  // namespace rsc
