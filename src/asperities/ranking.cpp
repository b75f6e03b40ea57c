#include "asperities/ranking.hpp"

namespace rsc {
namespace {

bool comes_first(const Ranking::Entry& a, const Ranking::Entry& b) {
    return a.height != b.height ? a.height > b.height : a.asperity < b.asperity;
}

// Insertion sort, which is the fastest if few entries changed places; falls back to std::sort after
// many moves.
void sort_nearly_sorted(std::vector<Ranking::Entry>::iterator first,
                        std::vector<Ranking::Entry>::iterator last) {
    auto steps = 8 * (last - first);
    for (auto e = first; e != last; ++e) {
        const Ranking::Entry entry = *e;
        auto to = e;
        for (; to != first && comes_first(entry, *(to - 1)); --to) *to = *(to - 1);
        *to = entry;
        steps -= e - to;
        if (steps < 0) return std::sort(first, last, comes_first);
    }
}

}  // namespace

void Ranking::assign(const Asperities& asperities, const Indenter& indenter) {
    asperities_ = &asperities;
    now_ = indenter;
    x_rest_ = indenter.x0;
    y_rest_ = indenter.y0;
    entries_.clear();
    places_.clear();
    sorted_ = 0;
    entries_.reserve(asperities.size());
    highest_rest_ = highest_z_ = -kInfinity;
    for (const auto i : indices(asperities)) {
        highest_z_ = std::max(highest_z_, asperities.z[i]);
        const double h = indenter.clearance(asperities.x[i], asperities.y[i], asperities.z[i]);
        if (h == -kInfinity) continue;
        entries_.push_back({h, int(i)});
        highest_rest_ = std::max(highest_rest_, h);
    }
}

// Upper bound of the heights of unsorted asperities. They cannot exceed highest_rest where the face
// is now more than highest_z - highest_rest above the tip; elsewhere the face has fallen by at most
// most_fallen().
double Ranking::bound_on_rest() const {
    const double d = std::hypot(now_.x0 - x_rest_, now_.y0 - y_rest_);
    if (!(d > 0)) return highest_rest_;
    const double fallen = now_.shape->most_fallen(d, highest_z_ - highest_rest_);
    const double most =
        highest_z_ - now_.shape->lowest({-kInfinity, kInfinity, -kInfinity, kInfinity});
    const double bound = std::isinf(fallen) ? most : std::min(highest_rest_ + fallen, most);
    if (std::isinf(bound)) return bound;
    return bound +
           16 * std::numeric_limits<double>::epsilon() * (std::abs(bound) + std::abs(highest_z_));
}

void Ranking::move(double x0, double y0) {
    if (x0 == now_.x0 && y0 == now_.y0) return;
    const bool opens = now_.repeats.finite() && !now_.around.finite();
    now_.move(x0, y0);
    if (sorted_ == 0 || opens) return assign(*asperities_, now_);
    for (std::size_t k = 0; k < sorted_; ++k)
        entries_[k].height = now_.clearance(places_[k].x, places_[k].y, places_[k].z);
    sort_nearly_sorted(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(sorted_));
    place_sorted();
    if (bound_on_rest() >= highest()) assign(*asperities_, now_);
}

void Ranking::place_sorted() {
    places_.resize(sorted_, {0, 0, 0, -1});
    for (std::size_t k = 0; k < sorted_; ++k)
        if (const int asperity = entries_[k].asperity; places_[k].asperity != asperity) {
            const auto i = at(asperity);
            places_[k] = {asperities_->x[i], asperities_->y[i], asperities_->z[i], asperity};
        }
}

double Ranking::highest() const { return sorted_ > 0 ? entries_.front().height : highest_rest_; }

std::size_t Ranking::above(double Z0, std::vector<int>& fresh) {
    if ((x_rest_ != now_.x0 || y_rest_ != now_.y0) && bound_on_rest() > Z0)
        assign(*asperities_, now_);
    const auto first = entries_.begin(), rest = first + static_cast<std::ptrdiff_t>(sorted_);
    auto end = rest;
    if (x_rest_ == now_.x0 && y_rest_ == now_.y0 && highest_rest_ > Z0) {
        // Sorts a quarter deeper than requested, so that a series of levels sorts only a few times.
        const double threshold = Z0 - 0.25 * (highest() - Z0);
        end = std::partition(rest, entries_.end(),
                             [threshold](const Entry& e) { return e.height > threshold; });
        std::sort(rest, end, comes_first);
        places_.resize(at(end - first),
                       {0, 0, 0, -1});  // before sorted_ counts them: there may be no memory
        for (auto e = rest; e != end; ++e) fresh.push_back(e->asperity);
        sorted_ = at(end - first);
        highest_rest_ = end == entries_.end() ? -kInfinity : threshold;
        place_sorted();
    }
    const auto last =
        std::partition_point(first, end, [Z0](const Entry& e) { return e.height > Z0; });
    return at(last - first);
}

}  // namespace rsc
