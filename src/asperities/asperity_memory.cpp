// What asperities keep of earlier loads: their state as numbers, which is set again, also under a
// tip that has moved.

#include "asperities/asperity_impl.hpp"
#include "base/error.hpp"

namespace rsc {

std::vector<double> AsperityContact::residual_depths() const {
    std::vector<double> depths;
    if (!path_dependent() || relaxes()) return depths;
    for (std::size_t i = 0; i < impl_->asperities.size(); ++i)
        depths.push_back(impl_->law->residual_depth(static_cast<int>(i)));
    return depths;
}

std::optional<Level> AsperityContact::lasting_loads(const Level& level) const {
    if (!relaxes()) return {};
    return impl_->relaxing->lasting(level);
}

// Pairs of the index of a yielded asperity and its largest penetration; for relaxing bodies the
// time, followed by their state.
std::vector<double> AsperityContact::memory() const {
    std::vector<double> pairs;
    if (relaxes()) {
        pairs = last_accepted();
        impl_->relaxing->write(pairs);
        return pairs;
    }
    for (const int i : impl_->law->yielded())
        pairs.insert(pairs.end(), {static_cast<double>(i), impl_->law->deepest(i)});
    return pairs;
}

void AsperityContact::recall(const std::vector<double>& memory, const Level* level) {
    Impl& my = *impl_;
    if (relaxes()) {
        my.relaxing->read(recall_accepted(memory));
    } else {
        std::vector<int> yielded;
        std::vector<double> deepest;
        for (std::size_t k = 0; k + 1 < memory.size(); k += 2) {
            if (!(memory[k] >= 0 && memory[k] < static_cast<double>(my.asperities.size()) &&
                  std::isfinite(memory[k + 1])))
                throw Error(Failure::bad_input,
                            "the state does not belong to a contact of these asperities");
            yielded.push_back(static_cast<int>(memory[k])), deepest.push_back(memory[k + 1]);
        }
        my.law->forget();
        my.law->prepare(yielded);
        my.law->commit(static_cast<int>(yielded.size()), yielded.data(), deepest.data());
    }
    my.earlier = {};
    my.candidates = {};
    my.solution.clear();
    if (!level) return;
    // separation as defined for solve()
    const double Z0 = level->separation - shift() * level->force;
    if (!my.follows()) return (void)solve(Z0);
    my.select(Z0);
    std::vector<double> start(static_cast<std::size_t>(my.candidates.size()),
                              -1e300);  // no contact
    const auto& known = level->asperity;
    for (std::size_t k = 0; k < start.size(); ++k) {
        const auto found =
            std::lower_bound(known.begin(), known.end(), my.candidates.set.asperity[k]);
        if (found != known.end() && *found == my.candidates.set.asperity[k])
            start[k] = level->u[static_cast<std::size_t>(found - known.begin())];
    }
    my.solution.clear();
    if (start.empty()) return;
    my.solve_from(start, false);
    my.solved = {Z0, level->unique};
    my.earlier.remember(Z0, my.candidates, my.solution.v, my.solved.unique);
}

// The summits of the difference are those of the new place. What the bodies keep of earlier loads
// is known by the number of the summit.
void AsperityContact::move_with_memory(double x0, double y0) {
    const Impl& my = *impl_;
    const std::vector<double> kept = memory();
    Indenter there = my.indenter;
    there.move(x0, y0);
    auto moved = std::make_unique<Impl>(my.of_surface, there, my.options);
    const bool nothing =
        kept.empty() || (relaxes() && my.relaxing->stored() == 0 && my.relaxing->lost() == 0);
    impl_ = std::move(moved);
    const double now = time();
    if (!nothing) recall(kept, nullptr);
    set_time(now);
}

}  // namespace rsc
