#include "io/result.hpp"

#include "base/error.hpp"
#include "contact/quantities.hpp"
#include "io/input_netcdf.hpp"
#include "physics/physics.hpp"

namespace rsc {

Contacts contacts_kept(const Case& c) {
    const bool one = c.run.realizations == 1;
    if (!one && (c.output.contacts == Contacts::last || c.output.contacts == Contacts::all))
        bad_input(
            "&output contacts: contacts are stored for one realization only, and this case has ",
            c.run.realizations, "; use contacts='none' or 'auto', or realizations=1");
    if (!one && c.output.heights)
        bad_input(
            "&output heights: heights are stored for one realization only, and this case has ",
            c.run.realizations, "; use heights=.false. or realizations=1");
    if (!one && !c.output.fields.empty())
        bad_input("&output fields: fields are stored for one realization only, and this case has ",
                  c.run.realizations);
    if (c.output.contacts != Contacts::automatic) return c.output.contacts;
    return one ? Contacts::all : Contacts::none;
}

ObserveOptions observe_options(const Case& c, const Domain& domain, const Indenter& indenter,
                               double sigma, double sqrt_m4) {
    ObserveOptions options;
    options.tip_x = indenter.x0;
    options.tip_y = indenter.y0;
    options.map = make_map_grid(domain.x0, domain.y0, domain.Lx, domain.Ly, c.output.map_cells);
    // two flats have no centre
    options.radial_bins = indenter.period.finite() ? 0 : c.output.radial_bins;
    if (c.output.pdf_levels.empty() || !(sigma > 0) || !(sqrt_m4 > 0))
        return options;  // no length scale for the ranges: no distributions
    for (double level : c.output.pdf_levels) options.pdf_levels.push_back(level * sigma);
    // radii down to a quarter of 1/sqrt(m4): nearly all (Nayak's density of curvatures)
    constexpr double sharpest = 4;
    const double hardest = largest_pressure(c, 1 / (sharpest * sqrt_m4));
    options.pdf = make_pdf_bins(c.output.pdf_bins, indenter.E_star, sigma, sqrt_m4, 1.1 * hardest);
    // Two rough flats are at most some four rms heights apart on either side of the mean.
    if (by_elements(c) && indenter.period.finite()) options.pdf.gap_max = 8 * sigma;
    return options;
}

double typical_sqrt_m4(const Asperities& asperities) {
    double sum = 0;
    for (double r : asperities.radius) sum += r;
    return sum > 0 ? 0.9 * double(asperities.size()) / sum : 0;
}

Result make_result(const Case& c, std::string case_text, const Indenter& indenter, double sigma,
                   std::optional<Moments> theory, Observations observations) {
    Result result;
    result.settings = c;
    result.case_text = std::move(case_text);
    result.indenter = indenter;
    result.sigma = sigma > 0 ? sigma : kNotComputed;
    result.theory = theory;
    result.observations = std::move(observations);
    return result;
}

void keep_contacts(Result& result, std::vector<Level>& levels, Contacts keep) {
    const bool yields = std::isfinite(largest_pressure(result.settings));
    PackedContacts packed;
    if (keep == Contacts::none || keep == Contacts::automatic) return;
    for (const auto s : indices(levels)) {
        Level& level = levels[s];
        const bool stored = keep == Contacts::all || s + 1 == levels.size();
        const std::size_t count = stored ? level.asperity.size() : 0;
        if (packed.force.size() + count > at(std::numeric_limits<std::int32_t>::max()))
            bad_input(
                "&output contacts: too many contacts for the indices of the result file; use "
                "contacts='last' or 'none'");
        packed.start.push_back(std::int32_t(packed.force.size()));
        packed.count.push_back(std::int32_t(count));
        if (!stored) continue;
        if (level.pixels.index.empty()) {
            append(packed.asperity, level.asperity);
        } else {
            append(packed.x, level.x);
            append(packed.y, level.y);
        }
        append(packed.force, level.f);
        append(packed.radius, level.a);
        for (const Spot& spot : level.spots) {
            packed.spot_x.push_back(spot.x);
            packed.spot_y.push_back(spot.y);
            packed.major.push_back(spot.major);
            packed.minor.push_back(spot.minor);
            packed.angle.push_back(spot.angle);
        }
        if (yields) append(packed.yields, level.yields);
        result.pixels.resize(levels.size());
        result.pixels[s] = std::move(level.pixels);
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
    const auto n = double(surfaces.size());
    return {mean.m0 / n,
            mean.m2 / n,
            mean.m4 / n,
            {},
            {}};  // NaN without surfaces, and if a surface lacks them
}

namespace {

// Variables of known shapes.
class Columns : public NetcdfInput {
public:
    using NetcdfInput::NetcdfInput;

    // Missing values are NaN.
    std::vector<double> values(const std::string& name,
                               const std::vector<std::size_t>& lengths) const {
        const std::optional<Variable> variable = find(name);
        if (!variable) refuse("it has no variable ", name, ", which is needed to merge campaigns");
        if (variable->lengths != lengths)
            refuse("variable ", variable->shape(), " does not have the shape given by its case");
        std::vector<double> values(variable->count());
        read(*variable, values.data(), true);
        return values;
    }
    std::size_t length(const std::string& name) const {
        const std::optional<Variable> variable = find(name);
        if (!variable || variable->lengths.size() != 1) refuse("it has no list ", name);
        return variable->lengths.front();
    }
    [[noreturn]] void refuse(const auto&... why) const { bad_input("'", path(), "': ", why...); }
};

// Both axes depend on the surface, which may differ if it was read from a file.
void require_same_axes(const Columns& file, const ObserveOptions& options) {
    const auto require = [&](const std::string& name, std::size_t count, double first) {
        if (file.values(name, {count}).front() != first)
            file.refuse(
                name,
                " begins at another value than the case gives: the surfaces were not the same");
    };
    require("x", at(options.map.nx), options.map.x(0));
    require("y", at(options.map.ny), options.map.y(0));
    if (options.pdf_levels.empty()) return;
    require("pressure_mean_bin", at(options.pdf.bins), 0.5 * options.pdf.mean_pressure_width());
    require("spot_area_bin", at(options.pdf.bins), 0.5 * options.pdf.area_width());
}

void read_levels(const Columns& file, Accumulators& sums) {
    const std::size_t count = sums.realization.size(), steps = sums.steps;
    sums.rows.resize(count * steps);
    const auto known = file.find("separation");
    const bool of_each = known && known->lengths.size() == 2;
    const std::vector<double> separation =
        file.values("separation", of_each ? std::vector<std::size_t>{count, steps}
                                          : std::vector<std::size_t>{steps});
    for (const auto k : indices(sums.rows))
        sums.rows[k].separation = separation[of_each ? k : k % steps];
    for (const LevelQuantity& q : level_quantities()) {
        if (q.separate || (!file.find(q.name) && !q.always)) continue;  // no level has it
        const std::size_t parts = q.components();
        std::vector<std::size_t> lengths{count, steps};
        if (q.of_step) lengths = {steps};
        if (parts > 1) lengths.push_back(parts);
        const std::vector<double> values = file.values(q.name, lengths);
        for (const auto k : indices(sums.rows))
            for (const auto c : indices(parts))
                q.put(sums.rows[k], values[(q.of_step ? k % steps : k) * parts + c], c);
        if (q.error_member || !file.find(q.error_name())) continue;
        const std::vector<double> errors = file.values(q.error_name(), lengths);
        for (const auto k : indices(errors))
            sums.rows[k / parts].errors[q.slot + k % parts] = errors[k];
    }
}

void read_surfaces(const Columns& file, Accumulators& sums) {
    sums.surface.resize(sums.realization.size());
    using S = SurfaceStatistics;
    const auto read = [&](const char* name, auto member) {
        const std::vector<double> values = file.values(name, {sums.surface.size()});
        for (const auto k : indices(values)) {
            auto& to = std::invoke(member, sums.surface[k]);
            to = static_cast<std::decay_t<decltype(to)>>(values[k]);
        }
    };
    for (const auto& [name, member] : {std::pair{"sigma", &S::sigma},
                                       {"m2", &S::m2},
                                       {"m4", &S::m4},
                                       {"m2_grid", &S::m2_grid},
                                       {"m4_grid", &S::m4_grid},
                                       {"mean_kappa_g", &S::mean_kappa_g},
                                       {"mean_kappa_a", &S::mean_kappa_a}})
        read(name, member);
    for (const auto& [name, of] : kMomentComponents)
        read(name, [m = of](S& s) -> double& { return s.tensor.*m; });
    if (file.find("skewness")) {
        read("skewness", &S::skewness);
        read("kurtosis", &S::kurtosis);
    }
    if (!file.find("summits")) return;  // elements do not search for summits
    read("summits", &S::summits);
    read("saddles", &S::saddles);
}

// Each variable holds its curve of all levels, the sums all curves of each level.
void read_curves(const Columns& file, Accumulators& sums) {
    const std::size_t each = values_of(sums.options.curves);
    sums.curves.resize(sums.rows.size() * each, kNotComputed);
    std::size_t first = 0;
    for (const AskedCurves& asked : sums.options.curves)
        for (const LevelCurve& curve : asked.physics->curves) {
            const std::size_t n = curve.count(asked.axis);
            std::vector<std::size_t> lengths{sums.realization.size(), sums.steps};
            if (curve.along || curve.repeated) lengths.push_back(n / at(curve.components));
            if (curve.components > 1) lengths.push_back(at(curve.components));
            if (asked.axis.size > 0 && (file.find(curve.name) || !curve.if_known)) {
                const std::vector<double> values = file.values(curve.name, lengths);
                for (const auto k : indices(values))
                    sums.curves[k / n * each + first + k % n] = values[k];
            }
            first += asked.axis.size > 0 ? n : 0;
        }
}

void read_distributions(const Columns& file, Accumulators& sums) {
    const std::size_t levels = sums.distributions.size();
    if (levels == 0) return;
    const std::vector<double> step = file.values("pdf_step", {levels});
    Distributions one = rounded({}, sums.options.pdf, 0);
    std::size_t count = 0;
    for_each_number(one, [&count](double) { ++count; });
    const std::vector<double> numbers = file.values("pdf_sums", {levels, count});
    for (const auto d : indices(levels)) {
        sums.distributions[d].step = std::int32_t(step[d]) - 1;
        for (std::size_t k = d * count; k < (d + 1) * count; ++k)
            sums.distributions[d].numbers.push_back(numbers[k]);
    }
}

}  // namespace

Accumulators read_sums(const std::string& path, const ObserveOptions& options, std::size_t steps) {
    const Columns file(path);
    Accumulators sums(options, steps);
    for (const double number : file.values("realization", {file.length("realization")}))
        sums.realization.push_back(std::int64_t(number));
    require_same_axes(file, options);
    read_levels(file, sums);
    read_surfaces(file, sums);
    read_curves(file, sums);
    const std::vector<std::size_t> lengths{steps, at(options.map.ny), at(options.map.nx)};
    const std::vector<double> area = file.values("map_area_fraction", lengths);
    const std::vector<double> pressure = file.values("map_pressure", lengths);
    const auto cells = at(options.map.cells());
    for (const auto s : indices(steps))
        sums.restore_map(s, std::span(area).subspan(s * cells, cells),
                         std::span(pressure).subspan(s * cells, cells));
    read_distributions(file, sums);
    return sums;
}

std::optional<LevelCount> count_levels(const std::string& path) {
    const Columns file(path);
    const auto status = file.find("status");
    if (!status) return {};
    const std::vector<double> values = file.values("status", status->lengths);
    const auto failed = std::ranges::count(values, double(LevelStatus::not_converged));
    return LevelCount{long(values.size()), long(failed)};
}

}  // namespace rsc
