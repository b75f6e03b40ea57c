#include "run/study.hpp"

#include <unistd.h>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "base/version.h"
#include "case/registry.hpp"
#include "case/units.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_writer.hpp"
#include "io/result.hpp"
#include "io/whole_file.hpp"
#include "run/checkpoint.hpp"
#include "run/memory.hpp"
#include "run/screen.hpp"
#include "run/signals.hpp"
#include "trust/doubts.hpp"

namespace rsc {
namespace fs = std::filesystem;
namespace {

// "solids%R(2)" -> "solids_R_2".
std::string variable_name(const std::string& axis) {
    std::string name;
    for (char c : axis)
        if (c != ')') name += c == '%' || c == '(' ? '_' : c;
    return name;
}

// The registry's units in the syntax of UDUNITS; sigma and the unit of the levels have none.
std::string units_of(const Key& key, const Case& settings) {
    const std::string unit = key.unit, &l = settings.run.length_unit, &f = settings.run.force_unit;
    if (unit == "length") return unit_of(l, 1);
    if (unit == "time") return settings.run.time_unit;
    if (unit == "force/length^2") return unit_of(l, -2, f, 1);
    return unit == "1" ? "1" : "";
}

// None if the members have different ones.
std::string units_of(const Key& key, const std::vector<Member>& members) {
    const std::string first = units_of(key, members.front().settings);
    for (const Member& member : members)
        if (units_of(key, member.settings) != first) return "";
    return first;
}

// The path of the file relative to the folder of the manifest.
std::string relative_name(const std::string& file, const std::string& manifest) {
    const fs::path folder = fs::path(manifest).parent_path();
    const fs::path relative =
        fs::path(file).lexically_relative(folder.empty() ? fs::path(".") : folder);
    return relative.empty() ? file : relative.string();
}

std::size_t longest(const std::vector<std::string>& texts) {
    std::size_t most = 1;
    for (const std::string& text : texts) most = std::max(most, text.size());
    return most;
}

void add_axis(NetcdfFile& file, const std::string& axis, const std::vector<Member>& members,
              std::size_t number) {
    const Key& key = key_of(axis.substr(0, axis.find('(')));
    const std::string name = variable_name(axis);
    const NetcdfAttributes attributes{{"key", axis}};
    if (key.type == Type::real || key.type == Type::integer) {
        std::vector<double> values;
        for (const Member& member : members)
            if (const std::string text = get_key(member.settings, axis);
                !text.empty() && text.find("Inf") == std::string::npos)
                values.push_back(std::stod(text));
        const bool finite = values.size() == members.size();
        if (finite && key.type == Type::integer)
            return file.variable({name,
                                  {"member"},
                                  "1",
                                  key.meaning,
                                  std::vector<std::int32_t>(values.begin(), values.end()),
                                  attributes,
                                  false});
        if (finite)
            return file.variable(
                {name, {"member"}, units_of(key, members), key.meaning, values, attributes, false});
    }
    std::vector<std::string> values;
    for (const Member& member : members) values.push_back(member.values[number].second);
    const std::string length = name + "_length";
    file.dimension(length, longest(values));
    file.variable({name, {"member", length}, "", key.meaning, values, attributes, false});
}

const FileKind kManifest{"manifest", kResultFile.is_one};

// "output/rsc.nc" -> "output/rsc_manifest.nc".
std::string manifest_file(const std::string& output_file) {
    const fs::path path(output_file);
    fs::path name = path.stem();
    name += "_manifest.nc";
    return (path.parent_path() / name).string();
}

}  // namespace

void write_manifest(const ReadCase& read, const std::vector<Member>& members,
                    const std::string& command) {
    const std::string path = manifest_file(read.settings.output.file);
    const Case base = without_idle_keys(read.settings);
    NetcdfFile file;
    file.attribute("Conventions", "CF-1.10");
    file.attribute("title", read.settings.run.title.empty()
                                ? "Manifest of a study"
                                : read.settings.run.title + ": manifest of the study");
    file.attribute("source", "rsc " RSC_VERSION);
    file.attribute("history", history_text(command));
    file.attribute("comment",
                   "the result of member k is `file`(k), relative to this file; the other "
                   "variables are the keys that differ between members");
    file.attribute("case", effective_namelist(base) + effective_namelist(*read.study));
    file.dimension("member", members.size());
    std::vector<std::int32_t> numbers;
    std::vector<std::string> names;
    for (const Member& member : members) {
        numbers.push_back(member.index);
        names.push_back(relative_name(member.settings.output.file, path));
    }
    file.dimension("file_length", longest(names));
    file.variable({"member", {"member"}, "1", "number of the member", numbers, {}, false});
    file.variable(
        {"file", {"member", "file_length"}, "", "result file of the member", names, {}, false});
    for (const auto k : indices(members.front().values))
        add_axis(file, members.front().values[k].first, members, k);
    file.write(path, read.settings.output.format, read.settings.output.compression);
}

// "member 3 (surface%sigma=0.001)"; empty for a case that is no member of a study.
static std::string member_name(const Member& member) {
    return member.values.empty() ? ""
                                 : joined("member ", member.index, " (", values_text(member), ")");
}

std::string list_members(const std::vector<Member>& members) {
    std::string text;
    for (const Member& member : members)
        text += joined(member.index, "  ", member.settings.output.file, "  ", values_text(member),
                       "\n");
    return text;
}

namespace {

Error named(const Error& error, const Member& member) {
    const std::string name = member_name(member);
    return {error.kind(), name.empty() ? error.what() : name + ": " + error.what()};
}

// Checks everything that can be checked without preparing the case (prepare). Returns true if a
// result exists already.
bool look_at(const Member& member, const RunOptions& options,
             const std::vector<std::string>& inputs) {
    const Case& settings = member.settings;
    (void)input_files(settings);  // refuses a pattern without files
    const bool there = check_output(settings.output.file, inputs);
    contacts_kept(settings);
    if (settings.run.realizations > 1 && fs::exists(checkpoint_name(settings.output.file)))
        Checkpoint(settings.output.file, settings, options.resume);
    return there;
}

// Prepares a case, unless its maps were read for other members.
void prepare_once(const Case& settings, std::set<std::vector<std::string>>& files_read) {
    const std::vector<std::string> files = input_files(settings);
    if (settings.surface.source == Source::synthetic || files_read.insert(files).second)
        prepare(settings);
}

std::vector<std::string> inputs_of(const std::vector<Member>& members, const RunOptions& options) {
    std::set<std::string> names(options.inputs.begin(), options.inputs.end());
    for (const Member& member : members) {
        try {
            for (std::string& file : input_files(member.settings)) names.insert(std::move(file));
        } catch (const Error&) {  // a pattern without files: told when that member is looked at
        }
    }
    return {names.begin(), names.end()};
}

// Throws Error(bad_input) if the manifest must not be written.
void check_manifest(const std::string& output_file, const std::vector<std::string>& inputs) {
    const std::string path = manifest_file(output_file);
    std::string why = reason_to_leave(path, kManifest);
    std::error_code error;
    for (const std::string& input : inputs)
        if (fs::equivalent(input, path, error)) why = "this is an input of the run";
    if (!why.empty())
        bad_input("the manifest of the study, '", path, "': ", why,
                  " (give &output file another name)");
}

std::vector<const Member*> requested_of(const ReadCase& read, const std::vector<Member>& all,
                                        std::optional<int> only) {
    std::vector<const Member*> requested;
    for (const Member& member : all)
        if (!only || member.index == *only) requested.push_back(&member);
    if (only && (!read.study || requested.empty()))
        bad_input("--member", read.study ? joined(" ", *only, ": the study has ", all.size(),
                                                  " members (--list names them)")
                                         : ": the case has no &study");
    return requested;
}

// Calls look_at and then `ready(member, true if a result exists)` for every requested member;
// errors name the member. No result may replace an input of any of `all`.
template <class Ready>
void look_at_all(const ReadCase& read, const std::vector<Member>& all,
                 const std::vector<const Member*>& requested, const RunOptions& options,
                 Ready ready) {
    const std::vector<std::string> inputs = inputs_of(all, options);
    if (read.study) check_manifest(read.settings.output.file, inputs);
    for (const Member* member : requested) {
        try {
            ready(*member, look_at(*member, options, inputs));
        } catch (const Error& error) {
            throw named(error, *member);
        }
    }
}

// " +- 3 %", of an expected relative error; "" if none is stated.
std::string with_error(double relative) { return relative > 0 ? " +- " + percent(relative) : ""; }

// What a case asked for at its last level: N, A and Z0, and the quantities of its physics; those
// that have changed since the first level as "first to last". Each ends with "; ".
std::string answers_of(const Case& settings, const RunSummary& summary) {
    const Case::Run& run = settings.run;
    const auto &l = run.length_unit, &f = run.force_unit;
    const LevelValues& last = summary.last;
    std::string text =
        format("N = %.6g %s%s, A = %.6g %s2%s at Z0 = %.6g %s", last.force, f.c_str(),
               with_error(last.force_error_expected).c_str(), last.area, l.c_str(),
               with_error(last.area_error_expected).c_str(), last.separation, l.c_str());
    if (const double error = last.separation_error_expected; error > 0)
        text += format(" +- %.2g %s", error, l.c_str());
    text += "; ";
    for (const LevelQuantity& q : level_quantities()) {
        const double value = q.of(last), first = q.of(summary.first);
        if (std::isnan(value) || !(q.answers || q.least)) continue;
        const std::string unit = q.unit_in(l, f, run.time_unit);
        if (q.least)
            text += format("pull-off %.4g", -value);
        else
            text += q.plain + (first != 0 && first != value && !std::isnan(first)
                                   ? format(" %.4g to %.4g", first, value)
                                   : format(" %.4g", value));
        text += (unit == "1" ? "" : " " + unit) +
                with_error(q.least ? summary.least_force_error : q.error(last)) + "; ";
    }
    if (summary.doubtful > 0)
        text += format("%ld of %ld levels in doubt: ", summary.doubtful, summary.levels) +
                words_of_doubts(summary.doubts) + "; ";
    return text;
}

// The summary of a result file that is complete, from the same case, and whose inputs have not
// changed.
std::optional<RunSummary> finished(const Member& member) {
    const Case& settings = member.settings;
    std::error_code error;
    if (fs::exists(checkpoint_name(settings.output.file), error)) return {};
    return finished_result(settings);
}

class Run {
public:
    Run(std::size_t members, const RunOptions& options, CampaignWork& work, Team& team)
        : members_(members), options_(options), work_(work), team_(team), table_(options.table) {}

    // Runs members of one realization each in parallel.
    void side_by_side(const std::vector<const Member*>& members) {
        ProgressLine line(options_, "members");
        std::size_t next = 0, done = 0;
        team_.run(
            [&]() -> std::optional<Task> {
                if (next == members.size()) return {};
                return Task{members[next++]->index - 1, 0};
            },
            [&](const Task& task, std::string&& answer) {
                const RunSummary summary = from_bytes<RunSummary>(answer);
                const auto at = [&](const Member* m) { return m->index - 1 == task.member; };
                line.wipe();
                tell(**std::ranges::find_if(members, at), summary);
                add(summary);
                line.show(double(++done), double(members.size()));
            },
            0);
    }

    // Runs a single member, with all workers for a campaign, and with its own table unless the
    // table of a study goes to a pipe or file, which has a line for each member.
    void alone(const Member& member) {
        const bool line = members_ > 1 && isatty(STDOUT_FILENO) == 0;
        RunOptions options = options_;
        if (line) options.table = nullptr;
        try {
            if (table_ && members_ > 1 && !line) *table_ << member_name(member) << '\n';
            const bool campaign = member.settings.run.realizations > 1;
            const RunSummary summary =
                campaign ? run_campaign(member.settings, options, team_, member.index - 1,
                                        work_.job(member.index - 1))
                         : run_realization(member.settings, options);
            if (line) tell(member, summary);
            add(summary);
            if (table_ && members_ > 1 && !line) *table_ << '\n' << std::flush;
        } catch (const Error& error) {
            throw named(error, member);
        }
    }

    void already(const Member& member, const RunSummary& summary) {
        if (options_.messages)
            *options_.messages << "rsc: "
                               << (member.values.empty() ? "" : member_name(member) + ": ") << "'"
                               << member.settings.output.file << "' is complete: nothing to do\n";
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
        if (table_)
            *table_ << member_name(member) << ": " << answers_of(member.settings, summary)
                    << member.settings.output.file << std::endl;
        if (summary.failed > 0 && options_.messages)
            *options_.messages << "rsc: " << member_name(member) << ":\n";
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

CampaignWork make_work(const std::vector<Member>& members, const RunOptions& options,
                       std::size_t threads) {
    std::vector<Case> cases;
    for (const Member& member : members) {
        cases.push_back(member.settings);
        cases.back().run.threads =
            int(std::max<std::size_t>(1, threads / std::min(threads, members.size())));
    }
    return {std::move(cases), options};
}

CheckedSize check_members(const ReadCase& read, std::optional<int> only, const RunOptions& options,
                          std::size_t threads) {
    const std::vector<Member> all = members_of(read);
    const std::vector<const Member*> requested = requested_of(read, all, only);
    // members whose memory is estimated; the others are assumed similar
    constexpr std::size_t samples = 20;
    CheckedSize size;
    double most = -1;  // unknowns
    std::size_t estimated = 0;
    std::set<std::vector<std::string>> files_read;
    look_at_all(read, all, requested, options, [&](const Member& member, bool) {
        const bool campaign = member.settings.run.realizations > 1;
        if (estimated == samples) return prepare_once(member.settings, files_read);
        ++estimated;
        // Members of one realization run in parallel.
        const double side_by_side =
            campaign || requested.size() == 1 ? 1.0 : double(std::min(threads, requested.size()));
        const double workers = double(threads);
        const Job job = prepare(member.settings);
        size.megabytes = std::max(size.megabytes, expected_megabytes(job, workers) * side_by_side);
        const Unknowns unknowns = expected_unknowns(job);
        if (unknowns.number > most) size.unknowns = unknowns.text;
        most = std::max(most, unknowns.number);
    });
    return size;
}

RunSummary run_members(const ReadCase& read, std::optional<int> only, const RunOptions& options,
                       CampaignWork& work, Team& team) {
    const std::vector<Member> all = members_of(read);
    const std::vector<const Member*> requested = requested_of(read, all, only);
    std::set<std::vector<std::string>> files_read;
    std::set<const Member*> there;  // members with an existing result
    look_at_all(read, all, requested, options, [&](const Member& member, bool result_there) {
        if (result_there) there.insert(&member);
        // A single case is prepared later anyway.
        if (!member.values.empty()) prepare_once(member.settings, files_read);
    });
    if (read.study) write_manifest(read, all, options.command);

    Run run(requested.size(), options, work, team);
    try {
        std::vector<const Member*> left;
        for (const Member* member : requested) {
            const std::optional<RunSummary> done =
                options.resume ? finished(*member) : std::nullopt;
            if (done)
                run.already(*member, *done);
            else
                left.push_back(member);
        }
        const auto replaced =
            std::ranges::count_if(left, [&](const Member* m) { return there.contains(m); });
        if (read.study && replaced > 0 && options.messages)
            *options.messages << "rsc: the results of " << replaced
                              << " of the members exist already and will be replaced\n";
        const auto is_campaign = [](const Member* m) { return m->settings.run.realizations > 1; };
        for (auto from = left.begin(); from != left.end();) {
            leave_if_interrupted();
            const auto to =
                requested.size() > 1 ? std::find_if(from, left.end(), is_campaign) : from;
            if (to == from)
                run.alone(**from++);
            else
                run.side_by_side({from, to});
            from = std::max(from, to);
        }
    } catch (const Interrupted& stop) {
        if (requested.size() == 1) throw;
        throw Interrupted(stop.signal(), stop.what(), "; ", run.finished(), " of ",
                          requested.size(),
                          " members are finished; the same command with --resume keeps them");
    }
    if (read.study && options.table)
        *options.table << requested.size() << " of " << all.size()
                       << " members; the manifest: " << manifest_file(read.settings.output.file)
                       << std::endl;
    return run.sum();
}

}  // namespace rsc
