// The history of asperities as numbers, which is restored, also under a tip that has moved.

#include "asperities/asperity_impl.hpp"
#include "base/error.hpp"

namespace rsc {

std::vector<double> AsperityModel::residual_depths() const {
    return impl_->history->residual_depths();
}

std::optional<Level> AsperityModel::lasting_loads(const Level& level) const {
    return impl_->history->lasting(level);
}

std::vector<double> AsperityModel::write() const {
    std::vector<double> numbers;
    impl_->history->write(numbers);
    return numbers;
}

void AsperityModel::read(const std::vector<double>& numbers) {
    Impl& my = *impl_;
    my.history->read(numbers);
    my.earlier = {};
    my.candidates = {};
    my.solution.clear();
}

void AsperityModel::solve_again(double Z0, const Level& level) {
    Impl& my = *impl_;
    if (!my.follows()) return (void)solve(Z0, false);
    my.select(Z0);
    std::vector<double> start(static_cast<std::size_t>(my.candidates.size()),
                              -1e300);  // no contact
    const auto& known = level.asperity;
    for (std::size_t k = 0; k < start.size(); ++k) {
        const auto found =
            std::lower_bound(known.begin(), known.end(), my.candidates.set.asperity[k]);
        if (found != known.end() && *found == my.candidates.set.asperity[k])
            start[k] = level.u[static_cast<std::size_t>(found - known.begin())];
    }
    my.solution.clear();
    if (start.empty()) return;
    my.solve_from(start, false);
    my.solved = {Z0, level.unique};
    my.earlier.remember(Z0, my.candidates, my.solution.v, my.solved.unique);
}

// The summits of the difference are those of the new place. The history is stored by the number of
// the summit.
void AsperityModel::move_with_history(double x0, double y0) {
    const Impl& my = *impl_;
    const std::vector<double> stored = write();
    Indenter there = my.indenter;
    there.move(x0, y0);
    impl_ = std::make_unique<Impl>(my.of_surface, there, my.options, my.make);
    if (!stored.empty()) read(stored);
}

}  // namespace rsc
