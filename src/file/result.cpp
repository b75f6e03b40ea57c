#include "file/result.hpp"

#include <cmath>

#include <limits>
#include <utility>

#include "error.hpp"

namespace rsc {

Contacts contacts_kept(const Case& c) {
    const bool one = c.run.realizations == 1;
    if (!one && (c.output.contacts == Contacts::last || c.output.contacts == Contacts::all))
        throw Error(Failure::bad_input, "&output contacts: contacts are kept for one realization only, and this case has " +
                                            std::to_string(c.run.realizations) + "; use contacts='none' or 'auto', or realizations=1");
    if (!one && c.output.heights)
        throw Error(Failure::bad_input, "&output heights: heights are kept for one realization only, and this case has " +
                                            std::to_string(c.run.realizations) + "; use heights=.false. or realizations=1");
    if (c.output.contacts != Contacts::automatic) return c.output.contacts;
    return one ? Contacts::all : Contacts::none;
}

ObserveOptions observe_options(const Case& c, const Domain& domain, const Indenter& indenter, double sigma, double sqrt_m4) {
    ObserveOptions options;
    options.tip_x = indenter.x0;
    options.tip_y = indenter.y0;
    options.map = make_map_grid(domain.x0, domain.y0, domain.Lx, domain.Ly, c.output.map_cells);
    options.radial_bins = indenter.period.finite() ? 0 : c.output.radial_bins;  // two flats have no centre
    if (c.output.pdf_levels.empty() || !(sigma > 0) || !(sqrt_m4 > 0))
        return options;  // nothing to measure the ranges by: no distributions
    for (double level : c.output.pdf_levels) options.pdf_levels.push_back(level * sigma);
    constexpr double sharpest = 4;  // radii down to a quarter of 1/sqrt(m4): nearly all (Nayak's density of curvatures)
    const double hardest = c.solids.hardness * std::sqrt(1 + sharpest * c.solids.size_effect * sqrt_m4);
    options.pdf = make_pdf_bins(c.output.pdf_bins, indenter.E_star, sigma, sqrt_m4, 1.1 * hardest);
    return options;
}

double typical_sqrt_m4(const Asperities& asperities) {
    double sum = 0;
    for (double r : asperities.radius) sum += r;
    return sum > 0 ? 0.9 * static_cast<double>(asperities.size()) / sum : 0;
}

Result make_result(const Case& c, std::string case_text, const Indenter& indenter, double sigma, std::optional<Moments> theory,
                   Observations observations) {
    Result result;
    result.title = c.run.title;
    result.case_text = std::move(case_text);
    result.length_unit = c.run.length_unit;
    result.force_unit = c.run.force_unit;
    result.seed = c.run.seed;
    result.force_control = c.indentation.control != Control::separation;
    result.path_dependent = std::isfinite(c.solids.hardness);
    result.indenter = indenter;
    result.sigma = sigma > 0 ? sigma : kAbsent;
    result.theory = theory;
    result.observations = std::move(observations);
    return result;
}

void keep_contacts(Result& result, const std::vector<Level>& levels, Contacts keep) {
    PackedContacts packed;
    if (keep == Contacts::none || keep == Contacts::automatic) {
        result.contacts = packed;
        return;
    }
    for (std::size_t s = 0; s < levels.size(); ++s) {
        const Level& level = levels[s];
        const bool kept = keep == Contacts::all || s + 1 == levels.size();
        const std::size_t count = kept ? level.asperity.size() : 0;
        if (packed.force.size() + count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
            throw Error(Failure::bad_input,
                        "&output contacts: more contacts than the result file can number; use contacts='last' or 'none'");
        packed.start.push_back(static_cast<std::int32_t>(packed.force.size()));
        packed.count.push_back(static_cast<std::int32_t>(count));
        if (!kept) continue;
        if (level.pixels.index.empty()) {
            packed.asperity.insert(packed.asperity.end(), level.asperity.begin(), level.asperity.end());
        } else {
            packed.x.insert(packed.x.end(), level.x.begin(), level.x.end());
            packed.y.insert(packed.y.end(), level.y.begin(), level.y.end());
        }
        packed.force.insert(packed.force.end(), level.f.begin(), level.f.end());
        packed.radius.insert(packed.radius.end(), level.a.begin(), level.a.end());
        if (result.path_dependent) packed.yields.insert(packed.yields.end(), level.yields.begin(), level.yields.end());
    }
    result.contacts = std::move(packed);
}

Moments regime_moments(const Result& result) {
    if (result.theory) return *result.theory;
    const auto& surfaces = result.observations.surface;
    Moments mean;
    for (const SurfaceStatistics& s : surfaces) {
        mean.m0 += s.sigma * s.sigma;
        mean.m2 += s.m2;
        mean.m4 += s.m4;
    }
    const auto n = static_cast<double>(surfaces.size());
    return {mean.m0 / n, mean.m2 / n, mean.m4 / n, {}, {}};  // NaN for no surface, and when one lacks them
}

}  // namespace rsc
