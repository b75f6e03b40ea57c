// The remarks at the end of a run, on both sides of each threshold; and the number of candidates
// that --check foresees.
#include "run/memory.hpp"
#include "run/screen.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"
#include "trust/doubts.hpp"

namespace test_remarks {

using namespace rsc;

// Each remark is there beyond its threshold and not at it, with levels made up for it.
TEST(thresholds) {
    Job job;
    job.settings.solver.model = ModelKind::asperities;
    job.sigma = 2;
    using V = LevelValues;
    const auto remarks = [&](const std::function<void(V&)>& change) {
        std::vector<V> levels(2);
        for (V& level : levels) {
            level.contacts = 10;
            level.area = 1;
            level.nominal_area = 2;
            level.plastic_work = 0.25;
            level.separation = 1;
            level.stiffness = -1;
        }
        change(levels[1]);
        std::ostringstream out;
        print_remarks(out, levels, job);
        return out.str();
    };
    const auto said = [&](const char* word, const std::function<void(V&)>& change) {
        return remarks([](V&) {}).find(word) == std::string::npos &&
               remarks(change).find(word) != std::string::npos;
    };
    for (const auto k : indices(kCauseNames)) {
        const Cause cause{int(k)};
        CHECK(said(words_of_doubts(bit(cause)).c_str(), [&](V& v) { v.doubts = bit(cause); }));
    }
    // Three times a yield stress of E/100, of bodies stiffer than 10 GPa that have no hardness.
    auto& [E, rigid] = job.settings.solids.E;
    const auto pressed = [&](double p) {
        return said("elastic pressures", [&](V& v) { v.pressure_max = p * E; });
    };
    for (const double stiff : {210e3, 10.1e3}) {
        E = stiff;
        CHECK(!pressed(0.0299) && pressed(0.0301));
    }
    E = 9.9e3;
    CHECK(!pressed(0.5));
    E = 210e3;
    job.settings.solids.hardness = 3e3;
    CHECK(!pressed(0.5));
    job.settings.solids.hardness = kInfinity;
    CHECK(said("are missing", [](V& v) { v.stiffness = kNotComputed; }));
    CHECK(said("overlapping", [](V& v) { v.status = LevelStatus::overlapping; }));
    CHECK(said("not unique", [](V& v) { v.status = LevelStatus::not_unique; }));
    CHECK(said("NOT CONVERGED", [](V& v) { v.converged = false; }));
    // A map that no level reaches: levels without force alone, and the separation where its first
    // point touches.
    job.points_touch = -3.5;
    CHECK(remarks([](V&) {}).find("-3.5") != std::string::npos);
    CHECK(remarks([](V& v) { v.force = 1; }).find("-3.5") == std::string::npos);
    // A list of asperities has no heights that elements could solve.
    const auto all_wrong = [](V& v) {
        v.doubts = ~0;
        v.stiffness = kNotComputed;
    };
    CHECK(said("'elements'", all_wrong));
    job.settings.surface.source = Source::asperities;
    CHECK(!said("'elements'", all_wrong));
    job.settings.surface.source = Source::synthetic;
    job.settings.solids.hardness = 100;
    CHECK(said("1 of 7 contacts yield", [](V& v) {
        v.plastic_contacts = 1;
        v.plastic_work = 0.5;
        v.contacts = 7;
    }));
    CHECK(std::string(slope_remark(0.5)).empty() &&
          !std::string(slope_remark(std::nextafter(0.5, 1.0))).empty());
}

// The modulus of diamond, 1.2e12 Pa, in several units is plausible; ten times as much is not, nor
// are gigapascals in place of pascals.
TEST(moduli) {
    const auto warned = [](const std::string& units, double E) {
        std::ostringstream out;
        Case c = settings_of("&run " + units + " / &surface n=64 L_lambda_l=2 L_lambda_s=8 /");
        c.solids.E[0] = E;
        print_heading(out, prepare(c));
        return out.str().find("warning: solids%E") != std::string::npos;
    };
    const std::string um = "length_unit='um' force_unit='mN'", m = "length_unit='m'",
                      none = "length_unit='1' force_unit='1'";
    CHECK(!warned("", 1.2e6) && warned("", 1.2e7));
    CHECK(!warned(um, 1.2e3) && warned(um, 1.2e4));
    CHECK(!warned(m, 1.2e12) && warned(m, 1.2e13) && warned(m, 70.0));
    CHECK(!warned(none, 1.0) && !warned(none, 1e20));
}

// Surfaces beyond 0.02 in skewness or 0.05 in kurtosis are counted; for Gaussian heights nothing is
// said.
TEST(heights_missed) {
    Job job;
    job.spectrum.emplace();
    const auto remark = [&](double skewness, double kurtosis) {
        std::vector<SurfaceStatistics> surfaces(2);
        for (auto& s : surfaces) {
            s.skewness = -1;
            s.kurtosis = 4;
        }
        surfaces[1].skewness = skewness;
        surfaces[1].kurtosis = kurtosis;
        std::ostringstream out;
        tell_unreached_heights(out, surfaces, job);
        return out.str();
    };
    CHECK(remark(-0.5, 4).empty());
    job.spectrum->shape = {-1, 4};
    CHECK(remark(-0.981, 4.049).empty());
    CHECK(remark(-0.979, 4).find("1 of 2") != std::string::npos &&
          remark(-1, 4.051).find("1 of 2") != std::string::npos);
}

// Pastewka and Robbins' criterion for two flats: h' z0/(2 l) (h'^2/(h'' z0))^(2/3) < pi
// (3/16)^(2/3), l = w/E*.
TEST(sticks) {
    Job job;
    job.indenter = {100.0, 1.0};
    job.theory.emplace();
    job.theory->m2 = 0.02;
    job.theory->m4 = 30;
    job.settings.solids.adhesion_range = 1e-3;
    const double slope = 0.2, curvature = std::sqrt(80.0);  // rms of the gradient; of the Laplacian
    const double needed = 100.0 * slope * 1e-3 / (2 * pi) *
                          std::pow(16.0 / 3 * slope * slope / (curvature * 1e-3), 2.0 / 3);
    for (const double share : {0.98, 1.02}) {
        job.settings.solids.adhesion = share * needed;
        std::ostringstream out;
        print_remarks(out, std::vector<LevelValues>(1), job);
        CHECK((out.str().find("would not stick") != std::string::npos) == (share < 1) &&
              out.str().find("Pastewka") != std::string::npos);
    }
}

// A list's candidates are counted; a synthetic surface's are the area under the sphere of a
// Gaussian surface over that of a summit: the share of it above Z0 between flats, 2 pi R times its
// mean excess over Z0 under a sphere, at most all.
TEST(memory) {
    const Folder folder;
    std::ofstream list(folder / "many.txt");
    for (const int k : indices(300))
        list << 0.05 * (k % 20) << ' ' << 0.07 * (k / 20) << ' ' << 0.01 * std::sin(7.3 * k)
             << " 0.05\n";
    list.close();
    const auto job_of = [](const std::string& text) { return prepare(settings_of(text)); };
    const std::string text = "&surface source='asperities' L=1.5 sigma=0.01 file='" +
                             folder / "many.txt" + "' / &indentation ";
    const Job job = job_of(text + "levels=0.5,0,-0.5 / &solver method='direct' /");
    CHECK(job.given->statistics.summits == 300 && job.domain.Lx == 1.5 && !job.domain.guessed);
    const Asperities& a = job.given->asperities;
    for (const double Z0 : {0.005, 0.0, -0.005}) {
        double count = 0;
        for (const auto i : indices(a)) {
            const double rho2 = std::pow(a.x[i] - 0.75, 2) + std::pow(a.y[i] - 0.75, 2);
            count += a.z[i] - (2.5 - std::sqrt(2.5 * 2.5 - rho2)) > Z0;
        }
        CHECK(count > 0 && expected_candidates(job, Z0) == count);
    }
    // Memory: of asperities only values that are kept for layers, in each of the parallel
    // realizations, are estimated; elements that yield store all heights, in each of the parallel
    // realizations, and more at depth.
    CHECK(expected_megabytes(job, 1) == 0);
    const auto elements = [&](int realizations, double level, double workers) {
        return expected_megabytes(
            job_of(std::string("&run realizations=") + std::to_string(realizations) +
                   " / &solids hardness=1e9 / &surface n=1024 L_lambda_s=128 / &solver "
                   "model='elements' / &indentation levels=" +
                   std::to_string(level) + " /"),
            workers);
    };
    const Job coated = job_of(
        "&run realizations=4 / &solids layer_thickness=0.1 layer_E=1 layer_nu=0.3 / &indentation "
        "levels=2 /");
    const double kept = expected_megabytes(coated, 2) - expected_megabytes(coated, 1);
    CHECK(kept > 0 && expected_megabytes(coated, 1) > kept);
    CHECK_RELATIVE(expected_megabytes(coated, 3) - expected_megabytes(coated, 2), kept, 1e-9);
    CHECK(elements(1, 2, 2) == elements(1, 2, 1) && elements(1, -2, 1) > elements(1, 2, 1));
    CHECK_RELATIVE(elements(4, 2, 3) - elements(4, 2, 2), elements(4, 2, 2) - elements(4, 2, 1),
                   1e-9);
    CHECK(elements(4, 2, 2) - elements(4, 2, 1) > 8e-6 * 1024 * 1024);
    // Stresses below two flats need the pressures and six components at all points.
    const auto flats_with = [&](const std::string& output) {
        return expected_megabytes(
            job_of("&solids R=Infinity,Infinity / &surface L_lambda_s=128 / &solver "
                   "model='elements' / &indentation boundary='periodic' levels=2 / &output " +
                   output + " /"),
            1);
    };
    CHECK_RELATIVE(flats_with("stress_depths=0.1") - flats_with(""), 7 * 8e-6 * 1024 * 1024, 1e-9);
    for (const bool flats : {false, true}) {
        const Job rough =
            job_of(std::string("&surface n=512 L_lambda_l=8 L_lambda_s=128 sigma=0.004 L=1.3 / ") +
                   (flats ? "&solids R=Infinity,Infinity / &indentation boundary='periodic' /"
                          : "&solids R=2,2 /"));
        const double d2 = std::pow(rough.domain.mean_spacing, 2);
        for (const double t : {2.0, 0.5, -1.0}) {
            const double above = 0.5 * std::erfc(t / std::sqrt(2.0)),
                         density = std::exp(-0.5 * t * t) / std::sqrt(2 * pi);
            const double everywhere = 1.69 * above,
                         under = 2 * pi * 1.0 * 0.004 * (density - t * above);
            CHECK_RELATIVE(expected_candidates(rough, 0.004 * t),
                           (flats ? everywhere : std::min(everywhere, under)) / d2, 1e-2);
        }
    }
}

}  // namespace test_remarks
