// Cases by their text, and what running them leaves.
#pragma once

#include "case/read_case.hpp"
#include "run/realize.hpp"
#include "run/run.hpp"
#include "support/result_reader.hpp"

inline rsc::Case settings_of(const std::string& text) {
    return rsc::read_case_text(text, "case.nml").settings;
}

// A measured map, whose heights stay as they are read.
inline rsc::Case case_of_map(const std::string& file) {
    rsc::Case c;
    c.surface.source = rsc::Source::heights;
    c.surface.detrend = rsc::Detrend::none;
    c.surface.file = file;
    return c;
}

// Runs the case into the file.
inline Reader run_to(const std::string& path, const std::string& text) {
    rsc::Case settings = settings_of(text);
    settings.output.file = path;
    CHECK(rsc::run_case(settings, {}) == 0);
    return Reader(path);
}
