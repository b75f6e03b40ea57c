// The choice of solver%model = 'auto', from the case alone: asperities where they hold.

#include "base/error.hpp"
#include "case/case.hpp"
#include "contact/equivalent.hpp"
#include "physics/indenter/shapes.hpp"
#include "physics/physics.hpp"
#include "surface/spectrum.hpp"

namespace rsc {
namespace {

// Summits stand for a surface under an indenter whose slope at the contacts is at most this part of
// the rms slope of the surface: beyond it, contacts lie on flanks between the summits.
constexpr double kLargestSlopeRatio = 0.2;

// The same limit for two flats. The pressure in the middle of a smooth contact is p0 = (2/pi) E*
// a/R, and a/R is the slope of the indenter at its border.
constexpr double kLargestPressureRatio = 2 / std::numbers::pi * kLargestSlopeRatio;

// Largest grid of elements, in points a side.
constexpr double kLargestGrid = 32768;

std::vector<double> levels_of(const Case::Indentation& keys) {
    return keys.levels.empty() ? std::vector<double>{keys.start, keys.stop} : keys.levels;
}

// E* of the softest body that the case contains: that of the softest layer or of the base, after
// all relaxation [force/length^2].
double softest_modulus(const Case::Solids& solids) {
    double E[2] = {solids.E[0], solids.E[1]}, nu[2] = {solids.nu[0], solids.nu[1]};
    double softest = equivalent_modulus(E, nu);
    for (const auto k : indices(solids.layer_E)) {
        E[0] = solids.layer_E[k];
        nu[0] = solids.layer_nu[k];
        softest = std::min(softest, equivalent_modulus(E, nu));
    }
    const auto& share = solids.relaxation_share;
    return softest * (1 - sum_of(share));
}

// Radius of a round indenter, the smaller one of a paraboloid; nothing for other shapes.
std::optional<double> radius_of(const Case& c) {
    const std::string_view shape = kShapes[at(c.indenter.shape)].name;
    if (shape == "sphere") return equivalent_radius(c.solids.R);
    if (shape != "paraboloid") return std::nullopt;
    const GapRadii gap = gap_radii(c);
    return std::min(equivalent_radius(gap.R[0]), equivalent_radius(gap.R[1]));
}

// Height of the highest of n independent Gaussian summits, over the rms height.
double highest_of(double n) { return std::sqrt(2 * std::log(std::max(n, 2.0))); }

// Largest slope of a ball of radius R where it may touch a surface whose highest summits are at
// `top` above the mean plane. By separation, the ball reaches down to Z0. By force N, the border of
// the contact is where the deflected surface, u = a^2/2R at Hertz's radius a, still reaches it.
double slope_at_border(const Case& c, double R, double top) {
    const std::vector<double> levels = levels_of(c.indentation);
    if (c.indentation.control == Control::separation) {
        const double unit =
            c.indentation.unit == LevelUnit::sigma ? c.surface.sigma.value_or(0.01) : 1.0;
        const double lowest = std::ranges::min(levels) * unit;
        return std::sqrt(2 * std::max(top - lowest, 0.0) / R);
    }
    const double N = std::ranges::max(levels);
    const double a = std::cbrt(0.75 * N * R / softest_modulus(c.solids));
    return std::sqrt(a * a + 2 * R * top) / R;
}

// Nominal pressure of two flats over E* times the rms slope. By separation it is not known, but the
// share of the surface above the separation is at least the contact area, A/A0 = erf(sqrt(2) p)
// (Persson): the pressure that would belong to this area.
double pressure_ratio(const Case& c, const Spectrum& spectrum, double rms_slope) {
    const std::vector<double> levels = levels_of(c.indentation);
    const double largest = std::ranges::max(levels);
    if (c.indentation.control == Control::separation) {
        const double unit = c.indentation.unit == LevelUnit::sigma ? 1.0 : spectrum.sigma;
        const double lowest = std::ranges::min(levels) / unit;
        const double share = 0.5 * std::erfc(lowest / std::numbers::sqrt2);
        return share / (2 * std::sqrt(2 / std::numbers::pi));  // of small pressures
    }
    if (c.indentation.control == Control::pressure && c.indentation.unit == LevelUnit::relative)
        return largest;
    const double p =
        c.indentation.control == Control::force ? largest / (spectrum.L * spectrum.L) : largest;
    return p / (softest_modulus(c.solids) * rms_slope);
}

// Why asperities do not hold for a synthetic surface; empty if they do.
const char* why_elements(const Case& c) {
    const std::optional<double> R = radius_of(c);
    if (!R) return "asperities hold under spheres, paraboloids and flats only";
    const Spectrum spectrum = self_affine_spectrum(c);
    if (spectrum.directional() || !spectrum.gaussian())
        return "the asperities of a surface that has a lay, or is not Gaussian, are no spheres";
    const Moments moments = theoretical_moments(spectrum);
    const double density = moments.summit_density();
    // A contact of asperities may be as wide as a quarter of their mean spacing, and a fifth of the
    // thickness of a layer.
    if (!c.solids.layer_thickness.empty() &&
        c.solids.layer_thickness[0] < 1.25 / std::sqrt(density))
        return "the layer is thin compared with the spacing of asperities";
    if (std::isinf(*R)) {
        return pressure_ratio(c, spectrum, moments.rms_slope()) > kLargestPressureRatio
                   ? "the surfaces come too close for asperities"
                   : "";
    }
    const double top = spectrum.sigma * highest_of(density * spectrum.L * spectrum.L);
    return slope_at_border(c, *R, top) > kLargestSlopeRatio * moments.rms_slope()
               ? "the slope of the indenter at the border of the contact is more than 0.2 of the "
                 "rms slope of the surface"
               : "";
}

// Why the case cannot be solved by elements, or asks for what only asperities have; empty if not.
const char* why_asperities(const Case& c) {
    const std::pair<bool, const char*> reasons[] = {
        {c.surface.source == Source::asperities, "only asperities are given"},
        {c.surface.source == Source::spectrum, "the surface is synthetic"},
        {c.compare.listed(), "compare%levels compares them with elements"},
        {c.asperities.law != LawKind::hertz || c.asperities.curvature != Curvature::geometric,
         "&asperities is set"},
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
    if (c.output.flow) return {ModelKind::elements, "output%flow needs them"};
    try {
        if (const char* why = why_elements(c); *why) return {ModelKind::elements, why};
    } catch (const Error&) {
        // The case contradicts itself; the checks of its keys say where.
    }
    return {ModelKind::asperities, "the surface is synthetic, and its asperities hold"};
}

}  // namespace rsc
