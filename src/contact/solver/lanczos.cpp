#include "contact/solver/lanczos.hpp"

#include "contact/solver/lapack.hpp"

namespace rsc {

double lanczos_lowest(std::size_t n, const std::function<void(const std::vector<double>&, std::vector<double>&)>& multiply,
                      std::vector<double>& vector) {
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
        return sum;
    };
    const std::size_t most = std::min<std::size_t>(n, 300);
    std::vector<std::vector<double>> basis;
    std::vector<double> alpha, beta, image(n), ritz;
    std::vector<double> q(n);
    // A fixed start vector that is not orthogonal to any eigenvector by symmetry.
    for (std::size_t k = 0; k < n; ++k) q[k] = std::sin(12.9898 * static_cast<double>(k + 1)) + 0.1;
    double length = std::sqrt(dot(q, q)), lowest = 1;
    while (basis.size() < most) {
        for (double& x : q) x /= length;
        basis.push_back(q);
        multiply(q, image);
        alpha.push_back(dot(q, image));
        // Three-term recurrence, after which reorthogonalisation only removes rounding errors.
        for (std::size_t k = 0; k < n; ++k) image[k] -= alpha.back() * q[k];
        if (basis.size() > 1) {
            const auto& before = basis[basis.size() - 2];
            for (std::size_t k = 0; k < n; ++k) image[k] -= beta.back() * before[k];
        }
        for (const auto& b : basis) {
            const double c = dot(b, image);
            for (std::size_t k = 0; k < n; ++k) image[k] -= c * b[k];
        }
        q = image;
        length = std::sqrt(dot(q, q));
        const std::size_t m = basis.size();
        const bool last = m == most || length < 1e-12;
        if (last || m % 5 == 0) {
            lowest = lapack::lowest_of_tridiagonal(alpha, beta, ritz);
            const double error = last && length < 1e-12 ? 0.0 : length * std::abs(ritz.back());
            if (last || error < 0.2 * std::abs(lowest)) {
                if (lowest > 0) lowest -= std::min(error, 0.99 * lowest);
                break;
            }
        }
        beta.push_back(length);
    }
    vector.assign(n, 0.0);
    for (std::size_t m = 0; m < ritz.size(); ++m) {
        for (std::size_t k = 0; k < n; ++k) vector[k] += ritz[m] * basis[m][k];
    }
    return lowest;
}

}  // namespace rsc
