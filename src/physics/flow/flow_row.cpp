#include "physics/flow/flow_row.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "base/parallel.hpp"
#include "case/units.hpp"
#include "physics/flow/flow.hpp"

namespace rsc {
namespace {

bool flow_asked(const Case& settings) { return settings.output.flow; }

bool leak_asked(const Case& settings) { return settings.output.leak_drop[0].has_value(); }

// Levels of two flats by elements have a gap.
bool has_gap(const Case& settings) {
    return settings.indentation.boundary == Boundary::periodic && by_elements(settings);
}

std::vector<Key> flow_keys() {
    using namespace keys;
    return {
        number(RSC_KEY(output, flow), "", kAny,
               "permeability of the gap between two flats at each level, by elements with boundary "
               "= 'periodic', and the flow that a sliding smooth face drags along"),
        number(RSC_KEY(output, leak_drop), "force/length^2", kNotNegative,
               "pressures of the fluid at the inlet and at the outlet of a seal, for its leak rate",
               "no leak rate"),
        number(RSC_KEY(output, leak_length), "length", kPositive,
               "length of the seal from inlet to outlet, along x", "none: leak_drop needs it"),
        number(RSC_KEY(output, leak_width), "length", kPositive,
               "width of the seal across the flow", "none: leak_drop needs it"),
        number(RSC_KEY(solids, viscosity), "force time/length^2", kNotNegative,
               "viscosity of the fluid, for the leak rate"),
        number(RSC_KEY(solids, gas), "", kAny,
               "the fluid is an ideal gas at constant temperature; its leak rate is the volume at "
               "the pressure of the outlet"),
    };
}

// The leak rate needs all of its keys.
void check_leak(const Case& settings, const Complain& complain) {
    const auto& o = settings.output;
    const double viscosity = settings.solids.viscosity;
    const bool asked = o.leak_drop[0].has_value();
    if (!asked && (o.leak_length || o.leak_width))
        complain({o.leak_length ? "output%leak_length" : "output%leak_width", "output%leak_drop"},
                 "it is for the leak rate; give output%leak_drop = P1, P2");
    if (!asked) return;
    if (!o.flow)
        complain({"output%leak_drop", "output%flow"}, "a leak rate needs output%flow = .true.");
    if (!o.leak_length || !o.leak_width || !(viscosity > 0))
        complain({"output%leak_drop", "output%leak_length"},
                 "a leak rate needs output%leak_length, output%leak_width and solids%viscosity");
    if (!(*o.leak_drop[0] >= *o.leak_drop[1]))
        complain({"output%leak_drop"}, "the first pressure, at the inlet, must not be lower");
    if (settings.solids.gas && !(*o.leak_drop[1] > 0))
        complain({"output%leak_drop", "solids%gas"},
                 "a gas has no volume at the pressure 0: the second pressure must be > 0");
}

void check_flow(const Case& settings, const Complain& complain) {
    check_leak(settings, complain);
    if (!settings.output.flow) return;
    if (settings.indentation.boundary != Boundary::periodic)
        complain({"output%flow", "indentation%boundary"},
                 "fluid flows through the gap of two flats, whose surface is periodic; give "
                 "boundary = 'periodic' and R = Infinity, Infinity");
    if (!by_elements(settings))
        complain({"output%flow", "solver%model"},
                 "asperities have no gap between them; use model = 'elements'");
    if (!has_permeability())
        complain({"output%flow"},
                 "this rsc was built without CHOLMOD (Debian: libsuitesparse-dev), which solves "
                 "for the flow");
}

std::vector<LevelQuantity> flow_quantities() {
    using V = LevelValues;
    return {
        {.name = "gap_mean",
         .member = &V::gap_mean,
         .length_power = 1,
         .meaning = "mean gap between two flats",
         .comment = "boundary elements, over the whole cell; 0 where the bodies touch",
         .compute = compute_gap,
         .in_run = has_gap,
         .always = false,
         .shown = flow_asked,
         .statistics = true,
         .plain = "mean gap",
         .heading = "gap",
         .width = 11,
         .digits = 5},
        {.name = "gap_mean_open",
         .member = &V::gap_mean_open,
         .length_power = 1,
         .meaning = "mean gap where two flats do not touch",
         .compute = compute_gap,
         .in_run = has_gap,
         .always = false},
        {.name = "percolates",
         .member = &V::percolates_x,
         .y = &V::percolates_y,
         .unit = "1",
         .meaning = "1 if the gap is open across any number of periods, otherwise 0",
         .comment = "along x, along y: points of the gap connected by their sides wind around the "
                    "periodic cell",
         .compute = compute_gap,
         .in_run = has_gap,
         .always = false,
         .statistics = true,
         .plain = "percolation (its share)"},
        {.name = "permeability",
         .member = &V::permeability_xx,
         .y = &V::permeability_yy,
         .z = &V::permeability_xy,
         .length_power = 3,
         .meaning = "permeability of the gap, K",
         .comment =
             "flux per width q = -(K/eta) grad P of a fluid of viscosity eta; a parallel gap h "
             "has h^3/12. Extrapolated from the gap on the points and on every second one. A seal "
             "of length l along x and width w leaks w K_xx/(eta l) times the "
             "pressure drop",
         .compute = compute_permeability,
         .in_run = flow_asked,
         .own_error = permeability_error,
         .always = false,
         .statistics = true,
         .logarithm = true,
         .plain = "permeability"},
        {.name = "hydraulic_gap",
         .member = &V::hydraulic_gap_x,
         .y = &V::hydraulic_gap_y,
         .length_power = 1,
         .meaning = "parallel gap of the same permeability, (12 K)^(1/3), along x and along y",
         .compute = compute_permeability,
         .in_run = flow_asked,
         .own_error = hydraulic_gap_error,
         .always = false,
         .shown = flow_asked,
         .plain = "hydraulic gap",
         .heading = "hydraulic",
         .width = 14,
         .digits = 5},
        {.name = "shear_flow",
         .member = &V::shear_xx,
         .y = &V::shear_yy,
         .z = &V::shear_xy,
         .yx = &V::shear_yx,
         .length_power = 1,
         .meaning = "flow that the smooth face drags along when it slides over the rough one, S",
         .comment = "flux per width q = S U for its velocity U, the rough face at rest; xy: along "
                    "x for a velocity along y; a parallel gap h has h/2",
         .compute = compute_permeability,
         .in_run = flow_asked,
         .own_error = shear_flow_error,
         .always = false,
         .plain = "shear flow"},
        {.name = "flow_factor_pressure",
         .member = &V::pressure_factor_x,
         .y = &V::pressure_factor_y,
         .unit = "1",
         .meaning = "pressure flow factor of Patir and Cheng, 12 K/h^3, along x and along y",
         .comment = "h: the mean gap, closed parts included; missing in full contact",
         .compute = compute_permeability,
         .in_run = flow_asked,
         .own_error = permeability_error,
         .always = false,
         .plain = "pressure flow factor"},
        {.name = "flow_factor_shear",
         .member = &V::shear_factor_x,
         .y = &V::shear_factor_y,
         .unit = "1",
         .meaning = "shear flow factor of Patir and Cheng, (h - 2 S)/sigma, along x and along y",
         .comment = "h: the mean gap, closed parts included; sigma: rms height of the surface",
         .compute = compute_permeability,
         .in_run = flow_asked,
         .own_error = shear_factor_error,
         .always = false,
         .plain = "shear flow factor"},
        {.name = "leak_rate",
         .member = &V::leak_rate,
         .length_power = 3,
         .per_time = true,
         .meaning = "volume that leaks through the seal along x in a unit of time",
         .comment = "K_xx w (P1 - P2)/(eta l); of a gas K_xx w (P1^2 - P2^2)/(2 eta l P2), its "
                    "volume at the outlet's pressure",
         .compute = compute_leak,
         .in_run = leak_asked,
         .own_error = permeability_error,
         .always = false,
         .shown = leak_asked,
         .answers = true,
         .statistics = true,
         .plain = "leak rate",
         .heading = "leak",
         .width = 16,
         .digits = 5},
    };
}

// The memory of the machine must bear the flow through a map of this size.
void require_memory(const PreparedFacts& facts) {
    const double needed = permeability_bytes(facts.points), memory = machine_memory();
    if (needed <= memory) return;
    const double side = std::floor(std::sqrt(permeability_points(memory)));
    bad_input(
        format("output%%flow: the flow through a gap of %.0f points needs up to %.3g GB, and the "
               "machine has %.3g GB of memory, enough for %.0f x %.0f points; give a smaller "
               "elements%%points_per_wave or surface%%L_lambda_s",
               facts.points, 1e-9 * needed, 1e-9 * memory, side, side));
}

class FluxRecorder final : public LevelRecorder {
public:
    FieldValues fields_at(LevelSource& source) override { return {std::move(source.flux)}; }
};

// Says up to which levels the gap is open across the cell, and how a leak follows from K.
void print_gap(std::ostream& out, const RunFacts& run) {
    const auto open = [](const LevelValues& l) { return l.percolates_x > 0; };
    const auto count = std::ranges::count_if(run.levels, open);
    // The last open and the first closed level by contact area.
    const LevelValues *most = nullptr, *least = nullptr;
    for (const LevelValues& l : run.levels) {
        if (open(l) && (!most || l.area_fraction > most->area_fraction)) most = &l;
        if (l.percolates_x == 0 && (!least || l.area_fraction < least->area_fraction)) least = &l;
    }
    const auto load = [&](const LevelValues& l) {
        const Case::Run& units = run.settings.run;
        return format("A/A0 = %.3g (%.4g %s/%s2)", l.area_fraction, l.pressure,
                      units.force_unit.c_str(), units.length_unit.c_str());
    };
    out << format("  gap: open across the cell along x at %zu of %zu levels", at(count),
                  run.levels.size());
    if (most) {
        const double error = permeability_error(*most, 0);
        out << ", up to " << load(*most) << (error > 0 ? ", where K is known to +- " : "")
            << (error > 0 ? percent(error) : ", where no error of K is stated");
    }
    if (least) out << "; closed at " << load(*least) << " and above";
    out << '\n';
    if (leak_asked(run.settings)) return;
    const auto& [l, f, t] = std::tie(run.settings.run.length_unit, run.settings.run.force_unit,
                                     run.settings.run.time_unit);
    out << format(
        "  leak rate = K w dP/(eta l) [%s/%s] for a pressure drop dP [%s] over the length l of "
        "the seal along x, its width w and the viscosity eta [%s %s]; hydraulic gap h: K = "
        "h^3/12\n",
        unit_of(l, 3, "", 0).c_str(), t.c_str(), unit_of(l, -2, f, 1).c_str(),
        unit_of(l, -2, f, 1).c_str(), t.c_str());
}

}  // namespace

const Physics kFlow = {
    .name = "flow",
    .key = "output%flow",
    .keys = flow_keys,
    .take =
        [](const Case& c, BodyPhysics& bodies) {
            bodies.of<FlowAsked>() = {c.output.flow};
            const auto& [inlet, outlet] = c.output.leak_drop;
            if (!inlet || !outlet) return;
            bodies.of<Leak>() = {{*inlet, *outlet},
                                 c.output.leak_length.value_or(0),
                                 c.output.leak_width.value_or(0),
                                 c.solids.viscosity,
                                 c.solids.gas};
        },
    .asked = [](const BodyPhysics& bodies) { return bodies.of<FlowAsked>().asked; },
    .check = check_flow,
    .needs_elements = [](const Case&) { return "output%flow needs them"; },
    .quantities = flow_quantities(),
    .fields = {{"flow",
                "magnitude of the flux per width times the viscosity, for a mean pressure gradient "
                "of 1 along x",
                3, 0}},
    .recorder = [](const RecordedBodies&) -> std::unique_ptr<LevelRecorder> {
        return std::make_unique<FluxRecorder>();
    },
    .require_feasible = require_memory,
    .calibrated = [](const BodyPhysics&, bool) { return true; },  // levels do not depend on it
    .bytes = permeability_bytes,
    .remark = print_gap,
};

}  // namespace rsc
