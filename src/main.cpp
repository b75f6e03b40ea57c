// The program: `rsc < case.nml`. It reads the case and runs it; everything else is in run/. With
// RSC_MPI it is built as rsc_mpi.

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/reason.hpp"
#include "case/options.hpp"
#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "io/whole_file.hpp"
#include "run/run.hpp"
#include "run/screen.hpp"
#include "run/signals.hpp"
#include "run/study.hpp"
#ifdef RSC_MPI
#include "run/mpi_team.hpp"
#endif

// A threaded BLAS sums in an order that depends on the number of threads, but results must not.
// Only OpenBLAS needs this switch.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace rsc {
namespace {

#ifdef RSC_MPI
using Ranks = MpiJob;
#else
struct Ranks {};  // one process
#endif

// For the attribute `history`. With SOURCE_DATE_EPOCH, for reproducible files, only the version: it
// is independent of --resume, the program and the number of threads.
std::string command_line(int argc, char** argv) {
    if (std::getenv("SOURCE_DATE_EPOCH")) return {};
    std::string text = "rsc";
    for (int i = 1; i < argc; ++i) text.append(1, ' ').append(argv[i]);
    return text;
}

std::unique_ptr<Team> make_team(Ranks& ranks, CampaignWork& work, const ReadCase& read,
                                std::size_t threads) {
#ifdef RSC_MPI
    return ranks.team(std::ref(work), threads, effective_namelist(read));
#else
    (void)ranks;
    (void)read;
    return std::make_unique<ThreadTeam>(std::ref(work), int(threads));
#endif
}

std::size_t threads_of(const Case& settings) {
#ifdef RSC_MPI
    return threads_of_rank(settings.run.threads);
#else
    return most_threads(settings.run.threads);
#endif
}

RunOptions how_to_run(const Options& options, const std::string& command) {
    RunOptions how;
    how.command = command;
    how.inputs = {options.case_path.empty() ? "/dev/stdin" : options.case_path};
    how.progress = options.progress;
    how.resume = options.resume;
    how.compare_automatically = true;
    if (!options.quiet) how.table = &std::cout;
    how.messages = &std::cerr;
    return how;
}

// Returns the exit status: 0 on success, 1 if a level did not converge.
int run(Ranks& ranks, const Options& options, const ReadCase& read, const std::string& command) {
    RunOptions how = how_to_run(options, command);
    if (read.study)
        // so that a member alone has the same result as in the study
        how.compare_automatically = false;
    const std::size_t threads = threads_of(read.settings);
    CampaignWork work = make_work(members_of(read), how, threads);
    const std::unique_ptr<Team> team = make_team(ranks, work, read, threads);
    return run_members(read, options.member, how, work, *team).failed == 0 ? 0 : 1;
}

// Without MPI every process started by mpirun would run the whole case and write the same file.
void refuse_mpi([[maybe_unused]] const Options& options) {
#ifndef RSC_MPI
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"}) {
        const char* const size = std::getenv(name);
        if (size && std::atoi(size) > 1 && !options.member)
            bad_input(
                "rsc: started ", size,
                " times by an MPI launcher, but this program is built without MPI: use rsc_mpi "
                "(cmake -DRSC_MPI=ON, or make -f Makefile.legacy rsc_mpi), or rsc --member K");
    }
#endif
}

// With MPI signals are caught already.
void catch_signals_early() {
#ifndef RSC_MPI
    catch_signals();
#endif
}

// Runs `f`. Refusals during a run that begin with a key, "surface%sigma: ...", get the name of the
// case before it.
template <class F>
auto named(const Options& options, F f) {
    try {
        return f();
    } catch (const Error& error) {
        const std::string what = error.what(), name = what.substr(0, what.find_first_of("( :="));
        const std::size_t percent = std::min(name.find('%'), name.size());
        if (!find_key(name.substr(0, percent), name.substr(std::min(percent + 1, name.size()))))
            throw;
        throw Error(error.kind(), options.case_path.empty() ? "<stdin>" : options.case_path, ": ",
                    what);
    }
}

// Prints what is asked about the program, or about a result file, without a case to run. False if
// nothing is.
bool tells(const Options& options) {
    if (options.help) {
        std::cout << usage_text();
    } else if (options.version) {
        std::cout << version_text();
    } else if (options.man) {
        std::cout << manual_page();
    } else if (options.describe) {
        std::cout << describe(options.describe_what);
    } else if (options.show_case) {
        const std::optional<ResultHead> head = head_of_result(options.case_path);
        const std::string why = head ? "" : why_not_opened(options.case_path);
        if (!head)
            bad_input(options.case_path, ": ",
                      why.empty() ? "is no result of rsc, so there is no case to print" : why);
        std::cout << head->case_text;
    } else {
        return false;
    }
    return true;
}

int run_program(int argc, char** argv, Ranks& ranks) {
    const Options options = parse_options(argc, argv);
    if (tells(options)) return 0;
    refuse_mpi(options);
    if (!options.merge.empty()) {
        catch_signals_early();
        return merge_campaigns(options.merge, *options.output,
                               how_to_run(options, command_line(argc, argv)))
                           .failed == 0
                   ? 0
                   : 1;
    }
    // A result file can also be given as a case.
    const std::optional<ResultHead> inside = head_of_result(options.case_path);
    const ReadCase read =
        inside ? read_case_text(inside->case_text, options.case_path, options) : read_case(options);
    catch_signals_early();  // not earlier, so that a signal ends the wait for standard input
    for (const std::string& warning : read.warnings) std::cerr << warning << '\n';
    if (options.list) {
        if (!read.study) bad_input("--list: the case has no &study");
        std::cout << list_members(members_of(read));
        return 0;
    }
    if (options.check) {
        const RunOptions how = how_to_run(options, command_line(argc, argv));
        const std::size_t threads = threads_of(read.settings);
        const CheckedSize size =
            named(options, [&] { return check_members(read, options.member, how, threads); });
        std::cout << effective_namelist(read);
        if (!options.quiet)
            std::cerr << "rsc: the inputs can be read and the result can be written"
                      << (size.megabytes > 0
                              ? format("; about %.0f MB of memory with %zu thread%s",
                                       size.megabytes, threads, threads == 1 ? "" : "s")
                              : "")
                      << '\n'
                      << (read.study ? "rsc: largest member by " : "rsc: by ") << size.unknowns
                      << '\n';
        return 0;
    }
    return named(options, [&] { return run(ranks, options, read, command_line(argc, argv)); });
}

// Converts every failure into a message and an exit status.
int guarded(const std::function<int()>& program) {
    try {
        const int status = program();
        if (std::cout.flush()) return status;
        // The failure may be an old one, so that errno tells of something else by now.
        errno = ::write(STDOUT_FILENO, "\n", 1) == 1 ? 0 : errno;
        std::cerr << "rsc: standard output could not be written"
                  << (errno != 0 ? ": " + std::generic_category().message(errno) : "") << '\n';
        return 1;
    } catch (const Interrupted& stop) {
        std::cerr << "rsc: " << stop.what() << '\n';
        return 128 + stop.signal();
    } catch (const Error& error) {
        // Text from files may contain control characters of terminals.
        std::istringstream lines(error.what());
        for (std::string line; std::getline(lines, line);)
            std::cerr << printable(line, line.size()) << '\n';
        return error.kind() == Failure::bad_input ? 2 : 1;
    } catch (const std::bad_alloc&) {
        std::cerr << "rsc: out of memory; reduce surface%n or the number of levels, or use "
                     "solver%method = 'direct'\n";
        return 1;
    } catch (const std::exception& error) {
        std::cerr << "rsc: internal failure: " << error.what()
                  << "\nPlease report it with the case that caused it.\n";
        return 1;
    }
}

#ifdef RSC_MPI
// The work of a rank other than the first.
int serve(Ranks& ranks, const std::string& command) {
    return ranks.serve([&command](const std::string& case_text, std::size_t threads) -> Work {
        RunOptions how;
        how.command = command;
        const auto members = members_of(read_case_text(case_text, "case"));
        const std::shared_ptr<CampaignWork> work(
            new CampaignWork(make_work(members, how, threads)));
        return [work](const Task& task, const std::atomic<bool>& abandoned) {
            return (*work)(task, abandoned);
        };
    });
}
#endif

}  // namespace
}  // namespace rsc

int main(int argc, char** argv) {
    using namespace rsc;
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    std::ios::sync_with_stdio(false);
#ifdef RSC_MPI
    return guarded([&] {
        Ranks ranks(argc, argv);
        catch_signals();  // after MPI_Init, which installs its own handlers
        if (!ranks.root()) return serve(ranks, command_line(argc, argv));
        const int status = guarded([&] { return run_program(argc, argv, ranks); });
        std::cout.flush();
        ranks.dismiss(status);
        return status;
    });
#else
    Ranks ranks;
    return guarded([&] { return run_program(argc, argv, ranks); });
#endif
}
