// The checks of a case, key by key and as a whole.

#include "case/case.hpp"
#include "case/namelist_value.hpp"
#include "case/registry.hpp"
#include "case/units.hpp"
#include "contact/indenter/shapes.hpp"
#include "error.hpp"
#include "rough/asperities.hpp"

namespace rsc {
namespace {

constexpr double kMostMapValues = 1e9;    // of one map variable: 8 GB
constexpr double kMostCircles = 2e6;      // radial_bins times map_cells, to which the work of the radial means is proportional: a second
constexpr double kMostLevelValues = 1e9;  // realizations x levels

class Checker {
public:
    explicit Checker(const Case& settings) : c_(settings) {}

    std::vector<Problem> check() {
        for (const Key& key : registry()) check_key(key);
        check_units();
        check_solids();
        check_surface();
        check_elements();
        check_indenter();
        check_levels();
        check_boundary();
        check_sizes();
        return std::move(problems_);
    }

private:
    void complain(std::vector<const char*> names, std::string text) {
        Problem problem{{}, 0, std::move(text)};
        for (const std::string_view name : names) {
            const std::size_t percent = name.find('%');
            problem.keys.push_back(find_key(name.substr(0, percent), name.substr(percent + 1)));
        }
        problems_.push_back(std::move(problem));
    }

    void check_key(const Key& key) {
        // Slots point to non-const values; here they are only read.
        const Slot slot = key.slot(const_cast<Case&>(c_));
        const auto number = [&](double value, long element) {
            const bool overflows = std::isfinite(value) && !usable(value);
            const bool vanishes = value > 0 && key.bounds.low == 0 && key.bounds.open && !usable_positive(value) && std::isfinite(value);
            if (key.bounds.hold(value) && !overflows && !vanishes) return;
            const std::string bounds = overflows || vanishes ? "of a magnitude from 1e-50 to 1e50" : key.bounds.text();
            problems_.push_back({{&key},
                                 element,
                                 std::string(key.name) + (element > 0 ? "(" + std::to_string(element) + ")" : "") + " = " +
                                     shown(value, key.type) + ": must be " + (bounds.empty() ? "finite" : bounds)});
        };
        const long size = key.size;
        for (long i = 0; i < size; ++i) {
            const long element = size > 1 ? i + 1 : 0;
            if (auto* n = std::get_if<int*>(&slot))
                number((*n)[i], element);
            else if (auto* x = std::get_if<double*>(&slot))
                number((*x)[i], element);
            else if (auto* o = std::get_if<std::optional<double>*>(&slot)) {
                if ((*o)[i]) number(*(*o)[i], element);
            } else
                break;
        }
        if (auto* v = std::get_if<std::vector<double>*>(&slot)) {
            const std::vector<double>& list = **v;
            if (list.size() > static_cast<std::size_t>(key.size))
                problems_.push_back({{&key}, 0, std::string(key.name) + ": at most " + std::to_string(key.size) + " values"});
            if (list.empty() && !*key.unset && !key.word) problems_.push_back({{&key}, 0, std::string(key.name) + ": at least one value"});
            for (std::size_t i = 0; i < list.size() && i < static_cast<std::size_t>(key.size); ++i)
                number(list[i], static_cast<long>(i + 1));
        }
        if (auto* s = std::get_if<std::string*>(&slot)) check_text(key, **s);
    }

    // Text that the effective namelist could not reproduce is refused.
    void check_text(const Key& key, const std::string& text) {
        const auto control = [](char c) { return (static_cast<unsigned char>(c) < 32 && c != '\t') || c == 127; };
        std::string wrong;
        if (std::any_of(text.begin(), text.end(), control))
            wrong = "control characters are not allowed";
        else if (text.size() > static_cast<std::size_t>(key.length))
            wrong = "at most " + std::to_string(key.length) + " characters";
        else if (!text.empty() && text.back() == ' ')
            wrong = "blanks at the end are not allowed";
        if (!wrong.empty()) problems_.push_back({{&key}, 0, std::string(key.name) + ": " + wrong});
    }

    static std::string shown(double value, Type type) {
        if (type == Type::integer) return std::to_string(static_cast<long long>(value));
        return namelist::from_real(value);
    }

    void check_units() {
        if (const std::string wrong = unit_problem(c_.run.length_unit, Quantity::length); !wrong.empty())
            complain({"run%length_unit"}, "length_unit: " + wrong);
        if (const std::string& unit = c_.surface.height_unit; !unit.empty())
            if (const std::string wrong = unit_problem(unit, Quantity::length); !wrong.empty())
                complain({"surface%height_unit"}, "height_unit: " + wrong);
        if (const std::string wrong = unit_problem(c_.run.force_unit, Quantity::force); !wrong.empty())
            complain({"run%force_unit"}, "force_unit: " + wrong);
        if (const std::string wrong = unit_problem(c_.run.time_unit, Quantity::time); !wrong.empty())
            complain({"run%time_unit"}, "time_unit: " + wrong);
    }

    void check_adhesion() {
        const Case::Solids& s = c_.solids;
        if (!(s.adhesion > 0)) {
            if (s.adhesion_range > 0) complain({"solids%adhesion_range", "solids%adhesion"}, "adhesion_range: needs solids%adhesion > 0");
            return;
        }
        const auto refuse = [&](bool asked, const char* with, const std::string& what) {
            if (asked) complain({"solids%adhesion", with}, "adhesion: " + what);
        };
        refuse(std::isfinite(s.hardness), "solids%hardness", "with solids%hardness it is not available yet");
        refuse(s.friction > 0, "solids%friction", "with solids%friction it is not available yet");
        refuse(relaxes(c_), "solids%relaxation_share", "with solids%relaxation_share it is not available yet");
        refuse(s.adhesion_range > 0 && !by_elements(c_) && c_.asperities.law == LawKind::fourth_order, "asperities%law",
               "with adhesion_range > 0 law = 'fourth_order' is not available yet; give 'hertz' or 'elliptic'");
        refuse(!(s.adhesion_range > 0) && by_elements(c_), "solids%adhesion_range", "model = 'elements' needs adhesion_range > 0");
        refuse(c_.compare.listed() && !(s.adhesion_range > 0), "compare%levels", "elements need adhesion_range > 0");
        refuse(c_.solver.method == Method::dgesv, "solver%method", "method = 'dgesv' does not support tensile forces; give another method");
        refuse(c_.indentation.selection == Selection::paper, "indentation%selection",
               "needs asperities beyond the circle of selection = 'paper'; give 'overlap'");
    }

    void check_solids() {
        check_layers();
        check_relaxation();
        check_adhesion();
        if (c_.solids.layer_thickness.empty() && std::isinf(c_.solids.E[0]) && std::isinf(c_.solids.E[1]))
            complain({"solids%E"}, "E = Infinity, Infinity: two rigid bodies do not deform; at most one body may be rigid");
        if (std::isfinite(c_.solids.hardness)) {
            if (c_.solids.layer_thickness.empty() && std::isinf(c_.solids.E[0]))
                complain({"solids%hardness", "solids%E"},
                         "hardness: the asperities of body 1 yield, so body 1 must not be rigid (E(1) = Infinity)");
            if (c_.solids.friction > 0)
                complain({"solids%hardness", "solids%friction"},
                         "hardness: not available together with friction, which needs elastic asperities");
            const char* elements = by_elements(c_) ? "solver%model" : "compare%levels";
            if (by_elements(c_) || c_.compare.listed()) {
                if (c_.solids.size_effect > 0)
                    complain({"solids%size_effect", elements},
                             "size_effect: not available for elements, which have no radius; give the hardness of asperities of "
                             "this size");
            }
        }
        if (c_.solids.friction > 0 && by_elements(c_))
            complain({"solids%friction", "solver%model"}, "friction: with model = 'elements' it is not available yet");
    }

    void check_layers() {
        const Case::Solids& s = c_.solids;
        const std::size_t n = s.layer_thickness.size();
        if (s.layer_E.size() != n || s.layer_nu.size() != n)
            complain({s.layer_E.size() != n ? "solids%layer_E" : "solids%layer_nu", "solids%layer_thickness"},
                     "layer_thickness, layer_E, layer_nu: have " + std::to_string(n) + ", " + std::to_string(s.layer_E.size()) + " and " +
                         std::to_string(s.layer_nu.size()) + " values; each layer needs one of each");
        if (n == 0) return;
        if (s.friction > 0)
            complain({"solids%friction", "solids%layer_thickness"}, "friction: on a body with layers it is not available yet");
        if (s.resistivity[0] > 0 || s.resistivity[1] > 0)
            complain({"solids%resistivity", "solids%layer_thickness"},
                     "resistivity: not available yet for a body with layers, whose conductance does not follow from its stiffness");
    }

    void check_relaxation() {
        const Case::Solids& s = c_.solids;
        const Case::Indentation& i = c_.indentation;
        if (s.relaxation_share.size() != s.relaxation_time.size())
            complain({"solids%relaxation_share", "solids%relaxation_time"},
                     "relaxation_share, relaxation_time: have " + std::to_string(s.relaxation_share.size()) + " and " +
                         std::to_string(s.relaxation_time.size()) + " values; each share needs one time");
        double sum = 0;
        for (const double g : s.relaxation_share) sum += g;
        if (sum > 1 + 1e-12)
            complain({"solids%relaxation_share"},
                     "relaxation_share: the shares add up to " + namelist::from_real(sum) + "; their sum must be at most 1");
        if (i.duration && !i.times.empty())
            complain({"indentation%duration", "indentation%times"}, "duration: times are given as well; give only one of the two");
        const std::size_t levels = i.levels.empty() ? static_cast<std::size_t>(std::max(i.steps, 0)) : i.levels.size();
        if (!i.times.empty() && i.times.size() != levels)
            complain({"indentation%times", i.levels.empty() ? "indentation%steps" : "indentation%levels"},
                     "times: has " + std::to_string(i.times.size()) + " values for " + std::to_string(levels) + " levels");
        if (std::adjacent_find(i.times.begin(), i.times.end(), [](double a, double b) { return !(b > a); }) != i.times.end())
            complain({"indentation%times"}, "times: must increase from each level to the next");
        if (!relaxes(c_)) return;
        const auto together = [&](bool given, const char* key) {
            if (given)
                complain({"solids%relaxation_share", key},
                         std::string("relaxation_share: together with ") + key + " it is not available yet");
        };
        together(std::isfinite(s.hardness), "solids%hardness");
        together(s.friction > 0, "solids%friction");
        together(!s.layer_thickness.empty(), "solids%layer_thickness");
        together(c_.compare.listed(), "compare%levels");
        together(c_.solver.method == Method::dgesv, "solver%method");
        if (std::isinf(s.E[0])) complain({"solids%relaxation_share", "solids%E"}, "relaxation_share: E(1) = Infinity makes body 1 rigid");
    }

    void check_surface() {
        const Case::Surface& s = c_.surface;
        if (s.source != Source::synthetic && s.file.empty())
            complain({"surface%source", "surface%file"}, "source = " + get_key(c_, "surface%source") + " needs a file");
        check_window("surface%window", "surface%source", s.window);
        const auto of_maps = [&](bool given, const char* key) {
            if (given && s.source != Source::heights &&
                kShapes.at(static_cast<std::size_t>(c_.indenter.shape)).name != std::string_view("map"))
                complain({key, "surface%source"}, std::string(std::strchr(key, '%') + 1) +
                                                      ": is for heights read from files, and source = " + get_key(c_, "surface%source"));
        };
        of_maps(!s.height_unit.empty(), "surface%height_unit");
        of_maps(s.pixel.has_value(), "surface%pixel");
        of_maps(s.window[0].has_value(), "surface%window");
        of_maps(s.outliers > 0, "surface%outliers");
        if (s.source == Source::heights || s.source == Source::asperities) {
            const bool several = s.source == Source::heights && s.file.find_first_of("*?[") != std::string::npos;
            if (c_.run.realizations > 1 && !several)
                complain(
                    {"run%realizations", "surface%source"},
                    "realizations: a surface from one file is one realization; for several height maps give a pattern such as maps/*.gwy as the file");
            return;
        }
        if (!(s.kurtosis > s.skewness * s.skewness + 1))
            complain({"surface%kurtosis", "surface%skewness"},
                     "kurtosis = " + namelist::from_real(s.kurtosis) + ": must be greater than skewness^2 + 1 = " +
                         namelist::from_real(s.skewness * s.skewness + 1) + ", the lower bound for any distribution");
        if (s.n % 2 != 0) complain({"surface%n"}, "n = " + std::to_string(s.n) + ": must be even");
        if (s.twin_heights == TwinHeights::measured && (s.skewness != 0 || s.kurtosis != 3))
            complain({"surface%twin_heights", "surface%skewness", "surface%kurtosis"},
                     "twin_heights = 'measured': excludes skewness and kurtosis, because the file gives the height distribution");
        if (s.twins == Twins::directional && s.aspect != 1)
            complain({"surface%twins", "surface%aspect"},
                     "twins = 'directional': excludes aspect, because the spectrum has its own direction");
        if (s.source == Source::spectrum) return;
        if (s.twins != Twins::radial) complain({"surface%twins", "surface%source"}, "twins = 'directional': needs source = 'spectrum'");
        if (s.twin_heights != TwinHeights::gaussian)
            complain({"surface%twin_heights", "surface%source"}, "twin_heights = 'measured': needs source = 'spectrum'");
        if (!(s.L_lambda_s > s.L_lambda_l))
            complain({"surface%L_lambda_s", "surface%L_lambda_l"},
                     "L_lambda_s = " + namelist::from_real(s.L_lambda_s) +
                         ": must be larger than L_lambda_l = " + namelist::from_real(s.L_lambda_l));
        const double stretched = std::sqrt(std::max(s.aspect, 1 / s.aspect));
        if (!(s.n > 2 * s.L_lambda_s * stretched))
            complain({"surface%n", "surface%L_lambda_s", "surface%aspect"},
                     "n = " + std::to_string(s.n) + ": must be larger than 2 L_lambda_s" + (s.aspect == 1 ? "" : " sqrt(aspect)") + " = " +
                         namelist::from_real(2 * s.L_lambda_s * stretched) + " so that the grid resolves the shortest wavelength");
        const double L = s.L.value_or(1.0);
        for (const std::optional<double>& x : c_.indentation.centre)
            if (x && (*x < 0 || *x > L)) {
                complain({"indentation%centre", "surface%L"},
                         "centre = " + get_key(c_, "indentation%centre") + ": must lie on the surface, 0 to L = " + namelist::from_real(L));
                break;
            }
    }

    void check_window(const char* key, const char* beside, const std::optional<double> (&w)[4]) {
        if (!w[0] && !w[1] && !w[2] && !w[3]) return;
        if (!(w[0] && w[1] && w[2] && w[3] && *w[0] < *w[1] && *w[2] < *w[3]))
            complain({key, beside}, std::string(std::strchr(key, '%') + 1) + ": x0, x1, y0, y1 with x0 < x1 and y0 < y1 are expected");
    }

    void check_elements() {
        const bool elements = by_elements(c_), compare = c_.compare.listed();
        if (!elements && !compare) return;
        const char* const key = elements ? "solver%model" : "compare%levels";
        const std::string what = elements ? "model = 'elements'" : "levels";
        if (c_.surface.source == Source::asperities)
            complain({key, "surface%source"}, what + ": elements need a surface, and source = 'asperities' has only summits");
        if (elements && compare)
            complain({"compare%levels", "solver%model"},
                     "levels: &compare compares asperities with elements; with model = 'elements' there is nothing to compare");
        if (elements && c_.solver.method != Method::automatic)
            complain({"solver%method", "solver%model"},
                     "method = " + get_key(c_, "solver%method") + ": is for model = 'asperities'; with elements only 'auto' is possible");
        if (c_.solver.interaction != Interaction::point)
            complain({key, "solver%interaction"}, what + ": interaction = 'none' is for asperities; elements always interact");
        const double shortest = c_.surface.L_lambda_s * std::sqrt(std::max(c_.surface.aspect, 1 / c_.surface.aspect));
        if (c_.surface.source == Source::synthetic && c_.elements.points_per_wave * shortest > 32768)
            complain({"elements%points_per_wave", "surface%L_lambda_s"},
                     "points_per_wave = " + namelist::from_real(c_.elements.points_per_wave) + ": gives a grid of " +
                         count(std::ceil(c_.elements.points_per_wave * shortest)) + " points a side; the maximum is 32768");
    }

    void check_indenter() {
        const Case::IndenterKeys& i = c_.indenter;
        const ShapeRow& row = kShapes.at(static_cast<std::size_t>(i.shape));
        const auto takes = [](const ShapeRow& shape, std::string_view key, bool needed) {
            return std::ranges::any_of(shape.keys,
                                       [&](std::string_view k) { return k == std::string(key) + '!' || (!needed && k == key); });
        };
        for (const Key& key : registry()) {
            if (key.group != std::string_view("indenter") || key.name == std::string_view("shape")) continue;
            const std::string name = std::string("indenter%") + key.name;
            const bool given = get_key(c_, name) != get_key(Case{}, name);
            if (!given && takes(row, key.name, true))
                complain({"indenter%shape", name.c_str()}, "shape = " + get_key(c_, "indenter%shape") + ": needs " + key.name);
            if (!given || takes(row, key.name, false)) continue;
            std::string shapes;
            for (const ShapeRow& other : kShapes)
                if (takes(other, key.name, false)) shapes += (shapes.empty() ? "'" : " or '") + std::string(other.name) + "'";
            complain({name.c_str(), "indenter%shape"},
                     std::string(key.name) + ": is for shape = " + shapes + ", and shape = " + get_key(c_, "indenter%shape"));
        }
        const std::string_view shape = row.name;
        if (i.radii[0].has_value() != i.radii[1].has_value()) complain({"indenter%radii"}, "radii: two values are needed");
        if (shape == "sphere") return;
        if (std::isfinite(c_.solids.R[0]) && shape != "paraboloid")
            complain({"solids%R", "indenter%shape"}, "R(1) = " + namelist::from_real(c_.solids.R[0]) +
                                                         ": a curved body 1 is for shape = 'sphere' and 'paraboloid'; give Infinity");
        if (c_.indentation.selection == Selection::paper)
            complain({"indentation%selection", "indenter%shape"}, "selection = 'paper': is defined for a sphere only");
    }

    void check_levels() {
        const Case::Indentation& i = c_.indentation;
        const bool explicit_levels = !i.levels.empty();
        const auto positive = [&](const char* why) {
            if (explicit_levels) {
                if (std::any_of(i.levels.begin(), i.levels.end(), [](double x) { return !(x > 0); }))
                    complain({"indentation%levels", "indentation%control"}, std::string("levels: must be positive ") + why);
                return;
            }
            if (!(i.start > 0))
                complain({"indentation%start", "indentation%spacing"},
                         "start = " + namelist::from_real(i.start) + ": must be positive " + why);
            if (!(i.stop > 0))
                complain({"indentation%stop", "indentation%spacing"},
                         "stop = " + namelist::from_real(i.stop) + ": must be positive " + why);
        };
        if (i.control == Control::force && !(c_.solids.adhesion > 0))
            positive("with control = 'force'");
        else if (i.control == Control::pressure && !(c_.solids.adhesion > 0))
            positive("with control = 'pressure'");
        else if (!explicit_levels && i.spacing == Spacing::log)
            positive("with spacing = 'log'");
    }

    void check_boundary() {
        const Case::Indentation& i = c_.indentation;
        const bool periodic = i.boundary == Boundary::periodic, relative = i.unit == LevelUnit::relative;
        const std::string_view shape = kShapes.at(static_cast<std::size_t>(c_.indenter.shape)).name;
        if (periodic && shape != "sphere" && shape != "map")
            complain({"indentation%boundary", "indenter%shape"},
                     "boundary = 'periodic': is for two flats, smooth or rough, and shape = " + get_key(c_, "indenter%shape") + " is none");
        if (periodic && shape == "sphere" && !(std::isinf(c_.solids.R[0]) && std::isinf(c_.solids.R[1])))
            complain({"indentation%boundary", "solids%R"},
                     "boundary = 'periodic': is for two flats, and R = " + get_key(c_, "solids%R") + "; give R = Infinity, Infinity");
        if (periodic && i.selection == Selection::paper)
            complain({"indentation%selection", "indentation%boundary"},
                     "selection = 'paper': is defined for a sphere only, not for two flats");
        if (periodic && c_.surface.source == Source::asperities && !c_.surface.L)
            complain({"surface%L", "indentation%boundary"}, "L: give the period of the list of asperities");
        if (i.control == Control::pressure && !periodic)
            complain({"indentation%control", "indentation%boundary"},
                     "control = 'pressure': a nominal pressure needs a nominal area, that of boundary = 'periodic'");
        const bool of_pressure = relative || i.unit == LevelUnit::pressure;
        if (of_pressure != (i.control == Control::pressure))
            complain({"indentation%unit", "indentation%control"}, "unit = " + get_key(c_, "indentation%unit") +
                                                                      ": with control = " + get_key(c_, "indentation%control") + " it is " +
                                                                      (of_pressure ? "'sigma' or 'length'" : "'relative' or 'pressure'"));
        if (!(i.control == Control::pressure && relative) || by_elements(c_)) return;
        const double most = i.levels.empty() ? std::max(i.start, i.stop) : *std::max_element(i.levels.begin(), i.levels.end());
        if (most >= kClosingPressure)
            complain(
                {i.levels.empty() ? "indentation%start" : "indentation%levels", "indentation%unit"},
                "a pressure of " + namelist::from_real(most) +
                    " E* sqrt(2 m2): at 1 and above less than 5 % of the area is gap, too little for the asperity model; use solver%model = "
                    "'elements', which is valid up to full contact");
    }

    void check_sizes() {
        const double levels = c_.indentation.levels.empty() ? c_.indentation.steps : static_cast<double>(c_.indentation.levels.size());
        const double cells = c_.output.map_cells;
        const char* by = c_.indentation.levels.empty() ? "indentation%steps" : "indentation%levels";
        if (levels * cells * cells > kMostMapValues)
            complain({"output%map_cells", by}, "map_cells = " + std::to_string(c_.output.map_cells) + ": the maps of " + count(levels) +
                                                   " levels would hold more than " + count(kMostMapValues) + " values");
        if (levels * c_.output.radial_bins > kMostMapValues)
            complain({"output%radial_bins", by}, "radial_bins = " + std::to_string(c_.output.radial_bins) + ": the radial means of " +
                                                     count(levels) + " levels would hold more than " + count(kMostMapValues) + " values");
        if (cells * c_.output.radial_bins > kMostCircles)
            complain({"output%radial_bins", "output%map_cells"},
                     "radial_bins = " + std::to_string(c_.output.radial_bins) + ": times map_cells at most " + count(kMostCircles));
        if (levels * c_.run.realizations > kMostLevelValues)
            complain({"run%realizations", by}, "realizations = " + std::to_string(c_.run.realizations) + ": with " + count(levels) +
                                                   " levels more than " + count(kMostLevelValues) + " values of each curve");
        if (c_.solids.friction > 0 && c_.run.realizations > 1)
            complain({"run%realizations"}, "realizations: only one with solids%friction > 0");
        if (double(c_.run.first_realization) + c_.run.realizations - 1 > 2147483647.0)
            complain({"run%first_realization", "run%realizations"}, "first_realization: the last realization would be beyond 2147483647");
        check_window("output%field_window", "output%fields", c_.output.field_window);
        if (c_.output.fields.empty() && c_.output.field_window[0])
            complain({"output%field_window", "output%fields"}, "field_window: no fields are requested");
        if (c_.output.fields.empty() && !c_.output.field_levels.empty())
            complain({"output%field_levels", "output%fields"}, "field_levels: no fields are requested");
        if (!c_.output.fields.empty() && c_.surface.source == Source::asperities)
            complain({"output%fields", "surface%source"}, "fields: need the points of a surface, and source = 'asperities' has none");
        if (c_.output.file.empty()) complain({"output%file"}, "file: must not be empty");
    }

    static std::string count(double n) { return std::to_string(static_cast<long long>(n)); }

    const Case& c_;
    std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> check_case(const Case& settings) { return Checker(settings).check(); }

void require_valid(const Case& settings) {
    std::string text;
    for (const Problem& problem : check_case(settings))
        text += (text.empty() ? "&" : "\n&") + std::string(problem.keys.front()->group) + ": " + problem.text;
    if (!text.empty()) bad_input(text);
}

bool relaxes(const Case& settings) {
    const auto& shares = settings.solids.relaxation_share;
    return std::any_of(shares.begin(), shares.end(), [](double g) { return g > 0; });
}

ModelChoice model_of(const Case& settings) {
    if (settings.solver.model != Model::automatic) return {settings.solver.model};
    switch (settings.surface.source) {
        case Source::synthetic:
        case Source::spectrum: return {Model::asperities, "the surface is synthetic"};
        case Source::asperities: return {Model::asperities, "only asperities are given"};
        case Source::heights: break;
    }
    // Keys that elements do not support.
    if (settings.compare.listed()) return {Model::asperities, "compare%levels compares them with elements"};
    if (settings.solids.adhesion > 0 && !(settings.solids.adhesion_range > 0))
        return {Model::asperities, "solids%adhesion without adhesion_range needs them"};
    if (settings.solids.friction > 0) return {Model::asperities, "solids%friction needs them"};
    if (settings.solids.hardness < Case::kInfinity && settings.solids.size_effect > 0)
        return {Model::asperities, "solids%size_effect needs them"};
    if (settings.asperities.law != LawKind::hertz || settings.asperities.curvature != Curvature::geometric)
        return {Model::asperities, "&asperities is set"};
    if (settings.solver.method != Method::automatic) return {Model::asperities, "solver%method needs them"};
    if (settings.solver.interaction != Interaction::point) return {Model::asperities, "solver%interaction needs them"};
    if (settings.indentation.selection != Selection::overlap) return {Model::asperities, "indentation%selection needs them"};
    return {Model::elements, "the heights are read from a file"};
}

}  // namespace rsc
