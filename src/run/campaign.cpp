#include "run/run.hpp"

#include "base/error.hpp"
#include "base/reason.hpp"
#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "io/inputs.hpp"
#include "io/netcdf_writer.hpp"
#include "io/whole_file.hpp"
#include "run/checkpoint.hpp"
#include "run/compare.hpp"
#include "run/screen.hpp"
#include "run/signals.hpp"
#include "run/team.hpp"

namespace rsc {
namespace fs = std::filesystem;
namespace {

const char* const kGoesOn = "to continue, run the same command with --resume";

// The finished realizations of a campaign: those in the sums, and those that wait for an earlier
// one.
class Progressing {
public:
    // `earlier`: the sums of a finished campaign that this one continues, if the checkpoint has
    // none.
    Progressing(const Job& job, Checkpoint& checkpoint, std::size_t workers,
                const std::function<std::optional<Accumulators>()>& earlier)
        : first_(job.settings.run.first_realization),
          count_(job.settings.run.realizations),
          window_(std::int64_t(4 * workers + 32)),
          sums_(job.observe, job.levels.size()),
          checkpoint_(checkpoint) {
        Checkpoint::Contents contents = checkpoint.take_contents();
        if (contents.sums) {
            sums_from_bytes(*contents.sums, sums_);
        } else if (std::optional<Accumulators> found = earlier()) {
            sums_ = std::move(*found);
            std::vector<const std::string*> rest;
            for (const std::string& record : contents.records) rest.push_back(&record);
            checkpoint.rewrite(to_bytes(sums_), rest);  // the result file is not needed any more
        }
        for (std::string& record : contents.records) take(std::move(record));
        add_in_order();
        next_ = next_to_add();
    }

    // The next realization to start. None starts far ahead of a slow one, because finished ones
    // that wait for it are held in memory.
    std::optional<std::int64_t> next() {
        while (waiting_.contains(next_)) ++next_;
        if (next_ >= first_ + count_ || next_ >= next_to_add() + window_) return {};
        return next_++;
    }

    void collect(std::string record) {
        checkpoint_.append(record);
        take(std::move(record));
        add_in_order();
        if (!checkpoint_.wants_rewrite()) return;
        std::vector<const std::string*> rest;
        for (const auto& [number, bytes] : waiting_) rest.push_back(&bytes);
        checkpoint_.rewrite(to_bytes(sums_), rest);
    }

    const Accumulators& sums() const { return sums_; }
    std::size_t added() const { return sums_.realization.size(); }
    std::size_t finished() const { return added() + waiting_.size(); }

private:
    std::int64_t next_to_add() const { return first_ + std::int64_t(added()); }
    void take(std::string record) {
        const std::int64_t number = realization_of(record);
        if (number >= next_to_add() && number < first_ + count_)
            waiting_.emplace(number, std::move(record));
    }
    void add_in_order() {
        for (auto found = waiting_.find(next_to_add()); found != waiting_.end();
             found = waiting_.find(next_to_add())) {
            sums_.add(record_from_bytes(found->second));
            waiting_.erase(found);
        }
    }

    std::int64_t first_, count_, window_, next_ = 0;
    Accumulators sums_;
    std::map<std::int64_t, std::string> waiting_;
    Checkpoint& checkpoint_;
};

// True if an input file is not older than the result.
bool input_is_newer(const Case& settings) {
    std::error_code error;
    const fs::file_time_type written = fs::last_write_time(settings.output.file, error);
    for (const std::string& input : input_files(settings))
        if (!(fs::last_write_time(input, error) < written)) return true;
    return false;
}

// The sums in the result file of the case, if it contains the first realizations of the same
// campaign and no others. Otherwise the reason is written to `messages`, because that result will
// be replaced.
std::optional<Accumulators> earlier_sums(const Job& job, std::ostream* messages) {
    const std::string& file = job.settings.output.file;
    std::string why;
    try {
        const std::optional<ResultHead> head = head_of_result(file);
        if (!head) return {};
        const Reading there = read_namelist(head->case_text);
        if (there.study) bad_input("it is not the result of a campaign");
        if (!head->this_version() || !there.faults.empty())
            bad_input("it was written by another version of rsc");
        if (input_is_newer(job.settings)) bad_input("an input has changed since");
        for (const std::string& line :
             Checkpoint::differences(there.settings, without_idle_keys(job.settings)))
            enlist(why, "; ", line);
        if (why.empty()) return read_sums(file, job.observe, job.levels.size());
    } catch (const Error& error) {
        why = error.what();
    }
    if (messages)
        *messages << "rsc: '" << file << "' is not the first part of this campaign (" << why
                  << "): all realizations are computed, and the file is replaced\n";
    return {};
}

// The contents of a campaign's result file. Levels of &compare are solved by elements here and
// reported on `table`. If a signal is caught meanwhile, the result is incomplete.
Result campaign_result(const Job& job, const Accumulators& sums, std::ostream* table) {
    const Case& settings = job.settings;
    Observations observations = sums.finish();
    const std::vector<LevelValues> first(
        observations.rows.begin(), observations.rows.begin() + std::ptrdiff_t(observations.steps));
    ComparedLevels compared;
    if (compares(job, false))
        compared = compare_levels(job, settings.run.first_realization, 1, first, table,
                                  [] { return caught_signal() != 0; });
    Result result = make_result(settings, case_text(settings), job.indenter, job.sigma, job.theory,
                                std::move(observations));
    result.compared = std::move(compared);
    return result;
}

std::string how_far(const Progressing& state, const Case& settings) {
    return joined(state.finished(), " of ", settings.run.realizations,
                  " realizations are finished and saved in '",
                  checkpoint_name(settings.output.file), "'");
}

// Runs the realizations that are not finished, and calls tell_batch() after each twentieth of all.
void run_remaining(Team& team, std::int32_t member, Progressing& state, std::size_t total,
                   ProgressLine& line, const std::function<void()>& tell_batch) {
    const std::size_t batch = std::max<std::size_t>(1, total / 20);
    team.run(
        [&]() -> std::optional<Task> {
            const std::optional<std::int64_t> number = state.next();
            return number ? std::optional<Task>({member, *number}) : std::nullopt;
        },
        [&](const Task&, std::string&& record) {
            const std::size_t before = state.added();
            state.collect(std::move(record));
            if (state.added() / batch > before / batch) tell_batch();
            line.show(double(state.finished()), double(total));
        },
        1);
}

}  // namespace

RunSummary run_campaign(const Case& settings, const RunOptions& options, Team& team,
                        std::int32_t member, std::shared_ptr<const Job> job) {
    const auto start = std::chrono::steady_clock::now();
    const std::string& file = settings.output.file;
    const bool replaces = check_result_path(settings, options);
    contacts_kept(settings);
    std::error_code ignored;
    if (const fs::path folder = fs::path(file).parent_path(); !folder.empty())
        fs::create_directories(folder, ignored);

    Checkpoint checkpoint(file, settings, options.resume);
    Progressing state(*job, checkpoint, team.workers(), [&]() -> std::optional<Accumulators> {
        return options.resume && replaces ? earlier_sums(*job, options.messages) : std::nullopt;
    });
    const std::size_t already = state.finished();
    const auto total = at(settings.run.realizations);

    std::ostream* const table = options.table;
    if (table) print_campaign_heading(*table, *job, team.workers(), already);
    if (options.report)
        team.meanwhile = [&] {
            if (options.report(double(state.finished()), double(total)))
                throw Interrupted(0, "stopped");
        };
    try {
        ProgressLine line(options, "realizations", double(already));
        run_remaining(team, member, state, total, line, [&] {
            if (!table) return;
            line.wipe();
            print_batch(*table, *job, state.sums(), seconds_since(start),
                        state.finished() - already);
        });
    } catch (const Interrupted& stop) {
        throw Interrupted(stop.signal(), stop.what(), "; ", how_far(state, settings), ": ",
                          kGoesOn);
    } catch (const Error& error) {
        throw Error(error.kind() == Failure::bad_input ? Failure::internal : error.kind(),
                    error.what(), "\n", how_far(state, settings), ": ", kGoesOn);
    }

    if (state.added() != total)
        throw Error(Failure::internal, "a campaign ended with ", how_far(state, settings));
    const Result result = campaign_result(*job, state.sums(), table);
    leave_if_interrupted("; " + how_far(state, settings) + ": " + kGoesOn);
    try {
        write_result(result, file, options.command);
    } catch (const Error& error) {
        throw Error(error.kind(), error.what(), "\n", how_far(state, settings),
                    ": run the same command with --resume to write the file "
                    "without computing them again");
    }
    checkpoint.remove();
    const RunSummary summary = summary_of(result);
    if (table)
        print_campaign_summary(*table, *job, result.observations, seconds_since(start), file,
                               replaces);
    tell_failed(options, summary);
    return summary;
}

std::optional<RunSummary> finished_result(const Case& settings) {
    const std::optional<ResultHead> head = head_of_result(settings.output.file);
    if (!head || !head->this_version() || head->case_text != case_text(settings) ||
        input_is_newer(settings))
        return {};
    const std::optional<LevelCount> count = count_levels(settings.output.file);
    if (!count) return {};
    RunSummary summary;
    summary.levels = count->levels;
    summary.failed = count->failed;
    return summary;
}

namespace {

[[noreturn]] void refuse(const auto&... text) { bad_input("--merge: ", text...); }

struct Part {
    std::string file;
    Case settings;
    std::int64_t first() const { return settings.run.first_realization; }
    std::int64_t last() const { return first() + settings.run.realizations - 1; }
};

std::string numbers(std::int64_t from, std::int64_t to) {
    return from == to ? joined("realization ", from) : joined("realizations ", from, " to ", to);
}

Part open_part(const std::string& file) {
    const std::optional<ResultHead> head = head_of_result(file);
    const std::string why = head ? "" : why_not_opened(file);
    if (!head) refuse("'", file, why.empty() ? "' is no result of rsc" : "': " + why);
    const ReadCase read = read_case_text(head->case_text, file);
    if (read.study) refuse("'", file, "' is the manifest of a study, not the result of a campaign");
    if (!head->this_version())
        refuse("'", file, "' is of another version (",
               head->source.substr(0, head->source.find(',')), ")");
    if (read.settings.run.realizations == 1)
        refuse("'", file, "' holds a single realization, not a campaign");
    return {file, read.settings};
}

void require_same_case(const Part& first, Part other) {
    other.settings.run.first_realization = first.settings.run.first_realization;
    other.settings.run.realizations = first.settings.run.realizations;
    std::string changed;
    for (const std::string& line : Checkpoint::differences(
             first.settings, other.settings, "in '" + first.file + "'", "in '" + other.file + "'"))
        changed += "\n  " + line;
    if (!changed.empty())
        refuse("'", other.file, "' is of another case than '", first.file, "':", changed);
}

void require_adjacent(const Part& before, const Part& after) {
    if (after.first() <= before.last())
        refuse(numbers(after.first(), std::min(before.last(), after.last())), " are in '",
               before.file, "' and in '", after.file, "'");
    if (after.first() > before.last() + 1)
        refuse(numbers(before.last() + 1, after.first() - 1),
               " of the campaign are missing from the files");
}

}  // namespace

RunSummary merge_campaigns(const std::vector<std::string>& files, const std::string& output,
                           const RunOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<Part> parts;
    for (const std::string& file : files) parts.push_back(open_part(file));
    for (const Part& part : parts) require_same_case(parts.front(), part);
    std::ranges::stable_sort(parts,
                             [](const Part& a, const Part& b) { return a.first() < b.first(); });
    for (std::size_t k = 1; k < parts.size(); ++k) require_adjacent(parts[k - 1], parts[k]);
    const bool replaces = check_output(output, files);

    Case whole = parts.front().settings;
    whole.output.file = output;
    whole.run.realizations = int(parts.back().last() - parts.front().first() + 1);
    const Job job = prepare(whole);
    Accumulators sums = read_sums(parts.front().file, job.observe, job.levels.size());
    for (std::size_t k = 1; k < parts.size(); ++k) {
        const Accumulators more = read_sums(parts[k].file, job.observe, job.levels.size());
        if (whole.indentation.control == Control::separation &&
            more.rows.front().separation != sums.rows.front().separation)
            refuse("the levels of '", parts[k].file, "' differ from those of '", parts.front().file,
                   "'");
        sums.append(more);
    }
    std::ostream* const table = options.table;
    const Result result = campaign_result(job, sums, table);
    leave_if_interrupted("; nothing is written");
    write_result(result, output, options.command);
    const RunSummary summary = summary_of(result);
    if (table)
        print_campaign_summary(*table, job, result.observations, seconds_since(start), output,
                               replaces);
    tell_failed(options, summary);
    return summary;
}

}  // namespace rsc
