// The manifest of a study: which file is which member, and what is special about it.
#pragma once

#include <string>
#include <vector>

#include "case/read_case.hpp"
#include "case/study.hpp"

namespace rsc {

// "output/rsc.nc" -> "output/rsc_manifest.nc"; the text lies beside it, "output/rsc_manifest.txt".
std::string manifest_file(const std::string& output_file);

// Writes both, each whole or not at all. They say the same whether the study is finished or not, so that the tasks of a job array
// may all write them. Throws Error(file_system).
void write_manifest(const ReadCase& read, const std::vector<Member>& members, const std::string& command);

// Can both be written? As check_output; the text one may be replaced if it is a manifest. Throws Error(bad_input).
void check_manifest(const std::string& output_file, const std::vector<std::string>& inputs);

// "1  output/rsc_001.nc  surface%sigma=0.001 surface%L_lambda_s=256", a line a member.
std::string list_members(const std::vector<Member>& members);

// "member 3 (surface%sigma=0.001)"; empty for a case that is no member of a study.
std::string member_name(const Member& member);

}  // namespace rsc
