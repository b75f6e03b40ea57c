// What is asked of the system, and in which order: a file gets its name only when its bytes are on
// the disk, a name never goes missing in between, a refusal of the disk is told as what it is, and
// NetCDF is called by one thread at a time. The calls in question are those of this file, which
// write down what they are asked for and pass it on.
#include <dlfcn.h>
#include <fcntl.h>
#include <netcdf.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "case/read_case.hpp"
#include "case/study.hpp"
#include "check.hpp"
#include "io/netcdf_writer.hpp"
#include "rsc.h"
#include "run/checkpoint.hpp"
#include "run/study.hpp"
#include "support/result_reader.hpp"
#include "support/sample_result.hpp"
#include "support/temporary_folder.hpp"

namespace {

std::mutex log_mutex;
std::vector<std::string> calls;  // "sync PATH", "write PATH", "rename FROM > TO", "unlink PATH"
std::atomic<bool> refuse_renames{false};
std::atomic<int> inside{0}, most_inside{0};

void note(const std::string& what) {
    const std::lock_guard lock(log_mutex);
    calls.push_back(what);
}

std::string path_of(int fd) {
    char path[4096];
    const ssize_t n =
        ::readlink(("/proc/self/fd/" + std::to_string(fd)).c_str(), path, sizeof path);
    return n > 0 ? std::string(path, n) : "?";
}

// Calls the function of the next library of that name.
template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int fsync(int fd) {
    note("sync " + path_of(fd));
    return int(::syscall(SYS_fsync, fd));
}
ssize_t write(int fd, const void* bytes, size_t n) {
    note("write " + path_of(fd));
    return ::syscall(SYS_write, fd, bytes, n);
}
ssize_t pwrite(int fd, const void* bytes, size_t n, off_t offset) {
    note("write " + path_of(fd));
    return ::syscall(SYS_pwrite64, fd, bytes, n, offset);
}
int rename(const char* from, const char* to) noexcept {
    note(std::string("rename ") + from + " > " + to);
    if (refuse_renames) {
        errno = ENOSPC;
        return -1;
    }
    return int(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
int unlink(const char* path) noexcept {
    note(std::string("unlink ") + path);
    return int(::syscall(SYS_unlinkat, AT_FDCWD, path, 0));
}

int nc_def_var(int id, const char* name, nc_type type, int n, const int* dimensions,
               int* variable) {
    const int now = ++inside;
    for (int seen = most_inside; now > seen && !most_inside.compare_exchange_weak(seen, now);) {
    }
    std::this_thread::sleep_for(std::chrono::microseconds(50));
    const int status =
        next<decltype(&nc_def_var)>("nc_def_var")(id, name, type, n, dimensions, variable);
    --inside;
    return status;
}

}  // extern "C"

using namespace rsc;

namespace {

// Place of the last call of these words before `end`, or -1.
long last_call(const std::string& words, long end) {
    for (long k = end - 1; k >= 0; --k)
        if (calls[k] == words) return k;
    return -1;
}

// A file came to its name whole: the last write to it, then the disk has it, then the name; the
// name was never taken away.
void named_after_the_disk_has_it(const std::string& path, bool folder_too) {
    long renamed = -1;
    std::string from;
    for (const auto k : indices(calls)) {
        CHECK(calls[k] != "unlink " + path);
        CHECK(calls[k] != "write " + path || renamed >= 0);
        if (!calls[k].starts_with("rename ") || !calls[k].ends_with(" > " + path)) continue;
        renamed = long(k);
        from = calls[k].substr(7, calls[k].size() - 7 - 3 - path.size());
    }
    CHECK(renamed > 0);
    const long synced = last_call("sync " + from, renamed),
               written = last_call("write " + from, renamed);
    CHECK(synced >= 0 &&
          synced > written);  // written: -1 where the C library writes by calls of its own
    if (!folder_too) return;
    const std::string folder = std::filesystem::path(path).parent_path().string();
    CHECK(last_call("sync " + folder, long(calls.size())) > renamed);
}

void results(const Folder& folder) {
    const std::string path = folder / "result.nc";
    for (const Format format : {Format::netcdf4, Format::classic}) {
        calls.clear();
        Result r = sample::result(1);
        r.settings.output.format = format;
        write_result(r, path, "");  // the second time over a file of that name
        named_after_the_disk_has_it(path, true);
    }
}

void manifests(const Folder& folder) {
    ReadCase read =
        read_case_text("&study surface%sigma = 0.01, 0.02  run%realizations = 3, 5 /", "case.nml");
    read.settings.output.file = folder / "study.nc";
    calls.clear();
    write_manifest(read, expand_study(read.settings, *read.study), "");
    named_after_the_disk_has_it(folder / "study_manifest.nc", true);
    nc_type type = NC_NAT;  // whole numbers as such
    const Reader file(folder / "study_manifest.nc");
    CHECK(nc_inq_vartype(file.id(), file.var("run_realizations"), &type) == NC_NOERR &&
          type == NC_INT);
}

void checkpoints(const Folder& folder) {
    const std::string file = folder / "campaign.nc", state = checkpoint_name(file);
    Checkpoint checkpoint(file, Case{}, false);
    const std::string record(1000, 'x');
    checkpoint.append(record);
    calls.clear();
    checkpoint.rewrite("the sums", {&record});
    named_after_the_disk_has_it(state, false);
    checkpoint.remove();
}

// NetCDF and HDF5 are not safe to call from several threads at a time, and are not.
void one_thread_in_netcdf(const Folder& folder) {
    most_inside = 0;
    const Result result = sample::result(3);
    std::vector<std::thread> threads;
    for (const int k : indices(4))
        threads.emplace_back(
            [&, k] { write_result(result, folder / ("thread" + std::to_string(k) + ".nc"), {}); });
    for (std::thread& thread : threads) thread.join();
    CHECK(most_inside == 1);
}

}  // namespace

TEST(all_calls) {
    const Folder folder;
    results(folder);
    manifests(folder);
    checkpoints(folder);
    one_thread_in_netcdf(folder);
}
