// The law of most loaded ellipses: Hertz's ellipse, convexity, work and turned surfaces; its levels
// against elements.
#include "asperities/asperity_contact.hpp"
#include "asperities/ellipse_law.hpp"
#include "check.hpp"
#include "contact/answers.hpp"
#include "height_maps.hpp"
#include "run/prepare.hpp"

using namespace rsc;

namespace {

constexpr double kE = 1e5, kSpacing = 0.4;
constexpr double kStep = 0.01;  // of the maps

// A map of the given heights about (0, 0) with the given summits, of which x, y, kappa1, kappa2 and
// angle are set.
template <class Height>
FoundSummits map_of(Height&& height, std::vector<std::array<double, 5>> summits) {
    constexpr int half = 80;
    auto map = std::make_shared<HeightMap>(
        height_map(2 * half + 1, 2 * half + 1, kStep, kStep,
                   [&](int i, int j) { return height((i - half) * kStep, (j - half) * kStep); }));
    map->x0 = map->y0 = -half * kStep;
    FoundSummits found;
    for (const auto& [x, y, k1, k2, angle] : summits) {
        Asperities& a = found.summits;
        a.x.push_back(x), a.y.push_back(y), a.z.push_back(height(x, y)),
            a.radius.push_back(1 / std::sqrt(k1 * k2));
        a.kappa1.push_back(k1), a.kappa2.push_back(k2), a.angle.push_back(angle),
            a.biharmonic.push_back(0);
    }
    found.map = std::move(map);
    return found;
}

std::unique_ptr<Law> law_of(const FoundSummits& found) {
    Indenter flat;
    flat.E_star = kE, flat.shape = std::numeric_limits<double>::infinity();
    auto law =
        make_ellipse_law(make_law(LawKind::fourth_order, found.summits, kE), found, flat, kSpacing);
    std::vector<int> all(found.summits.size());
    std::iota(all.begin(), all.end(), 0);
    law->prepare(all);
    return law;
}

struct Answer {
    double force, slope, work;
};
Answer ask(const Law& law, int i, double u) {
    Answer a{};
    law.respond(1, &i, &u, &a.force, &a.slope, &a.work);
    return a;
}

// Force and work increase with their own derivatives, and the force is convex: it lies above its
// tangents, also where one ellipse takes over from another.
void check_work(const Law& law, int i, double deepest) {
    constexpr double kDerivative = 1e-5, kStepShare = 1e-5, kRounding = 1e-9;
    double slope = 0, last = 0;
    Answer before{};
    for (double u = 0.002 * deepest; u < deepest; last = u, u *= 1.01) {
        const double h = kStepShare * u;
        const Answer a = ask(law, i, u), low = ask(law, i, u - h), high = ask(law, i, u + h);
        CHECK_RELATIVE((high.work - low.work) / (2 * h), a.force, kDerivative);
        CHECK_RELATIVE((high.force - low.force) / (2 * h), a.slope, 10 * kDerivative);
        CHECK(a.slope >= slope * (1 - kRounding));
        CHECK(a.force - before.force >= (1 - kRounding) * slope * (u - last));
        CHECK(a.force - before.force <= (1 + kRounding) * a.slope * (u - last));
        slope = a.slope, before = a;
    }
}

}  // namespace

TEST(most_loaded) {
    // A paraboloid of any ratio of curvatures and direction: Hertz's ellipse.
    for (const double ratio : {1.0, 2.21, 10.0})
        for (const double angle : {0.0, 0.6, -1.2}) {
            constexpr double
                kForce = 1e-5,
                kArea = 1e-3;  // interpolation between penetrations in steps of a twentieth
            const double k2 = 0.5, k1 = ratio * k2, c = std::cos(angle), s = std::sin(angle);
            const FoundSummits found = map_of(
                [&](double x, double y) {
                    const double along = x * c + y * s, across = y * c - x * s;
                    return -0.5 * (k2 * along * along + k1 * across * across);
                },
                {{0, 0, k1, k2, angle}});
            const auto law = law_of(found), hertz = make_law(LawKind::elliptic, found.summits, kE);
            const int zero = 0;
            hertz->prepare({&zero, 1});
            for (const double u : {1e-4, 1.3e-3, 7e-3}) {
                CHECK_RELATIVE(law->force(0, u), hertz->force(0, u), kForce);
                CHECK_RELATIVE(law->area(0, u), hertz->area(0, u), kArea);
                const auto spot = law->spot(0, u);
                CHECK(spot && std::hypot(spot->x, spot->y) < 1e-3 * spot->minor);
                CHECK(spot && (ratio == 1 || std::abs(std::sin(spot->angle - angle)) < 1e-2));
            }
            // Beyond the table the load is between those of a punch and of the paraboloid.
            double end = 7e-3;
            while (!law->beyond(0, end)) end *= 1.01;
            const Answer last = ask(*law, 0, end);
            CHECK(law->force(0, 2 * end) > (1 + 1e-2) * (last.force + last.slope * end));
            CHECK(law->force(0, 2 * end) < hertz->force(0, 2 * end));
            check_work(*law, 0, 3 * end);
        }

    // A summit that falls off faster to one side: its spots go beside it, and are known until they
    // are as wide as summits are apart.
    {
        const auto law = law_of(
            map_of([](double x, double y) { return -6 * y * y - (x > 0 ? 6.0 : 0.6) * x * x; },
                   {{0, 0, 12, std::sqrt(1.2 * 12), 0}}));
        double end = 1e-3;
        while (!law->beyond(0, 1.01 * end)) end *= 1.01;
        const auto spot = law->spot(0, end);
        CHECK(spot && spot->major > 0.9 * kSpacing && spot->x < -0.3 * kSpacing);
    }

    // A small top on a wide one: its own spot jumps to that of the wide one, which carries more
    // already at smaller penetrations.
    check_work(*law_of(map_of(
                   [](double x, double y) {
                       return -(x * x + y * y) + 2e-3 * std::exp(-(x * x + y * y) / 0.002);
                   },
                   {{0, 0, 4, 4, 0}})),
               0, 0.03);

    // Two tops on a ridge. The higher one carries, with the lower one, what their common ellipse
    // carries, and not less than alone.
    {
        const auto ridge = [](double x, double y) {
            return 0.02 * (std::exp(-((x + 0.06) * (x + 0.06) + y * y) / 0.005) +
                           0.98 * std::exp(-((x - 0.06) * (x - 0.06) + y * y) / 0.005));
        };
        const auto top_near = [&](double x) {
            for (double step = 0.01; step > 1e-9;
                 step *=
                 ridge(x + step, 0) <= ridge(x, 0) && ridge(x - step, 0) <= ridge(x, 0) ? 0.5 : 1)
                x += ridge(x + step, 0) > ridge(x, 0)   ? step
                     : ridge(x - step, 0) > ridge(x, 0) ? -step
                                                        : 0;
            return x;
        };
        const double k = 0.02 * 2 / 0.005, left = top_near(-0.06), right = top_near(0.06);
        const FoundSummits both = map_of(ridge, {{left, 0, k, 0.8 * k, 0.0},
                                                 {right, 0, 0.9 * k, 0.7 * k, 0.0}}),
                           one = map_of(ridge, {{left, 0, k, 0.8 * k, 0.0}});
        const auto law = law_of(both), alone = law_of(one);
        check_work(*law, 0, 0.018);
        check_work(*law, 1, 0.018);
        const double drop = both.summits.z[0] - both.summits.z[1],
                     B = 1 / (std::numbers::pi * kE * (both.summits.x[1] - both.summits.x[0]));
        bool shared = false;
        for (double u = 0.003; u < 0.016; u += 0.001) {
            double f = law->force(0, u), g = 0;  // loads of the two at the same penetration
            for (int i = 0; i < 2000; ++i) {
                g += 0.2 * (law->force(1, u - drop - B * f) - g);
                f += 0.2 * (law->force(0, u - B * g) - f);
            }
            const auto spot = alone->spot(0, u);
            const bool common =
                spot && spot->x + spot->major > both.summits.x[1] - both.summits.x[0];
            CHECK(f + g >= (1 - 2e-2) * alone->force(0, u));
            if (common) CHECK_RELATIVE(f + g, alone->force(0, u), 2e-2);
            shared = shared || (common && g > 0.05 * f);
        }
        CHECK(shared);
    }

    // A spot far from round on a polished surface, which carried 24 % too little by its top alone,
    // against elements; the load is the derivative of the energy, and tables do not depend on the
    // levels before.
    {
        constexpr double kForce = 0.03, kWork = 1e-5, kLateral = 1e-3;
        Case c;
        c.run.threads = 1, c.run.seed = 31;
        c.surface.n = 512, c.surface.L_lambda_l = 8, c.surface.L_lambda_s = 64,
        c.surface.sigma = 4e-4;
        c.asperities.law = LawKind::fourth_order;
        c.solver.tolerance = 1e-10;
        c.solver.model = Model::asperities;
        Case e = c;
        e.solver.model = Model::elements, e.solver.tolerance = 1e-6;
        const SurfaceModel summits = make_surface_model(c, 1, 1),
                           points = make_surface_model(e, 1, 1);
        const Indenter ball = indenter_of(c, summits.domain);
        const SolverOptions options = solver_of(c, summits.domain);
        const auto contact = make_contact(summits, ball, options);
        const Level pixels = make_contact(points, ball, solver_of(e, points.domain))
                                 ->at_separation(4e-4),
                    spot = contact->at_separation(4e-4);
        const double first = spot.force;
        const Vec2 true_side = lateral_force(ball, pixels), side = lateral_force(ball, spot);
        const double off = std::hypot(side.x - true_side.x, side.y - true_side.y) / pixels.force;
        CHECK_RELATIVE(first, pixels.force, kForce);
        CHECK(off < kLateral);
        for (const double Z : {4e-4, 1e-4}) {
            const double h = 1e-3 * 4e-4, force = contact->at_separation(Z).force;
            (void)contact->at_separation(Z - h);
            const double low = contact->energy();
            (void)contact->at_separation(Z + h);
            CHECK_RELATIVE((low - contact->energy()) / (2 * h), force, 10 * kWork);
        }
        CHECK_RELATIVE(contact->at_separation(4e-4).force, first, 1e-8);
        CHECK_RELATIVE(make_contact(summits, ball, options)->at_separation(1e-4).force,
                       contact->at_separation(1e-4).force, 1e-8);
    }
}
