// What a campaign shows on stdout: a line a batch of realizations, and at the end the mean curve with its scatter.
#pragma once

#include <ostream>
#include <string>

#include "observe/record.hpp"
#include "run/job.hpp"
#include "run/run_options.hpp"

namespace rsc {

// The case, how many realizations by how many workers, the column heads. `done` of them are there from an interrupted run.
void print_campaign_heading(std::ostream& out, const Job& job, std::size_t workers, std::size_t done);

// Means and scatter (standard deviation of a realization) of the last level over the realizations so far.
void print_batch(std::ostream& out, const Job& job, const Accumulators& sums, double seconds, std::size_t done_in_this_run);

// The mean curve, statuses, what to be wary of, the file.
void print_campaign_summary(std::ostream& out, const Job& job, const Observations& observations, double seconds, const std::string& file,
                            bool replaces);

RunSummary campaign_summary(const Result& result);

}  // namespace rsc
