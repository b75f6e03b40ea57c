// The second half of the table: maps, radial means, distributions, asperities, contacts, heights.
#include <netcdf.h>

#include "io/netcdf_table.hpp"
#include "observe/regimes.hpp"
#include "physics/physics.hpp"

namespace rsc {
namespace {

using Shown = ShownDistributions;

// Moments as attributes with one value for each pdf_level. NaN becomes the fill value, as in a
// variable.
NetcdfAttributes moments_of(const std::vector<Shown>& distributions,
                            DistributionMoments Shown::*moments) {
    using M = DistributionMoments;
    NetcdfAttributes attributes;
    for (const auto& [name, number] : {std::pair("mean", &M::mean),
                                       {"standard_deviation", &M::deviation},
                                       {"skewness", &M::skewness},
                                       {"kurtosis", &M::kurtosis}}) {
        std::vector<double> values;
        for (const Shown& f : distributions)
            values.push_back(std::isnan(f.*moments.*number) ? NC_FILL_DOUBLE : f.*moments.*number);
        attributes.push_back({name, values});
    }
    return attributes;
}

}  // namespace

void ResultTable::maps() {
    const MapGrid& g = o_.options.map;
    add_axis("y", unit(1), "y of the cell centres; the last row may extend beyond the surface",
             each_of(g.ny, [&](int j) { return g.y(j); }),
             {{"axis", "Y"}, {"share_of_last_row", g.last_row}});
    add_axis("x", unit(1), "x of the cell centres", each_of(g.nx, [&](int i) { return g.x(i); }),
             {{"axis", "X"}});
    add("map_cell_side", unit(1), "side of the square cells of the map, w", g.side);
    const Names dims{"step", "y", "x"};
    const auto add_map = [&](const char* name, const std::string& units, const char* meaning,
                             const SparseMaps& map, const char* note) {
        file_.variable({name, dims, units, meaning,
                        RowFiller([&map](std::size_t s, auto cells) { map.fill(s, cells); }),
                        comment(note), false});
    };
    add_map("map_area_fraction", "1", "contact area over cell area, mean over realizations",
            o_.map_area_fraction,
            "A' = sum of pi a^2/w^2 over the asperities in the cell; above 1 where a spot is "
            "larger than the cell of its centre");
    add_map("map_pressure", unit(-2, 1), "force over cell area, mean over realizations",
            o_.map_pressure,
            "p = sum of f/w^2 over the asperities in the cell, also of those that attract without "
            "contact");
}

void ResultTable::radial() {
    if (o_.radii.empty()) return;  // the tip is not above the map
    add_axis(
        "radius", unit(1), "distance from the tip", o_.radii,
        comment(
            "middles of rings of equal width, from the tip to the largest circle on the surface"));
    const Names dims{"step", "radius"};
    const std::string how =
        "mean over the circle of the map, interpolated by bicubic Bezier patches between cell "
        "centres; it may be negative beside empty cells";
    add("radial_area_fraction", dims, "1", "area fraction about the tip", o_.radial_area_fraction,
        comment(how));
    add("radial_pressure", dims, unit(-2, 1), "pressure about the tip", o_.radial_pressure,
        comment(how));
    if (!has_closed_forms(r_.settings)) return;
    std::vector<double> hertz;
    const double R = r_.indenter.shape->hertz_radius();
    for (double N : o_.force.mean)
        for (double r : o_.radii)
            hertz.push_back(std::isfinite(R) && N >= 0
                                ? hertz_contact(N, R, r_.indenter.E_star).pressure(r)
                                : kNotComputed);
    add_absent("hertz_pressure", dims, unit(-2, 1),
               "pressure of the smooth sphere at force_mean (Hertz)", hertz,
               "p0 sqrt(1 - r^2/a^2), p0 = 3 N/(2 pi a^2); missing for two flats and for shapes "
               "other than spheres");
}

void ResultTable::bin_axis(const std::string& name, const std::string& units,
                           const std::string& long_name, double width) {
    add(name, {"bin"}, units, long_name,
        each_of(o_.options.pdf.bins, [&](int b) { return (b + 0.5) * width; }),
        {{"bin_width", width}});
}

void ResultTable::distributions() {
    if (o_.distributions.empty()) return;
    std::vector<double> requested, used;
    std::vector<std::int32_t> step;
    for (double level : o_.options.pdf_levels) requested.push_back(level / r_.sigma);
    for (const ShownDistributions& f : o_.distributions) {
        used.push_back(f.sum.separation / double(f.sum.levels) / r_.sigma);
        step.push_back(f.sum.step);
    }
    add_axis("pdf_level", "1", "requested Z0/sigma", requested);
    add("pdf_separation_sigma", {"pdf_level"}, "1",
        "Z0/sigma of the nearest level, to which the distributions belong", used,
        comment("mean over realizations under force control"));
    add("pdf_step", {"pdf_level"}, "1", "number of that level", from_one(step),
        {kFromOne, {"comment", "0: it differs between realizations (force control)"}});
    add_axis("bin", "1", "number of the bin", one_to(at(o_.options.pdf.bins)));
    const PdfBins& bins = o_.options.pdf;
    bin_axis("pressure_mean_bin", unit(-2, 1), "middle of the bins of pressure_mean_pdf",
             bins.mean_pressure_width());
    bin_axis("pressure_bin", unit(-2, 1), "middle of the bins of pressure_pdf",
             bins.pressure_width());
    bin_axis("spot_area_bin", unit(2), "middle of the bins of spot_area_pdf", bins.area_width());
    histogram("pressure_mean_count", "pressure_mean_bin", "1",
              "contacts by mean pressure, all realizations", &Distributions::mean_pressure,
              "integers; overflow: contacts");
    density("pressure_mean_pdf", "pressure_mean_bin", unit(2, -1),
            "probability density of the mean pressure of a contact, f/(pi a^2)",
            &Shown::mean_pressure_pdf, &Shown::mean_pressure_moments, {}, "");
    pressure();
    histogram("spot_area_count", "spot_area_bin", "1", "contacts by area, all realizations",
              &Distributions::spot_area, "integers; overflow: contacts");
    density("spot_area_pdf", "spot_area_bin", unit(-2),
            "probability density of the area of a contact, pi a^2", &Shown::spot_area_pdf,
            &Shown::spot_area_moments, {}, "");
    if (bins.gap_max > 0) {
        bin_axis("gap_bin", unit(1), "middle of the bins of gap_pdf", bins.gap_width());
        histogram("gap_count", "gap_bin", "1", "points by the gap, all realizations",
                  &Distributions::gap, "points where the bodies do not touch; overflow: points");
        density("gap_pdf", "gap_bin", unit(-1),
                "probability density of the gap where the bodies do not touch", &Shown::gap_pdf,
                &Shown::gap_moments, {}, "");
    }
    if (o_.realizations == 1) return;
    std::vector<double> sums;
    for (const DistributionSums& level : o_.distribution_sums) append(sums, level.numbers);
    const std::size_t numbers = o_.distribution_sums.front().numbers.size();
    add_axis("pdf_sum", "1", "number of the sum", one_to(numbers));
    add("pdf_sums", {"pdf_level", "pdf_sum"}, "1",
        "sums over realizations from which the distributions are computed", sums,
        comment("in powers of the units of length and force; for rsc --merge and --resume, which "
                "add realizations"));
}

void ResultTable::histogram(const std::string& name, const std::string& axis,
                            const std::string& units, const std::string& long_name,
                            Histogram Distributions::*which, const std::string& note) {
    std::vector<double> values, overflow;
    for (const ShownDistributions& f : o_.distributions) {
        const Histogram& h = f.sum.*which;
        append(values, h.weight);
        overflow.push_back(h.overflow);
    }
    add(name, {"pdf_level", "bin"}, units, long_name, values,
        {{"coordinates", axis},
         {"overflow", overflow},
         {"comment", note + " beyond the last bin, one value for each pdf_level"}});
}

void ResultTable::density(const std::string& name, const std::string& axis,
                          const std::string& units, const std::string& long_name,
                          std::vector<double> Shown::*which, DistributionMoments Shown::*moments,
                          NetcdfAttributes more, const std::string& note) {
    std::vector<double> values;
    for (const Shown& f : o_.distributions) append(values, f.*which);
    NetcdfAttributes all{{"coordinates", axis}};
    append(all, std::move(more));
    append(all, moments_of(o_.distributions, moments));
    append(all, comment(note + "one value of an attribute for each pdf_level; " + kAbsentMeans));
    file_.variable(
        {name, {"pdf_level", "bin"}, units, long_name, std::move(values), std::move(all), true});
}

void ResultTable::pressure() {
    std::vector<double> equal;
    for (const Shown& f : o_.distributions)
        equal.push_back(f.sum.pressure.squares > 0
                            ? f.sum.pressure.total * f.sum.pressure.total / f.sum.pressure.squares
                            : 0);
    histogram("pressure_area", "pressure_bin", unit(2),
              "contact area by pressure, summed over realizations", &Distributions::pressure,
              "overflow: area");
    density("pressure_pdf", "pressure_bin", unit(2, -1),
            "probability density of the pressure at a random point of the contact area",
            &Shown::pressure_pdf, &Shown::pressure_moments, {{"independent_contacts", equal}},
            "each contact contributes 2 p/p0^2 on [0, p0], p0 = 1.5 f/(pi a^2), weighted by its "
            "area; independent_contacts = (sum A)^2/sum A^2; ");
}

void ResultTable::asperities() {
    const Asperities& a = r_.asperities;
    if (a.size() == 0) return;
    file_.dimension("asperity", a.size());
    for (const AsperityColumn& column : kAsperityColumns) {
        const std::vector<double>& values = a.*column.values;
        const std::string units = column.length_power == 0 ? "radian" : unit(column.length_power);
        if (!values.empty())
            add_disorder("asperity_" + std::string(column.name), {"asperity"}, units,
                         column.meaning, values);
    }
    if (!r_.residual_depth.empty())
        add("asperity_residual_depth", {"asperity"}, unit(1),
            "residual depth of the summit without force, after the last level", r_.residual_depth);
}

void ResultTable::contacts() {
    const PackedContacts& c = r_.contacts;
    if (c.start.empty()) return;
    add("contact_start", {"step"}, "1",
        "first contact of the level in the variables of dimension contact", from_one(c.start),
        {kFromOne,
         {"comment",
          "level s has the contacts contact_start(s) to contact_start(s) + contact_count(s) - 1"}});
    add("contact_count", {"step"}, "1", "number of stored contacts of the level", c.count);
    if (c.force.empty()) return;
    file_.dimension("contact", c.force.size());
    if (!c.asperity.empty())
        add("contact_asperity", {"contact"}, "1", "asperity of the contact", from_one(c.asperity),
            {kFromOne});
    for (const ContactColumn& column : kContactColumns) {
        const bool angle = column.length_power == 0 && column.force_power == 0;
        if (!(c.*column.of).empty())
            add_disorder(std::string("contact_") + column.name, {"contact"},
                         angle ? "radian" : unit(column.length_power, column.force_power),
                         column.meaning, c.*column.of, comment(column.comment));
    }
    if (!c.yields.empty())
        add("contact_yields", {"contact"}, "1",
            "1 if the contact yields at this level, 0 if it is elastic", c.yields);
}

// The smallest rectangle that contains the pixels of all levels.
void ResultTable::contact_mask() {
    std::vector<std::int32_t> steps;
    int left = INT32_MAX, right = -1, bottom = INT32_MAX, top = -1;
    for (const auto s : indices(r_.pixels)) {
        const LevelPixels& p = r_.pixels[s];
        if (p.empty()) continue;
        steps.push_back(std::int32_t(s));
        const auto [first, last, lowest, highest] = p.range();
        left = std::min(left, first);
        right = std::max(right, last);
        bottom = std::min(bottom, lowest);
        top = std::max(top, highest);
    }
    if (steps.empty()) return;
    const LevelPixels& grid = r_.pixels[at(steps[0])];
    const int columns = right - left + 1, rows = top - bottom + 1;
    add_axis("mask_step", "1", "number of the level of contact_mask", from_one(steps), {kFromOne});
    add_axis("mask_y", unit(1), "y of the pixels of contact_mask",
             each_of(rows, [&](int j) { return grid.y_of((bottom + j) * grid.columns); }));
    add_axis("mask_x", unit(1), "x of the pixels of contact_mask",
             each_of(columns, [&](int i) { return grid.x_of(left + i); }));
    const double most = largest_pressure(r_.settings);
    const auto fill = [=, this](std::size_t k, std::span<signed char> row) {
        std::ranges::fill(row, static_cast<signed char>(0));
        const LevelPixels& p = r_.pixels[at(steps[k])];
        p.each([&](std::int32_t pixel, double pressure, int contact) {
            const int i = pixel % p.columns - left, j = pixel / p.columns - bottom;
            row[at(j) * at(columns) + at(i)] = contact < 0 ? 3 : pressure >= most ? 2 : 1;
        });
    };
    constexpr std::array<const char*, 4> kinds = {"apart", "contact", "yielding", "attracted"};
    file_.variable({"contact_mask",
                    {"mask_step", "mask_y", "mask_x"},
                    "1",
                    "pixels in contact, at the hardness, or attracted without contact",
                    FlagFiller(fill),
                    flags(kinds)});
}

void ResultTable::residual_profile() {
    const ResidualProfile& p = r_.residual_profile;
    if (p.depth.empty()) return;
    file_.dimension("residual_pixel", p.depth.size());
    const Names dims{"residual_pixel"};
    const std::string points = " of the points of the surface with residual depth";
    add("residual_pixel_x", dims, unit(1), "x" + points, p.x, {{"pixel_size", p.dx}});
    add("residual_pixel_y", dims, unit(1), "y" + points, p.y, {{"pixel_size", p.dy}});
    add("residual_pixel_depth", dims, unit(1), "residual depth without force, after the last level",
        p.depth);
}

void ResultTable::compared() {
    const ComparedLevels& c = r_.compared;
    if (c.levels.empty()) return;
    using C = ComparedLevel;
    file_.dimension("compare", c.levels.size());
    const auto of = [&c]<class T>(T C::*member) {
        std::vector<T> values;
        for (const C& level : c.levels) values.push_back(level.*member);
        return values;
    };
    const Names dims{"compare"};
    const std::string by = " by elements", change = "from its change with the grid",
                      over = "of asperities over that of elements, minus 1";
    add("compare_step", dims, "1", "number of the level that was also solved by elements",
        from_one(of(&C::step)), {kFromOne, {"comment", "of the first realization"}});
    add("compare_separation", dims, unit(1), "separation of that level, Z0", of(&C::separation),
        comment(r_.force_control() ? "of elements at the force of the level" : ""));
    add_absent("compare_force", dims, unit(0, 1), "normal force" + by, of(&C::force));
    add_absent("compare_contact_area", dims, unit(2), "true contact area" + by, of(&C::area));
    add_absent("compare_contact_area_pixels", dims, unit(2),
               "area of the pixels under pressure, without the correction at borders",
               of(&C::area_pixels));
    add("compare_contacts", dims, "1", "number of contacts" + by, of(&C::contacts),
        comment("sets of pixels connected by their sides"));
    add("compare_residual", dims, "1", "residual of the contact conditions", of(&C::residual));
    if (r_.force_control())
        add_absent("separation_error", dims, unit(1),
                   "separation of asperities minus that of elements, at equal force",
                   of(&C::separation_error));
    else
        add_absent("force_error", dims, "1", "force " + over, of(&C::force_error));
    add_absent("compare_force_error_expected", dims, "1",
               "expected relative error of the force of elements", of(&C::force_error_expected),
               change);
    add_absent("compare_area_error_expected", dims, "1",
               "expected relative error of the contact area of elements",
               of(&C::area_error_expected), change);
    add("compare_columns", dims, "1", "points of the elements' grid along x", of(&C::columns));
    add("compare_rows", dims, "1", "points of the elements' grid along y", of(&C::rows));
    add_absent("area_error", dims, "1", "contact area " + over, of(&C::area_error));
    add_absent("contacts_error", dims, "1", "number of contacts " + over, of(&C::contacts_error));
    const LevelPixels& p = c.pixels;
    if (p.index.empty()) return;
    file_.dimension("compare_pixel", p.index.size());
    std::vector<double> x, y;
    for (const auto k : indices(p.index)) {
        x.push_back(p.x(k));
        y.push_back(p.y(k));
    }
    const std::string last = " of the last level compared";
    add("compare_pixel_x", {"compare_pixel"}, unit(1), "x of the pixels under pressure" + last, x,
        {{"pixel_size", p.dx}});
    add("compare_pixel_y", {"compare_pixel"}, unit(1), "y of the pixels under pressure" + last, y,
        {{"pixel_size", p.dy}});
    add("compare_pixel_pressure", {"compare_pixel"}, unit(-2, 1), "pressure on those pixels",
        p.pressure);
}

void ResultTable::heights() {
    if (!r_.heights) return;
    const HeightMap& h = *r_.heights;
    // The dimensions x and y are those of the maps; the heights are on a finer grid.
    add_axis("height_y", unit(1), "y of the points of height",
             each_of(h.ny, [&](int j) { return h.y(j); }));
    add_axis("height_x", unit(1), "x of the points of height",
             each_of(h.nx, [&](int i) { return h.x(i); }));
    file_.variable({"height",
                    {"height_y", "height_x"},
                    unit(1),
                    any_physics(r_.settings, &Physics::reshapes)
                        ? "height of the worn surface after the last level"
                        : "height of the surface",
                    RowFiller([&h](std::size_t j, std::span<double> row) {
                        std::copy_n(h.data.get() + std::ptrdiff_t(j) * h.stride, row.size(),
                                    row.begin());
                    }),
                    comment(h.periodic ? "periodic in x and y" : ""),
                    false});
}

// The curves of the levels, with their axes.
void ResultTable::curves() {
    const std::size_t each = rsc::values_of(o_.options.curves);
    std::size_t first = 0;
    for (const AskedCurves& asked : o_.options.curves) {
        const CurveAxis& axis = asked.axis;
        if (axis.size == 0) continue;
        file_.dimension(axis.name, axis.size);
        NetcdfAttributes attributes;
        for (const auto& [name, numbers] : axis.parts) attributes.push_back({name, numbers});
        append(attributes, comment(axis.comment));
        if (axis.values.empty())
            add(axis.name, {axis.name}, "1", axis.meaning, one_to(axis.size), attributes);
        else
            add(axis.name, {axis.name}, unit(1), axis.meaning, axis.values, attributes);
        if (axis.repeats > 0) {
            add_axis(axis.repeats_name, "1", axis.repeats_meaning, one_to(axis.repeats));
        }
        if (std::ranges::any_of(asked.physics->curves,
                                [](const LevelCurve& c) { return c.components > 1; }))
            file_.dimension("direction", 2);
        std::map<std::string, std::vector<double>> values;
        for (const LevelCurve& curve : asked.physics->curves) {
            const std::size_t n = curve.count(axis);
            std::vector<double>& all = values[curve.name];
            for (const auto k : indices(o_.rows.size())) {
                const auto begin = o_.curves.begin() + std::ptrdiff_t(k * each + first);
                all.insert(all.end(), begin, begin + std::ptrdiff_t(n));
            }
            first += n;
        }
        for (const LevelCurve& curve : asked.physics->curves) {
            if (curve.if_known && !computed(values[curve.name])) continue;
            Names dims = curve.of_single ? Names{"step"} : Names{"realization", "step"};
            if (curve.repeated)
                dims.push_back(axis.repeats_name);
            else if (curve.along)
                dims.push_back(axis.name);
            if (curve.components > 1) dims.push_back("direction");
            const bool error = !curve.error.empty() && computed(values[curve.error]);
            add_absent(curve.name, dims, unit(curve.length_power, curve.force_power), curve.meaning,
                       values[curve.name], curve.comment,
                       error ? NetcdfAttributes{{"ancillary_variables", curve.error}}
                             : NetcdfAttributes{});
        }
    }
}

void ResultTable::fields() {
    const Fields& f = r_.fields;
    if (f.step.empty()) return;
    add_axis("field_step", "1", "number of the level of the fields", from_one(f.step), {kFromOne});
    add_axis("field_y", unit(1), "y of the points of the fields", f.y);
    add_axis("field_x", unit(1), "x of the points of the fields", f.x);
    const Names dims{"field_step", "field_y", "field_x"};
    if (!f.pressure.empty())
        add_disorder("field_pressure", dims, unit(-2, 1), "pressure", f.pressure);
    if (!f.gap.empty())
        add_absent("field_gap", dims, unit(1), "gap between the bodies", f.gap,
                   "0 where they touch");
    if (!f.contact.empty())
        add("field_contact", dims, "1", "1 where the bodies touch, 0 elsewhere", f.contact);
    for (const Fields::OfPhysics& of : f.physics) {
        const PointField& row = *of.row;
        add_disorder(std::string("field_") + row.name,
                     row.along ? Names{"field_step", of.axis, "field_y", "field_x"} : dims,
                     unit(row.length_power, row.force_power), row.meaning, of.values);
    }
    if (!f.heights.empty())
        add_disorder(
            "field_height",
            any_physics(r_.settings, &Physics::reshapes) ? dims : Names{"field_y", "field_x"},
            unit(1), "height of the surface without load", f.heights);
}

}  // namespace rsc
