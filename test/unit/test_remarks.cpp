// What is told at the end of a run and on the way, on both sides of each threshold; and the forecast of --check.
#include <cmath>
#include <ctime>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "case/read_case.hpp"
#include "check.hpp"
#include "contact/ranking.hpp"
#include "run/forecast.hpp"
#include "run/screen.hpp"
#include "temporary_folder.hpp"

using namespace rsc;

namespace {

// Each remark on both sides of its threshold, with levels made up for it.
void thresholds() {
    Job job;
    job.sigma = 2;
    job.settings.run.force_unit = "kN";
    const auto remarks = [&](const std::function<void(LevelValues&)>& change) {
        std::vector<LevelValues> levels(2);
        for (LevelValues& level : levels)
            level.contacts = 10, level.area = 1, level.nominal_area = 2, level.plastic_work = 0.25, level.separation = 1;
        change(levels[1]);
        std::ostringstream out;
        print_remarks(out, levels, job);
        CHECK(out.str().starts_with("method: direct (2 levels)\n") || levels[1].method != Method::direct ||
              job.settings.solver.model == Model::elements);
        const std::size_t line = out.str().find('\n');
        return job.settings.solver.model == Model::elements ? out.str() : out.str().substr(line + 1);
    };
    using V = LevelValues;
    const auto starts = [](const std::string& text, const std::string& with) {
        return text.starts_with(with) && text.find('\n') == text.size() - 1;
    };
    CHECK(remarks([](V&) {}).empty());
    CHECK(remarks([](V& v) { v.separation = -6; }).empty());
    CHECK(starts(remarks([](V& v) { v.separation = std::nextafter(-6.0, -7.0); }), "  1 of 2 levels: separation below -3 sigma"));
    CHECK(remarks([](V& v) { v.area = 2 * (1 + 1e-9); }).empty());
    CHECK(starts(remarks([](V& v) { v.area = 2 * (1 + 2e-9); }), "  1 of 2 levels: contact area above the nominal area"));
    CHECK(starts(remarks([](V& v) { v.edge_contacts = 1; }), "  1 of 2 levels: contacts within <d> of"));
    CHECK(starts(remarks([](V& v) { v.large_contacts = 1; }), "  1 of 2 levels: contacts with a > <d>/4"));
    CHECK(starts(remarks([](V& v) { v.beyond_law = 3; }), "  1 of 2 levels: contacts pressed beyond"));
    CHECK(remarks([](V& v) { v.beyond_law = 4; }).find("\n  1 of 2 levels: spots cover much of each other, more than 30 %") !=
          std::string::npos);
    CHECK(remarks([](V& v) { v.extreme_area_fraction = 0.01; }).empty());
    CHECK(starts(remarks([](V& v) { v.extreme_area_fraction = 0.0149; }),
                 "  pressures above E*/10 on 1 % of the contact area at Z0/sigma = 0.5: no metal"));
    CHECK(starts(remarks([](V& v) { v.crowded_cells = 1; }), "  1 map cells (over all levels) with an area fraction above pi/16"));
    CHECK(starts(remarks([](V& v) { v.status = LevelStatus::overlapping; }), "  1 of 2 levels: overlapping - pairs"));
    CHECK(starts(remarks([](V& v) { v.status = LevelStatus::not_unique; }), "  1 of 2 levels: not unique - spots"));
    CHECK(starts(remarks([](V& v) { v.status = LevelStatus::not_converged; }), "  1 of 2 levels: NOT CONVERGED - the residual"));
    CHECK(remarks([](V& v) { v.status = LevelStatus::out_of_validity; }).empty());  // its reasons are told one by one
    for (const auto& [why, words] : {std::pair(Fallback::no_interaction, "there is no interaction"),
                                     {Fallback::dgesv_not_converged, "dgesv did not converge"},
                                     {Fallback::dgesv_singular, "dgesv's matrix was singular"},
                                     {Fallback::not_unique, "dgesv's solution is not proved unique"}}) {
        std::vector<LevelValues> levels(3);
        levels[1].fallback = why;
        levels[2].method = Method::mesh;
        std::ostringstream out;
        print_remarks(out, levels, job);
        CHECK(out.str() == std::string("method: direct (1 levels), direct (1 levels: ") + words + "), mesh (1 levels)\n");
    }
    job.settings.solver.model = Model::elements;  // of which the asperities' range says nothing
    CHECK(remarks([](V& v) { v.separation = -7, v.area = 3, v.large_contacts = 1, v.crowded_cells = 1; }).empty());
    CHECK(starts(remarks([](V& v) { v.edge_contacts = 2; }), "  1 of 2 levels: contacts within <d> of"));
    job.settings.solver.model = Model::asperities;
    job.settings.solids.hardness = 100;
    const std::string nothing = "  nothing yields: pressures stay below the hardness.\n";
    CHECK(remarks([](V&) {}) == nothing);
    CHECK(remarks([](V& v) { v.extreme_area_fraction = 0.5; }) == nothing);
    CHECK(remarks([](V& v) { v.plastic_contacts = 1, v.plastic_work = 0.5, v.contacts = 7; }) ==
          "  at Z0/sigma = 0.5, 1 of 7 contacts yield; 0.5 kN mm of work are lost. Levels depend on those before them.\n");
    job.settings.run.realizations = 2;
    CHECK(remarks([](V& v) { v.plastic_contacts = 1; }) ==
          "  at Z0/sigma = 0.5, 1 of 10 contacts yield. Levels depend on those before them.\n");

    CHECK(std::string(slope_remark(0.5)).empty() && std::string(slope_remark(std::nextafter(0.5, 1.0))).starts_with(" - above 0.5 "));
    CHECK(std::string(slope_remark(2)).starts_with(" - above 0.5 ") &&
          std::string(slope_remark(std::nextafter(2.0, 3.0))).starts_with(" - above 2 "));
    CHECK(duration(0.0124) == "12 ms" && duration(0.9994) == "999 ms" && duration(1) == "1.0 s" && duration(99.94) == "99.9 s");
    CHECK(duration(100) == "1 min 40 s" && duration(5399.9) == "89 min 59 s" && duration(5400) == "1 h 30 min" &&
          duration(90061) == "25 h 01 min");
    CHECK(duration(123.9) == "2 min 03 s");
}

// The line of progress on something that is no terminal, and on one.
void progress() {
    std::ostringstream out;
    {
        ProgressLine line(&out, true, "levels", 2);
        line.show(3, 8);  // too soon
        CHECK(out.str().empty());
    }
    CHECK(out.str().empty());
    ProgressLine silent(nullptr, true, "levels");
    silent.show(1, 2);
    const auto wait = [](ProgressLine& line, double done, double total, const std::ostringstream& to) {
        for (int k = 0; k < 400 && to.str().empty(); ++k) {
            timespec pause{0, 1000000};
            nanosleep(&pause, nullptr);
            line.show(done, total);
        }
    };
    ProgressLine line(&out, true, "levels", 2);
    wait(line, 5, 8, out);
    CHECK(std::regex_match(
        out.str(),
        std::regex(
            "\r\\[##################\\.\\.\\.\\.\\.\\.\\.\\.\\.\\.\\.\\.\\] 5/8 levels, [0-9.]+ a second, [0-9.]+ m?s left\x1b\\[K")));
    out.str("");
    line.wipe();
    CHECK(out.str() == "\r\x1b[K");
    out.str("");
    line.wipe();  // once
    CHECK(out.str().empty());
    ProgressLine nothing(&out, true, "realizations", 5);
    wait(nothing, 5, 10, out);
    CHECK(out.str() == "\r[###############...............] 5/10 realizations, \x1b[K");
}

// --check's forecast. A list of asperities takes no time to make: the time is that of its levels, by the counts of asperities above the
// sphere and the speeds that forecast.cpp gives (0.1 ms a level, 3 us a candidate, 6e9 pairs a second); a synthetic surface's candidates
// are the area under the sphere of a Gaussian surface over that of a summit.
void forecast(const Folder& folder) {
    std::ofstream list(folder / "many.txt");
    for (int k = 0; k < 300; ++k) list << 0.05 * (k % 20) << ' ' << 0.07 * (k / 20) << ' ' << 0.01 * std::sin(7.3 * k) << " 0.05\n";
    list.close();
    const auto job_of = [](const std::string& text) { return prepare(read_case_text(text, "case.nml").settings); };
    const std::string text = "&surface source='asperities' L=1.5 sigma=0.01 file='" + folder / "many.txt" + "' / &indentation ";
    const Job job = job_of(text + "levels=0.5,0,-0.5 / &solver method='direct' /");
    double seconds = 0;
    const Asperities& a = job.given->asperities;
    for (const double Z0 : {0.005, 0.0, -0.005}) {
        double count = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double rho2 = std::pow(a.x[i] - 0.75, 2) + std::pow(a.y[i] - 0.75, 2);
            count += a.z[i] - (2.5 - std::sqrt(2.5 * 2.5 - rho2)) > Z0;
        }
        CHECK(count > 0 && expected_candidates(job, Z0) == count);
        seconds += 1e-4 + 3e-6 * count + 40 * std::pow(0.4 * count, 2) / 6e9;
    }
    CHECK_RELATIVE(expected_seconds(job, 1), seconds, 1e-12);
    CHECK_RELATIVE(expected_seconds(job, 8), seconds, 1e-12);  // one realization has no use for more
    Job many = job_of(text + "levels=0.5,0,-0.5 / &solver method='direct' /");
    many.settings.run.realizations = 7;
    CHECK_RELATIVE(expected_seconds(many, 3), 3 * seconds, 1e-12);
    CHECK_RELATIVE(expected_seconds(many, 1), 7 * seconds, 1e-12);
    // The paper's method takes ten factorisations of all candidates, 2/3 n^3 operations at 1e9 a second.
    const Job dgesv = job_of(text + "levels=-0.5 / &solver method='dgesv' /");
    const double n = expected_candidates(dgesv, -0.005);
    CHECK_RELATIVE(expected_seconds(dgesv, 1), 1e-4 + 3e-6 * n + 10 * n * n * n / 1.5e9, 1e-12);
    // A force takes six separations; of a list near zero.
    const double none = expected_candidates(job, 0);
    CHECK_RELATIVE(expected_seconds(job_of(text + "control='force' levels=1,2 / &solver method='direct' /"), 1),
                   2 * 6 * (1e-4 + 3e-6 * none + 40 * std::pow(0.4 * none, 2) / 6e9), 1e-12);
    // A synthetic surface: as many candidates as there are, within their scatter; two flats have the whole of it.
    for (const std::string more : {"", "&solids R=Infinity,Infinity / &indentation boundary='periodic' /"}) {
        const std::string synthetic = "&surface n=512 L_lambda_l=8 L_lambda_s=128 sigma=0.004 L=1.3 / " + more;
        const Job rough = job_of(synthetic);
        double found = 0, expected = 0;
        for (int k = 1; k <= 4; ++k) {
            const Ground ground = make_ground(rough.settings, k, 1);
            for (const double Z0 : {0.004, 0.0}) {
                const auto& s = ground.asperities;
                for (std::size_t i = 0; i < s.size(); ++i) found += height_under_sphere(rough.indenter, s.x[i], s.y[i], s.z[i]) > Z0;
                expected += expected_candidates(rough, Z0);
            }
        }
        // Summits are higher than the surface: more of them are candidates than area is above the sphere.
        CHECK(found / expected > 1 && found / expected < 3);
    }
}

}  // namespace

int main() {
    const Folder folder;
    thresholds();
    progress();
    forecast(folder);
    return check::summary();
}
