#include "contact/periodic_element_contact.hpp"

#include "contact/load_memory.hpp"
#include "contact/pixel_spots.hpp"
#include "contact/pressed_out.hpp"
#include "contact/solver/periodic_elements.hpp"
#include "error.hpp"
#include "format.hpp"

namespace rsc {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

struct PeriodicElementContact::Impl {
    const HeightMap& surface;
    // For yielding or relaxing surfaces, or a rough indenter: the current heights minus the indenter's face.
    HeightMap own;
    const HeightMap& heights;
    Indenter indenter;
    SolverOptions options;
    PressedOut pressed;
    std::optional<LoadMemory> loads;  // relaxing bodies; pressures in the solver are then scale() times the true ones
    std::vector<double> lowered;      // deflection of each point by earlier loads at the end of the step; empty: none
    PeriodicElements solver;
    double top = 0;
    bool touches = false;   // true if the last level is in contact
    bool accepted = false;  // the last level is accepted: the contact is elastic until loaded further

    Impl(const HeightMap& heights_, const Indenter& indenter_, const SolverOptions& options_)
        : surface(heights_),
          own(std::isfinite(options_.hardness.H0) || !options_.relaxation.none() || !indenter_.shape->flat() ? heights_.copy()
                                                                                                             : HeightMap{}),
          heights(own.data ? own : heights_),
          indenter(indenter_),
          options(options_),
          pressed(heights_.nx, heights_.ny),
          solver({heights.nx, heights.ny, heights.dx, heights.dy, heights.data.get(), heights.stride}, substrate_of(indenter_),
                 options_.hardness.H0) {
        if (!options.relaxation.none()) loads.emplace(Creep(options.relaxation));
        place_indenter();
    }

    double scale() const { return loads ? loads->compliance() : 1.0; }
    std::vector<double> deflections(const std::vector<double>& q) {
        std::vector<Pixel> where;
        for (const std::int32_t i : loads->places()) where.push_back({i % heights.nx, i / heights.nx});
        return solver.deflections(where, q);
    }
    // Subtracts the indenter's face (unless flat) and the deflection by earlier loads from the heights.
    void place_indenter() {
        const bool changes = !indenter.shape->flat() || loads;
        for (int j = 0; j < heights.ny && changes; ++j)
            for (int i = 0; i < heights.nx; ++i) {
                own.row(j)[i] = indenter.clearance(surface.x0 + i * surface.dx, surface.y0 + j * surface.dy, surface(i, j) - pressed(i, j));
                if (!lowered.empty()) own.row(j)[i] -= lowered[at(j) * at(heights.nx) + at(i)];
            }
        if (changes) solver.heights_changed();
        find_top();
    }
    void find_top() {
        top = -std::numeric_limits<double>::infinity();
        for (int j = 0; j < heights.ny; ++j) top = std::max(top, *std::max_element(heights.row(j), heights.row(j) + heights.nx));
    }
    double area() const { return heights.Lx() * heights.Ly(); }
    Level report(double Z0, const ElementsOutcome& outcome);
};

Level PeriodicElementContact::Impl::report(double Z0, const ElementsOutcome& outcome) {
    Level level;
    level.separation = Z0;
    level.candidates = heights.nx * heights.ny;
    level.iterations = outcome.iterations;
    level.products = outcome.products;
    level.residual = outcome.residual;
    level.method = Method::automatic;
    if (!outcome.converged) level.status = LevelStatus::not_converged;
    touches = Z0 < top;
    accepted = false;
    if (touches) {
        std::vector<double> pressures = solver.pressures();
        for (double& p : pressures) p /= scale();
        add_pixels(level, heights, indenter, options.hardness.H0, solver.pixels(), std::move(pressures));
    } else
        add_pixels(level, heights, indenter, options.hardness.H0, {}, {});
    level.nominal_area = area();
    return level;
}

PeriodicElementContact::PeriodicElementContact(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options)
    : impl_(std::make_unique<Impl>(require_elements(heights, indenter, options), indenter, options)) {}
PeriodicElementContact::~PeriodicElementContact() = default;

Level PeriodicElementContact::solve(double Z0) {
    Impl& my = *impl_;
    ElementsOutcome outcome;
    outcome.converged = true;
    if (Z0 < my.top) outcome = my.solver.approach(Z0, my.options.tolerance, my.options.max_iterations);
    return my.report(Z0, outcome);
}

std::optional<Level> PeriodicElementContact::solve_under(double N) {
    Impl& my = *impl_;
    const double p = N / my.area(), H = my.options.hardness.H0;
    if (!(p < H)) throw Error(Failure::bad_input, format("a nominal pressure of %.9g exceeds the hardness %.9g", p, H));
    if (std::isfinite(H)) return std::nullopt;
    const ElementsOutcome outcome = my.solver.press(my.scale() * p, my.options.tolerance, my.options.max_iterations);
    return my.report(my.solver.separation(), outcome);
}

// Penetrating pixels at the hardness are lowered by their penetration; the same pressures then cause no penetration.
void PeriodicElementContact::accept(Level& level) {
    Impl& my = *impl_;
    my.accepted = true;
    if (my.loads) {
        std::vector<std::int32_t> where;
        std::vector<double> p;
        for (std::size_t k = 0; my.touches && k < my.solver.pixels().size(); ++k) {
            where.push_back(static_cast<std::int32_t>(my.solver.pixels()[k].y * my.heights.nx + my.solver.pixels()[k].x));
            p.push_back(my.solver.pressures()[k] / my.scale());
        }
        my.loads->accept(where, p, [&](const std::vector<double>& q) {
            const std::vector<double> all = my.deflections(q);
            std::vector<double> there;
            for (const std::int32_t i : my.loads->places()) there.push_back(all[at(i)]);
            return there;
        });
        level.energy_lost = my.heights.dx * my.heights.dy * my.loads->lost();
        return;
    }
    if (!path_dependent()) return;
    if (my.touches) {
        for (const auto& [pixel, depth] : my.solver.press_out()) {
            my.pressed.add(pixel.x, pixel.y, depth);
            my.own.row(pixel.y)[pixel.x] -= depth;
        }
        my.find_top();
        my.solver.heights_changed();
    }
    level.plastic_work = my.options.hardness.H0 * my.heights.dx * my.heights.dy * my.pressed.sum();
}

bool PeriodicElementContact::path_dependent() const { return relaxes() || std::isfinite(impl_->options.hardness.H0); }

bool PeriodicElementContact::relaxes() const { return impl_->loads.has_value(); }

void PeriodicElementContact::step(double dt) {
    Impl& my = *impl_;
    my.loads->step(dt);
    my.lowered = my.loads->places().empty() ? std::vector<double>() : my.deflections(my.loads->rest());
    my.place_indenter();
}

std::vector<double> PeriodicElementContact::memory() const {  // as in ElementContact
    std::vector<double> triples;
    if (relaxes()) {
        triples.push_back(accepted_time());
        impl_->loads->write(triples);
        return triples;
    }
    for (const auto& [i, j, depth] : impl_->pressed.points()) triples.insert(triples.end(), {double(i), double(j), depth});
    return triples;
}

void PeriodicElementContact::recall(const std::vector<double>& memory, const Level* level) {
    Impl& my = *impl_;
    if (relaxes()) {
        recall_loads(*my.loads, memory, my.heights);
        recall_time(memory[0]);
        step(0);
    } else {
        const std::vector<PressedOut::Point> before = my.pressed.points();
        my.pressed = pressed_out_of(my.heights, memory);
        if (my.indenter.shape->flat()) {
            for (const auto& [i, j, depth] : before) my.own.row(j)[i] = my.surface(i, j);
            for (const auto& [i, j, depth] : my.pressed.points()) my.own.row(j)[i] = my.surface(i, j) - depth;
            if (my.own.data) my.solver.heights_changed();
        }
        my.place_indenter();
    }
    my.touches = false;
    if (!level) return;
    (void)solve(level->separation);
    my.accepted = true;
}

ResidualProfile PeriodicElementContact::residual_profile() const {
    const Impl& my = *impl_;
    ResidualProfile profile{{}, {}, {}, my.heights.dx, my.heights.dy};
    for (const auto& [i, j, depth] : my.pressed.points()) {
        profile.x.push_back(my.heights.x0 + i * my.heights.dx);
        profile.y.push_back(my.heights.y0 + j * my.heights.dy);
        profile.depth.push_back(depth);
    }
    return profile;
}

double PeriodicElementContact::stiffness() { return impl_->touches ? 0 - impl_->area() * impl_->solver.stiffness(impl_->accepted) : 0; }
double PeriodicElementContact::energy() const {
    if (impl_->loads) return impl_->heights.dx * impl_->heights.dy * impl_->loads->stored();
    return impl_->touches ? impl_->area() * impl_->solver.energy() : 0;
}

void PeriodicElementContact::move_tip(double x0, double y0) {
    if (!std::isfinite(x0) || !std::isfinite(y0)) throw Error(Failure::bad_input, "the tip's position must be finite");
    impl_->indenter.x0 = x0;
    impl_->indenter.y0 = y0;
    if (!impl_->indenter.shape->flat()) impl_->place_indenter();
}

double PeriodicElementContact::closed() const { return impl_->solver.closed(); }
double PeriodicElementContact::first_touch() const { return impl_->top; }
const Indenter& PeriodicElementContact::indenter() const { return impl_->indenter; }
double PeriodicElementContact::tolerance() const { return impl_->options.tolerance; }

// Force of a flat punch as wide as the period, an upper bound also for yielding surfaces.
double PeriodicElementContact::force_at_most(double depth) {
    return impl_->indenter.E_star * std::max(impl_->heights.Lx(), impl_->heights.Ly()) * depth;
}

}  // namespace rsc
