// Friction through the C interface: what it does is that of the core.
#include "check.hpp"
#include "physics/friction/contact_curve.hpp"
#include "support/asperities.hpp"
#include "support/library.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace test_api_friction {

// Elements along x and then y: the work of Q is what is stored and lost, spots carry all of Q,
// first loading in one increment is that in many, and in full slip Q is mu N along the slide.
TEST(elements_along_a_path) {
    const Made made(
        "&solids E = 1e5, 1e5  nu = 0.3, 0.3  R = Infinity, 2.5  friction = 0.3 /\n"
        "&surface n = 64  L = 1  L_lambda_l = 2  L_lambda_s = 8  sigma = 2e-3 /\n"
        "&solver model = 'elements' /");
    FrictionHandle friction;
    OK(rsc_friction_create_from_case(&friction, made.contact, made.c));
    double N = 0, Qx = 0, Qy = 0, full = 0, most = 0, work = 0, k[4] = {};
    OK(rsc_friction_update(friction, 0, 5, 7, &N, &Qx, &Qy, nullptr));
    OK(rsc_friction_full_slip(friction, &full, &most));
    CHECK(N > 0 && Qx == 0 && Qy == 0);
    CHECK_RELATIVE(most, 0.3 * N, 1e-14);
    constexpr int steps = 50;
    for (int step = 1; step <= 2 * steps; ++step) {
        const double x = 0.7 * full * std::min(step, steps) / steps,
                     y = 0.5 * full * std::max(step - steps, 0) / steps;
        const double qx = Qx;
        const double qy = Qy;
        OK(rsc_friction_update(friction, 0, 5 + x, 7 + y, nullptr, &Qx, &Qy, nullptr));
        work += (step <= steps ? 0.35 * (qx + Qx) : 0.25 * (qy + Qy)) * full / steps;
        CHECK(std::hypot(Qx, Qy) < most);
        if (step != steps) continue;
        double once = 0, back = 0;
        OK(rsc_friction_first_loading(friction, 1, &x, &once, nullptr));
        CHECK_RELATIVE(once, Qx, 2e-3);
        OK(rsc_friction_slide(friction, once, &back));
        CHECK_RELATIVE(back, x, 1e-4);
    }
    const FrictionState s = state(friction);
    CHECK(s.Qx == Qx && s.Qy == Qy && s.lost > 0 && Qy > 0);
    CHECK_RELATIVE(s.N, N, 1e-6);
    CHECK_CLOSE(s.x - 5, 0.7 * full, 1e-14);
    CHECK_RELATIVE(s.tangential + s.lost, work, 5e-3);
    OK(rsc_friction_stiffness(friction, &k[0], &k[1], &k[2], &k[3]));
    CHECK(k[0] > 0 && k[3] > 0 && k[1] == k[2] && k[0] * k[3] > k[1] * k[1]);
    std::int64_t n = 0;
    (void)rsc_friction_spots(friction, 0, &n, nullptr, nullptr, nullptr, nullptr, nullptr);
    std::vector<double> fx(n), outer(n), inner(n);
    OK(rsc_friction_spots(friction, n, &n, nullptr, outer.data(), inner.data(), fx.data(),
                          nullptr));
    CHECK_RELATIVE(std::accumulate(fx.begin(), fx.end(), 0.0), Qx, 1e-12);
    for (const auto i : indices(fx)) CHECK(inner[i] <= outer[i]);
    OK(rsc_friction_update(friction, 0, 5, 7 + 9 * full, nullptr, &Qx, &Qy, nullptr));
    CHECK_RELATIVE(Qy, most, 2e-3);
}

TEST(same_as_core) {
    const rsc::Asperities list = random_asperities(300, 0.02, 0.01, 5e-4, 0.3, 7);
    ContactHandle contact;
    OK(rsc_contact_create(&contact, take(list), 94e3, 2.5, 0.5, 0.5,
                          case_of("&solver tolerance=1e-12 /")));
    rsc::SolverOptions tight{.tolerance = 1e-12};
    rsc::Path one = asperity_path(list, {94e3, 2.5, 0.5, 0.5}, tight),
              other = asperity_path(list, {94e3, 2.5, 0.5, 0.5}, tight);
    rsc::ContactCurve curve(one, other);
    rsc::FrictionHistory path({0.3, 0.8});
    FrictionHandle friction;
    OK(rsc_friction_create(&friction, contact, 0.3, 0.8));
    rsc_contact_destroy(&contact);  // may go
    const double steps[][3] = {{0.002, 1, 2},           {0.001, 1.0001, 2},
                               {0.001, 1.0006, 2.0002}, {0.0005, 1.0006, 2},
                               {0.001, 1.0003, 1.9999}, {0.0012, 1.0003, 1.9999},
                               {0.001, 1.01, 2}};
    for (const auto& s : steps) {
        double N = 0, qx = 0, qy = 0, lost = 0, k[4] = {};
        OK(rsc_friction_update(friction, s[0], s[1], s[2], &N, &qx, &qy, &lost));
        path.go_to(curve, -s[0], {s[1], s[2]});
        CHECK(N == path.force() && qx == path.tangential_force().x &&
              qy == path.tangential_force().y && lost == path.step_lost());
        const FrictionState is = state(friction);
        CHECK(is.Z == s[0] && is.x == s[1] && is.y == s[2] && is.N == N && is.Qx == qx &&
              is.Qy == qy && is.normal == path.normal_energy());
        CHECK(is.tangential == path.tangential_energy() && is.lost == path.work_lost() &&
              is.stick == -path.stick_approach());
        OK(rsc_friction_stiffness(friction, &k[0], &k[1], &k[2], &k[3]));
        const auto tangent = path.stiffness(curve);
        CHECK(k[0] == tangent.xx && k[1] == tangent.xy && k[2] == tangent.yx && k[3] == tangent.yy);
    }
    // All slips now: mu N, and no spot sticks.
    double slide = 0, most = 0, sum = 0;
    const auto [now, x, y, N, qx, qy, normal, tangential, lost, stuck] = state(friction);
    OK(rsc_friction_full_slip(friction, &slide, &most));
    CHECK_RELATIVE(most, 0.3 * N, 1e-15);
    const double slides[2] = {0.3 * slide, 2 * slide};
    double Q[2], stick[2], back = 0;
    OK(rsc_friction_first_loading(friction, 2, slides, Q, stick));
    CHECK(Q[0] > 0 && Q[0] < most);
    CHECK_RELATIVE(Q[1], most, 1e-14);
    // Spots that touch at a separation stick up to a slide of mu/m times how much deeper the sphere
    // is.
    CHECK_RELATIVE(stick[0] - now, slides[0] * 0.8 / 0.3, 1e-12);
    CHECK_RELATIVE(stick[1] - now, slide * 0.8 / 0.3, 1e-12);
    OK(rsc_friction_slide(friction, Q[0], &back));
    CHECK_RELATIVE(back, slides[0], 1e-7);
    std::int64_t n = 0;
    CHECK(rsc_friction_spots(friction, 0, &n, nullptr, nullptr, nullptr, nullptr, nullptr) == -2 &&
          n > 5);
    std::vector<double> fx(n), inner(n, 1.0);
    OK(rsc_friction_spots(friction, n, &n, nullptr, nullptr, inner.data(), fx.data(), nullptr));
    for (const auto i : indices(fx)) {
        sum += fx[i];
        CHECK(inner[i] == 0);
    }
    CHECK_RELATIVE(
        sum, qx,
        1e-9);  // the levels of the sum and of the spots are two solutions to the tolerance
    // A copy has the path, and goes its own way.
    FrictionHandle copy;
    OK(rsc_friction_copy(&copy, friction));
    OK(rsc_friction_commit(friction));
    double original = 0, copied = 0;
    OK(rsc_friction_update(friction, 0.001, 1.005, 2, nullptr, &original, nullptr, nullptr));
    OK(rsc_friction_update(copy, 0.001, 1.005, 2, nullptr, &copied, nullptr, nullptr));
    CHECK_RELATIVE(copied, original, 1e-9);
    OK(rsc_friction_rollback(friction));
    CHECK(state(friction).Qx == qx);
    // After a step that is not committed, a restored path has the force of the step, and a rollback
    // leads to the commit.
    const Folder folder;
    const std::string file = folder / "friction";
    FrictionHandle restored;
    OK(rsc_friction_update(friction, 0.001, 1.005, 2, nullptr, &original, nullptr, nullptr));
    OK(rsc_friction_save(friction, file.c_str()));
    OK(rsc_friction_restore(&restored, take(list), file.c_str()));
    CHECK(state(restored).Qx == original && original != qx);
    OK(rsc_friction_rollback(restored));
    CHECK(state(restored).Qx == qx);
}

}  // namespace test_api_friction
