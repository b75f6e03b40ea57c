#include "run/campaign_study.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include "error.hpp"
#include "file/result.hpp"
#include "run/campaign.hpp"
#include "run/campaign_manifest.hpp"
#include "run/checkpoint.hpp"
#include "run/forecast.hpp"
#include "run/screen.hpp"
#include "run/signals.hpp"
#include "run/single.hpp"

namespace rsc {
namespace fs = std::filesystem;
namespace {

Error named(const Error& error, const Member& member) {
    const std::string name = member_name(member);
    return {error.kind(), name.empty() ? error.what() : name + ": " + error.what()};
}

// Checks everything that can be checked without preparing the case (prepare). Returns whether a result is there already.
bool look_at(const Member& member, const RunOptions& options) {
    const Case& settings = member.settings;
    const bool there = check_result_path(settings, options);
    contacts_kept(settings);
    if (settings.run.realizations > 1 && fs::exists(checkpoint_name(settings.output.file)))
        Checkpoint(settings.output.file, settings, options.resume);
    return there;
}

// Makes cases ready. Reading a large map for every one of many members would take its time: each is read once.
class ReadOnce {
public:
    void operator()(const Case& settings) {
        const auto& surface = settings.surface;
        if (surface.source == Source::synthetic || files_read_.insert(surface.file).second) prepare(settings);
    }

private:
    std::set<std::string> files_read_;
};

std::vector<const Member*> wanted_of(const ReadCase& read, const std::vector<Member>& all, std::optional<int> only) {
    std::vector<const Member*> wanted;
    for (const Member& member : all)
        if (!only || member.index == *only) wanted.push_back(&member);
    if (only && (!read.study || wanted.empty()))
        throw Error(Failure::bad_input, read.study ? "--member " + std::to_string(*only) + ": the study has " + std::to_string(all.size()) +
                                                         " members (--list names them)"
                                                   : "--member: the case has no &study");
    return wanted;
}

// look_at every member, then `ready(member, whether a result is there)`; errors name the member.
template <class Ready>
void look_at_all(const ReadCase& read, const std::vector<const Member*>& wanted, const RunOptions& options, Ready ready) {
    if (read.study) check_manifest(read.settings.output.file, options.inputs);
    for (const Member* member : wanted) {
        try {
            ready(*member, look_at(*member, options));
        } catch (const Error& error) {
            throw named(error, *member);
        }
    }
}

// Its result file is there, from the same case, and nothing has changed since.
std::optional<RunSummary> finished(const Member& member) {
    const Case& settings = member.settings;
    std::error_code error;
    if (fs::exists(checkpoint_name(settings.output.file), error)) return {};
    return finished_result(settings);
}

class Run {
public:
    Run(std::size_t members, const RunOptions& options, CampaignWork& work, Team& team)
        : members_(members), options_(options), work_(work), team_(team), table_(options.quiet ? nullptr : options.table) {}

    // Members of one realization each, side by side.
    void side_by_side(const std::vector<const Member*>& members) {
        const bool terminal = ::isatty(STDERR_FILENO) != 0;
        const bool show = options_.progress == Progress::always || (options_.progress == Progress::automatic && terminal);
        ProgressLine line(show ? options_.messages : nullptr, terminal, "members");
        std::size_t next = 0, done = 0;
        team_.run(
            [&]() -> std::optional<Task> {
                if (next == members.size()) return {};
                return Task{members[next++]->index - 1, 0};
            },
            [&](const Task& task, std::string&& answer) {
                const RunSummary summary = summary_from_bytes(answer);
                const auto at = [&](const Member* m) { return m->index - 1 == task.member; };
                line.wipe();
                tell(**std::find_if(members.begin(), members.end(), at), summary);
                add(summary);
                line.show(static_cast<double>(++done), static_cast<double>(members.size()));
            },
            0);
    }

    // One by itself: with its own table, and all workers for a campaign.
    void alone(const Member& member) {
        try {
            if (table_ && members_ > 1) *table_ << member_name(member) << '\n';
            const bool campaign = member.settings.run.realizations > 1;
            add(campaign ? run_campaign(member.settings, options_, team_, member.index - 1, work_.job(member.index - 1))
                         : run_realization(member.settings, options_));
            if (table_ && members_ > 1) *table_ << '\n' << std::flush;
        } catch (const Error& error) {
            throw named(error, member);
        }
    }

    void already(const Member& member, const RunSummary& summary) {
        if (options_.messages)
            *options_.messages << "rsc: " << (member.values.empty() ? "" : member_name(member) + ": ") << "'" << member.settings.output.file
                               << "' is there and whole: nothing to do\n";
        add(summary);
    }

    std::size_t finished() const { return finished_; }
    const RunSummary& sum() const { return sum_; }

private:
    void add(const RunSummary& summary) {
        sum_.levels += summary.levels;
        sum_.failed += summary.failed;
        ++finished_;
    }

    void tell(const Member& member, const RunSummary& summary) {
        if (table_) {
            char line[200];
            const auto& run = member.settings.run;
            std::snprintf(line, sizeof line, ": N = %.8g %s, A = %.8g %s2 at Z0 = %.6g %s; ", summary.force, run.force_unit.c_str(),
                          summary.area, run.length_unit.c_str(), summary.separation, run.length_unit.c_str());
            *table_ << member_name(member) << line << member.settings.output.file << std::endl;
        }
        if (summary.failed > 0 && options_.messages) *options_.messages << "rsc: " << member_name(member) << ":\n";
        tell_failed(options_, summary);
    }

    std::size_t members_;
    const RunOptions& options_;
    CampaignWork& work_;
    Team& team_;
    std::ostream* table_;
    RunSummary sum_;
    std::size_t finished_ = 0;
};

}  // namespace

std::vector<Member> members_of(const ReadCase& read) {
    if (read.study) return expand_study(read.settings, *read.study);
    return {Member{1, {}, read.settings}};
}

CampaignWork make_work(const std::vector<Member>& members, const RunOptions& options, std::size_t threads) {
    std::vector<Case> cases;
    for (const Member& member : members) {
        cases.push_back(member.settings);
        cases.back().run.threads = static_cast<int>(std::max<std::size_t>(1, threads / std::min(threads, members.size())));
    }
    return {std::move(cases), options};
}

double check_members(const ReadCase& read, std::optional<int> only, const RunOptions& options, std::size_t threads) {
    const std::vector<Member> all = members_of(read);
    const std::vector<const Member*> wanted = wanted_of(read, all, only);
    constexpr std::size_t samples = 20;  // members whose time is worked out; the others are taken to be like them
    double seconds = 0;
    std::size_t timed = 0;
    ReadOnce prepare_once;
    look_at_all(read, wanted, options, [&](const Member& member, bool) {
        const bool campaign = member.settings.run.realizations > 1;
        if (timed == samples) return prepare_once(member.settings);
        ++timed;
        // Members of one realization run side by side.
        const double side_by_side = campaign || wanted.size() == 1 ? 1.0 : static_cast<double>(std::min(threads, wanted.size()));
        seconds += expected_seconds(prepare(member.settings), static_cast<double>(threads)) / side_by_side;
    });
    return seconds * static_cast<double>(wanted.size()) / static_cast<double>(timed);
}

RunSummary run_members(const ReadCase& read, std::optional<int> only, const RunOptions& options, CampaignWork& work, Team& team) {
    const std::vector<Member> all = members_of(read);
    const std::vector<const Member*> wanted = wanted_of(read, all, only);
    ReadOnce prepare_once;
    std::set<const Member*> there;  // those with a result already
    look_at_all(read, wanted, options, [&](const Member& member, bool result_there) {
        if (result_there) there.insert(&member);
        // A single case is made ready next in any case.
        if (!member.values.empty()) prepare_once(member.settings);
    });
    if (read.study) write_manifest(read, all, options.command);

    Run run(wanted.size(), options, work, team);
    try {
        std::vector<const Member*> left;
        for (const Member* member : wanted) {
            const std::optional<RunSummary> done = options.resume ? finished(*member) : std::nullopt;
            if (done)
                run.already(*member, *done);
            else
                left.push_back(member);
        }
        const auto replaced = std::count_if(left.begin(), left.end(), [&](const Member* m) { return there.contains(m); });
        if (read.study && replaced > 0 && options.messages)
            *options.messages << "rsc: the results of " << replaced << " of the members are there already and will be replaced\n";
        const auto is_campaign = [](const Member* m) { return m->settings.run.realizations > 1; };
        for (auto from = left.begin(); from != left.end();) {
            leave_if_interrupted();
            const auto to = wanted.size() > 1 ? std::find_if(from, left.end(), is_campaign) : from;
            if (to == from)
                run.alone(**from++);
            else
                run.side_by_side({from, to});
            from = std::max(from, to);
        }
    } catch (const Interrupted& stop) {
        if (wanted.size() == 1) throw;
        throw Interrupted(stop.signal(), std::string(stop.what()) + "; " + std::to_string(run.finished()) + " of " +
                                             std::to_string(wanted.size()) +
                                             " members are finished; the same command with --resume leaves them alone");
    }
    if (read.study && !options.quiet && options.table)
        *options.table << wanted.size() << " of " << all.size() << " members; the manifest: " << manifest_file(read.settings.output.file)
                       << std::endl;
    return run.sum();
}

}  // namespace rsc
