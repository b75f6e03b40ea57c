// The lowest eigenvalue of a symmetric operator, for telling minima from saddles.
#pragma once

#include "std.hpp"

namespace rsc {

// Lanczos with full reorthogonalisation and a fixed start; stops as soon as the sign of the lowest eigenvalue is settled.
// Returns the lowest Ritz value less its error bound when that is positive, the Ritz value itself when it is negative;
// `vector` receives the Ritz vector (unit length).
double lanczos_lowest(std::size_t n, const std::function<void(const std::vector<double>&, std::vector<double>&)>& multiply,
                      std::vector<double>& vector);

}  // namespace rsc
