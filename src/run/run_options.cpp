#include "run/run_options.hpp"

#include <unistd.h>

#include "case/registry.hpp"
#include "file/output_path.hpp"
#include "read/file_list.hpp"

namespace rsc {

bool check_result_path(const Case& settings, const RunOptions& options) {
    std::vector<std::string> inputs = options.inputs;
    if (settings.surface.source != Source::synthetic && !settings.surface.file.empty())
        for (const std::string& file : matching_files(settings.surface.file)) inputs.push_back(file);
    return check_output(settings.output.file, inputs);
}

std::string case_text(const Case& settings) { return effective_namelist(without_idle_keys(settings)); }

// On a terminal a line that is drawn over, unless the table scrolls there; `always` gives a line now and then elsewhere too.
std::ostream* progress_stream(const RunOptions& options, bool& terminal) {
    terminal = isatty(STDERR_FILENO) != 0;
    const bool scrolls = options.table && !options.quiet && isatty(STDOUT_FILENO) != 0;
    const bool show = options.progress == Progress::always || (options.progress == Progress::automatic && terminal && !scrolls);
    return show ? options.messages : nullptr;
}

void tell_failed(const RunOptions& options, const RunSummary& summary) {
    if (summary.failed == 0 || !options.messages) return;
    *options.messages << "rsc: " << summary.failed << " of " << summary.levels
                      << " levels did not converge; their values are in the file with status = 4. Raise solver%max_iterations or "
                         "solver%tolerance.\n";
}

}  // namespace rsc
