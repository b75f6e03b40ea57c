// Files that are written completely or not at all: results, manifests, saved contacts, rewritten
// checkpoints.
//
// The bytes are written to a temporary file beside the target and flushed to the disk; then the
// temporary is renamed to the target. A reader never sees a part of a file, even if the writer is
// killed. Several threads and processes may write to one target: the last one wins.
#pragma once

#include "base/std.hpp"

namespace rsc {

// A kind of file that rsc writes. An existing file is replaced only if is_one() recognises it.
struct FileKind {
    const char* name;                         // "result": used in messages, "no result of rsc"
    bool (*is_one)(const std::string& path);  // for an existing, plain file
};

// The reason not to write to `path`: it is a folder, a link, a device or a FIFO, it is read-only,
// or it is a file that is not of this kind. Empty if it may be written.
std::string reason_to_leave(const std::string& path, const FileKind& kind);

// The folder of a file, "." for a bare name.
std::string folder_of(const std::string& path);

// Throws Error(file_system): the meaning of the system's error number for writing `path`, and a
// remedy.
[[noreturn]] void fail_to_write(const std::string& path, int error);

// True if `path` is a plain file that begins with the text `start`.
bool begins_with(const std::string& path, const std::string& start);

// Locks a file, which must be open for writing, as long as the descriptor and its copies are open.
// Returns 0, EAGAIN if another writer holds the lock, or another errno: some file systems have no
// locks.
int lock_file(int fd);

// Writes all of the bytes at the place of the descriptor. Returns 0, or errno.
int write_all(int fd, std::span<const char> bytes);

// Removes temporaries of this target whose writers were killed, but not those that are being
// written.
void remove_parts_left(const std::string& path);

class WholeFile {
public:
    // Creates the temporary `path`.rsc-part-<k> with the first free number k = 0, 1, ..., after
    // remove_parts_left(). Throws Error(file_system) if reason_to_leave() returns a reason or the
    // folder is not writable.
    WholeFile(const std::string& path, const FileKind& kind);
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;
    ~WholeFile();  // removes the temporary unless finish() was reached

    // Appends. Throws Error(file_system).
    void write(std::span<const char> bytes);
    // Flushes the bytes to the disk and then renames the file. Throws Error(file_system). Returns
    // the descriptor, open for reading and writing and locked, if `keep_open`; -1 otherwise.
    int finish(bool keep_open = false);

private:
    bool open_part(const std::string& name);

    std::string path_, part_;
    int fd_ = -1;
};

// Creates, writes and finishes a file in one call.
void write_whole(const std::string& path, const FileKind& kind, std::span<const char> bytes);

// Checks of the path of a result: a file that rsc has not written is never replaced.

// The global attributes of a NetCDF file written by rsc, a result or the manifest of a study.
struct ResultHead {
    std::string source;     // "rsc 0.4.0, deterministic ..."
    std::string case_text;  // the effective namelist
    bool this_version() const;
};
// None for any other file, or if there is no file.
std::optional<ResultHead> head_of_result(const std::string& path);

// Results and manifests, the files that head_of_result() recognises.
extern const FileKind kResultFile;

// Checks that a result can be written to `path`, without changing the disk. `inputs`: files the run
// reads; names that are no plain file are ignored (such as "/dev/stdin"). Returns true if a result
// of rsc exists there and will be replaced. Throws Error(bad_input) with the obstacle: no name, a
// URL, a folder that is missing above an absolute path, is no folder or is not writable, one of the
// inputs under any name, or the result of reason_to_leave().
bool check_output(const std::string& path, const std::vector<std::string>& inputs = {});

}  // namespace rsc
