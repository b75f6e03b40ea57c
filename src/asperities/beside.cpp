#include "asperities/beside.hpp"

#include "interaction/products.hpp"

namespace rsc {

void SummitsBeside::follow(std::span<const int> asperities, const LawOf& law_of) {
    const Indenter& indenter = bodies_.indenter;
    if (tips_.empty() || x0_ != indenter.x0 || y0_ != indenter.y0) {
        tips_.clear(), followed_.assign(bodies_.asperities.size(), false), x0_ = indenter.x0,
                                                                           y0_ = indenter.y0;
        for (const Vec2 way : {Vec2{-1, 0}, Vec2{1, 0}, Vec2{0, -1}, Vec2{0, 1}, Vec2{0, 0}}) {
            if (tips_.size() == 4 && !jumps_) break;
            Tip& to = tips_.emplace_back(Tip{indenter, *bodies_.of_difference, nullptr});
            to.indenter.x0 += way.x * step(), to.indenter.y0 += way.y * step();
        }
    }
    std::vector<std::size_t> which;
    for (const int k : asperities)
        if (const auto i = static_cast<std::size_t>(k); !followed_[i])
            which.push_back(i), followed_[i] = true;
    if (which.empty()) return;
    std::deque<Tip> tips = std::exchange(tips_, {});  // after an exception there are none
    for (Tip& to : tips) {
        if (to.found.map)
            to.found.summits = follow_summits(
                *to.found.map, std::move(to.found.summits), which, to.found.lay, to.found.threads,
                to.found.points_per_wave, Face(to.indenter), to.found.breaks.get());
        else
            replace(to.found.summits, which,
                    moved_summits(selected(bodies_.of_surface, which), to.indenter));
        if (!to.law || jumps_)
            to.law = law_of(to.found,
                            to.indenter);  // others read a summit when they are prepared for it
    }
    tips_ = std::move(tips);
}

Vec2 SummitsBeside::lateral(const std::vector<int>& asperities, const std::vector<double>& f,
                            bool lasting, const std::function<Response(Tip&, std::size_t)>& work) {
    const std::size_t n = f.size();
    std::vector<Response> there;
    std::vector<WorkingSet> sets;
    std::vector<double> first(n, 0.0), phi(n);
    for (Tip& to : tips_) {
        const Asperities &a = to.found.summits, &present = bodies_.asperities;
        to.law->prepare(asperities);
        WorkingSet& set = sets.emplace_back();
        for (std::size_t k = 0; k < n; ++k) {
            const auto i = static_cast<std::size_t>(asperities[k]);
            const Vec2 place = to.indenter.image(a.x[i], a.y[i]);
            set.asperity.push_back(asperities[k]), set.x.push_back(place.x),
                set.y.push_back(place.y);
            const double clearance = to.indenter.clearance(
                a.x[i], a.y[i], a.z[i]);  // not finite just beyond the edge of the indenter
            set.g0.push_back(
                std::isfinite(clearance)
                    ? clearance
                    : bodies_.indenter.clearance(present.x[i], present.y[i], present.z[i]));
            there.push_back(work(to, k));
            first[k] += there.back().force / static_cast<double>(tips_.size());
        }
    }
    const bool mesh = choose_method(bodies_.options, *bodies_.kernel, sets[0]) == Method::mesh;
    const auto products =
        mesh ? make_mesh_products(bodies_.kernel, std::min(1e-4, 0.1 * bodies_.options.tolerance),
                                  1e-3)
             : make_direct_products(bodies_.kernel);
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    const std::vector<double>& load = lasting ? first : f;
    // Where the work jumps between two tips, because several ellipses carry nearly the same load,
    // the smaller difference to one side.
    constexpr double rough = 0.5, jump = 1e-3;  // of the first differences; of N
    double N = 0, W[4] = {};
    for (const double force : f) N += std::abs(force);
    for (std::size_t k = 0; k < n && jumps_; ++k)
        for (const std::size_t t : {0u, 2u}) {
            double &low = there[t * n + k].work, &high = there[(t + 1) * n + k].work;
            const double here = there[4 * n + k].work, before = low - here, after = here - high,
                         bend = std::abs(before - after);
            if (!(bend > rough * std::abs(before + after)) || bend < jump * step() * N) continue;
            const double less = std::abs(before) < std::abs(after) ? before : after;
            low = here + less, high = here - less;
        }
    for (std::size_t t = 0; t < 4; ++t) {
        products->set_points(static_cast<int>(n), sets[t].x.data(), sets[t].y.data());
        products->set_active(all);
        products->full(load.data(), phi.data());
        for (std::size_t k = 0; k < n; ++k)
            W[t] += f[k] * (sets[t].g0[k] - 0.5 * phi[k] +
                            (first[k] != 0 ? there[t * n + k].work / first[k] : 0.0));
    }
    return {(W[0] - W[1]) / (2 * step()), (W[2] - W[3]) / (2 * step())};
}

}  // namespace rsc
