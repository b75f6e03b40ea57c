// The errors that elements tell on ridges, whose crests may lie between the points.
#include "support/height_maps.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"
#include "trust/judge.hpp"

namespace test_ridges {

using namespace rsc;

// Along a lay, just after first touch: four surfaces against the same on a grid four times as fine.
TEST(lay) {
    Case c;
    c.surface.L_lambda_l = 2;
    c.surface.L_lambda_s = 6;
    c.surface.aspect = 30;
    c.surface.sigma = 1e-3;
    c.solids.R[1] = 10;
    c.solver.model = ModelKind::elements;
    for (const int k : indices(20)) c.indentation.levels.push_back(2.9 - 0.1 * k);
    int levels = 0, force = 0, area = 0;
    for (const bool campaign : {false, true}) {
        c.surface.direction = campaign ? 90 : 0;
        c.run.realizations = campaign ? 2 : 1;
        for (const int seed : {1, 2, 3, 4}) {
            c.run.seed = seed;
            const auto pressed = [&](double points) {
                c.elements.points_per_wave = points;
                return realize(prepare(c), 1, 1).levels;
            };
            const std::vector<Level> coarse = pressed(5), fine = pressed(20);
            for (const auto k : indices(coarse)) {
                if (!(coarse[k].force > 0)) continue;
                const double dN = std::abs(coarse[k].force - fine[k].force),
                             dA = std::abs(coarse[k].area - fine[k].area);
                ++levels;
                force += dN <= coarse[k].force_error_expected * coarse[k].force;
                area += dA <= coarse[k].area_error_expected * coarse[k].area;
                CHECK(coarse[k].status == LevelStatus::out_of_validity ||
                      dN < 0.01 * fine[k].force);
            }
        }
    }
    CHECK(levels > 60 && 10 * force >= 9 * levels && 10 * area >= 9 * levels);
}

// Straight ridges on few points, whose crests lie on rows of points, between them and in the middle
// of two: a wave of one direction between flats, against Westergaard (Johnson 1985, section 13.2):
// with s = p/p*, p* = pi E* Delta/lambda, Z0 = Delta (1 - s + s ln s) and A/A0 = (2/pi) asin sqrt
// s.
// The errors that are told hold on nine of ten levels, and no level that is not told is off.
TEST(ridges) {
    constexpr double Delta = 1e-3;
    constexpr int waves = 4;
    const Folder folder;
    int levels = 0, touching = 0, force = 0, area = 0, untouched = 0;
    for (const int points : {4, 6, 8, 12})
        for (const double beside : {0.0, 0.2, 0.5}) {
            const int n = points * waves;
            Case c = case_of_map(folder.write("ridges.txt", rows_of_text(n, n, [&](int, int j) {
                                                  return Delta *
                                                         std::cos(2 * pi * (j - beside) / points);
                                              })));
            c.surface.L = 1.0;
            c.solids.R[0] = c.solids.R[1] = kInfinity;
            c.indentation.boundary = Boundary::periodic;
            c.indentation.unit = LevelUnit::length;
            const double share[] = {1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2};
            for (const double s : share)
                c.indentation.levels.push_back(Delta * (1 - s + s * std::log(s)));
            const Job job = prepare(c);
            const std::vector<Level> found = realize(job, 1, 1).levels;
            for (const auto k : indices(found)) {
                const Level& level = found[k];
                const double N = share[k] * pi * job.indenter.E_star * Delta * waves,
                             A = 2 / pi * std::asin(std::sqrt(share[k]));
                ++levels;
                touching += level.force > 0;
                force += std::abs(N - level.force) <= level.force_error_expected * level.force;
                area += std::abs(A - level.area) <= level.area_error_expected * level.area;
                if (level.force > 0)
                    CHECK(level.status == LevelStatus::out_of_validity ||
                          std::abs(level.force / N - 1) < 0.01);
                else
                    CHECK(++untouched > 0 && level.doubts == bit(Cause::missed_contact));
            }
        }
    CHECK(levels == 84 && untouched > 10 && 10 * force >= 9 * touching &&
          10 * area >= 9 * touching);
}

}  // namespace test_ridges
