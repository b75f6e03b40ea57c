// The history of asperities as numbers, which is restored, also under a tip that has moved.

#include "asperities/asperity_impl.hpp"
#include "base/error.hpp"

namespace rsc {

Remains AsperityModel::remains(const Level& level) const { return impl_->history->remains(level); }

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
    std::vector<double> start(at(my.candidates.size()),
                              -1e300);  // no contact
    const auto& known = level.asperity;
    for (const auto k : indices(start)) {
        const auto found =
            std::lower_bound(known.begin(), known.end(), my.candidates.set.asperity[k]);
        if (found != known.end() && *found == my.candidates.set.asperity[k])
            start[k] = level.u[at(found - known.begin())];
    }
    my.solution.clear();
    if (start.empty()) return;
    my.solve_from(start, false);
    my.solved = Z0;
    my.earlier.remember(Z0, my.candidates, my.solution.v);
}

void AsperityModel::keep(ArchiveWriter& to) const {
    to(*impl_);
    if (!impl_->solution.v.empty()) to(impl_->products->x(), impl_->products->y());
}

void AsperityModel::recall(ArchiveReader& from) {
    Impl& my = *impl_;
    my.tried.reset();
    from(my);
    const WorkingSet& set = my.candidates.set;
    const std::size_t n = set.asperity.size(), all = my.of_surface.size();
    bool sound = my.earlier.fits(all) && (my.solution.v.empty() || my.solution.v.size() == n);
    for (const auto* values : {&set.x, &set.y, &set.g0}) sound = sound && values->size() == n;
    sound = sound && my.candidates.rank.size() == n && std::ranges::is_sorted(my.candidates.rank) &&
            (n == 0 || my.candidates.rank.back() < all) &&
            std::ranges::all_of(set.asperity, [all](int i) { return i >= 0 && at(i) < all; });
    if (sound && !my.solution.v.empty()) {
        std::vector<double> x, y;
        from(x, y);
        sound = x.size() == y.size() && my.newton.fits(x.size()) && my.solution.force.size() == n;
        my.use(my.method);
        if (sound) my.products->set_points(int(x.size()), x.data(), y.data());
    }
    if (!sound) bad_input("the state does not belong to these asperities");
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
