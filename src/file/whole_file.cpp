#include "file/whole_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "error.hpp"

namespace rsc {
namespace fs = std::filesystem;
namespace {

constexpr int kPartsLookedAt = 16;  // more than one writer of the same file at a time is rare

std::string part_name(const std::string& path, int k) { return path + ".rsc-part-" + std::to_string(k); }

std::string folder_of(const std::string& path) {
    const std::string parent = fs::path(path).parent_path().string();
    return parent.empty() ? "." : parent;
}

}  // namespace

std::string reason_to_leave(const std::string& path, const FileKind& kind) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return {};  // what else is wrong with the name, opening it will tell
    if (S_ISDIR(status.st_mode)) return "this is a folder; name a file in it";
    if (S_ISLNK(status.st_mode)) return "this is a link to another file; name that file, or remove the link first";
    if (!S_ISREG(status.st_mode)) return "something that is not a plain file has this name (a device, a FIFO, ...)";
    if ((status.st_mode & 0222) == 0 || ::access(path.c_str(), W_OK) != 0)
        return "this file is read-only; name another, or allow it to be written";
    if (!kind.is_one(path))
        return std::string("this file exists and is no ") + kind.name + " of rsc; it is left alone: name another, or remove it first";
    return {};
}

void fail_to_write(const std::string& path, int error) {
    const std::string folder = folder_of(path);
    std::string why = std::error_code(error, std::generic_category()).message() + "; see whether folder '" + folder + "' can be written to";
    if (error == ENOSPC) why = "the disk that holds folder '" + folder + "' is full; make room there, or name a file on another disk";
    if (error == EDQUOT) why = "the disk quota for folder '" + folder + "' is used up; make room there, or name a file on another disk";
    if (error == EFBIG) why = "the file grows beyond the limit of file sizes (see ulimit -f); raise the limit, or write less";
    throw Error(Failure::file_system, "cannot write '" + path + "': " + why);
}

bool begins_with(const std::string& path, const std::string& start) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return false;
    std::string there(start.size(), '\0');
    std::ifstream in(path, std::ios::binary);
    return in.read(there.data(), static_cast<std::streamsize>(there.size())) && there == start;
}

// A temporary that an interrupted writer left is one that no process has locked. Where locks do not work it stays.
void remove_parts_left(const std::string& path) {
    for (int k = 0; k < kPartsLookedAt; ++k) {
        const std::string name = part_name(path, k);
        const int fd = ::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (fd < 0) continue;
        struct stat status {};
        if (::fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && ::flock(fd, LOCK_EX | LOCK_NB) == 0) ::unlink(name.c_str());
        ::close(fd);
    }
}

WholeFile::WholeFile(const std::string& path, const FileKind& kind) : path_(path) {
    if (const std::string why = reason_to_leave(path, kind); !why.empty())
        throw Error(Failure::file_system, "cannot write '" + path + "': " + why);
    remove_parts_left(path);
    for (int k = 0; !open_part(part_name(path, k));) ++k;
    struct stat before {};
    if (::stat(path.c_str(), &before) == 0) (void)::fchmod(fd_, before.st_mode & 0777);  // who may read it stays as it was
}

// Makes a new file of that name and locks it, so that no other writer takes it for one that was left. False where there is one already.
bool WholeFile::open_part(const std::string& name) {
    fd_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd_ < 0 && errno == EEXIST) return false;
    if (fd_ < 0) fail_to_write(path_, errno);
    struct stat status {};
    // Between the two calls another writer may have taken it for one that was left, and removed it.
    const bool taken = ::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (taken || ::fstat(fd_, &status) != 0 || status.st_nlink == 0) {
        ::close(std::exchange(fd_, -1));
        return false;
    }
    part_ = name;
    return true;
}

WholeFile::~WholeFile() {
    if (fd_ < 0) return;
    ::unlink(part_.c_str());  // while it is locked: afterwards the name may be another writer's
    ::close(fd_);
}

void WholeFile::write(std::span<const char> bytes) {
    constexpr std::size_t most = std::size_t{1} << 30;  // one call writes less than 2 GiB
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd_, bytes.data(), std::min(bytes.size(), most));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail_to_write(path_, errno);
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
}

int WholeFile::finish(bool keep_open) {
    if (::fsync(fd_) != 0 && errno != EINVAL && errno != ENOSYS) fail_to_write(path_, errno);  // some file systems lack it
    if (::rename(part_.c_str(), path_.c_str()) != 0) fail_to_write(path_, errno);
    const int fd = std::exchange(fd_, -1);
    if (const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
    if (keep_open) return fd;
    ::close(fd);
    return -1;
}

void write_whole(const std::string& path, const FileKind& kind, std::span<const char> bytes) {
    WholeFile file(path, kind);
    file.write(bytes);
    file.finish();
}

}  // namespace rsc
