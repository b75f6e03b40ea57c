#include "rough/resample.hpp"

#include <algorithm>

#include "error.hpp"
#include "rough/fftw_planner.hpp"

namespace rsc {

HeightMap twice_as_fine(const HeightMap& map) {
    HeightMap fine;
    fine.allocate(2 * map.nx, 2 * map.ny, 2 * map.nx);
    fine.dx = 0.5 * map.dx, fine.dy = 0.5 * map.dy;
    fine.x0 = map.x0 - 0.25 * map.dx, fine.y0 = map.y0 - 0.25 * map.dy;  // middle of the first of the four cells
    fine.periodic = map.periodic;
    const auto nx = static_cast<std::size_t>(map.nx), ny = static_cast<std::size_t>(map.ny);
    const std::unique_ptr<double[], HeightMap::Free> series(allocate_doubles(nx * ny, "the cosine series of a map"));
    FftwPlan forward, back;
    {
        const auto lock = fftw_planning();
        forward.reset(fftw_plan_r2r_2d(map.ny, map.nx, series.get(), series.get(), FFTW_REDFT10, FFTW_REDFT10, FFTW_ESTIMATE));
        back.reset(fftw_plan_r2r_2d(fine.ny, fine.nx, fine.row(0), fine.row(0), FFTW_REDFT01, FFTW_REDFT01, FFTW_ESTIMATE));
    }
    if (!forward || !back) throw Error(Failure::internal, "a finer map: FFTW made no plan");
    for (std::size_t j = 0; j < ny; ++j) std::copy_n(map.row(static_cast<int>(j)), nx, series.get() + j * nx);
    fftw_execute(forward.get());
    std::fill_n(fine.row(0), 4 * nx * ny, 0.0);
    const double scale = 1.0 / (4.0 * static_cast<double>(nx) * static_cast<double>(ny));
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) fine.row(static_cast<int>(j))[i] = scale * series[j * nx + i];
    fftw_execute(back.get());
    return fine;
}

}  // namespace rsc
