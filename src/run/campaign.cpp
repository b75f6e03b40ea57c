#include "run/campaign.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "error.hpp"
#include "file/netcdf_writer.hpp"
#include "file/output_path.hpp"
#include "file/result_sums.hpp"
#include "run/campaign_archive.hpp"
#include "run/campaign_screen.hpp"
#include "run/campaign_sums.hpp"
#include "run/checkpoint.hpp"
#include "run/screen.hpp"
#include "run/signals.hpp"

namespace rsc {
namespace fs = std::filesystem;
namespace {

const char* const kGoesOn = "the same command with --resume goes on from there";

using Clock = std::chrono::steady_clock;

// The realizations of a campaign that are finished: those added up, and those that wait for one before them.
class Progressing {
public:
    // `earlier`: the sums of a finished campaign that this one continues, where the checkpoint has none.
    Progressing(const Job& job, Checkpoint& checkpoint, std::size_t workers, const std::function<std::optional<Accumulators>()>& earlier)
        : first_(job.settings.run.first_realization),
          count_(job.settings.run.realizations),
          window_(static_cast<std::int64_t>(4 * workers + 32)),
          sums_(job.observe, job.levels.size()),
          checkpoint_(checkpoint) {
        Checkpoint::Contents contents = checkpoint.take_contents();
        if (contents.sums) {
            sums_from_bytes(*contents.sums, sums_);
        } else if (std::optional<Accumulators> found = earlier()) {
            sums_ = std::move(*found);
            std::vector<const std::string*> rest;
            for (const std::string& record : contents.records) rest.push_back(&record);
            checkpoint.rewrite(to_bytes(sums_), rest);  // from here on the result file is not needed
        }
        for (std::string& record : contents.records) take(std::move(record));
        add_in_order();
        next_ = next_to_add();
    }

    // The next realization to begin. None is begun far ahead of one that takes long, since finished ones that wait for it are held in memory.
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
    std::int64_t next_to_add() const { return first_ + static_cast<std::int64_t>(added()); }
    void take(std::string record) {
        const std::int64_t number = realization_of(record);
        if (number >= next_to_add() && number < first_ + count_) waiting_.emplace(number, std::move(record));
    }
    void add_in_order() {
        for (auto found = waiting_.find(next_to_add()); found != waiting_.end(); found = waiting_.find(next_to_add())) {
            sums_.add(record_from_bytes(found->second));
            waiting_.erase(found);
        }
    }

    std::int64_t first_, count_, window_, next_ = 0;
    Accumulators sums_;
    std::map<std::int64_t, std::string> waiting_;
    Checkpoint& checkpoint_;
};

std::string how_far(const Progressing& state, const Case& settings) {
    return std::to_string(state.finished()) + " of " + std::to_string(settings.run.realizations) +
           " realizations are finished and kept in '" + checkpoint_name(settings.output.file) + "'";
}

}  // namespace

RunSummary run_campaign(const Case& settings, const RunOptions& options, Team& team, std::int32_t member, std::shared_ptr<const Job> job) {
    const auto start = Clock::now();
    const auto seconds = [start] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    const std::string& file = settings.output.file;
    const bool replaces = check_result_path(settings, options);
    contacts_kept(settings);
    std::error_code ignored;
    if (const fs::path folder = fs::path(file).parent_path(); !folder.empty()) fs::create_directories(folder, ignored);

    Checkpoint checkpoint(file, settings, options.resume);
    Progressing state(*job, checkpoint, team.workers(), [&]() -> std::optional<Accumulators> {
        return options.resume && replaces ? earlier_sums(*job, options.messages) : std::nullopt;
    });
    const std::size_t already = state.finished();
    const auto total = static_cast<std::size_t>(settings.run.realizations);

    std::ostream* const table = options.quiet ? nullptr : options.table;
    const bool terminal = ::isatty(STDERR_FILENO) != 0;
    const bool show = options.progress == Progress::always || (options.progress == Progress::automatic && terminal);
    if (table) print_campaign_heading(*table, *job, team.workers(), already);
    const std::size_t batch = std::max<std::size_t>(1, total / 20);
    if (options.report)
        team.meanwhile = [&] {
            if (options.report(static_cast<double>(state.finished()), static_cast<double>(total))) throw Interrupted(0, "stopped");
        };
    try {
        ProgressLine line(show ? options.messages : nullptr, terminal, "realizations", static_cast<double>(already));
        team.run(
            [&]() -> std::optional<Task> {
                const std::optional<std::int64_t> number = state.next();
                return number ? std::optional<Task>({member, *number}) : std::nullopt;
            },
            [&](const Task&, std::string&& record) {
                const std::size_t before = state.added();
                state.collect(std::move(record));
                if (table && state.added() / batch > before / batch) {
                    line.wipe();
                    print_batch(*table, *job, state.sums(), seconds(), state.finished() - already);
                }
                line.show(static_cast<double>(state.finished()), static_cast<double>(total));
            },
            1);
    } catch (const Interrupted& stop) {
        throw Interrupted(stop.signal(), std::string(stop.what()) + "; " + how_far(state, settings) + ": " + kGoesOn);
    } catch (const Error& error) {
        throw Error(error.kind() == Failure::bad_input ? Failure::internal : error.kind(),
                    std::string(error.what()) + "\n" + how_far(state, settings) + ": " + kGoesOn);
    }

    if (state.added() != total) throw Error(Failure::internal, "a campaign ended with " + how_far(state, settings));
    const Result result = campaign_result(*job, state.sums(), table);
    if (const int signal = caught_signal())
        throw Interrupted(signal, std::string("stopped by ") + signal_name(signal) + "; " + how_far(state, settings) + ": " + kGoesOn);
    try {
        write_result(result, file, {settings.output.format, settings.output.compression, options.command});
    } catch (const Error& error) {
        throw Error(error.kind(), std::string(error.what()) + "\n" + how_far(state, settings) +
                                      ": the same command with --resume writes the file without computing them again");
    }
    checkpoint.remove();
    const RunSummary summary = campaign_summary(result);
    if (table) print_campaign_summary(*table, *job, result.observations, seconds(), file, replaces);
    tell_failed(options, summary);
    return summary;
}

std::optional<RunSummary> finished_result(const Case& settings) {
    const std::optional<ResultHead> head = head_of_result(settings.output.file);
    if (!head || !head->this_version() || head->case_text != case_text(settings) || input_is_newer(settings)) return {};
    const std::optional<LevelCount> count = count_levels(settings.output.file);
    if (!count) return {};
    RunSummary summary;
    summary.levels = count->levels, summary.failed = count->failed;
    return summary;
}

}  // namespace rsc
