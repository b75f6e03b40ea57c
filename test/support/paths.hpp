// Paths of contacts by value.
#pragma once

#include "contact/make.hpp"

inline rsc::Path asperity_path(const rsc::Asperities& asperities, const rsc::Indenter& indenter,
                               const rsc::SolverOptions& options) {
    return std::move(*rsc::make_asperity_contact(asperities, indenter, options));
}
