// The contact of a case: indenter, tip and solver of &indenter, &solids, &indentation and &solver.

#include "base/error.hpp"
#include "contact/equivalent.hpp"
#include "contact/make.hpp"
#include "physics/physics.hpp"
#include "problem/bodies.hpp"

namespace rsc {
namespace {

// E* at the surface: that of the top layer if body 1 has layers.
double surface_modulus(const Case::Solids& solids) {
    double E[2] = {solids.E[0], solids.E[1]}, nu[2] = {solids.nu[0], solids.nu[1]};
    if (!solids.layer_E.empty()) {
        E[0] = solids.layer_E[0];
        nu[0] = solids.layer_nu[0];
    }
    return equivalent_modulus(E, nu);
}

LayeredBody layers_in(const Case::Solids& solids) {
    LayeredBody body;
    for (std::size_t k = 0; k < solids.layer_thickness.size(); ++k, ++body.count)
        body.layer[k] = {solids.layer_thickness[k], solids.layer_E[k], solids.layer_nu[k]};
    if (body.count > 0) {
        body.E = solids.E[0];
        body.nu = solids.nu[0];
    }
    return body;
}

}  // namespace

void require_tip_above(const SurfaceDomain& domain, const Shape& shape, double x, double y) {
    const Domain& d = domain;
    const double beyond = domain.guessed ? shape->reach() : 0;
    const auto within = [&](double v, double first, double length) {
        const double rounding = 1e-12 * (std::abs(first) + length);
        return usable(v) && v >= first - beyond - rounding &&
               v <= first + length + beyond + rounding;
    };
    if (within(x, d.x0, d.Lx) && within(y, d.y0, d.Ly)) return;
    bad_input(
        "the tip at x = ", x, ", y = ", y,
        " is not above the surface, which reaches from x = ", d.x0, " to ", d.x0 + d.Lx,
        " and from y = ", d.y0, " to ", d.y0 + d.Ly,
        domain.guessed ? " (the extent of the asperities; set surface%L for a larger one)" : "");
}

Indenter indenter_of(const Case& settings, const SurfaceDomain& domain) {
    const auto& centre = settings.indentation.centre;
    const Domain& d = domain;
    Indenter indenter{surface_modulus(settings.solids), shape_of(settings),
                      centre[0].value_or(d.x0 + 0.5 * d.Lx - domain.half_step_x),
                      centre[1].value_or(d.y0 + 0.5 * d.Ly - domain.half_step_y),
                      period_of(settings, domain)};
    indenter.layers = layers_in(settings.solids);
    try {
        require_tip_above(domain, indenter.shape, indenter.x0, indenter.y0);
    } catch (const Error& error) {
        throw Error(error.kind(), "indentation%centre: ", error.what());
    }
    return indenter;
}

Period period_of(const Case& settings, const SurfaceDomain& domain) {
    const std::optional<double>& reference = settings.indentation.line_reference;
    switch (settings.indentation.boundary) {
        case Boundary::periodic: return {domain.Lx, domain.Ly};
        case Boundary::periodic_x: return {domain.Lx, kInfinity, reference.value_or(domain.Ly)};
        case Boundary::periodic_y: return {kInfinity, domain.Ly, reference.value_or(domain.Lx)};
        case Boundary::free: break;
    }
    return {};
}

std::unique_ptr<Path> make_contact(const SurfaceModel& model, const Indenter& indenter,
                                   const SolverOptions& options) {
    if (model.points) return make_element_contact(*model.points, indenter, options);
    return make_asperity_contact(model.asperities, indenter, options);
}

double sigma_of(const Case& settings, const SurfaceDomain& domain) {
    return settings.surface.sigma.value_or(domain.sigma);
}

LawKind law_of(const Case& settings, const SurfaceFacts& surface) {
    const LawKind law = settings.asperities.law;
    return law == LawKind::fourth_order ? surface.richest_law : law;
}

SolverOptions solver_of(const Case& settings, const SurfaceDomain& domain) {
    SolverOptions options;
    options.method = settings.solver.method;
    options.law = law_of(settings, domain);
    options.physics = physics_of(settings);
    options.interaction = settings.solver.interaction;
    options.selection = settings.indentation.selection;
    options.selection_factor = settings.indentation.selection_factor;
    options.surface = domain;
    options.surface.sigma = sigma_of(settings, domain);
    options.tolerance = settings.solver.tolerance;
    options.max_iterations = settings.solver.max_iterations;
    options.delta0 = settings.solver.delta0;
    const bool free = settings.indentation.boundary != Boundary::periodic;
    options.surface.measured = domain.measured || !settings.indenter.file.empty();
    if (!free) options.surface.marks = nullptr;
    if (!domain.guessed && free)
        options.surface.extent = {domain.x0, domain.y0, domain.Lx, domain.Ly};
    if (!(options.surface.sigma > 0) &&
        (options.method == Method::dgesv || options.selection == Selection::paper)) {
        bad_input(
            "surface%sigma: needed by solver%method = 'dgesv' and indentation%selection = 'paper', "
            "and the "
            "asperities, which all have the same height, do not give one");
    }
    return options;
}

}  // namespace rsc
