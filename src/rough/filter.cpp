#include "rough/filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "error.hpp"
#include "rough/fftw_planner.hpp"

namespace rsc {
namespace {

// Transmission of the waves a transform of n points knows: half waves on n steps (cosine transform), or whole ones, counted in the
// order of FFTW's half-complex format (r0, r1, ..., i2, i1). It is a product of a function of kx and one of ky.
std::vector<double> transmissions(int n, double step, double cutoff, bool periodic) {
    std::vector<double> t(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
        const double k = periodic ? 2 * std::numbers::pi * std::min(i, n - i) / (n * step) : std::numbers::pi * i / (n * step);
        t[static_cast<std::size_t>(i)] = gaussian_transmission(cutoff, k);
    }
    return t;
}

}  // namespace

double gaussian_transmission(double cutoff, double k) {
    const double ratio = cutoff * k / (2 * std::numbers::pi);
    return std::exp2(-ratio * ratio);  // exp(-pi alpha^2 x^2) with pi alpha^2 = ln 2
}

void gaussian_filter(HeightMap& map, double cutoff) {
    if (!(cutoff > 0 && std::isfinite(cutoff)))
        throw Error(Failure::bad_input, "filter_cutoff must be positive and finite, not " + std::to_string(cutoff));
    const auto nx = static_cast<std::size_t>(map.nx), ny = static_cast<std::size_t>(map.ny);
    const std::unique_ptr<double[], HeightMap::Free> buffer(allocate_doubles(nx * ny, "a filtered height map"));
    double* const z = buffer.get();
    FftwPlan forward, back;
    {
        const fftw_r2r_kind there = map.periodic ? FFTW_R2HC : FFTW_REDFT10, again = map.periodic ? FFTW_HC2R : FFTW_REDFT01;
        const auto lock = fftw_planning();
        forward.reset(fftw_plan_r2r_2d(map.ny, map.nx, z, z, there, there, FFTW_ESTIMATE));
        back.reset(fftw_plan_r2r_2d(map.ny, map.nx, z, z, again, again, FFTW_ESTIMATE));
    }
    if (!forward || !back) throw Error(Failure::internal, "filter: FFTW made no plan");
    for (int j = 0; j < map.ny; ++j) std::copy_n(map.row(j), nx, z + static_cast<std::size_t>(j) * nx);
    fftw_execute(forward.get());
    const std::vector<double> tx = transmissions(map.nx, map.dx, cutoff, map.periodic);
    const std::vector<double> ty = transmissions(map.ny, map.dy, cutoff, map.periodic);
    const double scale = 1.0 / ((map.periodic ? 1.0 : 4.0) * static_cast<double>(nx) * static_cast<double>(ny));
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) z[j * nx + i] *= scale * ty[j] * tx[i];
    fftw_execute(back.get());
    for (int j = 0; j < map.ny; ++j) std::copy_n(z + static_cast<std::size_t>(j) * nx, nx, map.row(j));
}

}  // namespace rsc
