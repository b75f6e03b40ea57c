#include "asperities/dgesv.hpp"

#include "asperities/lapack.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "interaction/pairs.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;

std::unique_ptr<double[]> allocate_matrix(std::size_t n) {
    try {
        return std::make_unique_for_overwrite<double[]>(n * n);
    } catch (const std::bad_alloc&) {
        throw Error(Failure::no_memory,
                    "solver%method='dgesv' needs a dense matrix of " + std::to_string(n) + " x " +
                        std::to_string(n) + " numbers (" + std::to_string(n * n / 131072) +
                        " MiB), which could not be allocated; method = 'direct' needs none");
    }
}

// K = I + diag(weight) B, column-major.
void build_matrix(const WorkingSet& set, const Kernel& kernel, const Vector& weight, double* K) {
    const std::size_t n = weight.size();
    for (const auto j : indices(n)) {
        double* column = K + j * n;
        for (const auto i : indices(n)) {
            if (i != j) column[i] = weight[i] * kernel.at(set.x[i] - set.x[j], set.y[i] - set.y[j]);
        }
        column[j] = 1 + weight[j] * kernel.self();
    }
}

}  // namespace

void paper_equations(const Law& law, const Kernel& kernel, const WorkingSet& set, double delta,
                     const Vector& force, const Vector& v, Vector& R, double* K) {
    const std::size_t size = v.size();
    Vector m(size), rate(size), slope(size), work(size);
    for (std::size_t i = 0; i < size; ++i) {
        const double far = 2 * delta - v[i];
        m[i] = v[i] < delta ? delta * delta / far : v[i];
        rate[i] = v[i] < delta ? delta * delta / (far * far) : 1.0;
    }
    R.resize(size);
    law.respond(set.size(), set.asperity.data(), m.data(), R.data(), slope.data(), work.data());
    for (std::size_t i = 0; i < size; ++i) {
        rate[i] *= slope[i];
        R[i] = force[i] - R[i];
    }
    build_matrix(set, kernel, rate, K);
}

PaperOutcome solve_by_dgesv(const Law& law, const Kernel& kernel, const WorkingSet& set,
                            const PaperMethod& method, Vector& v, Vector& force, Vector& slope) {
    const int n = set.size();
    const std::size_t size = at(n);
    const auto K = allocate_matrix(size);
    std::vector<int> pivots;
    PairSums pairs(kernel);
    pairs.assign(size, set.x.data(), set.y.data());

    Vector R(size), work(size), target(size);
    const auto penetrations = [&] {  // v = g0 - B F
        pairs.among(false, force.data(), v.data());
        for (std::size_t i = 0; i < size; ++i) v[i] = set.g0[i] - v[i];
    };
    const auto residual = [&] {
        law.respond(n, set.asperity.data(), v.data(), target.data(), slope.data(), work.data());
        for (std::size_t i = 0; i < size; ++i) target[i] = force[i] - target[i];
        return relative_residual(target, force);
    };

    v.resize(size);
    force.resize(size);
    slope.resize(size);
    law.respond(n, set.asperity.data(), set.g0.data(), force.data(), slope.data(), work.data());
    penetrations();

    PaperOutcome outcome;
    double delta = method.delta0;
    while (outcome.iterations < method.max_iterations) {
        stopping_point();
        paper_equations(law, kernel, set, delta, force, v, R, K.get());
        ++outcome.iterations;
        if (!lapack::solve(n, K.get(), R.data(), pivots)) {
            outcome.singular = true;
            break;
        }
        double force2 = 0, change2 = 0;
        for (std::size_t i = 0; i < size; ++i) {  // K dF = -R
            force2 += force[i] * force[i];
            change2 += R[i] * R[i];
            force[i] = std::max(force[i] - R[i], 0.0);
        }
        penetrations();
        outcome.residual = residual();
        if (change2 <= method.tolerance * method.tolerance * force2 &&
            outcome.residual <= method.tolerance) {
            outcome.converged = true;
            break;
        }
        delta = std::max(delta / method.cut, 1e-12 * method.delta0);
    }
    // Forces on asperities out of contact are an artefact of the regularisation.
    for (std::size_t i = 0; i < size; ++i) {
        if (v[i] <= 0) force[i] = 0;
    }
    penetrations();
    outcome.residual = residual();
    outcome.converged = outcome.converged && outcome.residual <= method.tolerance;
    return outcome;
}

}  // namespace rsc
