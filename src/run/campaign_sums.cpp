#include "run/campaign_sums.hpp"

#include <filesystem>

#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "error.hpp"
#include "file/output_path.hpp"
#include "file/result_sums.hpp"
#include "read/file_list.hpp"
#include "run/checkpoint.hpp"
#include "run/compare.hpp"
#include "run/run_options.hpp"
#include "run/signals.hpp"

namespace rsc {
namespace fs = std::filesystem;

bool input_is_newer(const Case& settings) {
    if (settings.surface.source == Source::synthetic) return false;
    std::error_code error;
    const fs::file_time_type written = fs::last_write_time(settings.output.file, error);
    for (const std::string& input : matching_files(settings.surface.file))
        if (!(fs::last_write_time(input, error) < written)) return true;
    return false;
}

std::optional<Accumulators> earlier_sums(const Job& job, std::ostream* messages) {
    const std::string& file = job.settings.output.file;
    std::string why;
    try {
        const std::optional<ResultHead> head = head_of_result(file);
        if (!head) return {};
        const Reading there = read_namelist(head->case_text);
        if (there.study) throw Error(Failure::bad_input, "it is no campaign");
        if (!head->this_version() || !there.faults.empty()) throw Error(Failure::bad_input, "it is of another version of rsc");
        if (input_is_newer(job.settings)) throw Error(Failure::bad_input, "an input has changed since");
        for (const std::string& line : Checkpoint::differences(there.settings, without_idle_keys(job.settings)))
            why += (why.empty() ? "" : "; ") + line;
        if (why.empty()) return read_sums(file, job.observe, job.levels.size());
    } catch (const Error& error) {
        why = error.what();
    }
    if (messages)
        *messages << "rsc: '" << file << "' is not the first part of this campaign (" << why
                  << "): all realizations are computed, and it is replaced\n";
    return {};
}

Result campaign_result(const Job& job, const Accumulators& sums, std::ostream* table) {
    const Case& settings = job.settings;
    Observations observations = sums.finish();
    const std::vector<LevelValues> first(observations.rows.begin(),
                                         observations.rows.begin() + static_cast<std::ptrdiff_t>(observations.steps));
    ComparedLevels compared;
    if (compares(job, false))
        compared = compare_levels(job, settings.run.first_realization, 1, first, table, [] { return caught_signal() != 0; });
    Result result = make_result(settings, case_text(settings), job.indenter, job.sigma, job.theory, std::move(observations));
    result.compared = std::move(compared);
    return result;
}

}  // namespace rsc
