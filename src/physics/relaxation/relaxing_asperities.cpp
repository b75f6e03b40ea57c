#include "physics/relaxation/relaxing_asperities.hpp"

#include "base/error.hpp"
#include "physics/relaxation/load_memory.hpp"

namespace rsc {
namespace {

// B f at all points, for forces f at the first f.size() points.
std::vector<double> deflections(Products& products, const std::vector<double>& x,
                                const std::vector<double>& y, const std::vector<double>& f,
                                double tolerance) {
    std::vector<double> phi(x.size(), 0.0);
    if (f.empty()) return phi;
    std::vector<int> first(f.size());
    std::iota(first.begin(), first.end(), 0);
    products.set_points(int(x.size()), x.data(), y.data());
    products.set_active(first);
    if (products.inner_error() <= tolerance)
        products.inner_everywhere(f.data(), phi.data());
    else
        products.full(f.data(), phi.data());
    return phi;
}

}  // namespace

RelaxingAsperities::RelaxingAsperities(const Asperities& asperities, const Indenter& indenter,
                                       RelaxingLaw& law, const Relaxation& body, double tolerance)
    : asperities_(asperities),
      indenter_(indenter),
      law_(law),
      creep_(body),
      tolerance_(tolerance),
      steps_(body.shortest()),
      lowered_(asperities.size(), kNotComputed) {}

void RelaxingAsperities::step(double dt) {
    law_.step(dt);
    rests_ = law_.rests();
    rest_ = sum_of(rests_);
    for (int i : known_) lowered_[at(i)] = kNotComputed;
    known_.clear();
}

void RelaxingAsperities::add_places(std::vector<double>& x, std::vector<double>& y,
                                    const std::vector<int>& places) const {
    for (int i : places) {
        const Vec2 image = indenter_.image(asperities_.x[at(i)], asperities_.y[at(i)]);
        x.push_back(image.x);
        y.push_back(image.y);
    }
}

void RelaxingAsperities::lower(Candidates& candidates, Products& products) {
    if (rests_.empty()) return;
    WorkingSet& set = candidates.set;
    const std::vector<int>& places = law_.touched();
    std::vector<int> missing;
    for (int i : set.asperity)
        if (std::isnan(lowered_[at(i)])) missing.push_back(i);
    if (!missing.empty()) {
        // At loaded points, deflections are computed together with the sources, so that no point
        // occurs twice.
        std::vector<double> x, y;
        add_places(x, y, places);
        std::vector<int> sorted = places, elsewhere;
        std::ranges::sort(sorted);
        for (int i : missing)
            if (!std::binary_search(sorted.begin(), sorted.end(), i)) elsewhere.push_back(i);
        add_places(x, y, elsewhere);
        const std::vector<double> phi = deflections(products, x, y, rests_, tolerance_);
        const auto keep = [&](int i, double value) {
            if (std::isnan(lowered_[at(i)])) known_.push_back(i);
            lowered_[at(i)] = value;
        };
        for (const auto k : indices(places)) keep(places[k], phi[k]);
        for (const auto k : indices(elsewhere)) keep(elsewhere[k], phi[places.size() + k]);
    }
    std::size_t remaining = 0;
    for (const auto k : indices(set.g0)) {
        const double g0 = set.g0[k] - lowered_[at(set.asperity[k])];
        if (!(g0 > 0)) continue;
        set.asperity[remaining] = set.asperity[k];
        set.x[remaining] = set.x[k];
        set.y[remaining] = set.y[k];
        candidates.rank[remaining] = candidates.rank[k];
        set.g0[remaining++] = g0;
    }
    set.asperity.resize(remaining);
    set.x.resize(remaining);
    set.y.resize(remaining);
    set.g0.resize(remaining);
    candidates.rank.resize(remaining);
}

void RelaxingAsperities::accept(const WorkingSet& candidates, const Solution& solution,
                                Products& products, Level& level) {
    law_.commit(int(solution.v.size()), candidates.asperity.data(), solution.v.data());
    std::vector<double> x, y;
    add_places(x, y, law_.touched());
    const auto deflected_by = [&](const std::vector<double>& f) {
        std::vector<double> phi = deflections(products, x, y, f, tolerance_);
        // The constant Kernel::shift() is not a deflection of the body.
        const double shift = products.kernel().shift() * sum_of(f);
        for (double& d : phi) d -= shift;
        return phi;
    };
    const std::vector<double> f = law_.forces(), df = deflected_by(f);
    std::vector<double> load = f, d = df;
    double stored = 0.5 * dot(f, df);
    const std::vector<std::vector<double>> retarded = law_.retarded();
    for (const auto k : indices(retarded)) {
        const std::vector<double> dy = deflected_by(retarded[k]);
        stored += 0.5 * creep_.retardations()[k].rate / creep_.retardations()[k].flow *
                  dot(retarded[k], dy);
        for (const auto i : indices(load)) {
            load[i] += retarded[k][i];
            d[i] += dy[i];
        }
    }
    // Work f' dd of the step by the trapezoidal rule; asperities touched for the first time had no
    // load before.
    force_.resize(f.size(), 0.0);
    load_.resize(f.size(), 0.0);
    const double held = dot(f, d);
    lost_ += 0.5 * (held + dot(force_, d) - dot(df, load_) - held_) - (stored - stored_);
    stored_ = stored;
    held_ = held;
    force_ = f;
    load_ = std::move(load);
    step(0);
    level.energy_lost = law_.lost() + lost_;
}

Remains RelaxingAsperities::remains(const Level& level) const {
    Level all = level;
    const std::vector<double> widest = law_.widest();
    for (const auto i : indices(load_)) {
        const int asperity = law_.touched()[i];
        const auto now = std::ranges::lower_bound(level.asperity, asperity);
        if (now != level.asperity.end() && *now == asperity) {
            all.f[at(now - level.asperity.begin())] = load_[i];
            continue;
        }
        const Vec2 image =
            indenter_.image(asperities_.x[at(asperity)], asperities_.y[at(asperity)]);
        const double a = std::sqrt(widest[i] / pi);
        all.add_contact(asperity, image.x, image.y, load_[i], a, 0);
        if (!level.spots.empty()) all.spots.push_back({image.x, image.y, a, a, 0});
    }
    return {.lasting_loads = std::move(all)};
}

void RelaxingAsperities::write(std::vector<double>& numbers) const {
    append(numbers, {stored_, lost_, held_});
    law_.write(numbers);
}

void RelaxingAsperities::read(std::span<const double> numbers) {
    if (numbers.size() < 3) bad_input("the state does not belong to these asperities");
    law_.read(numbers.subspan(3));
    stored_ = numbers[0];
    lost_ = numbers[1];
    held_ = numbers[2];
    load_ = force_ = law_.forces();
    for (const std::vector<double>& y : law_.retarded())
        for (const auto i : indices(y)) load_[i] += y[i];
    step(0);
}

AsperityPhysics make_relaxing_asperities(const ContactBodies& bodies,
                                         std::unique_ptr<Law> elastic) {
    const Relaxation& body = bodies.options.physics.of<Relaxation>();
    auto law = make_relaxing(std::move(elastic), bodies.asperities.size(), Creep(body));
    auto history = std::make_unique<RelaxingAsperities>(bodies.of_surface, bodies.indenter, *law,
                                                        body, bodies.options.tolerance);
    return {std::move(law), std::move(history)};
}

namespace {

std::vector<Key> relaxation_keys() {
    using namespace keys;
    return {
        list(RSC_KEY(solids, relaxation_share), kMostRelaxations, "1", between(0, 1), "none",
             "shares g_k of E(1) that body 1 loses by relaxation, E(t) = E(1) (1 - sum g_k (1 - "
             "exp(-t/tau_k))); their sum is at most 1"),
        list(RSC_KEY(solids, relaxation_time), kMostRelaxations, "time", kPositive, "none",
             "relaxation times tau_k, one for each share"),
        number(RSC_KEY(indentation, duration), "time", kPositive,
               "for a body that relaxes, time from the first to the last level, in equal steps; "
               "the first level is reached at once",
               "none"),
        list(RSC_KEY(indentation, times), 10000, "time", kAny, "none",
             "time of each level, increasing, instead of `duration`; separations, or forces, "
             "change linearly in between"),
    };
}

bool relaxes(const Case::Solids& s) {
    return std::ranges::any_of(s.relaxation_share, [](double g) { return g > 0; });
}

void take_relaxation(const Case& settings, BodyPhysics& bodies) {
    const Case::Solids& s = settings.solids;
    if (!relaxes(s)) return;
    const auto compliance = [&](int i) { return (1 - s.nu[i] * s.nu[i]) / s.E[i]; };
    bodies.of<Relaxation>() = {s.relaxation_share, s.relaxation_time,
                               compliance(0) / (compliance(0) + compliance(1))};
}

void check_relaxation(const Case& settings, const Complain& complain) {
    const Case::Solids& s = settings.solids;
    const std::size_t times = s.relaxation_time.size(), shares = s.relaxation_share.size();
    if (times != shares)
        complain({"solids%relaxation_time", "solids%relaxation_share"},
                 joined("needs as many values as solids%relaxation_share (", shares, "), found ",
                        times));
    const double sum = sum_of(s.relaxation_share);
    if (sum > 1 + 1e-12)
        complain({"solids%relaxation_share"},
                 format("the shares add up to %.9g, more than 1", sum));
    if (relaxes(s) && std::isinf(s.E[0]))
        complain({"solids%relaxation_share", "solids%E"}, "E(1) = Infinity makes body 1 rigid");
}

void require_times(const PreparedFacts& facts) {
    const Case::Indentation& levels = facts.settings.indentation;
    if (levels.times.empty() && !levels.duration)
        bad_input(
            "indentation%duration: solids%relaxation_share lets body 1 relax, and the levels have "
            "no times; give duration or times");
}

std::vector<LevelQuantity> relaxation_quantities() {
    using V = LevelValues;
    return {
        {.name = "time",
         .member = &V::time,
         .unit = "time",
         .of_step = true,
         .meaning = "time of the level",
         .comment =
             "the load changes linearly between levels; the first level is applied instantaneously",
         .always = false,
         .shown =
             [](const Case& c) { return c.indentation.duration || !c.indentation.times.empty(); },
         .heading = "time",
         .width = 11,
         .digits = 6},
    };
}

void print_relaxation(std::ostream& out, const RunFacts& run) {
    const auto& units = run.settings.run;
    if (units.realizations > 1 || run.levels.empty()) return;
    out << format(
        "  %.4g %s %s of the work done are lost by relaxation. Results depend on the loading "
        "history.\n",
        run.levels.back().energy_lost, units.force_unit.c_str(), units.length_unit.c_str());
}

}  // namespace

const Physics kRelaxation = {
    .name = "relaxation",
    .key = "solids%relaxation_share",
    .keys = relaxation_keys,
    .take = take_relaxation,
    .asked = [](const BodyPhysics& bodies) { return !bodies.of<Relaxation>().none(); },
    .excludes =
        {{"hardness"},
         {"friction"},
         {"solids%layer_thickness", "", [](const Combination& c) { return c.layers; }},
         {"compare%levels", "", [](const Combination& c) { return c.compares; }},
         {"indentation%boundary", "", [](const Combination& c) { return c.line; }},
         {"solver%method", "", [](const Combination& c) { return c.method == Method::dgesv; }},
         {"asperities%law", "the law does not say that its slope increases with the penetration",
          [](const Combination& c) { return !c.elements && !capabilities_of(c.law).convex; }}},
    .check = check_relaxation,
    .path = "the response of a relaxing body depends on the history of loads",
    .quantities = relaxation_quantities(),
    .mends_extreme_pressures = true,
    .may_close_gap = "bodies that relax may have closed the gap between flats",
    .closed_forms = false,
    .require_feasible = require_times,
    .compares_itself = [](const Case&) { return false; },
    .remark = print_relaxation,
    .law = make_relaxing_asperities,
    .loads = [](const BodyPhysics& bodies) -> std::unique_ptr<LastingLoads> {
        return std::make_unique<LoadMemory>(bodies.of<Relaxation>());
    },
};

}  // namespace rsc
