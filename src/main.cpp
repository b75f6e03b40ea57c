// The program: `rsc < case.nml`. It reads the case and runs it; everything else is in run/. With
// RSC_MPI it is built as rsc_mpi.

#include "base/error.hpp"
#include "base/format.hpp"
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
#if defined(__GLIBC__)
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

// A threaded BLAS sums in an order that depends on the number of threads, but results must not.
// Only OpenBLAS needs this switch.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace {

#ifdef RSC_MPI
using Job = rsc::MpiJob;
#else
struct Job {};  // one process
#endif

// For the attribute `history`. With SOURCE_DATE_EPOCH, for reproducible files, only the version: it
// is independent of --resume, the program and the number of threads.
std::string command_line(int argc, char** argv) {
    if (std::getenv("SOURCE_DATE_EPOCH")) return {};
    std::string text = "rsc";
    for (int i = 1; i < argc; ++i) text.append(1, ' ').append(argv[i]);
    return text;
}

std::unique_ptr<rsc::Team> make_team(Job& job, rsc::CampaignWork& work, const rsc::ReadCase& read,
                                     std::size_t threads) {
#ifdef RSC_MPI
    return job.team(std::ref(work), threads, rsc::effective_namelist(read));
#else
    (void)job;
    (void)read;
    return std::make_unique<rsc::ThreadTeam>(std::ref(work), static_cast<int>(threads));
#endif
}

std::size_t threads_of(const rsc::Case& settings) {
#ifdef RSC_MPI
    return rsc::threads_of_rank(settings.run.threads);
#else
    return rsc::most_threads(settings.run.threads);
#endif
}

rsc::RunOptions how_to_run(const rsc::Options& options, const std::string& command) {
    rsc::RunOptions how;
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
int run(Job& job, const rsc::Options& options, const rsc::ReadCase& read,
        const std::string& command) {
    rsc::RunOptions how = how_to_run(options, command);
    if (read.study)
        // so that a member alone has the same result as in the study
        how.compare_automatically = false;
    const std::size_t threads = threads_of(read.settings);
    rsc::CampaignWork work = rsc::make_work(rsc::members_of(read), how, threads);
    const std::unique_ptr<rsc::Team> team = make_team(job, work, read, threads);
    return rsc::run_members(read, options.member, how, work, *team).failed == 0 ? 0 : 1;
}

// Without MPI every process started by mpirun would run the whole case and write the same file.
void refuse_mpi([[maybe_unused]] const rsc::Options& options) {
#ifndef RSC_MPI
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"}) {
        const char* const size = std::getenv(name);
        if (size && std::atoi(size) > 1 && !options.member)
            rsc::bad_input(
                std::string("rsc: started ") + size +
                " times by an MPI launcher, but this program is built without MPI: use rsc_mpi "
                "(cmake -DRSC_MPI=ON, or make -f Makefile.legacy rsc_mpi), or rsc --member K");
    }
#endif
}

// With MPI signals are caught already.
void catch_signals_early() {
#ifndef RSC_MPI
    rsc::catch_signals();
#endif
}

// Runs `f`. Refusals during a run that begin with a key, "surface%sigma: ...", get the name of the
// case before it.
template <class F>
auto named(const rsc::Options& options, F f) {
    try {
        return f();
    } catch (const rsc::Error& error) {
        const std::string what = error.what(), name = what.substr(0, what.find_first_of("( :="));
        const std::size_t percent = std::min(name.find('%'), name.size());
        if (!rsc::find_key(name.substr(0, percent),
                           name.substr(std::min(percent + 1, name.size()))))
            throw;
        throw rsc::Error(error.kind(),
                         (options.case_path.empty() ? "<stdin>" : options.case_path) + ": " + what);
    }
}

// Prints what is asked about the program, or about a result file, without a case to run. False if
// nothing is.
bool tells(const rsc::Options& options) {
    if (options.help) {
        std::cout << rsc::usage_text();
    } else if (options.version) {
        std::cout << rsc::version_text();
    } else if (options.man) {
        std::cout << rsc::manual_page();
    } else if (options.describe) {
        std::cout << rsc::describe(options.describe_what);
    } else if (options.show_case) {
        const std::optional<rsc::ResultHead> head = rsc::head_of_result(options.case_path);
        const std::string why = head ? "" : rsc::why_not_opened(options.case_path);
        if (!head)
            rsc::bad_input(
                options.case_path + ": " +
                (why.empty() ? "is no result of rsc, so there is no case to print" : why));
        std::cout << head->case_text;
    } else {
        return false;
    }
    return true;
}

int run_program(int argc, char** argv, Job& job) {
    const rsc::Options options = rsc::parse_options(argc, argv);
    if (tells(options)) return 0;
    refuse_mpi(options);
    if (!options.merge.empty()) {
        catch_signals_early();
        return rsc::merge_campaigns(options.merge, *options.output,
                                    how_to_run(options, command_line(argc, argv)))
                           .failed == 0
                   ? 0
                   : 1;
    }
    // A result file can also be given as a case.
    const std::optional<rsc::ResultHead> inside = rsc::head_of_result(options.case_path);
    const rsc::ReadCase read =
        inside ? rsc::read_case_text(inside->case_text, options.case_path, options)
               : rsc::read_case(options);
    catch_signals_early();  // not earlier, so that a signal ends the wait for standard input
    for (const std::string& warning : read.warnings) std::cerr << warning << '\n';
    if (options.list) {
        if (!read.study) rsc::bad_input("--list: the case has no &study");
        std::cout << rsc::list_members(rsc::members_of(read));
        return 0;
    }
    if (options.check) {
        const rsc::RunOptions how = how_to_run(options, command_line(argc, argv));
        const std::size_t threads = threads_of(read.settings);
        const double megabytes =
            named(options, [&] { return rsc::check_members(read, options.member, how, threads); });
        std::cout << rsc::effective_namelist(read);
        if (!options.quiet)
            std::cerr << "rsc: the inputs can be read and the result can be written"
                      << (megabytes > 0 ? rsc::format("; about %.0f MB of memory with %zu thread%s",
                                                      megabytes, threads, threads == 1 ? "" : "s")
                                        : "")
                      << '\n';
        return 0;
    }
    return named(options, [&] { return run(job, options, read, command_line(argc, argv)); });
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
    } catch (const rsc::Interrupted& stop) {
        std::cerr << "rsc: " << stop.what() << '\n';
        return 128 + stop.signal();
    } catch (const rsc::Error& error) {
        // Text from files may contain control characters of terminals.
        std::istringstream lines(error.what());
        for (std::string line; std::getline(lines, line);)
            std::cerr << rsc::printable(line, line.size()) << '\n';
        return error.kind() == rsc::Failure::bad_input ? 2 : 1;
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
int serve(Job& job, const std::string& command) {
    return job.serve([&command](const std::string& case_text, std::size_t threads) -> rsc::Work {
        rsc::RunOptions how;
        how.command = command;
        const auto members = rsc::members_of(rsc::read_case_text(case_text, "case"));
        const std::shared_ptr<rsc::CampaignWork> work(
            new rsc::CampaignWork(rsc::make_work(members, how, threads)));
        return [work](const rsc::Task& task, const std::atomic<bool>& abandoned) {
            return (*work)(task, abandoned);
        };
    });
}
#endif

// A short run spends a tenth of its time on pages of memory that it has just given back, and on
// small ones: freed memory is kept, and memory is taken from the system in huge pages where it has
// them.
void keep_memory() {
#if defined(__GLIBC__)
    for (const auto which : {RLIMIT_AS, RLIMIT_DATA})
        if (rlimit limit{}; getrlimit(which, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY)
            return;                  // memory is short
    constexpr int piece = 32 << 20;  // the largest threshold that is accepted
    mallopt(M_MMAP_THRESHOLD, piece);
    mallopt(M_TRIM_THRESHOLD, 4 * piece);
    mallopt(M_TOP_PAD, piece);
    auto* const heap = static_cast<char*>(sbrk(0));
    void* volatile first = std::malloc(piece - 4096);
    std::free(first);
    const auto into_page = reinterpret_cast<std::uintptr_t>(heap) % 4096;
    madvise(heap - into_page,
            static_cast<std::size_t>(static_cast<char*>(sbrk(0)) - heap) + into_page,
            MADV_HUGEPAGE);
#endif
}

}  // namespace

int main(int argc, char** argv) {
    keep_memory();
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    std::ios::sync_with_stdio(false);
#ifdef RSC_MPI
    return guarded([&] {
        Job job(argc, argv);
        rsc::catch_signals();  // after MPI_Init, which installs its own handlers
        if (!job.root()) return serve(job, command_line(argc, argv));
        const int status = guarded([&] { return run_program(argc, argv, job); });
        std::cout.flush();
        job.dismiss(status);
        return status;
    });
#else
    Job job;
    return guarded([&] { return run_program(argc, argv, job); });
#endif
}
