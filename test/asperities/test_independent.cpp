// Hundreds of random systems against the independent slow solver (independent.hpp).
#include "check.hpp"
#include "support/asperities.hpp"
#include "support/paths.hpp"
#include "truth/independent.hpp"

namespace test_independent {

using namespace rsc;

constexpr double kE = 94.0e3;
// Of the total load, a force or the load itself: the solver is asked for residuals of 1e-13, and
// errors are larger than residuals by the condition of I + S B S, below 100 where the solution is
// unique by the solver's own proof.
constexpr double kTolerance = 1e-10;

SolverOptions options(Method method, LawKind law = LawKind::hertz) {
    return {.method = method, .law = law, .tolerance = 1e-13, .surface = {.sigma = 0.01}};
}

// Principal curvatures and biharmonics for asperities that have only radii: ratios up to 10;
// flatter summits than paraboloids, mostly, as those of rough surfaces are, within the range of the
// law down to `deepest`.
void shape(Asperities& a, LawKind law, double deepest, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const auto i : indices(a)) {
        const double kappa = 1 / a.radius[i], root = std::sqrt(std::pow(10.0, uniform(random)));
        a.kappa1.push_back(kappa * root);
        a.kappa2.push_back(kappa / root);
        a.angle.push_back(0);
        const double last =
            4 * kappa / deepest;  // q^2 of the profile whose range ends at `deepest`
        const double q2 = last * (uniform(random) * 1.2 - 0.3);
        a.biharmonic.push_back(law == LawKind::fourth_order ? q2 * (a.kappa1[i] + a.kappa2[i])
                                                            : 0.0);
    }
}

std::vector<independent::Summit> summits_of(const Asperities& a, LawKind law) {
    std::vector<independent::Summit> out;
    for (const auto i : indices(a)) {
        independent::Summit s{a.x[i], a.y[i], a.z[i], 1 / static_cast<long double>(a.radius[i])};
        if (law != LawKind::hertz) {
            const long double k1 = a.kappa1[i], k2 = a.kappa2[i];
            const auto e = independent::ellipse_of_ratio(k1 / k2);
            s.kappa = std::sqrt(k1 * k2);
            s.F1_squared = e.F1 * e.F1;
            s.per_F2 = 1 / e.F2;
            s.q2 = law == LawKind::fourth_order ? a.biharmonic[i] / (k1 + k2) : 0;
        }
        out.push_back(s);
    }
    return out;
}

struct Family {
    const char* name;
    int systems, n;
    double spacing, radius, spread, R;
    LawKind law;
};

// Of summits some 0.01 high; densities from a few per cent of contact to spots that nearly touch.
const Family kFamilies[] = {
    {"few", 150, 12, 0.02, 5e-4, 0.5, 2.5, LawKind::hertz},
    {"ordinary", 100, 60, 0.03, 1e-3, 0.7, 2.5, LawKind::hertz},
    {"flat", 60, 50, 0.03, 1e-3, 0.5, kInfinity, LawKind::hertz},
    {"small sphere", 40, 80, 0.02, 5e-4, 0.5, 0.3, LawKind::hertz},
    {"ten decades", 40, 40, 0.04, 1e-5, 5.0, 2.5, LawKind::hertz},
    {"elliptic", 60, 50, 0.03, 1e-3, 0.5, 2.5, LawKind::elliptic},
    {"fourth order", 60, 50, 0.03, 1e-3, 0.5, 2.5, LawKind::fourth_order},
};

TEST(against_slow_solver) {
    int systems = 0;
    for (const Family& family : kFamilies) {
        int unique = 0;
        for (const int k : indices(family.systems)) {
            const unsigned seed = 1000u + unsigned(k);
            Asperities a = random_asperities(1 + (k * family.n) / family.systems, family.spacing,
                                             0.01, family.radius, family.spread, seed);
            if (family.law != LawKind::hertz) shape(a, family.law, 0.06, seed);
            // down to where every summit under the sphere is pressed
            const double Z0 = 0.01 - 0.02 * (k % 5);
            const auto reference =
                independent::press(summits_of(a, family.law), family.R, 0.5, 0.5, Z0, 1e-15L);
            CHECK(reference.converged);
            const bool all_methods = k % 10 == 0;
            for (Method method : {Method::direct, Method::dgesv, Method::mesh, Method::automatic}) {
                if (method != Method::direct && !all_methods) continue;
                const Level level =
                    asperity_path(a, {kE, family.R, 0.5, 0.5}, options(method, family.law))
                        .at_separation(Z0);
                CHECK(level.converged);
                if ((!level.unique || !level.converged)) continue;  // the two may find two minima
                unique += method == Method::direct;
                const double N = double(reference.force) * kE, A = double(reference.area);
                CHECK_CLOSE(level.force, N, kTolerance * N);
                CHECK_CLOSE(level.area, A, kTolerance * A);
                std::vector<double> F(a.size(), 0.0);
                for (const auto c : indices(level.f)) F[level.asperity[c]] = level.f[c];
                double difference = 0;
                for (const auto i : indices(a)) {
                    difference =
                        check::worse(difference, std::abs(F[i] - double(reference.load[i]) * kE));
                }
                CHECK(difference <= kTolerance * N);
            }
        }
        // The comparison is worth something only where most systems have one solution, and many
        // contacts.
        CHECK(unique >= 9 * family.systems / 10);
        systems += unique;
    }
    CHECK(systems >= 450);
}

}  // namespace test_independent
