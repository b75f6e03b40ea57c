// What a path does around its model's solutions: force control and separations between
// planes count all their work, accept one level and no trial, and none that failed; the curve of
// two contacts counts its levels; forgetting is starting anew, bit by bit.
#include "check.hpp"
#include "contact/path.hpp"
#include "physics/friction/contact_curve.hpp"
#include "support/asperities.hpp"

namespace test_contact_control {

using namespace rsc;

constexpr double kTop = 1.5;

// N = (1.5 - z)^(3/2) of the separation z as the model counts it, and `jump` more below 0.3;
// trials are wrong by `wrong` of the load.
class Known final : public Model, private History {
public:
    explicit Known(double shift = 0, double wrong = 0) : shift_(shift), wrong_(wrong) {}

    long solves = 0, trials = 0, accepted = 0;
    bool fails = false;
    double jump = 0;
    long iterations() const { return 3 * solves + 2 * trials; }
    long products() const { return 30 * solves + 50 * trials; }
    void put_period(const Period& period) { indenter_.period = period; }

    const Indenter& indenter() const override { return indenter_; }
    History* history() override { return this; }
    void move_tip(double, double) override {}
    ContactRange contact_range() const override { return {.first_touch = kTop}; }
    double shift() const override { return shift_; }
    Level solve(double z, bool trial) override {
        const bool wrong = trial && wrong_ != 0;
        ++(wrong ? trials : solves);
        z_ = z;
        const double factor = wrong ? 1 + wrong_ : 1;
        Level level;
        level.provisional = wrong;
        level.separation = z;
        level.force = factor * std::pow(std::max(kTop - z, 0.0), 1.5) + (z < 0.3 ? jump : 0);
        level.area = 2 * level.force;
        level.iterations = wrong ? 2 : 3;
        level.products = wrong ? 50 : 30;
        level.converged = !fails;
        slope_ = z < kTop ? -1.5 * factor * std::sqrt(kTop - z) : 0;
        return level;
    }
    void solve_again(double z, const Level&) override { (void)solve(z, false); }
    void forget() override {}
    double stiffness(Slope) override { return slope_; }
    double energy() const override {
        const double N = std::pow(std::max(kTop - z_, 0.0), 1.5);
        return 0.4 * std::pow(std::max(kTop - z_, 0.0), 2.5) + 0.5 * shift_ * N * N;
    }
    double force_at_most(double depth) override { return std::pow(depth, 1.5); }

private:
    void accept(Level& level) override {
        ++accepted;
        level.plastic_work = 42;
    }
    std::vector<double> write() const override { return {}; }
    void read(const std::vector<double>&) override {}

    double shift_, wrong_, z_ = kTop, slope_ = 0;
    Indenter indenter_{1, 1, 0, 0, {}};
};

// A path of a known model, which stays accessible.
struct KnownPath {
    explicit KnownPath(double shift = 0, double wrong = 0)
        : model(new Known(shift, wrong)), path(std::unique_ptr<Model>(model), 1e-9) {}
    Known* model;
    Path path;
};

TEST(control) {
    for (const double shift : {0.0, 0.3})
        for (const double wrong : {0.0, 0.02}) {
            KnownPath known(shift, wrong);
            Known& model = *known.model;
            Path& contact = known.path;
            if (shift > 0) model.put_period({2, 4});
            long levels = 0, iterations = 0, products = 0;
            const auto check = [&](const Level& level, double z, double N) {
                CHECK_CLOSE(level.separation, z + shift * N, 1e-8 * std::max(1.0, N));
                CHECK_RELATIVE(level.force, N, 1e-8);
                CHECK(level.converged && model.accepted == ++levels && level.plastic_work == 42);
                CHECK(level.iterations == model.iterations() - iterations &&
                      level.products == model.products() - products);
                iterations = model.iterations();
                products = model.products();
                CHECK((shift > 0) == std::isfinite(level.pressure) &&
                      (shift > 0) == std::isfinite(level.area_fraction));
                if (shift > 0) CHECK_RELATIVE(level.pressure, level.force / 8, 1e-15);
                if (shift > 0) CHECK_RELATIVE(level.area_fraction, level.area / 8, 1e-15);
            };
            for (const double N : {1e-6, 0.3, 20.0, 0.31, 1e5, 1e-3}) {
                const double z = kTop - std::cbrt(N * N);
                check(contact.at_force(N), z, N);
                // Deeper, z + shift N is the same at two depths.
                if (shift == 0 || N < 5) check(contact.at_separation(z + shift * N), z, N);
            }
            const Level none = contact.at_separation(kTop);
            CHECK(none.force == 0 && none.separation == kTop && model.accepted == ++levels);
            CHECK(none.iterations == 3 && none.products == 30);
            // What failed is told and not accepted.
            model.fails = true;
            CHECK(!contact.at_force(2.0).converged && model.accepted == levels);
            CHECK(!contact.at_separation(0.5).converged && model.accepted == levels);
        }
}

// A force that no separation carries is told; those on both sides of the jump are found.
TEST(jumps) {
    KnownPath known;
    Path& contact = known.path;
    known.model->jump = 5;
    const double below = std::pow(1.2, 1.5);
    for (const double N : {0.5, below - 1e-3, below + 5.001, 8.0}) {
        const Level level = contact.at_force(N);
        CHECK(level.converged);
        CHECK_RELATIVE(level.force, N, 1e-8);
    }
    for (const double N : {below + 0.01, 3.0, below + 4.99}) {
        const Level level = contact.at_force(N);
        CHECK(!level.converged && level.fallback == Fallback::jump);
        CHECK_CLOSE(level.separation, 0.3, 1e-12);
    }
}

// Two contacts take turns; a level that one of them holds is not computed again.
TEST(curves) {
    KnownPath first, second;
    Known &one = *first.model, &other = *second.model;
    ContactCurve curve(first.path, second.path);
    const auto N = [](double delta) { return std::pow(kTop + delta, 1.5); };
    CHECK(curve.first_touch() == -kTop && curve.levels() == 0 && curve.failed() == 0);
    CHECK(curve.load(-kTop).force == 0 && curve.load(-2).energy == 0 &&
          curve.stiffness(-kTop) == 0 && curve.levels() == 0);
    CHECK_RELATIVE(curve.load(0.5).force, N(0.5), 1e-14);
    CHECK_RELATIVE(curve.load(0.5).energy, 0.4 * std::pow(2.0, 2.5), 1e-14);
    CHECK(curve.levels() == 1 && one.solves == 1 && other.solves == 0);
    CHECK_RELATIVE(curve.load(-1).force, N(-1), 1e-14);
    CHECK(curve.levels() == 2 && other.solves == 1);
    CHECK_RELATIVE(curve.stiffness(0.5), 1.5 * std::sqrt(2.0), 1e-14);
    CHECK_RELATIVE(curve.stiffness(-1), 1.5 * std::sqrt(0.5), 1e-14);
    CHECK_RELATIVE(curve.load(-1).energy, 0.4 * std::pow(0.5, 2.5), 1e-14);
    CHECK(curve.levels() == 2);
    CHECK_RELATIVE(curve.stiffness(0.4), 1.5 * std::sqrt(1.9), 1e-14);  // nearer to the first
    CHECK(curve.levels() == 3 && one.solves == 2);
    CHECK_RELATIVE(curve.load(-0.9).force, N(-0.9), 1e-14);
    CHECK(curve.levels() == 4 && other.solves == 2);
    CHECK_RELATIVE(curve.approach(8.0), 2.5, 1e-8);
    CHECK(curve.levels() == 5 && other.solves > 2 && curve.failed() == 0);
    CHECK(curve.level(2.5).force == 0 || std::abs(curve.level(2.5).force - 8) < 1e-6);
    other.fails = one.fails = true;
    const long before = curve.levels();
    curve.load(-0.2);
    curve.approach(3.0);
    CHECK(curve.levels() == before + 2 && curve.failed() == 2);
    curve.forget();
    curve.load(-0.2);
    CHECK(curve.levels() == before + 3 && curve.failed() == 3);
}

}  // namespace test_contact_control
