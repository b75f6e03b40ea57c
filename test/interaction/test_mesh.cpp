// The mesh product against sums in long double, on every kind of point set.
#include "check.hpp"
#include "interaction/mesh.hpp"

#include "base/parallel.hpp"

namespace test_mesh {

using namespace rsc;

using Vector = std::vector<double>;

struct Points {
    Vector x, y;
    std::size_t size() const { return x.size(); }
};

Points uniform_points(std::size_t n, unsigned seed, double length_x = 1, double length_y = 1) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Points p{Vector(n), Vector(n)};
    for (const std::size_t i : indices(n)) {
        p.x[i] = length_x * uniform(engine);
        p.y[i] = length_y * uniform(engine);
    }
    return p;
}

// Nine clusters of a hundredth of the size, and a tenth of the points anywhere.
Points clustered_points(std::size_t n, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    Points p = uniform_points(n, seed);
    for (const std::size_t i : indices(n - n / 10)) {
        const double cluster = double(i % 9);
        p.x[i] = std::cos(cluster) + 0.01 * normal(engine);
        p.y[i] = std::sin(2 * cluster) + 0.01 * normal(engine);
    }
    return p;
}

Vector random_forces(std::size_t n, unsigned seed, bool signs) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Vector f(n);
    for (double& value : f) value = signs ? 2 * uniform(engine) - 1 : uniform(engine);
    return f;
}

const auto kUnit = make_kernel(Interaction::point, 1 / pi);  // 1/d

Vector product(MeshPotential& potential, const Vector& f) {
    Vector phi(f.size(), std::nan(""));
    potential.apply(f.data(), phi.data());
    return phi;
}

// |phi - exact| / |exact| over some 100 of the points.
double error_of(const Points& p, const Vector& f, const Vector& phi) {
    const std::size_t step = p.size() / 100 + 1;
    long double difference = 0, norm = 0;
    for (std::size_t i = 0; i < p.size(); i += step) {
        long double sum = 0;
        for (const auto j : indices(p)) {
            const long double dx = static_cast<long double>(p.x[i]) - p.x[j],
                              dy = static_cast<long double>(p.y[i]) - p.y[j];
            const long double d = std::sqrt(dx * dx + dy * dy);
            if (d > 0) sum += f[j] / d;
        }
        difference += (phi[i] - sum) * (phi[i] - sum);
        norm += sum * sum;
    }
    return norm > 0 ? double(std::sqrt(difference / norm)) : double(std::sqrt(difference));
}

void check_errors(const Points& p, const char* name, bool on_mesh = true) {
    const int before = check::failures;
    for (double wanted : {1e-3, 1e-6, 1e-9}) {
        MeshPotential potential(p.size(), p.x.data(), p.y.data(), wanted, kUnit);
        CHECK((potential.mesh_points() > 0) == on_mesh);
        double largest = 0;
        for (bool signs : {false, true}) {
            const Vector f = random_forces(p.size(), 7, signs);
            const double error = error_of(p, f, product(potential, f));
            CHECK_CLOSE(error, 0, wanted);
            largest = std::max(largest, error);
        }
    }
    if (check::failures > before) std::printf("  (in %s)\n", name);
}

TEST(shapes) {
    check_errors(uniform_points(4000, 1), "uniform");
    check_errors(uniform_points(20000, 2), "uniform");
    check_errors(uniform_points(300, 3), "few");
    check_errors(uniform_points(4000, 4, 1, 0.01), "long");
    check_errors(uniform_points(4000, 5, 0.02, 1), "tall");
    check_errors(uniform_points(4000, 6, 1, 0), "collinear");
    check_errors(uniform_points(4000, 7, 0, 1e-5), "collinear y");
    check_errors(clustered_points(4000, 8), "clustered");

    // A hundred places with ten points each, and a point far from the others.
    Points twice = uniform_points(4000, 9);
    for (std::size_t i = 100; i < 1000; ++i) {
        twice.x[i] = twice.x[i % 100];
        twice.y[i] = twice.y[i % 100];
    }
    check_errors(twice, "coincident");
    Points far = uniform_points(2000, 10);
    far.x[77] = 30;
    far.y[77] = -20;
    check_errors(far, "far point");
}

TEST(tiny) {
    for (std::size_t n : {0, 1, 2, 3, 100}) check_errors(uniform_points(n, 11), "tiny", false);
    const Points place{Vector(1000, 0.3), Vector(1000, -2.0)};
    MeshPotential potential(1000, place.x.data(), place.y.data(), 1e-6, kUnit);
    const Vector phi = product(potential, random_forces(1000, 12, true));
    CHECK(std::ranges::all_of(phi, [](double value) { return value == 0; }));
}

TEST(same_bits_for_any_threads) {
    for (const Points& p : {uniform_points(12000, 20), clustered_points(6000, 21)}) {
        const Vector f = random_forces(p.size(), 22, true);
        Vector first;
        for (int threads : {1, 2, 3}) {
            const rsc::LoopThreads loops(threads);
            MeshPotential potential(p.size(), p.x.data(), p.y.data(), 1e-6, kUnit);
            const Vector phi = product(potential, f), again = product(potential, f);
            if (first.empty()) first = phi;
            CHECK(phi == first);
            CHECK(again == first);
        }
    }
}

}  // namespace test_mesh
