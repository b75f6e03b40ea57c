#include "physics/adhesion/adhesive_contact.hpp"

#include "base/error.hpp"
#include "physics/adhesion/adhesive_path.hpp"
#include "physics/adhesion/sticking.hpp"

namespace rsc {
namespace {

constexpr std::size_t kBefore = 8;  // numbers of write() before the pairs

class AdhesiveAsperities final : public Model, private History {
public:
    AdhesiveAsperities(const Asperities& asperities, const Indenter& indenter,
                       const SolverOptions& options)
        : path_(std::make_unique<AdhesivePath>(asperities, indenter, options)) {}

    double stiffness(Slope which) override {
        if (which == Slope::clamped && stands())
            return 0 - path_->solver.clamped_stiffness(path_->here.states);
        if (fresh_ && which == Slope::rough) return path_->here.dforce;
        if (std::exchange(fresh_, false))
            slope_ = stands() ? path_->solver.slope(path_->here.states) : kNotComputed;
        return slope_;
    }
    double energy() const override { return energy_; }
    void move_tip(double x0, double y0) override;
    ContactRange contact_range() const override {
        return {.first_touch = path_->ranking.highest()};
    }
    const Indenter& indenter() const override { return path_->indenter; }
    std::shared_ptr<const Asperities> asperities() const override {
        return {std::shared_ptr<void>(), &path_->asperities};
    }
    History* history() override { return this; }
    void forget() override {
        path_ = path_at(path_->indenter.x0, path_->indenter.y0);
        slope_ = energy_ = 0;
        fresh_ = false;
    }
    Level solve(double Z0, bool trial) override;
    void solve_again(double z, const Level&) override {
        const double last = path_->accepted.separation;
        (void)solve(last < kInfinity ? last : z, false);
    }
    // The first state with this force on the path: towards the surface if the force is larger than
    // the present one, otherwise away. If no state has it, the result is one without contact, with
    // Fallback::held.
    std::optional<Level> solve_under(double N) override;
    double force_at_most(double) override { return 0; }
    void keep(ArchiveWriter& to) const override { to(slope_, energy_, fresh_); }
    void recall(ArchiveReader& from) override { from(slope_, energy_, fresh_); }

private:
    // Finds the accepted state again, by which all that is asked of it depends on nothing else;
    // false without a contact.
    bool stands() {
        return path_->begin(path_->accepted.separation) && !path_->lost_way &&
               !path_->here.active.empty();
    }
    double attraction() const override { return path_->options.physics.of<Adhesion>().range; }
    void accept(Level&) override {
        path_->accepted = path_->now;
        path_->accepted.jumps = 0;
    }
    // Position of the tip, separation, dissipated energy, smallest force, jumps, margin, largest
    // energy, and pairs of an attached asperity and its state.
    std::vector<double> write() const override;
    void read(const std::vector<double>& numbers) override;

    Level report();
    // A path without loads at another place, with the summits there.
    std::unique_ptr<AdhesivePath> path_at(double x0, double y0) const {
        const AdhesivePath& my = *path_;
        Indenter tip = my.indenter;
        if (x0 != tip.x0 || y0 != tip.y0) tip.move(x0, y0);
        return std::make_unique<AdhesivePath>(my.of_surface, tip, my.options);
    }

    std::unique_ptr<AdhesivePath> path_;
    double slope_ = 0, energy_ = 0;  // of the last level
    bool fresh_ = false;             // slope_ is still to be computed, from the state of the path
};

Level AdhesiveAsperities::report() {
    AdhesivePath& my = *path_;
    Level l;
    l.separation = my.here.Z;
    // there is no state to report: the values become not-a-number (Path::finish)
    if (my.lost_way) {
        my.now = my.accepted;
        l.converged = false;
        l.residual = 1;
        l.candidates = my.set.size();
        l.iterations = my.steps;
        slope_ = energy_ = kNotComputed;
        return l;
    }
    my.now = my.past();
    l.candidates = my.set.size();
    l.residual = my.here.residual;
    l.iterations = my.steps;
    l.products = my.direct->count() + (my.mesh ? my.mesh->count() : 0) - my.products_before;
    l.method = my.products == my.mesh.get() && my.mesh ? Method::mesh : Method::direct;
    double cohesive = 0;
    for (const auto k : indices(my.now.asperity)) {
        const int i = my.now.asperity[k];
        const Sticking::State state = my.sticking.at(i, my.now.s[k]);
        const Vec2 place = my.indenter.image(my.asperities.x[at(i)], my.asperities.y[at(i)]);
        if (state.area > 0)
            l.add_contact(i, place.x, place.y, state.f, std::sqrt(state.area / std::numbers::pi),
                          state.u);
        l.tractions.x.push_back(place.x);
        l.tractions.y.push_back(place.y);
        l.tractions.a.push_back(std::sqrt(state.area / std::numbers::pi));
        l.tractions.c.push_back(std::sqrt(state.outer / std::numbers::pi));
        l.tractions.pressed.push_back(state.pressed);
        l.tractions.pulled.push_back(state.f - state.pressed);
        cohesive += state.outer - state.area;
        l.force += state.f;
        l.area += state.area;
        l.beyond_law += state.beyond || my.law->footprint(i, my.now.s[k]).beyond;
    }
    complete_level(l, *my.law, my);
    if (my.options.physics.of<Adhesion>().range > 0) l.cohesive_area = cohesive;
    l.jumps = my.jumps + my.accepted.jumps;
    l.energy_lost = my.now.lost;
    l.least_force = my.now.least_force;
    slope_ = 0;
    fresh_ = !my.here.active.empty();
    energy_ = my.here.active.empty() ? 0.0 : my.here.energy;
    return l;
}

Level AdhesiveAsperities::solve(double Z0, bool) {
    AdhesivePath& my = *path_;
    fresh_ = false;
    if (my.begin(Z0) && !my.lost_way) my.follow(Z0);
    my.here.Z = Z0;
    return report();
}

std::optional<Level> AdhesiveAsperities::solve_under(double N) {
    fresh_ = false;
    const bool found = path_->follow_to_force(N);
    Level level = report();
    if (!found) {
        level.fallback = Fallback::held;
        level.converged = false;
    }
    return level;
}

void AdhesiveAsperities::move_tip(double x0, double y0) {
    AdhesivePath& my = *path_;
    if (x0 == my.indenter.x0 && y0 == my.indenter.y0) return;
    (void)stiffness(Slope::exact);
    if (!my.accepted.asperity.empty()) {
        // with the summits of the difference at the new place
        std::unique_ptr<AdhesivePath> there = my.of_difference ? path_at(x0, y0) : nullptr;
        AdhesivePath::Past before = my.accepted;
        const Indenter old = my.indenter;
        bool done = my.move(x0, y0);
        if (done && there) {
            there->accepted = std::exchange(my.accepted, std::move(before));
            my.indenter = old;
            my.ranking.assign(my.asperities, my.indenter);
            done = there->stand();
            if (done) path_ = std::move(there);
        }
        if (!done)
            throw Error(Failure::not_converged,
                        "the path of the attached asperities to the new position of the tip is "
                        "lost; the tip stays where it was");
        slope_ = 0;
        fresh_ = !path_->here.active.empty();
        return;
    }
    auto there = path_at(x0, y0);
    there->accepted = my.accepted;
    path_ = std::move(there);
    slope_ = energy_ = 0;
    fresh_ = false;
}

std::vector<double> AdhesiveAsperities::write() const {
    const AdhesivePath::Past& past = path_->accepted;
    if (past.separation == kInfinity) return {};
    const Indenter& tip = path_->indenter;
    std::vector<double> numbers = {tip.x0,      tip.y0,           past.separation,
                                   past.lost,   past.least_force, double(past.jumps),
                                   past.margin, past.most_energy};
    for (const auto k : indices(past.asperity))
        append(numbers, {double(past.asperity[k]), past.s[k]});
    return numbers;
}

void AdhesiveAsperities::read(const std::vector<double>& numbers) {
    bool sound = numbers.size() >= kBefore && (numbers.size() - kBefore) % 2 == 0;
    for (double value : numbers) sound = sound && std::isfinite(value);
    // The state belongs to the stored position of the tip, which may differ from that of the last
    // level.
    if (sound && (numbers[0] != path_->indenter.x0 || numbers[1] != path_->indenter.y0))
        path_ = path_at(numbers[0], numbers[1]);
    AdhesivePath& my = *path_;
    my.accepted = {};
    if (!numbers.empty()) {
        AdhesivePath::Past& past = my.accepted;
        if (sound) {
            past.separation = numbers[2];
            past.lost = numbers[3];
            past.least_force = numbers[4];
            past.jumps = int(numbers[5]);
            past.margin = numbers[6];
            past.most_energy = numbers[7];
        }
        for (std::size_t k = kBefore; sound && k + 1 < numbers.size(); k += 2) {
            sound =
                numbers[k] >= 0 && numbers[k] < double(my.asperities.size()) && numbers[k + 1] > 0;
            if (!sound) break;
            past.asperity.push_back(int(numbers[k]));
            past.s.push_back(numbers[k + 1]);
        }
        if (!sound) bad_input("the state does not belong to these asperities");
        my.sticking.prepare(past.asperity);
    }
}

}  // namespace

std::unique_ptr<Model> make_adhesive_asperities(const Asperities& asperities,
                                                const Indenter& indenter,
                                                const SolverOptions& options) {
    return std::make_unique<AdhesiveAsperities>(asperities, indenter, options);
}

}  // namespace rsc
