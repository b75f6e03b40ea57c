// Force control's first guess of a separation, from the force without interaction.

#include "asperities/asperity_impl.hpp"

namespace rsc {

// The force without interaction, which is an upper bound.
double AsperityContact::force_at_most(double depth) {
    Impl& my = *impl_;
    const double Z0 = first_touch() - depth;
    Candidates there;
    select_candidates(my.ranking, my.indenter, my.options, *my.law, Z0, there);
    const WorkingSet& set = there.set;
    double sum = 0;
    for (std::size_t k = 0; k < set.g0.size(); ++k)
        sum += my.law->force(set.asperity[k], set.g0[k]);
    return sum / my.scale();
}

// Without interaction the force N belongs to a depth, which the interaction increases by s, the
// mean of B F. There a solution to some per cent shows by its slope where the force is N.
std::optional<double> AsperityContact::guessed_separation(double N) {
    Impl& my = *impl_;
    if (my.follows() || my.options.method == Method::dgesv) return {};
    constexpr double near = 0.05, rough = 0.02, slope = 1e-2;
    constexpr double shallow = 0.25, shrink = 0.125,
                     grow = 3;  // in rms heights; the ranking is extended seldom
    constexpr int depths = 200;
    double depth = std::max(shallow * my.options.sigma,
                            std::numeric_limits<double>::epsilon() * std::abs(first_touch()));
    double force_there = force_at_most(depth), power = 5;
    for (int i = 0; i < depths && std::abs(force_there / N - 1) > near;
         ++i) {  // secants of logarithms
        const double ratio =
            force_there > 0 ? std::clamp(std::pow(N / force_there, 1 / power), shrink, grow) : grow;
        const double next = force_at_most(depth *= ratio);
        if (next > 0 && force_there > 0 && ratio != 1)
            power = std::max(std::log(next / force_there) / std::log(ratio), 1.0);
        force_there = next;
    }
    if (!(force_there > 0)) return {};
    const long products_before = my.products_taken();
    my.select(first_touch() - depth);
    const WorkingSet& set = my.candidates.set;
    std::vector<double> force, phi(static_cast<std::size_t>(set.size()));
    for (std::size_t k = 0; k < phi.size(); ++k)
        force.push_back(my.law->force(set.asperity[k], set.g0[k]));
    std::vector<int> all(phi.size());
    std::iota(all.begin(), all.end(), 0);
    my.products->set_points(set.size(), set.x.data(), set.y.data());
    my.products->set_active(all);
    my.products->inner(force.data(), phi.data());
    // Forces in proportion to those without interaction raise the surface more than the true ones
    // do: by 1.4 to 1.8 times on the default surface at any depth.
    constexpr double screened = 0.67;
    const double s = screened * std::inner_product(force.begin(), force.end(), phi.begin(), 0.0) /
                     std::accumulate(force.begin(), force.end(), 0.0);
    double Z0 = first_touch() - depth - s;
    if (!std::isfinite(Z0)) return {};
    my.select(Z0);
    std::vector<double> start(set.g0);
    for (double& v : start) v -= s;
    const NewtonOutcome outcome =
        solve_candidates(set, my.newton, *my.products, {rough, my.options.max_iterations, false},
                         start, my.solution);
    double sum =
        std::accumulate(my.solution.force.begin(), my.solution.force.end(), 0.0) / my.scale();
    if (outcome.converged && sum > 0) {
        my.earlier.remember(Z0, my.candidates, my.solution.v, false, true);
        const double rise = my.force_slope(slope);
        sum += my.newton.missing_force() / my.scale();
        Z0 += std::log(N / sum) * sum / rise;
    }
    my.guessing = my.products_taken() - products_before;
    return Z0;
}

}  // namespace rsc
