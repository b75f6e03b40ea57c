// Every product that the solver takes, against plain sums of the kernel: direct and mesh, free and
// repeating on oblong periods, without interaction and with a smooth part; all points, most, few,
// one, none of them carrying forces.
#include "check.hpp"
#include "interaction/products.hpp"

namespace test_products {

using namespace rsc;

using Vector = std::vector<double>;
constexpr double kE = 3.0, kWide = 1.2, kHigh = 0.5;

double error_of(const Vector& value, const Vector& truth) {
    double d = 0, s = 0;
    for (const auto k : indices(truth)) {
        d += std::pow(value[k] - truth[k], 2);
        s += truth[k] * truth[k];
    }
    return s > 0 ? std::sqrt(d / s) : std::sqrt(d);
}

Vector some(const Vector& of, const std::vector<int>& which) {
    Vector out;
    for (int k : which) out.push_back(of[k]);
    return out;
}

struct Kind {
    const char* name;
    std::unique_ptr<Products> products;
    double full, inner, elsewhere;  // errors promised
};

void against_plain_sums(const std::shared_ptr<const Kernel>& kernel, int n, const char* name) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    const std::size_t size = n, others = size / 3 + 7;
    Vector x, y, force, xo, yo;
    for (std::size_t k = 0; k < size; ++k) {
        x.push_back(5 + kWide * uniform(random));
        y.push_back(-3 + kHigh * uniform(random));
        force.push_back(uniform(random) + 0.1);
    }
    for (std::size_t k = 5; k < size; k += 5)
        x[k] = x[k - 1];  // as points of a grid have the same x
    for (std::size_t k = 0; k < others; ++k) {
        xo.push_back(4.9 + 1.2 * kWide * uniform(random));
        yo.push_back(-3.05 + kHigh * uniform(random));
    }
    // At the first so many points of (tx, ty), of the forces at some of (sx, sy).
    const auto sums = [&](std::size_t targets, const Vector& tx, const Vector& ty, const Vector& sx,
                          const Vector& sy, const std::vector<int>& active) {
        Vector truth(targets, 0.0);
        for (const std::size_t i : indices(targets))
            for (const std::size_t k : active)
                truth[i] +=
                    force[k] * (&tx == &sx && i == k ? kernel->self()
                                                     : kernel->at(tx[i] - sx[k], ty[i] - sy[k]));
        return truth;
    };
    Kind kinds[] = {
        {"direct", make_direct_products(kernel), 1e-13, 1e-6, 1e-5},
        {"mesh", make_mesh_products(kernel, 1e-7, 1e-3), 1e-7, 1e-3, 1e-5},
        {"mesh, direct where full", make_mesh_products(kernel, 1e-12, 1e-4), 1e-13, 1e-4, 1e-5}};
    for (Kind& kind : kinds) {
        const int before = check::failures;
        Products& p = *kind.products;
        CHECK(&p.kernel() == kernel.get() && p.full_error() <= kind.full &&
              p.inner_error() <= kind.inner && p.count() == 0);
        p.set_points(n, x.data(), y.data());
        for (const int every : {1, 2, 9, n, n + 1,
                                1}) {  // every so many a point carries a force; none; and all again
            std::vector<int> active, passive;
            for (const int k : indices(n))
                (k % every == (every > n ? n : every - 1) ? active : passive).push_back(k);
            p.set_active(active);
            CHECK(p.active() == active && p.passive() == passive);
            const Vector f = some(force, active);
            const Vector truth = sums(size, x, y, x, y, active),
                         elsewhere = sums(others, xo, yo, x, y, active);
            const Vector among = some(truth, active), beside = some(truth, passive);
            Vector all(size, -1.0), part(active.size(), -1.0), rest(passive.size(), -1.0),
                there(others, -1.0);
            const long count = p.count();
            p.full(f.data(), all.data());
            CHECK_CLOSE(error_of(all, truth), 0, 2 * kind.full);
            CHECK(p.count() == count + 1);
            // Where each force meets few others, an error of all is more of these few.
            const double loose = every > 2 ? 20 : 3;
            if (!active.empty()) {
                p.inner(f.data(), part.data());
                CHECK(error_of(part, among) <= loose * kind.inner && p.count() == count + 2);
                p.inner_everywhere(f.data(), all.data());
                CHECK(error_of(all, truth) <= loose * kind.inner);
                p.elsewhere(f.data(), int(others), xo.data(), yo.data(), there.data());
                CHECK(error_of(there, elsewhere) <= kind.elsewhere);
                p.inner_passive(f.data(), rest.data());
                CHECK(error_of(rest, beside) <= loose * kind.inner);
            }
        }
        // Other points, fewer: nothing is left of those before.
        const int few = n / 2;
        p.set_points(few, y.data(), x.data());
        std::vector<int> active;
        for (int k = 0; k < few; k += 2) active.push_back(k);
        p.set_active(active);
        const Vector f = some(force, active);
        const Vector truth = sums(few, y, x, y, x, active);
        Vector all(few);
        p.full(f.data(), all.data());
        CHECK(error_of(all, truth) <= 2 * kind.full);
        if (check::failures > before)
            std::printf("%s, %d points, %s: %d failures\n", kind.name, n, name,
                        check::failures - before);
    }
}

TEST(all_products) {
    against_plain_sums(make_kernel(Interaction::point, kE), 40, "free");
    against_plain_sums(make_kernel(Interaction::point, kE), 900, "free");
    against_plain_sums(make_kernel(Interaction::none, kE), 900, "no interaction");
    // A smooth part of either sign: of force/(pi E*) at a depth, coarser and finer than the points
    // lie.
    for (const double depth : {0.02, 0.3})
        for (const double share : {-0.7, 2.0}) {
            const double near = share / (pi * kE);
            const auto smooth = std::make_shared<const SmoothPart>(
                [=](double d) { return near / std::hypot(d, depth); },
                [=](double k) { return share * std::exp(-k * depth); }, depth);
            against_plain_sums(make_kernel(Interaction::point, {kE, smooth}), 40, "smooth part");
            against_plain_sums(make_kernel(Interaction::point, {kE, smooth}), 900, "smooth part");
            against_plain_sums(make_kernel(Interaction::none, {kE, smooth}), 40,
                               "smooth part without interaction");
        }
    against_plain_sums(make_kernel(Interaction::point, kE, {kWide, kHigh}), 30, "repeating");
    against_plain_sums(make_kernel(Interaction::point, kE, {kWide, kHigh}), 400, "repeating");
}

}  // namespace test_products
