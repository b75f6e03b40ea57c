#include "contact/adhesive_contact.hpp"

#include "contact/adhesive_path.hpp"
#include "error.hpp"

namespace rsc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kBefore = 6;  // numbers in memory() before the pairs

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

struct AdhesiveContact::Impl : AdhesivePath {
    using AdhesivePath::AdhesivePath;
    double slope = 0, energy = 0;  // of the last level
    Level report();
};

Level AdhesiveContact::Impl::report() {
    Level l;
    l.separation = here.Z;
    if (lost_way) {  // there is no state to report: the values become not-a-number (Contact::finish)
        now = accepted;
        l.status = LevelStatus::not_converged;
        l.residual = 1;
        l.candidates = set.size(), l.iterations = steps;
        slope = energy = kNotComputed;
        return l;
    }
    now = past();
    l.candidates = std::max(set.size(), static_cast<int>(active.size()));
    l.residual = here.residual;
    l.iterations = steps;
    l.products = direct->count() + (mesh ? mesh->count() : 0) - products_before;
    l.method = products == mesh.get() && mesh ? Method::mesh : Method::direct;
    double cohesive = 0;
    for (std::size_t k = 0; k < now.asperity.size(); ++k) {
        const int i = now.asperity[k];
        const Sticking::State state = sticking.at(i, now.s[k]);
        if (state.area > 0)
            l.add_contact(i, asperities.x[at(i)], asperities.y[at(i)], state.f, std::sqrt(state.area / std::numbers::pi), state.u);
        l.tractions.x.push_back(asperities.x[at(i)]), l.tractions.y.push_back(asperities.y[at(i)]);
        l.tractions.a.push_back(std::sqrt(state.area / std::numbers::pi)),
            l.tractions.c.push_back(std::sqrt(state.outer / std::numbers::pi));
        l.tractions.pressed.push_back(state.pressed), l.tractions.pulled.push_back(state.f - state.pressed);
        cohesive += state.outer - state.area;
        l.force += state.f;
        l.area += state.area;
        l.beyond_law += state.beyond || law->beyond(i, now.s[k]);
    }
    judge_asperities(l, *law, *this);
    if (options.adhesion.range > 0) l.cohesive_area = cohesive;
    // Where the zones that attract around the summits overlap, they would count twice.
    if (cohesive + l.area >
            static_cast<double>(now.asperity.size()) * 0.25 * std::numbers::pi * options.mean_spacing * options.mean_spacing &&
        options.adhesion.range > 0 && options.mean_spacing > 0)
        l.status = graver(l.status, LevelStatus::out_of_validity);
    l.jumps = jumps + accepted.jumps;
    l.energy_lost = now.lost;
    l.least_force = now.least_force;
    slope = active.empty() ? 0.0 : here.change.force;
    energy = active.empty() ? 0.0 : here.energy;
    return l;
}

AdhesiveContact::AdhesiveContact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options, SummitSearch search)
    : impl_(std::make_unique<Impl>(asperities, indenter, options, std::move(search))) {}
AdhesiveContact::~AdhesiveContact() = default;

Level AdhesiveContact::solve(double Z0) {
    Impl& my = *impl_;
    if (my.begin(Z0) && !my.lost_way) my.go(Z0, std::nullopt);
    my.here.Z = Z0;
    return my.report();
}

std::optional<Level> AdhesiveContact::solve_under(double N) {
    Impl& my = *impl_;
    const bool anything = my.begin(-kInfinity);
    if (my.lost_way) return my.report();
    if (anything && std::abs(my.here.force - N) > 0.1 * tolerance() * std::abs(N)) {
        const bool down = my.here.force < N && !(my.active.empty() && N < 0);
        if (!my.go(down ? -1e300 : 1e300, N) || my.lost_way) {
            if (my.lost_way) return my.report();
            // No state has this force: returns to the state with the smallest force.
            const double least = my.now.least_force;
            for (const double above : {1e-7, 1e-5, 1e-3}) {
                my.begin(-kInfinity);
                if (my.active.empty() || (my.go(1e300, least * (1 - above)) && !my.lost_way)) break;
            }
            if (my.lost_way) return my.report();
            Level level = my.report();
            level.fallback = Fallback::held;
            level.status = LevelStatus::not_converged;
            return level;
        }
    }
    return my.report();
}

void AdhesiveContact::accept(Level&) { impl_->accepted = impl_->now, impl_->accepted.jumps = 0; }

double AdhesiveContact::stiffness() { return impl_->slope; }
double AdhesiveContact::energy() const { return impl_->energy; }
double AdhesiveContact::tolerance() const { return impl_->options.tolerance; }
double AdhesiveContact::first_touch() const { return impl_->ranking.highest(); }
const Indenter& AdhesiveContact::indenter() const { return impl_->indenter; }
const Asperities* AdhesiveContact::asperities() const { return &impl_->asperities; }

void AdhesiveContact::move_tip(double x0, double y0) {
    if (!std::isfinite(x0) || !std::isfinite(y0)) throw Error(Failure::bad_input, "the tip's position must be finite");
    Impl& my = *impl_;
    if (x0 == my.indenter.x0 && y0 == my.indenter.y0) return;
    if (!my.accepted.asperity.empty()) {
        if (!my.move(x0, y0))
            throw Error(Failure::not_converged,
                        "the path of the attached asperities to the new position of the tip is lost; the tip stays where it was");
        return;
    }
    const AdhesivePath::Past past = my.accepted;
    my.indenter.move(x0, y0);
    forget_levels();
    impl_->accepted = past;
}

void AdhesiveContact::forget_levels() {
    const Impl& my = *impl_;
    impl_ = std::make_unique<Impl>(my.of_surface, Indenter(my.indenter), SolverOptions(my.options), my.search);
}

std::vector<double> AdhesiveContact::memory() const {
    const AdhesivePath::Past& past = impl_->accepted;
    if (past.separation == kInfinity) return {};
    const Indenter& tip = impl_->indenter;
    std::vector<double> numbers = {tip.x0, tip.y0, past.separation, past.lost, past.least_force, static_cast<double>(past.jumps)};
    for (std::size_t k = 0; k < past.asperity.size(); ++k)
        numbers.insert(numbers.end(), {static_cast<double>(past.asperity[k]), past.s[k]});
    return numbers;
}

void AdhesiveContact::recall(const std::vector<double>& memory, const Level* last) {
    Impl& my = *impl_;
    my.accepted = {};
    if (!memory.empty()) {
        AdhesivePath::Past& past = my.accepted;
        bool sound = memory.size() % 2 == 0 && memory.size() >= kBefore;
        for (double value : memory) sound = sound && std::isfinite(value);
        if (sound)
            past.separation = memory[2], past.lost = memory[3], past.least_force = memory[4], past.jumps = static_cast<int>(memory[5]);
        for (std::size_t k = kBefore; sound && k + 1 < memory.size(); k += 2) {
            sound = memory[k] >= 0 && memory[k] < static_cast<double>(my.asperities.size()) && memory[k + 1] > 0;
            if (!sound) break;
            past.asperity.push_back(static_cast<int>(memory[k])), past.s.push_back(memory[k + 1]);
        }
        if (!sound) throw Error(Failure::bad_input, "the state does not belong to these asperities");
        my.sticking.prepare(past.asperity);
        // The state belongs to the stored position of the tip, which may differ from that of the last level.
        if (memory[0] != my.indenter.x0 || memory[1] != my.indenter.y0) {
            my.indenter.move(memory[0], memory[1]);
            my.ranking.assign(my.asperities, my.indenter);
        }
    }
    if (last) (void)solve(my.accepted.separation < kInfinity ? my.accepted.separation : last->separation);
}

}  // namespace rsc
