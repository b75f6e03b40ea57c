// Twins of a measured map: the case of surfaces with its spectrum, written beside its result.
#pragma once

#include <string>

#include "run/job.hpp"

namespace rsc {

// The namelist of a campaign on surfaces with the spectrum that the result file `result` holds, otherwise as the case of the job.
std::string twins_text(const Job& job, const std::string& result);

// Writes it to NAME_twins.nml for the result NAME.nc of a measured map and returns a line that says so; empty for other surfaces and maps too
// small for a spectrum. A file of that name that rsc has not written is left alone, and the line says that. Throws Error(file_system).
std::string write_twins(const Job& job, const std::string& result);

}  // namespace rsc
