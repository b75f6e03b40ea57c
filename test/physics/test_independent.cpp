// Hundreds of random systems against the independent slow solver (independent.hpp); how fast Newton converges; and what follows
// from an energy: the symmetry of the response, dW/dg = F, a minimum.
#include <algorithm>
#include <cstdio>
#include <limits>

#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "physics/independent.hpp"
#include "physics/random_asperities.hpp"

using namespace rsc;

namespace {

constexpr double kE = 94.0e3;
constexpr double kFlat = std::numeric_limits<double>::infinity();
// Of the total load, a force or the load itself: the solver is asked for residuals of 1e-13, and errors are larger than residuals
// by the condition of I + S B S, below 100 where the solution is unique by the solver's own proof.
constexpr double kTolerance = 1e-10;

SolverOptions options(Method method, LawKind law = LawKind::hertz) {
    SolverOptions o;
    o.method = method;
    o.law = law;
    o.tolerance = 1e-13;
    o.sigma = 0.01;
    return o;
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Principal curvatures and biharmonics for asperities that have only radii: ratios up to 10; flatter summits than paraboloids,
// mostly, as those of rough surfaces are, within the range of the law down to `deepest`.
void shape(Asperities& a, LawKind law, double deepest, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double kappa = 1 / a.radius[i], root = std::sqrt(std::pow(10.0, uniform(random)));
        a.kappa1.push_back(kappa * root);
        a.kappa2.push_back(kappa / root);
        a.angle.push_back(0);
        const double last = 4 * kappa / deepest;  // q^2 of the profile whose range ends at `deepest`
        const double q2 = last * (uniform(random) * 1.2 - 0.3);
        a.biharmonic.push_back(law == LawKind::fourth_order ? q2 * (a.kappa1[i] + a.kappa2[i]) : 0.0);
    }
}

std::vector<independent::Summit> summits_of(const Asperities& a, LawKind law) {
    std::vector<independent::Summit> out;
    for (std::size_t i = 0; i < a.size(); ++i) {
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
    {"flat", 60, 50, 0.03, 1e-3, 0.5, kFlat, LawKind::hertz},
    {"small sphere", 40, 80, 0.02, 5e-4, 0.5, 0.3, LawKind::hertz},
    {"ten decades", 40, 40, 0.04, 1e-5, 5.0, 2.5, LawKind::hertz},
    {"elliptic", 60, 50, 0.03, 1e-3, 0.5, 2.5, LawKind::elliptic},
    {"fourth order", 60, 50, 0.03, 1e-3, 0.5, 2.5, LawKind::fourth_order},
};

void against_slow_solver() {
    int systems = 0;
    for (const Family& family : kFamilies) {
        double worst_force = 0, worst_load = 0, worst_area = 0;
        int unique = 0, contacts = 0, sweeps = 0;
        for (int k = 0; k < family.systems; ++k) {
            const unsigned seed = 1000u + static_cast<unsigned>(k);
            Asperities a = random_asperities(1 + (k * family.n) / family.systems, family.spacing, 0.01, family.radius, family.spread, seed);
            if (family.law != LawKind::hertz) shape(a, family.law, 0.06, seed);
            const double Z0 = 0.01 - 0.02 * (k % 5);  // down to where every summit under the sphere is pressed
            const auto reference = independent::press(summits_of(a, family.law), family.R, 0.5, 0.5, Z0, 1e-15L);
            CHECK(reference.converged);
            sweeps = std::max(sweeps, reference.sweeps);
            const bool all_methods = k % 10 == 0;
            for (Method method : {Method::direct, Method::dgesv, Method::mesh, Method::automatic}) {
                if (method != Method::direct && !all_methods) continue;
                const Level level = AsperityContact(a, {kE, family.R, 0.5, 0.5}, options(method, family.law)).at_separation(Z0);
                CHECK(level.status != LevelStatus::not_converged);
                if (level.status >= LevelStatus::not_unique) continue;  // the two may find two minima
                unique += method == Method::direct;
                const double N = static_cast<double>(reference.force) * kE, A = static_cast<double>(reference.area);
                CHECK_CLOSE(level.force, N, kTolerance * N);
                CHECK_CLOSE(level.area, A, kTolerance * A);
                std::vector<double> F(a.size(), 0.0);
                for (std::size_t c = 0; c < level.f.size(); ++c) F[at(level.asperity[c])] = level.f[c];
                double difference = 0;
                for (std::size_t i = 0; i < a.size(); ++i) {
                    difference = check::worse(difference, std::abs(F[i] - static_cast<double>(reference.load[i]) * kE));
                }
                CHECK(difference <= kTolerance * N);
                if (N > 0) {
                    worst_load = check::worse(worst_load, std::abs(level.force / N - 1));
                    worst_area = check::worse(worst_area, std::abs(level.area / A - 1));
                    worst_force = std::max(worst_force, difference / N);
                }
                contacts = std::max(contacts, static_cast<int>(level.f.size()));
            }
        }
        // The comparison is worth something only where most systems have one solution, and many contacts.
        CHECK(unique >= 9 * family.systems / 10);
        systems += unique;
        std::printf("%-12s %3d of %3d systems unique, up to %d contacts, %d sweeps: load %.1e, area %.1e, a force %.1e of the load\n",
                    family.name, unique, family.systems, contacts, sweeps, worst_load, worst_area, worst_force);
    }
    CHECK(systems >= 450);
}

// Residuals e of a cold start stopped after 1, 2, 3, ... steps. Steps are solved to sqrt(e), so that order 1.5 is what to expect:
// e' <= C e^1.5 with one C over eight decades, whatever the system (its largest value is printed; C = 3 is asserted). The slope
// of ln e' over ln e tells it from a linearly convergent method, whose slope is 1; it is blurred by C, which varies from step to
// step. Pairs count once the iteration has come near (e < 0.1), as long as rounding plays no part (e' > 1e-13).
void newton_order() {
    std::vector<double> from, to;
    int most_steps = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Asperities a = random_asperities(300, 0.02, 0.01, 5e-4, 0.5, 300 + seed);
        std::vector<double> residual;
        for (int steps = 1; steps < 30; ++steps) {
            SolverOptions o = options(Method::direct);
            o.max_iterations = steps;
            const Level level = AsperityContact(a, {kE, 2.5, 0.5, 0.5}, o).at_separation(-0.01);
            residual.push_back(level.residual);
            CHECK((level.status == LevelStatus::not_converged) == (level.residual > o.tolerance));
            CHECK(level.iterations <= steps);
            if (level.status != LevelStatus::not_converged) break;
        }
        most_steps = std::max(most_steps, static_cast<int>(residual.size()));
        for (std::size_t k = 1; k < residual.size(); ++k) {
            if (residual[k - 1] > 0.1 || residual[k] < 1e-13) continue;
            from.push_back(std::log(residual[k - 1]));
            to.push_back(std::log(residual[k]));
        }
        if (seed < 3) {
            std::printf("residuals of a cold start:");
            for (double e : residual) std::printf(" %.1e", e);
            std::printf("\n");
        }
    }
    double mean_from = 0, mean_to = 0, covariance = 0, variance = 0;
    for (std::size_t k = 0; k < from.size(); ++k) mean_from += from[k], mean_to += to[k];
    mean_from /= static_cast<double>(from.size()), mean_to /= static_cast<double>(from.size());
    for (std::size_t k = 0; k < from.size(); ++k) {
        covariance += (from[k] - mean_from) * (to[k] - mean_to);
        variance += (from[k] - mean_from) * (from[k] - mean_from);
    }
    const double order = covariance / variance;
    double C = 0;
    for (std::size_t k = 0; k < from.size(); ++k) C = check::worse(C, std::exp(to[k] - 1.5 * from[k]));
    std::printf("e' <= %.2f e^1.5 in %zu pairs of residuals, slope of ln e' over ln e %.2f; at most %d steps\n", C, from.size(), order,
                most_steps);
    CHECK(from.size() >= 40);
    CHECK(C <= 3);
    CHECK(order >= 1.35);
    CHECK(most_steps <= 15);
}

// dF_i/dg_j = dF_j/dg_i (reciprocity), and dW/dg_i = F_i (the forces come from an energy), by central differences in the height
// of single asperities, of second order in h/u; asperities that are nearly out of touch are left out, where the slope is not
// smooth.
void reciprocity() {
    for (unsigned seed = 0; seed < 6; ++seed) {
        Asperities a = random_asperities(80, 0.03, 0.01, 1e-3, 0.5, 400 + seed);
        const double Z0 = -0.015, h = 2e-7;
        const auto press = [&](const Asperities& set, double* energy) {
            AsperityContact contact(set, {kE, 2.5, 0.5, 0.5}, options(Method::direct));
            const Level level = contact.at_separation(Z0);
            if (energy) *energy = contact.energy();
            std::vector<double> F(set.size(), 0.0);
            for (std::size_t c = 0; c < level.f.size(); ++c) F[at(level.asperity[c])] = level.f[c];
            return F;
        };
        const Level level = AsperityContact(a, {kE, 2.5, 0.5, 0.5}, options(Method::direct)).at_separation(Z0);
        std::vector<std::size_t> chosen;
        for (std::size_t c = 0; c < level.f.size() && chosen.size() < 6; ++c) {
            if (level.u[c] > 1e-3) chosen.push_back(at(level.asperity[c]));
        }
        CHECK(chosen.size() == 6);
        const auto F = press(a, nullptr);
        std::vector<std::vector<double>> response;
        for (std::size_t j : chosen) {
            double energy_up = 0, energy_down = 0;
            const double z = a.z[j];
            a.z[j] = z + h;
            auto up = press(a, &energy_up);
            a.z[j] = z - h;
            const auto down = press(a, &energy_down);
            a.z[j] = z;
            CHECK_RELATIVE((energy_up - energy_down) / (2 * h), F[j], 1e-6);
            for (std::size_t i = 0; i < up.size(); ++i) up[i] = (up[i] - down[i]) / (2 * h);
            response.push_back(up);
        }
        double largest_off_diagonal = 0;
        for (std::size_t p = 0; p < chosen.size(); ++p) {
            CHECK(response[p][chosen[p]] > 0);
            for (std::size_t q = 0; q < p; ++q) {
                const double ij = response[p][chosen[q]], ji = response[q][chosen[p]];
                CHECK_CLOSE(ij, ji, 1e-7 * std::sqrt(response[p][chosen[p]] * response[q][chosen[q]]));
                largest_off_diagonal = std::max(largest_off_diagonal, std::abs(ij) / response[p][chosen[p]]);
            }
        }
        CHECK(largest_off_diagonal > 1e-3);  // the symmetry is not that of zeros
    }
}

// The energy as a function of forces, written out: sum (3/5) c^(-2/3) f^(5/3) + F'BF/2 - g0'F. At the answer it is minus
// energy(), and no feasible change of the forces, of few or of all, lowers it; W(Z0) and N(Z0) fall as the sphere is raised.
void energy_is_minimal() {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal(0, 1);
    for (unsigned seed = 0; seed < 8; ++seed) {
        const bool overlapping = seed % 2 == 1;
        const Asperities a = random_asperities(60, overlapping ? 0.004 : 0.03, 0.01, overlapping ? 0.2 : 1e-3, 0.5, 500 + seed);
        const double Z0 = -0.01;
        AsperityContact contact(a, {kE, kFlat, 0.5, 0.5}, options(Method::direct));
        const Level level = contact.at_separation(Z0);
        CHECK(level.status != LevelStatus::not_converged);
        const std::size_t n = a.size();
        const auto energy = [&](const std::vector<double>& F) {
            long double E = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const long double c = 4 / 3.0L * kE * std::sqrt(static_cast<long double>(a.radius[i])), f = F[i];
                E += 0.6L * std::pow(c, -2 / 3.0L) * std::pow(f, 5 / 3.0L) - f * (static_cast<long double>(a.z[i]) - Z0);
                for (std::size_t j = 0; j < i; ++j) {
                    E += f * F[j] / (independent::kPi * kE * std::hypot(static_cast<long double>(a.x[i] - a.x[j]), a.y[i] - a.y[j]));
                }
            }
            return E;
        };
        std::vector<double> F(n, 0.0);
        for (std::size_t c = 0; c < level.f.size(); ++c) F[at(level.asperity[c])] = level.f[c];
        const long double least = energy(F);
        CHECK_RELATIVE(contact.energy(), static_cast<double>(-least), 1e-11);
        int lower = 0;
        for (int trial = 0; trial < 300; ++trial) {
            std::vector<double> moved = F;
            const double size = std::pow(10.0, -1 - trial % 5);
            for (std::size_t i = 0; i < n; ++i) {
                const bool this_one = trial % 3 != 0 || i % 17 == static_cast<std::size_t>(trial) % 17;
                const double scale = F[i] > 0 ? F[i] : level.force / static_cast<double>(n);
                if (this_one) moved[i] = std::max(0.0, moved[i] + size * scale * normal(random));
            }
            lower += energy(moved) < least - 1e-15L * std::abs(least);
        }
        CHECK(lower == 0);
        if (overlapping) {
            CHECK(level.status >= LevelStatus::overlapping);
            continue;
        }
        double last_energy = 1e300, last_force = 1e300;
        for (double Z = -0.03; Z < 0.03; Z += 0.002) {
            const double N = contact.at_separation(Z).force, W = contact.energy();
            CHECK(W >= 0 && (W < last_energy || W == 0));
            CHECK(N < last_force || N == 0);
            last_energy = W;
            last_force = N;
        }
    }
}

}  // namespace

TESTS {
    against_slow_solver();
    newton_order();
    reciprocity();
    energy_is_minimal();
}
