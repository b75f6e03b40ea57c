#include "contact/expected_error.hpp"

#include "contact/expected_error_table.hpp"

namespace rsc {
namespace {

using Predictors = std::array<double, kErrorPredictors + 1>;  // the first is 1

// In the order of the table; the same as in input/trust/trust.py.
constexpr const char* kCauses[kErrorPredictors + 1] = {
    "",
    "the slope of the indenter at the contacts, which touches other points than summits (slope_ratio)",
    "contacts beyond the validity of the contact law (beyond_law)",
    "spots that overlap (overlapping_pairs)",
    "elongated summits",
    "the size of the contacts relative to the spacing of the summits",
    "few contacts",
    "few points in the shortest wave",
    "contacts that yield",
    "two flats",
};

Predictors predictors(const Level& level, const Asperities& asperities, const Indenter& indenter, const SolverOptions& options) {
    const double contacts = level.contacts;
    double elongation = 0, radius = 0, force = 0;
    for (std::size_t k = 0; k < level.asperity.size(); ++k) {
        const auto i = static_cast<std::size_t>(level.asperity[k]);
        const double ratio = asperities.kappa1.empty() ? 1.0 : asperities.kappa1[i] / asperities.kappa2[i];
        elongation += level.f[k] * std::log(std::min(ratio, 1e3));
        radius += level.f[k] * level.a[k];
        force += level.f[k];
    }
    const double slope = std::isnan(level.slope_ratio) ? 0.0 : std::min(level.slope_ratio / 0.2, 50.0);
    return {1.0,
            std::log1p(slope * slope),
            static_cast<double>(level.beyond_law) / contacts,
            std::log1p(static_cast<double>(level.overlapping_pairs) / contacts),
            elongation / force,
            std::log(std::max(radius / force / options.mean_spacing, 1e-3)),
            1 / std::sqrt(contacts),
            options.points_per_wave > 0 ? std::min(4 / options.points_per_wave, 1.5) : 1.0,
            level.plastic_contacts / contacts,
            indenter.period.finite() ? 1.0 : 0.0};
}

}  // namespace

const char* error_cause(std::int32_t cause) { return kCauses[cause]; }

void expect_error(Level& level, const Asperities& asperities, const Indenter& indenter, const SolverOptions& options) {
    if (level.contacts == 0 || !(level.force > 0) || options.interaction == Interaction::none || options.selection == Selection::paper ||
        !(options.mean_spacing > 0))
        return;
    const Predictors x = predictors(level, asperities, indenter, options);
    const auto bound = [&](const double(&coefficients)[kErrorPredictors + 1]) {
        double sum = 0;
        for (std::size_t k = 0; k < x.size(); ++k) sum += coefficients[k] * x[k];
        return std::clamp(std::exp(sum), kLeastError, kMostError);
    };
    const auto& [of_force, of_area] = kErrorTable[static_cast<std::size_t>(options.law)];
    level.force_error_expected = bound(of_force);
    level.area_error_expected = bound(of_area);
    // Of each predictor, what it adds above the most favourable value it has.
    double most = 0;
    for (std::size_t k = 1; k < x.size(); ++k) {
        const double least = of_force[k] > 0 && k == 5 ? std::log(1e-2) : 0.0;
        if (const double part = of_force[k] * (x[k] - least); part > most) most = part, level.error_cause = static_cast<std::int32_t>(k);
    }
}

}  // namespace rsc
