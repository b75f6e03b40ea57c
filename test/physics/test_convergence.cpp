// One surface on finer and finer grids. A summit between the points is the same on every grid that finds it, and nearly every grid
// finds all: the load at a fixed separation does not depend on the grid. Hertz asperities sit on grid points and do.
#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "rough/detection.hpp"

using namespace rsc;

namespace {

// The share of the summits of `a` that are in `b`, each the partner of one only, and the largest difference of their curvatures over
// the rms value.
double shared(const Asperities& a, const Asperities& b, double lambda, double& differ) {
    std::size_t found = 0;
    double square = 0;
    for (double k : b.kappa1) square += k * k;
    differ = 0;
    std::vector<char> taken(b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) {
            if (taken[j] || !(std::hypot(a.x[i] - b.x[j], a.y[i] - b.y[j]) < 1e-4 * lambda)) continue;
            ++found;
            taken[j] = 1;
            differ = check::worse(differ, {std::abs(a.kappa1[i] - b.kappa1[j]), std::abs(a.kappa2[i] - b.kappa2[j])});
            break;
        }
    differ /= std::sqrt(square / static_cast<double>(b.size()));
    return static_cast<double>(found) / static_cast<double>(a.size());
}

double load(const Asperities& a, const Spectrum& s, LawKind law) {
    SolverOptions options;
    options.law = law;
    options.sigma = s.sigma;
    options.tolerance = 1e-9;
    AsperityContact contact(a, Indenter{1, INFINITY, 0.5, 0.5}, options);
    return contact.at_separation(2 * s.sigma).force;
}

}  // namespace

TESTS {
    for (const double L_lambda_s : {64.0, 128.0}) {
        Spectrum s;
        s.L_lambda_l = 4, s.L_lambda_s = L_lambda_s;
        std::printf(
            "L/lambda_s = %g, Z0/sigma = 2, E* = 1, flat: N and its change against 32 points in lambda_s\n%8s %10s %22s %10s %22s %22s\n",
            L_lambda_s, "points", "summits", "hertz (grid)", "summits", "elliptic", "fourth_order");
        constexpr std::array kPoints{4, 8, 16, 32};
        std::array<std::array<double, 3>, 4> N{};
        std::array<std::array<std::size_t, 2>, 4> summits{};
        std::array<Asperities, 4> between;
        for (std::size_t k = 0; k < kPoints.size(); ++k) {
            const int n = kPoints[k] * static_cast<int>(L_lambda_s);
            const Asperities grid = make_asperities(s, n, Normalise::sample, 1, 1, Curvature::geometric);
            const Asperities fine =
                make_asperities(s, n, Normalise::sample, 1, 1, Curvature::geometric, nullptr, nullptr, 1, Detail::subgrid);
            N[k] = {load(grid, s, LawKind::hertz), load(fine, s, LawKind::elliptic), load(fine, s, LawKind::fourth_order)};
            summits[k] = {grid.size(), fine.size()};
            between[k] = fine;
        }
        const auto change = [&](std::size_t k, std::size_t law) { return N[k][law] / N[3][law] - 1; };
        for (std::size_t k = 0; k < kPoints.size(); ++k)
            std::printf("%8d %10zu %12.6g %+8.3f %% %10zu %12.6g %+8.3f %% %11.6g %+8.3f %%\n", kPoints[k], summits[k][0], N[k][0],
                        100 * change(k, 0), summits[k][1], N[k][1], 100 * change(k, 1), N[k][2], 100 * change(k, 2));
        for (std::size_t k = 0; k < 3; ++k) {
            double differ = 0;
            const double lambda = s.L / L_lambda_s;
            // What a grid finds is there: a summit found twice, or where there is none, has no partner.
            CHECK(shared(between[k], between[3], lambda, differ) == 1);
            CHECK_CLOSE(differ, 0, 1e-6);
            double unused = 0;
            const double found = shared(between[3], between[k], lambda, unused);
            std::printf("%8d points find %.2f %% of the summits of 32\n", kPoints[k], 100 * found);
            CHECK(found > (kPoints[k] == 4 ? 0.99 : 0.999));
            // The contacts being the same, what is left are the errors of the derivatives, some 1e-8 of their rms values.
            CHECK_CLOSE(change(k, 1), 0, 1e-6);
            CHECK_CLOSE(change(k, 2), 0, 1e-6);
        }
    }
}
