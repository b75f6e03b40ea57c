#include "physics/friction/friction_row.hpp"

#include "base/format.hpp"
#include "contact/equivalent.hpp"
#include "physics/friction/contact_curve.hpp"
#include "physics/friction/sliding_elements.hpp"

namespace rsc {
namespace {

std::vector<Key> friction_keys() {
    using namespace keys;
    return {
        number(RSC_KEY(solids, friction), "1", kNotNegative,
               "coefficient of friction mu; if above 0, the result has the tangential force at "
               "each level (one realization only)"),
        list(RSC_KEY(indentation, sliding_path), 20000, "length", kAny, "cycles",
             "friction: tangential displacements x1, y1, x2, y2, ... of body 2 at each level, one "
             "increment each, from rest without tangential force"),
        number(RSC_KEY(indentation, amplitude), "`amplitude_unit`", kPositive,
               "friction: amplitude of cycles along output%sliding_direction at each level"),
        choice(RSC_KEY(indentation, amplitude_unit), kAmplitudeUnitNames,
               "full_slip: amplitude is relative to the slide at which all slips; or length"),
        number(RSC_KEY(indentation, cycles), "1", between(1, 1000),
               "friction: number of cycles at each level"),
    };
}

void check_friction(const Case& settings, const Complain& complain) {
    const Case::Indentation& i = settings.indentation;
    const bool slips = settings.solids.friction > 0, path = !i.sliding_path.empty(),
               cycles = i.cycles != 1 || i.amplitude != Case::Indentation{}.amplitude ||
                        i.amplitude_unit != AmplitudeUnit::full_slip;
    if (!slips && path)
        complain({"indentation%sliding_path", "solids%friction"}, "needs solids%friction > 0");
    if (!slips && cycles)
        complain(
            {i.cycles != 1 ? "indentation%cycles" : "indentation%amplitude", "solids%friction"},
            "needs solids%friction > 0");
    if (!slips) return;
    if (i.sliding_path.size() % 2 != 0)
        complain({"indentation%sliding_path"}, "needs an x and a y of each displacement");
    if (path && cycles)
        complain({"indentation%sliding_path"},
                 "the cycles are given as well; give either a path or cycles");
    if (settings.run.realizations > 1)
        complain({"run%realizations"}, "only one with solids%friction > 0");
    if (by_elements(settings)) return;
    for (const char* field : {"traction", "traction_x", "traction_y", "slip_x", "slip_y"})
        if (has_field(settings, field))
            complain({"output%fields", "solver%model"},
                     joined("'", field,
                            "' is for elements; of asperities the picture `stick` shows the "
                            "spots"));
}

double amplitude_of(const Case& settings, double full_slip) {
    const Case::Indentation& i = settings.indentation;
    return i.amplitude * (i.amplitude_unit == AmplitudeUnit::full_slip ? full_slip : 1.0);
}

SlideCycles cycles_of(const Case& settings) { return {.cycles = settings.indentation.cycles}; }

CurveAxis points_of_slides(const PreparedFacts& facts) {
    const SlideCycles cycles = cycles_of(facts.settings);
    const std::size_t path = facts.settings.indentation.sliding_path.size() / 2;
    if (path > 0)
        return {.name = "point",
                .meaning = "point of a slide at constant separation",
                .size = path,
                .comment = "those of indentation%sliding_path"};
    const auto first = std::int32_t(cycles.first()), all = std::int32_t(cycles.points());
    return {.name = "point",
            .meaning = "point of a slide at constant separation",
            .size = at(all),
            .parts = {{"first_loading", {1, first}}, {"cycle", {first + 1, all}}},
            .comment =
                "first and last point of the first loading, from 0 to full slip, and of the "
                "cycles from one end at the amplitude to the last",
            .repeats_name = "cycle",
            .repeats = at(cycles.cycles),
            .repeats_meaning = "number of a cycle"};
}

std::vector<LevelCurve> friction_curves() {
    const std::string none = "missing without contact";
    const LevelCurve common{.name = "", .of_single = true};
    const auto curve = [&](const char* name, int length, int force, const char* meaning,
                           std::string comment) {
        LevelCurve made = common;
        made.name = name;
        made.length_power = length;
        made.force_power = force;
        made.meaning = meaning;
        made.comment = std::move(comment) + none;
        return made;
    };
    std::vector<LevelCurve> all = {
        curve("tangential_displacement", 1, 0, "tangential displacement of the indenter", "x, y; "),
        curve("tangential_force", 0, 1, "tangential force",
              "x, y; partial slip with the coefficient solids%friction at every point; in full "
              "slip the coefficient times the normal force; "),
        curve("stick_area", 2, 0, "contact area that sticks", ""),
        curve("friction_work", 1, 1, "work of friction since the beginning of the slide", ""),
        curve("full_slip", 1, 0, "tangential displacement at which all of the contact slips",
              "along output%sliding_direction, with tractions along it; "),
        curve("tangential_stiffness", -1, 1, "tangential stiffness in full stick",
              "along output%sliding_direction; "),
        curve("tangential_stiffness_xx", -1, 1, "tangential stiffness in full stick along x", ""),
        curve("tangential_stiffness_xy", -1, 1,
              "tangential force along x in full stick for a unit displacement along y", ""),
        curve("tangential_stiffness_yy", -1, 1, "tangential stiffness in full stick along y", ""),
        curve("cycle_work", 1, 1, "friction work of a cycle",
              "the area of the loop of a closed cycle; "),
    };
    all[0].components = all[1].components = 2;
    for (const auto k : indices(all)) {
        all[k].along = k < 4;
        all[k].if_known = k >= 2;
    }
    all.back().repeated = true;
    return all;
}

// A slide at a level: one value each point, or each cycle. Missing values are NaN.
struct SlideCurves {
    std::vector<Slide> displacement, force;
    std::vector<double> sticking, lost, cycle_work;
    double full_slip = kNotComputed;
    std::array<double, 3> stiffness = none_computed<3>();  // xx, xy, yy

    SlideCurves(std::size_t points, std::size_t cycles)
        : displacement(points, {kNotComputed, kNotComputed}),
          force(displacement),
          sticking(points, kNotComputed),
          lost(sticking),
          cycle_work(cycles, kNotComputed) {}

    // In the order of friction_curves().
    void put(const Vec2& along, std::vector<double>& values) const {
        for (const auto* pairs : {&displacement, &force})
            for (const Slide& s : *pairs) append(values, {s.x, s.y});
        append(values, sticking);
        append(values, lost);
        const auto [xx, xy, yy] = stiffness;
        append(values,
               {full_slip,
                xx * along.x * along.x + 2 * xy * along.x * along.y + yy * along.y * along.y, xx,
                xy, yy});
        append(values, cycle_work);
    }
};

// The slides of a case at each level, from rest.
class SlideRecorder : public LevelRecorder {
public:
    explicit SlideRecorder(const RecordedBodies& bodies)
        : settings_(bodies.settings),
          cycles_(cycles_of(bodies.settings)),
          friction_{bodies.settings.solids.friction,
                    tangential_ratio(bodies.settings.solids.E, bodies.settings.solids.nu)} {
        const double angle = bodies.settings.output.sliding_direction.value_or(0) * pi / 180;
        along_ = {std::cos(angle), std::sin(angle)};
        const std::vector<double>& path = settings_.indentation.sliding_path;
        for (std::size_t k = 0; k + 1 < path.size(); k += 2)
            path_.push_back({path[k], path[k + 1]});
    }

    bool in_order() const override { return true; }

    bool record(const Level& level, std::vector<double>& values) override {
        const bool cycles = path_.empty();
        SlideCurves curves(cycles ? cycles_.points() : path_.size(),
                           cycles ? at(cycles_.cycles) : 0);
        bool solved = true;
        if (level.converged && level.force > 0) solved = slide(level, curves);
        curves.put(along_, values);
        return solved;
    }

protected:
    // False: something did not converge.
    virtual bool slide(const Level& level, SlideCurves& curves) = 0;

    Slide along(double distance) const { return {distance * along_.x, distance * along_.y}; }

    const Case& settings_;
    SlideCycles cycles_;
    Friction friction_;
    Vec2 along_;
    std::vector<Slide> path_;  // empty: cycles
};

// Asperities: the superposition of friction.hpp, on copies of the contact.
class AsperitySlides final : public SlideRecorder {
public:
    explicit AsperitySlides(const RecordedBodies& bodies)
        : SlideRecorder(bodies),
          copies_{bodies.another(), bodies.another()},
          curve_(*copies_[0], *copies_[1]) {}

private:
    bool slide(const Level& level, SlideCurves& curves) override {
        const double delta = -level.separation;
        const long before = curve_.failed();
        if (!(delta > curve_.first_touch())) return true;
        const double stiffness = -friction_.ratio * level.stiffness;
        curves.stiffness = {stiffness, 0, stiffness};
        curves.full_slip = full_slip(curve_, friction_, delta);
        if (path_.empty()) {
            const SlideCycle cycle = slide_cycle(
                curve_, friction_, delta, amplitude_of(settings_, curves.full_slip), cycles_);
            for (const auto k : indices(cycle.force)) {
                curves.displacement[k] = along(cycle.displacement[k]);
                curves.force[k] = along(cycle.force[k]);
            }
            std::ranges::fill(curves.cycle_work, cycle.work);
        } else {
            FrictionHistory history(friction_);
            history.go_to(curve_, delta, {});
            for (const auto k : indices(path_)) {
                history.go_to(curve_, delta, path_[k]);
                curves.displacement[k] = path_[k];
                curves.force[k] = history.tangential_force();
                curves.lost[k] = history.work_lost();
            }
        }
        return curve_.failed() == before;
    }

    std::unique_ptr<Path> copies_[2];
    ContactCurve curve_;
};

// Boundary elements: sliding_elements.hpp. The fields are those at the end of the path, or of
// cycles half-way to full slip in first loading.
class ElementSlides final : public SlideRecorder {
public:
    explicit ElementSlides(const RecordedBodies& bodies)
        : SlideRecorder(bodies),
          points_(bodies.map->points()),
          sliding_(bodies.indenter, friction_, *bodies.map,
                   std::min(kTolerance, bodies.settings.solver.tolerance)) {}

    FieldValues fields_at(LevelSource&) override {
        FieldValues fields(5, std::vector<double>(points_, 0.0));
        const std::size_t n = drawn_.pixels.size();
        for (const auto k : indices(n)) {
            const std::size_t pixel = at(drawn_.pixels[k]);
            const double x = drawn_.q[k], y = drawn_.q[n + k];
            fields[0][pixel] = std::hypot(x, y);
            fields[1][pixel] = x;
            fields[2][pixel] = y;
            fields[3][pixel] = drawn_.slip[k];
            fields[4][pixel] = drawn_.slip[n + k];
        }
        return fields;
    }

private:
    static constexpr double kTolerance = 1e-6;

    bool slide(const Level& level, SlideCurves& curves) override {
        sliding_.restore({});
        at_ = {};
        solved_ = sliding_.slide(level.pixels, {});
        curves.stiffness = sliding_.stiffness();
        curves.full_slip = sliding_.full_slip(along(1));
        next_ = 0;
        if (path_.empty()) {
            cycle(level, curves);
        } else {
            for (const Slide& to : path_) step(level, to, curves);
            drawn_ = sliding_.state();
        }
        return solved_;
    }

    // The first loading, and from its point below the amplitude the cycles.
    void cycle(const Level& level, SlideCurves& curves) {
        const double full = curves.full_slip, reach = amplitude_of(settings_, full);
        const int n = cycles_.steps;
        SlidingElements::State start;
        Slide start_at;
        for (int k = 0; k <= n; ++k) {
            step(level, along(full * k / n), curves);
            if (2 * k == n) drawn_ = sliding_.state();
            if (full * k / n > reach) continue;
            start = sliding_.state();
            start_at = at_;
        }
        sliding_.restore(std::move(start));
        at_ = start_at;
        step(level, along(reach), curves);
        for (double& work : curves.cycle_work) {
            const double before = sliding_.work_lost();
            for (int k = 1; k <= 2 * n; ++k) {
                const double to = k <= n ? 1 - 2.0 * k / n : 2.0 * k / n - 3;
                step(level, along(reach * to), curves);
            }
            work = sliding_.work_lost() - before;
        }
    }

    void step(const Level& level, const Slide& to, SlideCurves& curves) {
        solved_ = sliding_.slide(level.pixels, {to.x - at_.x, to.y - at_.y}) && solved_;
        at_ = to;
        curves.displacement[next_] = to;
        curves.force[next_] = sliding_.force();
        curves.sticking[next_] = sliding_.sticking_area();
        curves.lost[next_] = sliding_.work_lost();
        ++next_;
    }

    std::size_t points_;
    SlidingElements sliding_;
    SlidingElements::State drawn_;
    Slide at_;  // displacement of body 2
    std::size_t next_ = 0;
    bool solved_ = true;
};

// Dundurs' second parameter, which couples the normal and the tangential problem; 0 for equal
// bodies.
double coupling(const Case::Solids& s) {
    const auto compliance = [&](int i) {
        return std::isinf(s.E[i]) ? 0.0 : 2 * (1 + s.nu[i]) / s.E[i];
    };  // 1/G
    const double above = (1 - 2 * s.nu[0]) * compliance(0) - (1 - 2 * s.nu[1]) * compliance(1);
    const double below = 2 * ((1 - s.nu[0]) * compliance(0) + (1 - s.nu[1]) * compliance(1));
    return above / below;
}

// What a slide needs at the last level, in cycles.
void print_slide(std::ostream& out, const RunFacts& run) {
    if (!run.settings.indentation.sliding_path.empty()) return;
    const std::size_t scalars = 6 * cycles_of(run.settings).points();  // friction_curves()
    if (run.curves.size() <= scalars + 5) return;
    const double full = run.curves[scalars], stiffness = run.curves[scalars + 1],
                 work = run.curves.back();
    if (std::isnan(full)) return;
    const auto& units = run.settings.run;
    const char *l = units.length_unit.c_str(), *f = units.force_unit.c_str();
    out << format(
        "  sliding at the last level: all spots slip at Q = %.4g %s after %.4g %s; tangential "
        "stiffness %.4g %s/%s before slip; a cycle of amplitude %.4g %s takes %.4g %s %s of "
        "friction work.\n",
        run.settings.solids.friction * run.levels.back().force, f, full, l, stiffness, f, l,
        amplitude_of(run.settings, full), l, work, f, l);
}

void print_friction(std::ostream& out, const RunFacts& run) {
    print_slide(out, run);
    if (!run.elements)
        out << "  friction of asperities superposes two normal contacts: exact for round spots of "
               "equal bodies that slide along a line; elements solve the tangential problem.\n";
    constexpr double much = 0.05;
    const double beta = coupling(run.settings.solids);
    if (std::abs(beta) > much)
        out << format(
            "  friction between unlike bodies: the coupling of pressure and tangential "
            "displacement (Dundurs' beta = %.2f) is neglected in the tangential forces.\n",
            beta);
}

}  // namespace

const Physics kFriction = {
    .name = "friction",
    .key = "solids%friction",
    .keys = friction_keys,
    .take = [](const Case& c,
               BodyPhysics& bodies) { bodies.of<Friction>().coefficient = c.solids.friction; },
    .asked = [](const BodyPhysics& bodies) { return bodies.of<Friction>().coefficient > 0; },
    .excludes = {{"solids%layer_thickness", "it is not for layers",
                  [](const Combination& c) { return c.layers; }}},
    .check = check_friction,
    .curves = friction_curves(),
    .axis = points_of_slides,
    .fields = {{"traction",
                "tangential traction of friction: at the end of the path, or of cycles half-way to "
                "full slip in first loading",
                -2, 1},
               {"traction_x", "its x component", -2, 1},
               {"traction_y", "its y component", -2, 1},
               {"slip_x", "slip of body 2 over body 1 along x up to there, where they touch", 1, 0},
               {"slip_y", "slip along y", 1, 0}},
    .recorder = [](const RecordedBodies& bodies) -> std::unique_ptr<LevelRecorder> {
        if (bodies.map) return std::make_unique<ElementSlides>(bodies);
        return std::make_unique<AsperitySlides>(bodies);
    },
    .calibrated = [](const BodyPhysics&, bool) { return true; },  // levels do not depend on it
    .bytes_per_point = 60,  // two planes and three kernels, of contacts as wide as half the map
    .remark = print_friction,
};

}  // namespace rsc
