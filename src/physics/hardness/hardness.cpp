#include "physics/hardness/hardness.hpp"

#include <boost/math/tools/roots.hpp>

#include "base/error.hpp"

namespace rsc {
namespace {

using Spread = Truncation::Spread;

// The slope decreases where a reloaded asperity continues to yield: the law is not convex.
class Yielding final : public YieldingLaw {
public:
    Yielding(std::unique_ptr<Law> elastic, const Truncation& truncation,
             const Asperities& asperities, const Hardness& hardness)
        : elastic_(std::move(elastic)),
          truncation_(truncation),
          radius_(asperities.radius),
          hardness_(hardness),
          place_(asperities.size(), -1) {}

    const LawMemory* memory() const override { return this; }

    void prepare(std::span<const int> asperities) override {
        elastic_->prepare(asperities);
        for (int i : asperities) {
            if (place_[at(i)] >= 0) continue;
            place_[at(i)] = int(summits_.size());
            Summit s;
            s.H = hardness_.at(radius_[at(i)]);
            s.yield = truncation_.yield_penetration(i, s.H);
            const double area = elastic_->area(i, s.yield);
            const Response first = elastic_->response(i, s.yield);
            s.start = {s.yield, area, std::sqrt(area / pi), truncation_.spread(i, s.yield)};
            s.modulus = 3 * first.force / (4 * s.start.radius * s.yield);
            s.sink = truncation_.sinks() ? 4 * s.H / (pi * s.modulus) : 0.0;
            s.work = first.work;
            summits_.push_back(s);
        }
    }

    void respond(int n, const int* asperity, const double* u, double* force, double* slope,
                 double* work) const override {
        for (const int k : indices(n)) {
            const Summit& s = summit(asperity[k]);
            if (!(u[k] > s.rest)) {  // rest is 0 if it has never yielded
                force[k] = slope[k] = work[k] = 0;
                continue;
            }
            if (s.deepest == 0 && u[k] <= s.yield) {
                elastic_->respond(1, &asperity[k], &u[k], &force[k], &slope[k], &work[k]);
                continue;
            }
            if (u[k] <= s.deepest) {
                const double x = u[k] - s.rest;
                force[k] = back(s, x);
                slope[k] = s.power * force[k] / x;
                work[k] = force[k] * x / (1 + s.power);
                continue;
            }
            const Flat now = flat(asperity[k], u[k]);
            force[k] = s.H * now.area;
            slope[k] = s.H * growth(s, now.spread.slope, now.radius);
            work[k] = s.deepest > 0 ? recoverable(s) + flow(s, s.end, now)
                                    : s.work + flow(s, s.start, now);
        }
    }

    Footprint footprint(int asperity, double u) const override {
        const Summit& s = summit(asperity);
        Footprint spot = elastic_->footprint(asperity, u);
        if (s.deepest > 0 && u <= s.deepest)
            spot.area = u > s.rest ? s.end.area * ((u - s.rest) / (s.deepest - s.rest)) : 0.0;
        else if (u > s.yield)
            spot.area = flat(asperity, u).area;
        return spot;
    }

    double steepest(int asperity, double high) const override {
        const Summit& s = summit(asperity);
        const auto slope = [&](double u) { return response(asperity, u).slope; };
        if (high <= (s.deepest > 0 ? s.deepest : s.yield)) return slope(high);
        // The largest of the slope at the end of the elastic branch and a bound on the plastic
        // growth, which increases with the radius and is monotonic in the slope of the spread.
        const Flat &from = s.deepest > 0 ? s.end : s.start, to = flat(asperity, high);
        return std::max(slope(s.deepest > 0 ? s.deepest : s.yield),
                        s.H * growth(s, std::max(from.spread.slope, to.spread.slope), to.radius));
    }

    bool yields(int asperity, double u) const override {
        const Summit& s = summit(asperity);
        return u > s.yield && u >= s.deepest;
    }
    double residual_depth(int asperity) const override {
        return place_[at(asperity)] < 0 ? 0 : summit(asperity).rest;
    }
    double deepest(int asperity) const override {
        return place_[at(asperity)] < 0 ? 0 : summit(asperity).deepest;
    }
    std::span<const int> yielded() const override { return yielded_; }
    void forget() override {
        for (Summit& s : summits_) {
            s.deepest = 0;
            s.end = {};
            s.rest = 0;
            s.power = 1.5;
            s.lost = 0;
        }
        yielded_.clear();
    }
    double work_lost() const override {
        double sum = 0;
        for (const int i : yielded_) sum += summit(i).lost;
        return sum;
    }

    void commit(int n, const int* asperity, const double* u) override {
        for (const int k : indices(n)) {
            Summit& s = summits_[at(place_[at(asperity[k])])];
            if (!(u[k] > s.yield && u[k] > s.deepest)) continue;
            s.end = {};  // where the search begins: the result depends on the depth alone
            const Flat now = flat(asperity[k], u[k]);
            const double f = s.H * now.area, spent = s.work + flow(s, s.start, now);
            const double x = 0.75 * f / (s.modulus * now.radius);  // a^2/r'
            if (s.deepest == 0)
                yielded_.insert(std::ranges::lower_bound(yielded_, asperity[k]), asperity[k]);
            s.deepest = u[k];
            s.end = now;
            s.power = std::max(1.5, f * x / spent - 1);
            s.rest = u[k] - x;
            s.lost = std::max(spent - recoverable(s), 0.0);  // rounding
        }
    }

private:
    // State of a flattened summit: depth without sinking, area, radius, and the spread of the
    // elastic law there.
    struct Flat {
        double depth = 0, area = 0, radius = 0;
        Spread spread;
    };
    struct Summit {
        double H = 0;
        double yield = 0;    // u_c
        Flat start;          // at u_c
        double work = 0;     // up to u_c
        double modulus = 0;  // E'
        double sink = 0;     // 4 H/(pi E'), or 0
        // History; deepest = 0: never yielded.
        double deepest = 0;  // u_m
        Flat end;            // at u_m
        double rest = 0;     // u_r
        double power = 1.5;  // exponent m of unloading
        double lost = 0;     // plastic work
    };

    const Summit& summit(int asperity) const { return summits_[at(place_[at(asperity)])]; }

    Flat flat_at(int asperity, double depth) const {
        const Summit& s = summit(asperity);
        const Spread spread = truncation_.spread(asperity, depth);
        const double area = s.start.area + 2 * (spread.area - s.start.spread.area);
        return {depth, area, std::sqrt(area / pi), spread};
    }
    // State beyond u_c. If summits sink, solves depth + sink [a(depth) - a(u_c)] = u.
    Flat flat(int asperity, double u) const {
        const Summit& s = summit(asperity);
        if (s.sink == 0) return flat_at(asperity, u);
        const auto miss = [&](double depth) {
            const Flat now = flat_at(asperity, depth);
            return std::pair(depth + s.sink * (now.radius - s.start.radius) - u,
                             1 + s.sink * now.spread.slope / (pi * now.radius));
        };
        // The last step from half of all digits is exact.
        std::uintmax_t steps = 50;
        return flat_at(asperity, boost::math::tools::newton_raphson_iterate(
                                     miss, std::max(s.start.depth, s.end.depth), s.start.depth, u,
                                     std::numeric_limits<double>::digits / 2, steps));
    }
    // Growth dA/du of the area.
    static double growth(const Summit& s, double spread_slope, double radius) {
        return 2 * spread_slope / (1 + s.sink * spread_slope / (pi * radius));
    }
    // Integral of f du at constant pressure between two states.
    static double flow(const Summit& s, const Flat& from, const Flat& to) {
        const double sunk =
            s.sink * pi / 3 *
            (to.radius * to.radius * to.radius - from.radius * from.radius * from.radius);
        return s.H * ((s.start.area - 2 * s.start.spread.area) * (to.depth - from.depth) +
                      2 * (to.spread.integral - from.spread.integral) + sunk);
    }
    // Unloading force H A_m (x/x_m)^m, where x = u - u_r.
    static double back(const Summit& s, double x) {
        const double share = x / (s.deepest - s.rest);
        return s.H * s.end.area *
               (s.power == 1.5 ? share * std::sqrt(share) : std::pow(share, s.power));
    }
    static double recoverable(const Summit& s) {
        return s.H * s.end.area * (s.deepest - s.rest) / (1 + s.power);
    }

    std::unique_ptr<Law> elastic_;
    const Truncation& truncation_;  // of the elastic law
    const std::vector<double>& radius_;
    Hardness hardness_;
    std::vector<int> place_;  // index of an asperity in summits_; -1: not prepared
    std::vector<Summit> summits_;
    std::vector<int> yielded_;  // increasing
};

class YieldingAsperities final : public AsperityHistory {
public:
    YieldingAsperities(YieldingLaw& law, std::size_t asperities)
        : law_(law), asperities_(asperities) {}

    void accept(const WorkingSet& set, const Solution& solution, Products&, Level& level) override {
        law_.commit(set.size(), set.asperity.data(), solution.v.data());
        level.plastic_work = law_.work_lost();
    }
    // Pairs of the index of a yielded asperity and its largest penetration.
    void write(std::vector<double>& numbers) const override {
        for (const int i : law_.yielded()) append(numbers, {double(i), law_.deepest(i)});
    }
    void read(std::span<const double> numbers) override {
        std::vector<int> yielded;
        std::vector<double> deepest;
        for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) {
            if (!(numbers[k] >= 0 && numbers[k] < double(asperities_) &&
                  std::isfinite(numbers[k + 1])))
                bad_input("the state does not belong to a contact of these asperities");
            yielded.push_back(int(numbers[k]));
            deepest.push_back(numbers[k + 1]);
        }
        law_.forget();
        law_.prepare(yielded);
        law_.commit(int(yielded.size()), yielded.data(), deepest.data());
    }
    Remains remains(const Level&) const override {
        Remains all;
        for (const auto i : indices(asperities_))
            all.residual_depths.push_back(law_.residual_depth(int(i)));
        return all;
    }

private:
    YieldingLaw& law_;
    std::size_t asperities_;
};

}  // namespace

std::unique_ptr<YieldingLaw> make_yielding(std::unique_ptr<Law> elastic,
                                           const Asperities& asperities, const Hardness& hardness) {
    const Truncation* const truncation = elastic->capabilities().truncation;
    if (!truncation) bad_input("solids%hardness: not available with this asperities%law");
    return std::make_unique<Yielding>(std::move(elastic), *truncation, asperities, hardness);
}

AsperityPhysics make_yielding_asperities(const ContactBodies& bodies,
                                         std::unique_ptr<Law> elastic) {
    const Hardness& hardness = bodies.options.physics.of<Hardness>();
    auto law = make_yielding(std::move(elastic), bodies.asperities, hardness);
    auto history = std::make_unique<YieldingAsperities>(*law, bodies.asperities.size());
    return {std::move(law), std::move(history)};
}

namespace {

std::vector<Key> hardness_keys() {
    using namespace keys;
    return {
        number(RSC_KEY(solids, hardness), "force/length^2", kPositiveOrInfinite,
               "hardness H0: upper limit of the mean pressure of an asperity, H0 sqrt(1 + "
               "size_effect/r), and of the pressure on an element, H0; each level then "
               "depends on the levels before it"),
        number(
            RSC_KEY(solids, size_effect), "length", kNotNegative,
            "characteristic length of the indentation size effect on the hardness of asperities"),
    };
}

void check_hardness(const Case& settings, const Complain& complain) {
    const Case::Solids& s = settings.solids;
    if (std::isfinite(s.hardness) && std::isinf(s.E[0]) && s.layer_thickness.empty())
        complain({"solids%hardness", "solids%E"},
                 "the asperities of body 1 yield, so body 1 must not be rigid (E(1) = Infinity)");
}

void print_yielding(std::ostream& out, const RunFacts& run) {
    const auto& levels = run.levels;
    if (levels.empty()) return;
    const auto most = std::ranges::max_element(levels, {}, &LevelValues::plastic_contacts);
    if (most->plastic_contacts == 0) {
        out << "  no contact yields: pressures stay below the hardness.\n";
        return;
    }
    out << format("  %s: %d of %d contacts yield", run.place_of(*most).c_str(),
                  most->plastic_contacts, most->contacts);
    double lost = 0;
    for (const LevelValues& level : levels)
        lost = std::max(lost, level.plastic_work);  // NaN if a level did not converge
    const auto& units = run.settings.run;
    if (units.realizations == 1)
        out << format("; plastic work %.4g %s %s", lost, units.force_unit.c_str(),
                      units.length_unit.c_str());
    out << ". Results depend on the loading history.\n";
}

bool hardness_asked(const Case& c) { return std::isfinite(c.solids.hardness); }

// The share of the contact area under the hardness: of pixels of elements, or of spots.
const char* compute_yielding_share(LevelSource& source) {
    Level& level = source.level;
    const double H = source.physics ? source.physics->of<Hardness>().H0 : kInfinity;
    if (std::isinf(H)) return "the bodies are elastic: the case has no solids%hardness";
    double all = 0, hard = 0;
    for (const double p : level.pixels.pressure) {
        all += 1;
        hard += p >= H;
    }
    if (level.pixels.pressure.empty())
        for (const auto k : indices(level.yields)) {
            all += level.a[k] * level.a[k];
            hard += level.yields[k] ? level.a[k] * level.a[k] : 0;
        }
    level.yielding_share = all > 0 ? hard / all : 0;
    return nullptr;
}

std::vector<LevelQuantity> hardness_quantities() {
    using V = LevelValues;
    return {
        {.name = "plastic_contacts",
         .member = &V::plastic_contacts,
         .meaning = "contacts that yield",
         .comment =
             "mean pressure at the hardness H = H0 sqrt(1 + l/r), at the largest penetration so "
             "far; boundary elements: contacts with a pixel at the hardness",
         .always = false,
         .written_with = &V::plastic_work},
        {.name = "yielding_share",
         .member = &V::yielding_share,
         .unit = "1",
         .meaning = "share of the contact area that yields",
         .comment = "boundary elements: pixels at the hardness over pixels under pressure; "
                    "asperities: area of the spots that yield over that of all spots",
         .compute = compute_yielding_share,
         .in_run = hardness_asked,
         .always = false,
         .shown = hardness_asked,
         .answers = true,
         .statistics = true,
         .plain = "share of the contact area that yields",
         .heading = "yielding",
         .width = 9,
         .digits = 3},
        {.name = "plastic_work",
         .member = &V::plastic_work,
         .length_power = 1,
         .force_power = 1,
         .meaning = "plastic work of all contacts since the first level",
         .comment = "boundary elements: H times the volume of the plastic residual; levels after "
                    "yielding depend on the history",
         .always = false},
    };
}

void require_sound(const BodyPhysics& bodies) {
    const Hardness& hardness = bodies.of<Hardness>();
    if (!(hardness.H0 > 0)) bad_input("solids%hardness must be positive (Infinity: elastic)");
    if (!(hardness.length >= 0) || std::isinf(hardness.length))
        bad_input("solids%size_effect must not be negative");
}

// The area at the hardness grows as that in which the undeformed bodies cross, at the present share
// of the points.
double depth_of_yielding(const Level& level, const HeightMap& map, const Indenter& indenter,
                         const BodyPhysics& bodies) {
    if (level.plastic_contacts == 0) return 0;
    const double hardness = bodies.of<Hardness>().H0;
    constexpr double around = 1.25;
    const auto& pressures = level.pixels.pressure;
    const double points = double(pressures.size());
    const double hard = double(
        std::ranges::count_if(pressures, [&](double pressure) { return pressure >= hardness; }));
    std::vector<double> heights;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx))
            if (const double z = indenter.clearance(map.x(i), map.y(j), map(i, j));
                std::isfinite(z))
                heights.push_back(z);
    const auto rank = [&](double share) {
        return std::min(std::size_t(share * points), heights.size() - 1);
    };
    const auto height = [&](std::size_t k) {
        std::ranges::nth_element(heights, heights.begin() + std::ptrdiff_t(k), std::greater());
        return heights[k];
    };
    const std::size_t few = rank(1 / around), many = std::max(few + 1, rank(around));
    if (many >= heights.size()) return kNotComputed;
    return hard * (height(few) - height(many)) / double(many - few);
}

bool has_size_effect(const Combination& c) { return c.bodies.of<Hardness>().length > 0; }

}  // namespace

const Physics kHardness = {
    .name = "hardness",
    .key = "solids%hardness",
    .keys = hardness_keys,
    .take =
        [](const Case& c, BodyPhysics& bodies) {
            bodies.of<Hardness>() = {c.solids.hardness, c.solids.size_effect};
        },
    .asked = [](const BodyPhysics& bodies) { return bodies.of<Hardness>().H0 != kInfinity; },
    .excludes = {{"friction", "friction of asperities needs elastic ones",
                  [](const Combination& c) { return !c.elements; }},
                 {"solver%model", "it needs the radius of asperities",
                  [](const Combination& c) { return has_size_effect(c) && c.elements; },
                  "solids%size_effect"},
                 {"compare%levels", "it needs the radius of asperities",
                  [](const Combination& c) { return has_size_effect(c) && c.compares; },
                  "solids%size_effect"},
                 {"asperities%law", "the law does not say how its contacts grow by truncation",
                  [](const Combination& c) {
                      return !c.elements && !capabilities_of(c.law).truncation;
                  }}},
    .check = check_hardness,
    .needs_asperities =
        [](const Case& c) {
            return c.solids.size_effect > 0 ? "solids%size_effect needs them" : "";
        },
    .path = "points that yielded (solids hardness) remain lowered",
    .quantities = hardness_quantities(),
    .lowers = true,
    .mends_extreme_pressures = true,
    .largest_pressure = [](const BodyPhysics& bodies,
                           double radius) { return bodies.of<Hardness>().at(radius); },
    .calibrated = [](const BodyPhysics& bodies,
                     bool layers) { return bodies.of<Hardness>().length == 0 && !layers; },
    .further_approach = depth_of_yielding,
    .require_sound = require_sound,
    .compares_itself = [](const Case& c) { return !(c.solids.size_effect > 0); },
    .bytes_per_point = 8,  // depths of lowered points
    .remark = print_yielding,
    .law = make_yielding_asperities,
};

}  // namespace rsc
