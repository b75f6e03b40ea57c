// Files that are written whole or not at all: results, manifests, saved contacts, checkpoints that are written anew.
//
// The bytes go to a temporary file beside the target, are brought to the disk, and the temporary is then renamed to the target, so that
// a reader never sees a part of a file, whatever ends the writer. Any number of threads and processes may write to one target: the last one
// wins.
#pragma once

#include "std.hpp"

namespace rsc {

// A kind of file that rsc writes. An existing file is replaced only where is_one() recognises it.
struct FileKind {
    const char* name;                         // "result": messages say "no result of rsc"
    bool (*is_one)(const std::string& path);  // of an existing, plain file
};

// Why `path` must not be written to, or nothing where it may: it is a folder, a link, a device or a FIFO, it is read-only, or it is a
// file that is not of this kind.
std::string reason_to_leave(const std::string& path, const FileKind& kind);

// Throws Error(file_system): the meaning of the system's error number for writing `path`, and a remedy.
[[noreturn]] void fail_to_write(const std::string& path, int error);

// A line of text at the beginning of a file; false where there is no such plain file.
bool begins_with(const std::string& path, const std::string& start);

// Locks an open file for its writer, as long as the descriptor and its copies are open; it must be open for writing. Returns 0, EAGAIN where
// another writer has it, or another errno: some file systems have no locks.
int lock_file(int fd);

// Removes temporaries of this target whose writers were killed; those that are being written stay.
void remove_parts_left(const std::string& path);

class WholeFile {
public:
    // Makes the temporary `path`.rsc-part-<k>, k = 0, 1, ... being the first that is free, after remove_parts_left(). Throws Error(file_system) where reason_to_leave() has a reason or the folder cannot be written to.
    WholeFile(const std::string& path, const FileKind& kind);
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;
    ~WholeFile();  // removes the temporary unless finish() was reached

    // Appends. Throws Error(file_system).
    void write(std::span<const char> bytes);
    // Makes sure that the bytes are on the disk, and only then gives the file its name. Throws Error(file_system). Returns the
    // descriptor, open for reading and writing and locked, where `keep_open`; -1 otherwise.
    int finish(bool keep_open = false);

private:
    bool open_part(const std::string& name);

    std::string path_, part_;
    int fd_ = -1;
};

// All of it in one call.
void write_whole(const std::string& path, const FileKind& kind, std::span<const char> bytes);

// Checks of the place of a result: a file that rsc has not written is never replaced.

// The global attributes of a NetCDF file written by rsc, a result or the manifest of a study.
struct ResultHead {
    std::string source;     // "rsc 0.2.0, deterministic ..."
    std::string case_text;  // the effective namelist
    bool this_version() const;
};
// None for any other file, or where there is none.
std::optional<ResultHead> head_of_result(const std::string& path);
// The case alone.
std::optional<std::string> case_in_result(const std::string& path);

// Results and manifests, the files that head_of_result() knows.
extern const FileKind kResultFile;

// Can a result be written there? Changes nothing on the disk. `inputs`: files the run reads; names that are no plain file are
// ignored (so that "/dev/stdin" may be among them). Returns whether a result of rsc is there and will be replaced. Throws
// Error(bad_input) saying what is in the way: no name, an address of the net, a folder that is missing above an absolute path, is no folder, or
// may not be written to, one of the inputs under whatever name, or what reason_to_leave() says.
bool check_output(const std::string& path, const std::vector<std::string>& inputs = {});

}  // namespace rsc
