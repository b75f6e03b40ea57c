// A file without a disk, for readers that want a path.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include "promise.hpp"

class MemoryFile {
public:
    MemoryFile() : fd_(memfd_create("input", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(fd_)) {
        PROMISE(fd_ >= 0, "memfd_create");
    }
    const std::string& path() const { return path_; }
    void set(const void* bytes, std::size_t size) {
        PROMISE(ftruncate(fd_, 0) == 0, "ftruncate");
        PROMISE(pwrite(fd_, bytes, size, 0) == static_cast<ssize_t>(size), "pwrite");
    }

private:
    int fd_;
    std::string path_;
};
