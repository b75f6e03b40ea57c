// The choice of solver%model = 'auto', from the case alone: asperities where they hold.

#include "case/case.hpp"
#include "case/units.hpp"
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
             c.elements.points_per_wave * self_affine_spectrum(c).L_lambda_s > kLargestGrid,
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

namespace {

// Sampling lengths of ISO 4288 (1996) up to this Ra, and the short cutoff that goes with them by
// ISO 3274 (1996): a drawing's Ra is that of the waves between the two. [m]
struct MeasuredBand {
    double ra, longest, shortest;
};
constexpr MeasuredBand kMeasuredBands[] = {{0.02e-6, 0.08e-3, 2.5e-6},
                                           {0.1e-6, 0.25e-3, 2.5e-6},
                                           {2e-6, 0.8e-3, 2.5e-6},
                                           {10e-6, 2.5e-3, 8e-6},
                                           {kInfinity, 8e-3, 25e-6}};

}  // namespace

std::optional<FinishedSurface> finished_surface(const Case& settings) {
    const Case::Surface& keys = settings.surface;
    if (keys.finish == Finish::none) return {};
    // Rq = Ra sqrt(pi/2) for Gaussian heights.
    const double ratio = std::sqrt(pi / 2), unit = length_factor("m", settings.run.length_unit);
    FinishedSurface made;
    made.sigma = keys.Ra ? *keys.Ra * ratio : keys.sigma.value_or(0.01);
    const MeasuredBand* band = kMeasuredBands;
    while (made.sigma / ratio > band->ra * unit) ++band;
    made.longest = band->longest * unit;
    made.shortest = band->shortest * unit;
    made.hurst = 0.85;
    made.sources =
        "hurst 0.85 +- 0.15: Persson, Tribology Letters 54 (2014) 99, for polished and "
        "sand-blasted "
        "surfaces; wavelengths: the band in which Ra is measured, ISO 4288 and ISO 3274; Gaussian, "
        "isotropic heights";
    return made;
}

Spectrum self_affine_spectrum(const Case& settings) {
    const Case::Surface& keys = settings.surface;
    if (const auto made = finished_surface(settings)) {
        const double L = keys.L.value_or(4 * made->longest);
        return {L,
                made->hurst,
                L / made->longest,
                L / made->shortest,
                keys.plateau,
                made->sigma,
                keys.aspect,
                keys.direction,
                {keys.skewness, keys.kurtosis}};
    }
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
    if (reads_heights(c)) return {ModelKind::elements, "the heights are read from a file"};
    for (const Physics* p : physics_asked(c))
        if (const char* const why = p->needs_elements ? p->needs_elements(c) : ""; *why)
            return {ModelKind::elements, why};
    if (least_stated_error(c.asperities.law) > kAcceptableError)
        return {ModelKind::elements,
                "they are the more accurate model; asperities, whose stated error of N is above "
                "5 % at every level, are faster"};
    return {ModelKind::asperities, "their stated error of N is at most 5 %"};
}

}  // namespace rsc
