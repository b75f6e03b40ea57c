// Lowest eigenvalue of a symmetric operator, used to distinguish minima from saddles.
#pragma once

#include "std.hpp"

namespace rsc {

// Lanczos iteration with full reorthogonalisation and a fixed start. It stops as soon as the sign of the lowest eigenvalue is certain.
// Returns the lowest Ritz value minus its error bound if that is positive, the Ritz value itself if it is negative; `vector` receives the
// Ritz vector (unit length).
double lanczos_lowest(std::size_t n, const std::function<void(const std::vector<double>&, std::vector<double>&)>& multiply,
                      std::vector<double>& vector);

}  // namespace rsc
