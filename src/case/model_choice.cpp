// The choice of solver%model = 'auto', from the case alone: asperities where they hold.

#include "case/case.hpp"
#include "physics/physics.hpp"
#include "surface/spectrum.hpp"
#include "trust/asperity_error.hpp"

namespace rsc {
namespace {

// Asperities whose stated error of N is larger at every level are no choice of `auto`.
constexpr double kAcceptableError = 0.05;

// Largest grid of elements, in points a side.
constexpr double kLargestGrid = 32768;

// Why the case cannot be solved by elements, or asks for what only asperities have; empty if not.
const char* why_asperities(const Case& c) {
    const std::pair<bool, const char*> reasons[] = {
        {c.surface.source == Source::asperities, "only asperities are given"},
        {c.compare.listed(), "compare%levels compares them with elements"},
        {c.solver.method != Method::automatic, "solver%method needs them"},
        {c.solver.interaction != Interaction::point, "solver%interaction needs them"},
        {c.indentation.selection != Selection::overlap, "indentation%selection needs them"},
        {c.surface.source == Source::synthetic &&
             c.elements.points_per_wave * c.surface.L_lambda_s > kLargestGrid,
         "elements would need more than 32768 points a side"},
    };
    for (const Physics* p : physics_asked(c))
        if (const char* const why = p->needs_asperities ? p->needs_asperities(c) : ""; *why)
            return why;
    for (const auto& [holds, why] : reasons)
        if (holds) return why;
    return "";
}

}  // namespace

Spectrum self_affine_spectrum(const Case& settings) {
    const Case::Surface& keys = settings.surface;
    return {keys.L.value_or(1.0), keys.hurst,     keys.L_lambda_l,
            keys.L_lambda_s,      keys.plateau,   keys.sigma.value_or(0.01),
            keys.aspect,          keys.direction, {keys.skewness, keys.kurtosis}};
}

GapRadii gap_radii(const Case& c) {
    const auto& [R, radii] = std::tie(c.solids.R, c.indenter.radii);
    GapRadii gap{{{R[0], radii[0].value_or(R[1])}, {R[0], radii[1].value_or(R[1])}},
                 c.indenter.angle};
    if (!c.indentation.line()) return gap;
    const int along = std::isinf(gap.R[1][1]) ? 1 : 0;
    gap.R[along][0] = kInfinity;
    if (std::isinf(gap.R[0][1]) && std::isinf(gap.R[1][1]))  // body 2 is flat, in any direction
        gap.angle = c.indentation.boundary == Boundary::periodic_x ? 90 : 0;
    return gap;
}

ModelChoice model_of(const Case& c) {
    if (c.solver.model != ModelKind::automatic) return {c.solver.model};
    if (c.indentation.line()) return {ModelKind::elements, "line contact needs them"};
    if (const char* why = why_asperities(c); *why) return {ModelKind::asperities, why};
    if (c.surface.source == Source::heights)
        return {ModelKind::elements, "the heights are read from a file"};
    for (const Physics* p : physics_asked(c))
        if (const char* const why = p->needs_elements ? p->needs_elements(c) : ""; *why)
            return {ModelKind::elements, why};
    if (least_stated_error(c.asperities.law) > kAcceptableError)
        return {ModelKind::elements,
                "asperities have a stated error of N above 5 % at every level; for many levels or "
                "realizations they are faster: solver%model = 'asperities'"};
    return {ModelKind::asperities, "their stated error of N is at most 5 %"};
}

}  // namespace rsc
