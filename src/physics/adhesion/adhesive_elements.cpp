#include "physics/adhesion/adhesive_elements.hpp"

#include "base/error.hpp"
#include "physics/adhesion/adhesive_pixels.hpp"

namespace rsc {
namespace {

constexpr std::size_t kKept = 7;  // numbers of write() before the points

class AdhesiveElements final : public Model, private History {
public:
    AdhesiveElements(const HeightMap& heights, const Indenter& indenter,
                     const SolverOptions& options)
        : state_(heights, indenter, options) {}

    double stiffness(Slope) override { return state_.stiffness(); }
    double energy() const override { return state_.now.energy; }
    ContactRange contact_range() const override {
        return {state_.flats ? state_.flats->closed() : -kInfinity, state_.top};
    }
    const Indenter& indenter() const override { return state_.indenter; }
    History* history() override { return this; }
    void move_tip(double x0, double y0) override { state_.move(x0, y0); }
    void forget() override { state_.forget(); }
    Level solve(double Z0, bool trial) override { return state_.solve(Z0, trial); }
    void solve_again(double, const Level&) override {}  // read() has
    double force_at_most(double) override { return 0; }
    void keep(ArchiveWriter& to) const override {
        exchange(to, state_);
        if (state_.flats) return state_.flats->keep(to);
        state_.spots->keep(to);
    }
    void recall(ArchiveReader& from) override {
        exchange(from, state_);
        state_.tried.reset();
        for (const auto* values : {&state_.q, &state_.share, &state_.p_before})
            if (values->size() != state_.clearance.size())
                bad_input("this is not the state of a contact of this surface");
        if (state_.flats) return state_.flats->recall(from);
        state_.spots->recall(from, state_.heights.nx, state_.heights.ny);
    }

private:
    template <class Archive, class Self>
    static void exchange(Archive& a, Self& state) {
        a(state.q, state.share, state.p_before, state.margin, state.bulged, state.accepted.energy,
          state.accepted.conjugate);
    }
    double attraction() const override { return state_.z0; }
    void accept(Level&) override {
        state_.accepted = state_.now;
        state_.accepted.jumps = 0;
        state_.keep();
    }
    std::vector<double> write() const override {
        const AdhesivePixels::Past& past = state_.accepted;
        if (past.separation == kInfinity) return {};
        const Indenter& tip = state_.indenter;
        std::vector<double> numbers = {past.separation, past.force,         past.least_force,
                                       past.lost,       double(past.jumps), tip.x0,
                                       tip.y0};
        for (const auto k : indices(past.attracting))
            append(numbers, {double(past.attracting[k]), past.share[k]});
        return numbers;
    }

    void read(const std::vector<double>& numbers) override {
        const auto points = double(state_.clearance.size());
        const bool any = !numbers.empty();
        bool sound =
            !any || (numbers.size() >= kKept && (numbers.size() - kKept) % 2 == 0 &&
                     numbers[4] >= 0 && numbers[4] <= std::numeric_limits<std::int32_t>::max());
        for (const double value : numbers) sound = sound && std::isfinite(value);
        AdhesivePixels::Past past;
        for (std::size_t k = kKept; k < numbers.size() && sound; k += 2) {
            sound = numbers[k] >= 0 && numbers[k] < points;
            past.attracting.push_back(std::int32_t(numbers[k]));
            past.share.push_back(numbers[k + 1]);
        }
        if (!sound) bad_input("this is not the state of a contact of this surface");
        forget();
        if (!any) return;
        past.separation = numbers[0];
        past.force = numbers[1];
        past.least_force = numbers[2];
        past.lost = numbers[3];
        past.jumps = std::int32_t(numbers[4]);
        if (numbers[5] != state_.indenter.x0 || numbers[6] != state_.indenter.y0) {
            state_.indenter.move(numbers[5], numbers[6]);
            state_.set_clearances();
        }
        state_.accepted = std::move(past);
        if (!state_.step(state_.accepted.separation).converged)
            bad_input(
                "the state of the contact cannot be reached again: the solver does not converge");
        state_.accepted.energy = state_.now.energy;
        state_.accepted.conjugate = state_.now.conjugate;
        state_.keep();
    }

    AdhesivePixels state_;
};

}  // namespace

std::unique_ptr<Model> make_adhesive_elements(const HeightMap& heights, const Indenter& indenter,
                                              const SolverOptions& options) {
    return std::make_unique<AdhesiveElements>(heights, indenter, options);
}

}  // namespace rsc
