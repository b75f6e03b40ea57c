#include "contact/solver/periodic_elements.hpp"

#include "contact/solver/periodic_grid.hpp"
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

struct PeriodicElements::Impl {
    Relief relief;
    Substrate substrate;
    double highest;
    // Units in which values are of order 1: heights are relative to `zero` in units of `rms` (both of the initial heights), pressures in
    // units of E* rms/dx.
    double zero = 0, rms = 0;
    double mean = 0;  // mean of the current heights
    std::unique_ptr<PeriodicGrid> grid;
    std::vector<Pixel> pixels;
    std::vector<double> pressures;

    double pressure_unit() const { return substrate.modulus() * (rms / relief.dx); }
    template <class F>
    double mean_of(F&& f) const;
    double mean_height() const {
        return mean_of([](double z) { return z; });
    }
    void prepare();
    ElementsOutcome solve(Given given, double tolerance, int most_iterations);
};

// Mean of a function of the heights.
template <class F>
double PeriodicElements::Impl::mean_of(F&& f) const {
    double all = 0;
    for (int j = 0; j < relief.ny; ++j) {
        double row = 0;
        for (int i = 0; i < relief.nx; ++i) row += f(relief.z[j * relief.stride + i]);
        all += row / relief.nx;
    }
    return all / relief.ny;
}

void PeriodicElements::Impl::prepare() {
    mean = zero = mean_height();
    double largest = 0;
    mean_of([&](double z) { return largest = std::max(largest, std::abs(z - mean)); });
    if (!(largest > 0)) throw Error(Failure::bad_input, "the surface is flat: two smooth flats touch everywhere");
    rms = largest * std::sqrt(mean_of([&](double z) { return (z - mean) / largest * ((z - mean) / largest); }));
    PeriodicGrid::Share share;
    if (substrate.smooth()) share = [this](double k) { return substrate.smooth()->share(k / relief.dx); };
    grid = std::make_unique<PeriodicGrid>(relief.nx, relief.ny, relief.dy / relief.dx, 1.0, highest / pressure_unit(),
                                          StoredHeights{relief.z, relief.stride, zero, 1 / rms}, std::move(share));
}

ElementsOutcome PeriodicElements::Impl::solve(Given given, double tolerance, int most_iterations) {
    const ElementsOutcome outcome = solve_from_coarse(*grid, given, tolerance, most_iterations, true);
    pixels = grid->pixels();
    pressures = grid->pressures();
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        if (!(pressures[k] > 0)) continue;
        pixels[kept] = pixels[k];
        pressures[kept++] = pressures[k] >= highest / pressure_unit() ? highest : pressures[k] * pressure_unit();
    }
    pixels.resize(kept), pressures.resize(kept);
    return outcome;
}

PeriodicElements::PeriodicElements(const Relief& relief, const Substrate& substrate, double highest)
    : impl_(std::make_unique<Impl>(Impl{relief, substrate, highest, 0, 0, 0, nullptr, {}, {}})) {
    impl_->prepare();
}
PeriodicElements::~PeriodicElements() = default;

std::vector<std::pair<Pixel, double>> PeriodicElements::press_out() {
    const std::vector<Pixel> set = impl_->grid->pixels();
    std::vector<std::pair<Pixel, double>> lowered;
    for (const auto& [k, depth] : impl_->grid->press_out()) lowered.emplace_back(set[static_cast<std::size_t>(k)], depth * impl_->rms);
    return lowered;
}

void PeriodicElements::heights_changed() { impl_->mean = impl_->mean_height(); }

ElementsOutcome PeriodicElements::press(double mean_pressure, double tolerance, int most_iterations) {
    Impl& my = *impl_;
    const ElementsOutcome outcome = my.solve({true, mean_pressure / my.pressure_unit()}, tolerance, most_iterations);
    if (my.grid->full())
        throw Error(Failure::bad_input, format("a nominal pressure of %.9g is above that of full contact on this surface, %.9g",
                                               mean_pressure, closing_pressure()));
    return outcome;
}

ElementsOutcome PeriodicElements::approach(double Z0, double tolerance, int most_iterations) {
    Impl& my = *impl_;
    if (!(Z0 > closed()))
        throw Error(Failure::bad_input, format("a separation of %.9g is below that of full contact, %.9g", Z0,
                                               std::abs(my.mean) > kRounding * my.rms ? my.mean : 0.0));
    return my.solve({false, (Z0 - my.zero) / my.rms}, tolerance, most_iterations);
}

double PeriodicElements::closed() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return impl_->highest < infinity ? -infinity : impl_->mean + kRounding * impl_->rms;
}

std::vector<double> PeriodicElements::deflections(const std::vector<Pixel>& pixels, const std::vector<double>& p) {
    const auto nx = static_cast<std::size_t>(impl_->relief.nx);
    std::vector<double> plane(nx * static_cast<std::size_t>(impl_->relief.ny), 0.0);
    for (std::size_t k = 0; k < p.size(); ++k)
        plane[static_cast<std::size_t>(pixels[k].y) * nx + static_cast<std::size_t>(pixels[k].x)] = p[k] / impl_->pressure_unit();
    impl_->grid->deflect(plane);
    for (double& u : plane) u *= impl_->rms;
    return plane;
}

double PeriodicElements::closing_pressure() { return 0 - impl_->grid->least_inverse() * impl_->pressure_unit(); }

double PeriodicElements::separation() const { return impl_->zero + impl_->grid->Z0() * impl_->rms; }
const std::vector<Pixel>& PeriodicElements::pixels() const { return impl_->pixels; }
const std::vector<double>& PeriodicElements::pressures() const { return impl_->pressures; }

double PeriodicElements::stiffness(bool back) {
    const double points = static_cast<double>(impl_->relief.nx) * static_cast<double>(impl_->relief.ny);
    return impl_->grid->stiffness(back) / points * (impl_->pressure_unit() / impl_->rms);
}

double PeriodicElements::energy() const {
    const double points = static_cast<double>(impl_->relief.nx) * static_cast<double>(impl_->relief.ny);
    return impl_->grid->energy() / points * (impl_->pressure_unit() * impl_->rms);
}

}  // namespace rsc
