#include "run/campaign_merge.hpp"

#include <algorithm>
#include <chrono>

#include "case/read_case.hpp"
#include "error.hpp"
#include "file/netcdf_writer.hpp"
#include "file/output_path.hpp"
#include "file/result_sums.hpp"
#include "run/campaign_screen.hpp"
#include "run/campaign_sums.hpp"
#include "run/checkpoint.hpp"
#include "run/signals.hpp"

namespace rsc {
namespace {

[[noreturn]] void refuse(const std::string& text) { throw Error(Failure::bad_input, "--merge: " + text); }

struct Part {
    std::string file;
    Case settings;
    std::int64_t first() const { return settings.run.first_realization; }
    std::int64_t last() const { return first() + settings.run.realizations - 1; }
};

std::string numbers(std::int64_t from, std::int64_t to) {
    return (from == to ? "realization " : "realizations ") + std::to_string(from) + (from == to ? "" : " to " + std::to_string(to));
}

Part open_part(const std::string& file) {
    const std::optional<ResultHead> head = head_of_result(file);
    if (!head) refuse("'" + file + "' is no result of rsc");
    const ReadCase read = read_case_text(head->case_text, file);
    if (read.study) refuse("'" + file + "' is the manifest of a study, not the result of a campaign");
    if (!head->this_version()) refuse("'" + file + "' is of another version (" + head->source.substr(0, head->source.find(',')) + ")");
    if (read.settings.run.realizations == 1) refuse("'" + file + "' holds a single realization, not a campaign");
    return {file, read.settings};
}

void require_same_case(const Part& first, Part other) {
    other.settings.run.first_realization = first.settings.run.first_realization;
    other.settings.run.realizations = first.settings.run.realizations;
    std::string changed;
    for (const std::string& line :
         Checkpoint::differences(first.settings, other.settings, "in '" + first.file + "'", "in '" + other.file + "'"))
        changed += "\n  " + line;
    if (!changed.empty()) refuse("'" + other.file + "' is of another case than '" + first.file + "':" + changed);
}

void require_adjacent(const Part& before, const Part& after) {
    if (after.first() <= before.last())
        refuse(numbers(after.first(), std::min(before.last(), after.last())) + " are in '" + before.file + "' and in '" + after.file + "'");
    if (after.first() > before.last() + 1)
        refuse(numbers(before.last() + 1, after.first() - 1) + " of the campaign are in none of the files");
}

}  // namespace

RunSummary merge_campaigns(const std::vector<std::string>& files, const std::string& output, const RunOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<Part> parts;
    for (const std::string& file : files) parts.push_back(open_part(file));
    for (const Part& part : parts) require_same_case(parts.front(), part);
    std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.first() < b.first(); });
    for (std::size_t k = 1; k < parts.size(); ++k) require_adjacent(parts[k - 1], parts[k]);
    const bool replaces = check_output(output, files);

    Case whole = parts.front().settings;
    whole.output.file = output;
    whole.run.realizations = static_cast<int>(parts.back().last() - parts.front().first() + 1);
    const Job job = prepare(whole);
    Accumulators sums = read_sums(parts.front().file, job.observe, job.levels.size());
    for (std::size_t k = 1; k < parts.size(); ++k) {
        const Accumulators more = read_sums(parts[k].file, job.observe, job.levels.size());
        if (whole.indentation.control == Control::separation && more.rows.front().separation != sums.rows.front().separation)
            refuse("the levels of '" + parts[k].file + "' are others than those of '" + parts.front().file + "'");
        sums.append(more);
    }
    std::ostream* const table = options.quiet ? nullptr : options.table;
    const Result result = campaign_result(job, sums, table);
    if (const int signal = caught_signal())
        throw Interrupted(signal, std::string("stopped by ") + signal_name(signal) + "; nothing is written");
    write_result(result, output, {whole.output.format, whole.output.compression, options.command});
    const RunSummary summary = campaign_summary(result);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (table) print_campaign_summary(*table, job, result.observations, seconds, output, replaces);
    tell_failed(options, summary);
    return summary;
}

}  // namespace rsc
