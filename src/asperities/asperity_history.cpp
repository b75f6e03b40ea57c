// The history of asperities as numbers, which is restored, also under a tip that has moved.

#include "asperities/asperity_impl.hpp"
#include "base/error.hpp"

namespace rsc {

std::vector<double> AsperityModel::residual_depths() const {
    std::vector<double> depths;
    if (impl_->relaxing) return depths;
    for (std::size_t i = 0; i < impl_->asperities.size(); ++i)
        depths.push_back(impl_->law->residual_depth(static_cast<int>(i)));
    return depths;
}

std::optional<Level> AsperityModel::lasting_loads(const Level& level) const {
    if (!impl_->relaxing) return {};
    return impl_->relaxing->lasting(level);
}

// Pairs of the index of a yielded asperity and its largest penetration, or the state of a relaxing
// body.
std::vector<double> AsperityModel::write() const {
    std::vector<double> numbers;
    if (impl_->relaxing) {
        impl_->relaxing->write(numbers);
        return numbers;
    }
    for (const int i : impl_->law->yielded())
        numbers.insert(numbers.end(), {static_cast<double>(i), impl_->law->deepest(i)});
    return numbers;
}

void AsperityModel::read(const std::vector<double>& numbers) {
    Impl& my = *impl_;
    if (my.relaxing) {
        my.relaxing->read(numbers);
    } else {
        std::vector<int> yielded;
        std::vector<double> deepest;
        for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) {
            if (!(numbers[k] >= 0 && numbers[k] < static_cast<double>(my.asperities.size()) &&
                  std::isfinite(numbers[k + 1])))
                throw Error(Failure::bad_input,
                            "the state does not belong to a contact of these asperities");
            yielded.push_back(static_cast<int>(numbers[k])), deepest.push_back(numbers[k + 1]);
        }
        my.law->forget();
        my.law->prepare(yielded);
        my.law->commit(static_cast<int>(yielded.size()), yielded.data(), deepest.data());
    }
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
    const bool nothing =
        stored.empty() || (my.relaxing && my.relaxing->stored() == 0 && my.relaxing->lost() == 0);
    impl_ = std::make_unique<Impl>(my.of_surface, there, my.options);
    if (!nothing) read(stored);
}

}  // namespace rsc
