// The program: `rsc < case.nml`. It turns text into a case and runs it; everything else is in run/.
#include <iostream>
#include <new>

#include "error.hpp"
#include "run/options.hpp"
#include "run/read_case.hpp"
#include "run/registry.hpp"
#include "run/run.hpp"

// A threaded BLAS sums in an order that depends on its threads; results must not. OpenBLAS has this switch, others need none.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace {

int exit_status(const rsc::Error& error) { return error.kind() == rsc::Failure::bad_input ? 2 : 1; }

std::string command_line(int argc, char** argv) {
    std::string text = "rsc";
    for (int i = 1; i < argc; ++i) text.append(1, ' ').append(argv[i]);
    return text;
}

// 0: done, 1: some level did not converge.
int run(const rsc::Options& options, const rsc::ReadCase& read, const std::string& command) {
    rsc::RunOptions how;
    how.case_text = rsc::effective_namelist(read);
    how.command = command;
    how.progress = options.progress;
    how.quiet = options.quiet;
    how.table = &std::cout;
    how.messages = &std::cerr;
    return rsc::run_case(read.settings, how) == 0 ? 0 : 1;
}

int run_program(int argc, char** argv) {
    const rsc::Options options = rsc::parse_options(argc, argv);
    if (options.help) {
        std::cout << rsc::usage_text();
        return 0;
    }
    if (options.version) {
        std::cout << rsc::version_text();
        return 0;
    }
    if (options.describe) {
        std::cout << rsc::describe(options.describe_what);
        return 0;
    }
    const rsc::ReadCase read = rsc::read_case(options);
    for (const std::string& warning : read.warnings) std::cerr << warning << '\n';
    if (options.check) {
        std::cout << rsc::effective_namelist(read);
        return 0;
    }
    return run(options, read, command_line(argc, argv));
}

}  // namespace

int main(int argc, char** argv) {
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    std::ios::sync_with_stdio(false);
    try {
        return run_program(argc, argv);
    } catch (const rsc::Error& error) {
        std::cerr << error.what() << '\n';
        return exit_status(error);
    } catch (const std::bad_alloc&) {
        std::cerr << "rsc: the machine refused memory; a smaller surface%n, fewer levels or solver%method='direct' need less\n";
        return 1;
    } catch (const std::exception& error) {
        std::cerr << "rsc: internal failure: " << error.what() << "\nPlease report it with the case that led here.\n";
        return 1;
    }
}
