#include "contact/solver/periodic_elements.hpp"

#include "error.hpp"
#include "format.hpp"

namespace rsc {
namespace {

// Tolerance of solutions on coarser grids, which are only starting points.
constexpr double kCoarseError = 1e-2;
constexpr double kRounding = 1e-12;  // rounding error of separations, in rms heights

// Solves on the coarsened grid (recursively) and starts from its solution.
ElementsOutcome solve_from_coarse(PeriodicGrid& grid, Given given, double tolerance, int most_iterations, bool finest) {
    bool started = false;
    if (grid.can_be_coarsened()) {  // its memory is free again before the finer grid is solved
        std::vector<double> heights;
        const auto coarse = grid.coarsened(heights);
        solve_from_coarse(*coarse, given, kCoarseError, most_iterations, false);
        grid.start(*coarse);
        started = !grid.bare();
    }
    if (!started) grid.start(given);
    return grid.solve(given, tolerance, most_iterations, finest);
}

}  // namespace

// Mean of a function of the heights.
template <class F>
double PeriodicElements::mean_of(F&& f) const {
    double all = 0;
    for (int j = 0; j < relief_.ny; ++j) {
        double row = 0;
        for (int i = 0; i < relief_.nx; ++i) row += f(relief_.z[j * relief_.stride + i]);
        all += row / relief_.nx;
    }
    return all / relief_.ny;
}

double PeriodicElements::mean_height() const {
    return mean_of([](double z) { return z; });
}

PeriodicElements::PeriodicElements(const Relief& relief, const Substrate& substrate, double highest)
    : relief_(relief), substrate_(substrate), highest_(highest) {
    mean_ = zero_ = mean_height();
    double largest = 0;
    mean_of([&](double z) { return largest = std::max(largest, std::abs(z - mean_)); });
    if (!(largest > 0)) throw Error(Failure::bad_input, "the surface is flat: two smooth flats touch everywhere");
    rms_ = largest * std::sqrt(mean_of([&](double z) { return (z - mean_) / largest * ((z - mean_) / largest); }));
    PeriodicGrid::Share share;
    if (substrate.smooth()) share = [body = substrate, dx = relief.dx](double k) { return body.smooth()->share(k / dx); };
    grid_ = std::make_unique<PeriodicGrid>(relief.nx, relief.ny, relief.dy / relief.dx, 1.0, highest / pressure_unit(),
                                           StoredHeights{relief.z, relief.stride, zero_, 1 / rms_}, std::move(share));
}

ElementsOutcome PeriodicElements::solve(Given given, double tolerance, int most_iterations) {
    const ElementsOutcome outcome = solve_from_coarse(*grid_, given, tolerance, most_iterations, true);
    const double limit = highest_ / pressure_unit();
    const std::vector<Pixel> set = grid_->pixels();
    pixels_.clear(), pressures_.clear();
    for (std::size_t k = 0; k < set.size(); ++k) {
        const double p = grid_->pressures()[k];
        if (p > 0) pixels_.push_back(set[k]), pressures_.push_back(p >= limit ? highest_ : p * pressure_unit());
    }
    return outcome;
}

std::vector<std::pair<Pixel, double>> PeriodicElements::press_out() {
    const std::vector<Pixel> set = grid_->pixels();
    std::vector<std::pair<Pixel, double>> lowered;
    for (const auto& [k, depth] : grid_->press_out()) lowered.emplace_back(set[static_cast<std::size_t>(k)], depth * rms_);
    return lowered;
}

ElementsOutcome PeriodicElements::press(double mean_pressure, double tolerance, int most_iterations) {
    const ElementsOutcome outcome = solve({true, mean_pressure / pressure_unit()}, tolerance, most_iterations);
    if (grid_->full())
        throw Error(Failure::bad_input, format("a nominal pressure of %.9g is above that of full contact on this surface, %.9g",
                                               mean_pressure, closing_pressure()));
    return outcome;
}

ElementsOutcome PeriodicElements::approach(double Z0, double tolerance, int most_iterations) {
    if (!(Z0 > closed()))
        throw Error(Failure::bad_input, format("a separation of %.9g is below that of full contact, %.9g", Z0,
                                               std::abs(mean_) > kRounding * rms_ ? mean_ : 0.0));
    return solve({false, (Z0 - zero_) / rms_}, tolerance, most_iterations);
}

double PeriodicElements::closed() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return highest_ < infinity ? -infinity : mean_ + kRounding * rms_;
}

std::vector<double> PeriodicElements::deflections(const std::vector<Pixel>& pixels, const std::vector<double>& p) {
    const auto nx = static_cast<std::size_t>(relief_.nx);
    std::vector<double> plane(nx * static_cast<std::size_t>(relief_.ny), 0.0);
    for (std::size_t k = 0; k < p.size(); ++k)
        plane[static_cast<std::size_t>(pixels[k].y) * nx + static_cast<std::size_t>(pixels[k].x)] = p[k] / pressure_unit();
    grid_->deflect(plane);
    for (double& u : plane) u *= rms_;
    return plane;
}

double PeriodicElements::closing_pressure() { return 0 - grid_->least_inverse() * pressure_unit(); }

double PeriodicElements::stiffness(bool back) { return grid_->stiffness(back) / points() * (pressure_unit() / rms_); }

double PeriodicElements::energy() const { return grid_->energy() / points() * (pressure_unit() * rms_); }

}  // namespace rsc
