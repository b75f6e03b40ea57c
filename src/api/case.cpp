// Cases: options by name, and runs as by the program.

#include "api/guard.hpp"
#include "api/handles.hpp"
#include "base/parallel.hpp"
#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "run/run.hpp"
#include "run/team.hpp"

namespace rsc::api {

const Case& settings_of(const rsc_case* a_case) {
    if (a_case && !a_case->tag.sound())
        bad_input("the case was already released, or is a handle of another kind");
    static const Case defaults;
    return a_case ? a_case->settings : defaults;
}

int threads_of(const Case& settings) { return int(most_threads(settings.run.threads)); }

}  // namespace rsc::api

using namespace rsc;
using namespace rsc::api;

int32_t rsc_case_create(rsc_case** new_case) {
    return constructed(0, new_case, "new_case", [] { return new rsc_case; });
}

int32_t rsc_case_copy(rsc_case** new_case, const rsc_case* original) {
    return constructed(0, new_case, "new_case", [&] {
        require(original, 2, "original");
        return new rsc_case(*original);
    });
}

int32_t rsc_case_destroy(rsc_case** old_case) { return destroyed(old_case, "old_case"); }

int32_t rsc_case_read(rsc_case* a_case, const char* text) {
    return on(a_case, "a_case", 2, [&] {
        require(text, 2, "text");
        ReadCase read = read_case_text(text, "case");
        if (read.study) refuse(2, "text", "must be one case: &study belongs to the program");
        a_case->settings = std::move(read.settings);
    });
}

int32_t rsc_case_read_file(rsc_case* a_case, const char* path) {
    return on(a_case, "a_case", 2, [&] {
        require(path, 2, "path");
        if (!*path) refuse(2, "path", "must not be empty");
        Options options;
        options.case_path = path;
        ReadCase read = read_case(options);
        if (read.study)
            refuse(2, "path", "must be a file with one case: &study belongs to the program");
        a_case->settings = std::move(read.settings);
    });
}

int32_t rsc_case_set(rsc_case* a_case, const char* name, const char* value) {
    return on(a_case, "a_case", 3, [&] {
        require(name, 2, "name");
        require(value, 3, "value");
        try {
            (void)get_key(a_case->settings, name);
        } catch (const Error& error) {
            if (error.kind() == Failure::bad_input) throw Refusal{2, error.what()};
            throw;
        }
        set_key(a_case->settings, name, value, true);
    });
}

int32_t rsc_case_get(const rsc_case* a_case, const char* name, char* buffer, int64_t size,
                     int64_t* length) {
    return on(a_case, "a_case", 2, [&] {
        require(name, 2, "name");
        put_text(get_key(a_case->settings, name), buffer, size, length, 3);
    });
}

int32_t rsc_case_text(const rsc_case* a_case, char* buffer, int64_t size, int64_t* length) {
    return on(a_case, "a_case", 1,
              [&] { put_text(effective_namelist(a_case->settings), buffer, size, length, 2); });
}

int32_t rsc_key_count(int64_t* count) {
    return on(count, "count", 0, [&] { put(count, registry().size()); });
}

int32_t rsc_key_name(int64_t key, char* buffer, int64_t size, int64_t* length) {
    return guarded(0, [&] {
        const auto keys = registry();
        if (key < 0 || key >= static_cast<int64_t>(keys.size()))
            refuse(1, "key", "must be the number of a key");
        put_text(full_name(keys[at(key)]), buffer, size, length, 2);
    });
}

namespace {

int32_t run(const rsc_case* a_case, bool resume, rsc_watch watch, void* data,
            int64_t* failed_levels) {
    return on(a_case, "a_case", 1, [&] {
        require_valid(a_case->settings);
        RunOptions how;
        how.command = resume ? "rsc_case_resume" : "rsc_case_run";
        how.resume = resume;
        if (watch)
            how.report = [=](double done, double total) { return watch(done, total, data) != 0; };
        const long failed = run_case(a_case->settings, how);
        put(failed_levels, failed);
        if (failed > 0)
            throw Outcome{
                RSC_NOT_CONVERGED,
                "some levels did not converge; their values are in the file with status = 4"};
    });
}

}  // namespace

int32_t rsc_case_run(const rsc_case* a_case, int64_t* failed_levels) {
    return run(a_case, false, nullptr, nullptr, failed_levels);
}

int32_t rsc_case_run_watched(const rsc_case* a_case, rsc_watch watch, void* data,
                             int64_t* failed_levels) {
    return run(a_case, false, watch, data, failed_levels);
}

int32_t rsc_case_resume(const rsc_case* a_case, rsc_watch watch, void* data,
                        int64_t* failed_levels) {
    return run(a_case, true, watch, data, failed_levels);
}
