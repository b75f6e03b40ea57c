// The checks of a case, key by key and as a whole.

#include "base/error.hpp"
#include "case/case.hpp"
#include "case/registry.hpp"
#include "case/units.hpp"
#include "physics/indenter/shapes.hpp"
#include "physics/physics.hpp"
#include "surface/asperities.hpp"

namespace rsc {

using namespace namelist;

namespace {

constexpr double kMostMapValues = 1e9;  // of one map variable: 8 GB
// radial_bins times map_cells, to which the work of the radial means is proportional: a second
constexpr double kMostCircles = 2e6;
constexpr double kMostLevelValues = 1e9;  // realizations x levels

std::string count(double n) { return std::to_string(static_cast<long long>(n)); }

class Checker {
public:
    explicit Checker(const Case& settings)
        : c_(settings),
          elements_(by_elements(settings)),
          by_(settings.indentation.levels.empty() ? "indentation%steps" : "indentation%levels"),
          levels_(settings.indentation.levels.empty()
                      ? settings.indentation.steps
                      : double(settings.indentation.levels.size())) {}

    std::vector<Problem> check() {
        for (const Key& key : registry()) check_key(key);
        check_units();
        check_exclusive();
        check_solids();
        check_times();
        check_surface();
        check_elements();
        check_indenter();
        check_levels();
        check_boundary();
        check_fields();
        check_sizes();
        return std::move(problems_);
    }

private:
    // A problem of the first key, in which the others take part. Its text is preceded by the first
    // key's name, and its value if it is short.
    void complain(std::initializer_list<std::string_view> names, const auto&... text) {
        Problem problem{{}, 0, {}};
        for (const std::string_view name : names) problem.keys.push_back(&key_of(name));
        const Key& key = *problem.keys.front();
        const std::string value =
            key.list || key.type == Type::string ? "" : get_key(c_, *names.begin());
        problem.text = joined(key.name, value.empty() ? "" : " = ", value, ": ", text...);
        problems_.push_back(std::move(problem));
    }
    void require(bool right, std::initializer_list<std::string_view> names, const auto&... text) {
        if (!right) complain(names, text...);
    }

    void check_key(const Key& key) {
        // Slots point to non-const values; here they are only read.
        const Slot slot = key.slot(const_cast<Case&>(c_));
        const auto number = [&](double value, std::size_t element) {
            const bool overflows = std::isfinite(value) && !usable(value);
            const bool never_zero =
                key.bounds.nonzero || (value > 0 && key.bounds.low == 0 && key.bounds.open);
            const bool vanishes = never_zero && value != 0 && !usable_positive(std::abs(value)) &&
                                  std::isfinite(value);
            if (key.bounds.hold(value) && !overflows && !vanishes) return;
            const std::string bounds =
                overflows || vanishes ? "of a magnitude from 1e-50 to 1e50" : key.bounds.text();
            problems_.push_back(
                {{&key},
                 long(element),
                 joined(key.name, element > 0 ? joined("(", element, ")") : "", " = ",
                        key.type == Type::integer ? count(value) : from_real(value), ": must be ",
                        bounds,
                        bounds.empty()                                ? "finite"
                        : std::isfinite(value) || key.bounds.infinity ? ""
                                                                      : " and finite")});
        };
        const auto each = [&](const auto* values, std::size_t size) {
            for (const auto i : indices(size)) number(double(values[i]), key.size > 1 ? i + 1 : 0);
        };
        const auto size = at(key.size);
        if (const auto* n = std::get_if<int*>(&slot)) each(*n, size);
        if (const auto* x = std::get_if<double*>(&slot)) each(*x, size);
        if (const auto* o = std::get_if<std::optional<double>*>(&slot))
            for (const auto i : indices(size))
                if ((*o)[i]) number(*(*o)[i], size > 1 ? i + 1 : 0);
        if (const auto* v = std::get_if<std::vector<double>*>(&slot)) {
            const std::vector<double>& list = **v;
            if (list.size() > size)
                problems_.push_back({{&key}, 0, joined(key.name, ": at most ", size, " values")});
            if (list.empty() && !*key.unset && !key.word)
                problems_.push_back({{&key}, 0, joined(key.name, ": at least one value")});
            each(list.data(), std::min(list.size(), size));
        }
        if (const auto* s = std::get_if<std::string*>(&slot)) check_text(key, **s);
    }

    // Text that the effective namelist could not reproduce is refused.
    void check_text(const Key& key, const std::string& text) {
        const auto control = [](char c) {
            return (static_cast<unsigned char>(c) < 32 && c != '\t') || c == 127;
        };
        std::string wrong;
        if (std::ranges::any_of(text, control))
            wrong = "control characters are not allowed";
        else if (text.size() > at(key.length))
            wrong = "at most " + std::to_string(key.length) + " characters";
        else if (!text.empty() && text.back() == ' ')
            wrong = "blanks at the end are not allowed";
        if (!wrong.empty()) problems_.push_back({{&key}, 0, joined(key.name, ": ", wrong)});
    }

    void check_units() {
        const std::tuple<const char*, const std::string&, Quantity> units[] = {
            {"run%length_unit", c_.run.length_unit, Quantity::length},
            {"surface%height_unit", c_.surface.height_unit, Quantity::length},
            {"surface%coordinate_unit", c_.surface.coordinate_unit, Quantity::length},
            {"run%force_unit", c_.run.force_unit, Quantity::force},
            {"run%time_unit", c_.run.time_unit, Quantity::time}};
        for (const auto& [key, unit, quantity] : units)
            if (const std::string wrong = unit_problem(unit, quantity); !wrong.empty())
                complain({key}, wrong);
    }

    // Pairs of keys that exclude each other.
    void check_exclusive() {
        const Case::Solids& s = c_.solids;
        const BodyPhysics bodies = physics_of(c_);
        const Combination all{.bodies = bodies,
                              .elements = elements_,
                              .compares = c_.compare.listed(),
                              .line = c_.indentation.line(),
                              .layers = !s.layer_thickness.empty(),
                              .method = c_.solver.method,
                              .selection = c_.indentation.selection,
                              .law = c_.asperities.law};
        const Complain refuse = [&](std::initializer_list<std::string_view> keys,
                                    const std::string& text) { complain(keys, text); };
        find_exclusions(all, refuse);
        for (const Physics* p : all_physics())
            if (p->check) p->check(c_, refuse);
        require(!(all.layers && (s.resistivity[0] > 0 || s.resistivity[1] > 0)),
                {"solids%resistivity", "solids%layer_thickness"},
                "not available together with solids%layer_thickness; the resistance of coated "
                "bodies is not computed: where spots are smaller than the thickness of the "
                "coating, give its resistivity and no layer");
        require(!(all.layers && all.line), {"indentation%boundary", "solids%layer_thickness"},
                "not available together with solids%layer_thickness");
    }

    void check_solids() {
        const Case::Solids& s = c_.solids;
        const std::size_t layers = s.layer_thickness.size();
        const auto as_many = [&](const std::vector<double>& values, const char* key) {
            require(values.size() == layers, {key, "solids%layer_thickness"},
                    "needs as many values as solids%layer_thickness (", layers, "), found ",
                    values.size());
        };
        as_many(s.layer_E, "solids%layer_E");
        as_many(s.layer_nu, "solids%layer_nu");
        require(layers > 0 || !std::isinf(s.E[0]) || !std::isinf(s.E[1]), {"solids%E"},
                "two rigid bodies do not deform; at most one body may be rigid");
    }

    void check_times() {
        const Case::Indentation& i = c_.indentation;
        check_steps("indentation%times", i.times, "indentation%duration", i.duration);
        check_steps("indentation%distances", i.distances, "indentation%sliding", i.sliding);
        require(!i.slides() || (i.times.empty() && !i.duration),
                {i.sliding ? "indentation%sliding" : "indentation%distances",
                 i.duration ? "indentation%duration" : "indentation%times"},
                "levels have either a distance of sliding or a time");
    }

    // A list with a value for each level, or their `whole` instead.
    void check_steps(const char* key, const std::vector<double>& list, const char* whole_key,
                     const std::optional<double>& whole) {
        if (list.empty()) return;
        const std::string name = std::string(key).substr(std::string_view(key).find('%') + 1);
        require(!whole, {whole_key, key}, name, " are given as well; give only one of the two");
        require(double(list.size()) == levels_, {key, by_}, list.size(), " values for ",
                count(levels_), " levels");
        require(std::ranges::adjacent_find(list, std::ranges::greater_equal()) == list.end(), {key},
                "must increase from each level to the next");
    }

    void check_surface() {
        const Case::Surface& s = c_.surface;
        require(s.source == Source::synthetic || !s.file.empty(),
                {"surface%source", "surface%file"}, "needs a file");
        check_window("surface%window", "surface%source", s.window);
        const bool of_file = reads_heights(c_) || s.source == Source::asperities;
        const bool maps = reads_heights(c_) || shape() == "map";
        const std::pair<const char*, bool> of_maps[] = {
            {"surface%height_unit", !s.height_unit.empty()},
            {"surface%coordinate_unit", !s.coordinate_unit.empty()},
            {"surface%pixel", s.pixel.has_value()},
            {"surface%window", s.window[0].has_value()},
            {"surface%outliers", s.outliers > 0},
            {"surface%missing_value", !s.missing_value.empty()}};
        for (const auto& [key, given] : of_maps)
            require(maps || !given, {key, "surface%source"},
                    "is only for heights read from files, here source = ",
                    get_key(c_, "surface%source"));
        check_profile();
        check_finish();
        if (of_file) {
            const bool several =
                reads_heights(c_) && s.file.find_first_of("*?[") != std::string::npos;
            require(several || c_.run.realizations == 1, {"run%realizations", "surface%source"},
                    "a surface from one file is one realization; for several height maps give a "
                    "pattern such as maps/*.gwy as the file");
            return;
        }
        require(s.kurtosis > s.skewness * s.skewness + 1, {"surface%kurtosis", "surface%skewness"},
                "must be greater than skewness^2 + 1 = ", from_real(s.skewness * s.skewness + 1),
                ", the lower bound for any distribution");
        require(s.n % 2 == 0, {"surface%n"}, "must be even");
        const bool measured = s.twin_heights == TwinHeights::measured,
                   directional = s.twins == Twins::directional;
        require(!measured || (s.skewness == 0 && s.kurtosis == 3),
                {"surface%twin_heights", "surface%skewness", "surface%kurtosis"},
                "excludes skewness and kurtosis, because the file gives the height distribution");
        require(!directional || s.aspect == 1, {"surface%twins", "surface%aspect"},
                "excludes aspect, because the spectrum has its own direction");
        if (s.source == Source::spectrum) return;
        require(!directional, {"surface%twins", "surface%source"}, "needs source = 'spectrum'");
        require(!measured, {"surface%twin_heights", "surface%source"}, "needs source = 'spectrum'");
        const Spectrum spectrum = self_affine_spectrum(c_);
        require(spectrum.L_lambda_s > spectrum.L_lambda_l,
                {"surface%L_lambda_s", "surface%L_lambda_l"},
                "must be larger than L_lambda_l = ", from_real(spectrum.L_lambda_l));
        require(s.n > 2 * shortest(),
                {"surface%n", "surface%L_lambda_s", "surface%aspect", "surface%finish"},
                "must be larger than 2 L_lambda_s", s.aspect == 1 ? "" : " sqrt(aspect)", " = ",
                from_real(2 * shortest()), " so that the grid resolves the shortest wavelength");
        const double L = spectrum.L;
        require(std::ranges::none_of(c_.indentation.centre,
                                     [&](const auto& x) { return x && (*x < 0 || *x > L); }),
                {"indentation%centre", "surface%L"},
                "must lie on the surface, 0 to L = ", from_real(L));
    }

    // A finish replaces the spectrum, and needs a length of heights.
    void check_finish() {
        const Case::Surface& s = c_.surface;
        const Case::Surface unset;
        const bool finish = s.finish != Finish::none;
        require(finish || !s.Ra, {"surface%Ra", "surface%finish"}, "is for a finish; give sigma");
        if (!finish) return;
        require(s.source == Source::synthetic, {"surface%finish", "surface%source"},
                "is for source = 'synthetic'");
        require(s.Ra.has_value() != s.sigma.has_value(),
                {"surface%finish", "surface%Ra", "surface%sigma"},
                "give either Ra or sigma, of the drawing");
        require(s.hurst == unset.hurst && s.L_lambda_l == unset.L_lambda_l &&
                    s.L_lambda_s == unset.L_lambda_s,
                {"surface%finish", "surface%hurst", "surface%L_lambda_l", "surface%L_lambda_s"},
                "replaces hurst, L_lambda_l and L_lambda_s");
    }

    void check_profile() {
        const Case::Surface& s = c_.surface;
        const bool profile = s.source == Source::profile;
        require(profile || s.cutoff_long == 0, {"surface%cutoff_long", "surface%source"},
                "is for source = 'profile'");
        require(s.cutoff_long == 0 || s.cutoff_long > s.filter_cutoff,
                {"surface%cutoff_long", "surface%filter_cutoff"},
                "must be longer than filter_cutoff = ", from_real(s.filter_cutoff));
        if (!profile) return;
        const Boundary boundary = c_.indentation.boundary;
        require(boundary == Boundary::periodic || boundary == Boundary::periodic_y,
                {"indentation%boundary", "surface%source"},
                "a surface with source = 'profile' is constant along y: 'periodic_y' (in contact "
                "with a roller or a flat) or 'periodic' (two flats) is expected");
        require(elements_, {"solver%model", "surface%source"},
                "a profile has no summits: its contact is solved by elements");
        require(!s.window[0], {"surface%window", "surface%source"}, "is for maps");
        require(c_.solids.adhesion == 0, {"solids%adhesion", "surface%source"},
                "not available for a surface that is constant along y");
        require(shape() != "map", {"indenter%shape", "surface%source"},
                "a map is not constant along y, as a surface with source = 'profile' is");
    }

    // L over the shortest wavelength of a synthetic surface, in the direction across its lay.
    double shortest() const {
        return self_affine_spectrum(c_).L_lambda_s *
               std::sqrt(std::max(c_.surface.aspect, 1 / c_.surface.aspect));
    }
    std::string_view shape() const { return kShapes.at(at(c_.indenter.shape)).name; }

    void check_window(const char* key, const char* beside, const std::optional<double> (&w)[4]) {
        if (!w[0] && !w[1] && !w[2] && !w[3]) return;
        require(w[0] && w[1] && w[2] && w[3] && *w[0] < *w[1] && *w[2] < *w[3], {key, beside},
                "x0, x1, y0, y1 with x0 < x1 and y0 < y1 are expected");
    }

    void check_elements() {
        const bool compare = c_.compare.listed();
        if (!elements_ && !compare) return;
        const char* const key = elements_ ? "solver%model" : "compare%levels";
        require(c_.surface.source != Source::asperities, {key, "surface%source"},
                "elements need a surface, and source = 'asperities' has only summits");
        require(!elements_ || !compare, {"compare%levels", "solver%model"},
                "&compare compares asperities with elements; with model = 'elements' there is "
                "nothing to compare");
        require(!elements_ || c_.solver.method == Method::automatic,
                {"solver%method", "solver%model"},
                "is for model = 'asperities'; with elements only 'auto' is possible");
        require(c_.solver.interaction == Interaction::point, {key, "solver%interaction"},
                "interaction = 'none' is for asperities; elements always interact");
        const double points = std::ceil(c_.elements.points_per_wave * shortest());
        require(c_.surface.source != Source::synthetic || points <= 32768,
                {"elements%points_per_wave", "surface%L_lambda_s"}, "gives a grid of ",
                count(points), " points a side; the maximum is 32768");
    }

    // The gap between bodies 1 and 2 must open in every direction.
    void check_gap() {
        const bool sphere = shape() == "sphere";
        if (!sphere && shape() != "paraboloid") return;
        const std::string_view key = sphere ? "solids%R" : "indenter%radii",
                               other = sphere ? "indenter%shape" : "solids%R";
        const auto flat = [](const double(&R)[2]) { return std::isinf(R[0]) && std::isinf(R[1]); };
        const GapRadii gap = gap_radii(c_);
        for (const auto& R : gap.R) {
            if (flat(R) || 1 / R[0] + 1 / R[1] > 0) continue;
            complain({key, other}, "bodies of radii ", R[0], " and ", R[1],
                     " do not touch at one point: 1/R1 + 1/R2 must be positive (a concave body "
                     "needs the larger radius)");
            return;
        }
        require(sphere || !flat(gap.R[0]) || !flat(gap.R[1]), {key, other},
                "two flats: give shape = 'sphere' and R = Infinity, Infinity");
    }

    void check_indenter() {
        const Case::IndenterKeys& i = c_.indenter;
        const ShapeRow& row = kShapes.at(at(i.shape));
        const auto takes = [](const ShapeRow& shape, std::string_view key, bool needed) {
            return std::ranges::any_of(shape.keys, [&](std::string_view k) {
                return k == std::string(key) + '!' || (!needed && k == key);
            });
        };
        for (const Key& key : registry()) {
            if (key.group != std::string_view("indenter") || key.name == std::string_view("shape"))
                continue;
            const std::string name = joined("indenter%", key.name);
            const bool given = get_key(c_, name) != get_key(Case{}, name);
            if (!given && takes(row, key.name, true))
                complain({"indenter%shape", name}, "needs ", key.name);
            if (!given || takes(row, key.name, false)) continue;
            std::string shapes;
            for (const ShapeRow& other : kShapes)
                if (takes(other, key.name, false)) enlist(shapes, " or ", "'", other.name, "'");
            complain({name, "indenter%shape"}, "is only for shape = ", shapes,
                     ", here shape = ", get_key(c_, "indenter%shape"));
        }
        require(i.radii[0].has_value() == i.radii[1].has_value(), {"indenter%radii"},
                "two values are needed");
        check_gap();
        if (shape() == "sphere") return;
        require(std::isinf(c_.solids.R[0]) || shape() == "paraboloid",
                {"solids%R", "indenter%shape"},
                "a curved body 1 is for shape = 'sphere' and 'paraboloid'; give R(1) = Infinity");
        require(c_.indentation.selection != Selection::paper,
                {"indentation%selection", "indenter%shape"}, "is defined for a sphere only");
    }

    void check_levels() {
        const Case::Indentation& i = c_.indentation;
        const bool separation = i.control == Control::separation,
                   with_log = i.spacing == Spacing::log && i.levels.empty();
        const bool pulls = any_physics(c_, &Physics::pulls);
        if (separation ? !with_log : pulls && !with_log) return;
        const std::string of = separation || pulls ? "spacing" : "control";
        const std::string text =
            "must be positive with " + of + " = " + get_key(c_, "indentation%" + of);
        if (!i.levels.empty()) {
            require(std::ranges::min(i.levels) > 0, {"indentation%levels", "indentation%control"},
                    text);
            return;
        }
        require(i.start > 0, {"indentation%start", "indentation%spacing"}, text);
        require(i.stop > 0, {"indentation%stop", "indentation%spacing"}, text);
    }

    void check_line() {
        const Case::Indentation& i = c_.indentation;
        const Case::IndenterKeys& body = c_.indenter;
        const char axis = i.boundary == Boundary::periodic_x ? 'x' : 'y';
        require(elements_, {"indentation%boundary", "solver%model"},
                "line contact is solved by model = 'elements'");
        const std::string repeats = std::string("body 2 must repeat along ") + axis;
        if (shape() == "sphere")
            require(std::isinf(c_.solids.R[0]) && std::isinf(c_.solids.R[1]),
                    {"indentation%boundary", "solids%R"}, repeats,
                    ", and a ball does not; give a cylinder, &indenter shape = "
                    "'paraboloid' with one of radii Infinity (both, if only body 1 is a cylinder, "
                    "of radius R(1)), or R = Infinity, Infinity");
        require(shape() != "cone" && shape() != "punch", {"indentation%boundary", "indenter%shape"},
                repeats, ", and shape = ", get_key(c_, "indenter%shape"), " does not");
        if (shape() != "paraboloid") return;
        const double R = body.radii[0].value_or(0), other = body.radii[1].value_or(0);
        const double turned = std::remainder(body.angle - (axis == 'x' ? 90 : 0), 180.0);
        const bool first = std::isfinite(R) && std::isinf(other) && turned == 0;
        const bool second = std::isfinite(other) && std::isinf(R) && std::abs(turned) == 90;
        require(first || second || (std::isinf(R) && std::isinf(other)),
                {"indenter%radii", "indentation%boundary"}, repeats,
                ": a cylinder with this axis has radii = R, Infinity and angle = ",
                axis == 'x' ? "90" : "0");
    }

    void check_boundary() {
        const Case::Indentation& i = c_.indentation;
        const bool periodic = i.boundary == Boundary::periodic,
                   relative = i.unit == LevelUnit::relative;
        if (periodic) {
            require(
                shape() == "sphere" || shape() == "map", {"indentation%boundary", "indenter%shape"},
                "is for two flats, smooth or rough, but shape = ", get_key(c_, "indenter%shape"),
                " is not flat");
            require(
                shape() != "sphere" || (std::isinf(c_.solids.R[0]) && std::isinf(c_.solids.R[1])),
                {"indentation%boundary", "solids%R"},
                "is for two flats, but R = ", get_key(c_, "solids%R"),
                "; give R = Infinity, Infinity");
            require(i.selection != Selection::paper,
                    {"indentation%selection", "indentation%boundary"},
                    "is defined for a sphere only, not for two flats");
            require(c_.surface.source != Source::asperities || c_.surface.L,
                    {"surface%L", "indentation%boundary"},
                    "give the period of the list of asperities");
        }
        if (i.line()) check_line();
        require(i.line() || !i.line_reference,
                {"indentation%line_reference", "indentation%boundary"},
                "is for line contact, boundary = 'periodic_x' or 'periodic_y'");
        const bool pressure = i.control == Control::pressure,
                   of_pressure = relative || i.unit == LevelUnit::pressure;
        require(!pressure || periodic, {"indentation%control", "indentation%boundary"},
                "a nominal pressure needs a nominal area, that of boundary = 'periodic'");
        require(of_pressure == pressure, {"indentation%unit", "indentation%control"},
                "with control = ", get_key(c_, "indentation%control"), " it is ",
                of_pressure ? "'sigma' or 'length'" : "'relative' or 'pressure'");
        if (!pressure || !relative || elements_) return;
        const double most =
            i.levels.empty() ? std::max(i.start, i.stop) : std::ranges::max(i.levels);
        require(most < kClosingPressure,
                {i.levels.empty() ? "indentation%start" : "indentation%levels", "indentation%unit"},
                "a pressure of ", from_real(most),
                " E* sqrt(2 m2): at 1 and above less than 5 % of the area is gap, too little "
                "for the asperity model; use solver%model = "
                "'elements', which is valid up to full contact");
    }

    // The fields of a physics need it.
    void check_fields() {
        const std::vector<const Physics*> asked = physics_asked(c_);
        for (const Physics* p : all_physics())
            for (const PointField& f : p->fields)
                require(!has_field(c_, f.name) || contains(asked, p), {"output%fields", p->key},
                        "'", f.name, "' needs ", p->key);
    }

    void check_sizes() {
        const Case::Output& o = c_.output;
        const double cells = o.map_cells;
        const auto at_most = [&](double values, double most, const char* key) {
            require(values <= most, {key, by_}, "with ", count(levels_), " levels more than ",
                    count(most), " values");
        };
        at_most(levels_ * cells * cells, kMostMapValues, "output%map_cells");
        at_most(levels_ * o.radial_bins, kMostMapValues, "output%radial_bins");
        at_most(levels_ * c_.run.realizations, kMostLevelValues, "run%realizations");
        require(cells * o.radial_bins <= kMostCircles, {"output%radial_bins", "output%map_cells"},
                "times map_cells at most ", count(kMostCircles));
        require(double(c_.run.first_realization) + c_.run.realizations - 1 <= 2147483647.0,
                {"run%first_realization", "run%realizations"},
                "the last realization would be beyond 2147483647");
        check_window("output%field_window", "output%fields", o.field_window);
        require(!o.fields.empty() || !o.field_window[0], {"output%field_window", "output%fields"},
                "no fields are requested");
        require(!o.fields.empty() || o.field_levels.empty(),
                {"output%field_levels", "output%fields"}, "no fields are requested");
        require(o.fields.empty() || c_.surface.source != Source::asperities,
                {"output%fields", "surface%source"},
                "need the points of a surface, and source = 'asperities' has none");
        require(!o.file.empty(), {"output%file"}, "must not be empty");
    }

    const Case& c_;
    bool elements_;
    const char* by_;  // the key that gives the number of levels
    double levels_;   // their number
    std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> check_case(const Case& settings) { return Checker(settings).check(); }

void require_valid(const Case& settings, std::initializer_list<std::string_view> names) {
    std::string text;
    for (const Problem& problem : check_case(settings)) {
        const Key& key = *problem.keys.front();
        const auto is_key = [&](std::string_view name) {
            return name == key.group || name == full_name(key);
        };
        if (names.size() == 0 || std::ranges::any_of(names, is_key))
            enlist(text, "\n", "&", key.group, ": ", problem.text);
    }
    if (!text.empty()) bad_input(text);
}

bool has_closed_forms(const Case& c) {
    return c.solids.layer_thickness.empty() && c.indenter.file.empty() &&
           std::ranges::all_of(physics_asked(c), &Physics::closed_forms);
}

}  // namespace rsc
