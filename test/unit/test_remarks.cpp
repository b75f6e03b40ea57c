// What is told at the end of a run and on the way, on both sides of each threshold; and the forecast of --check.
#include <algorithm>
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
#include "run/campaign_screen.hpp"
#include "run/campaign_study.hpp"
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
    CHECK(job.given->statistics.summits == 300 && job.site.domain.Lx == 1.5 && !job.site.guessed);
    std::ofstream(folder / "lone.txt") << "0.2 0.3 0.01 0.5\n";
    const Job lone = job_of("&surface source='asperities' sigma=0.01 file='" + folder / "lone.txt" +
                            "' / &indentation start=4 stop=1.1 steps=7 unit='length' /");
    CHECK(lone.site.guessed && lone.site.domain.Lx == 1 && lone.site.domain.Ly == 1 && lone.site.domain.x0 == -0.3 &&
          lone.site.domain.y0 == -0.2);
    CHECK(lone.levels.size() == 7 && lone.levels.front() == 4 && lone.levels.back() == 1.1);  // both ends exactly
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
    // The members of a study, side by side on so many threads.
    const ReadCase study =
        read_case_text(text + "levels=0.5,0,-0.5 / &solver method='direct' / &study solids%nu(1)=0.1,0.2,0.3 /", "case.nml");
    RunOptions options;
    CHECK_RELATIVE(check_members(study, {}, options, 1), 3 * seconds, 1e-12);
    CHECK_RELATIVE(check_members(study, {}, options, 2), 1.5 * seconds, 1e-12);
    CHECK_RELATIVE(check_members(study, {}, options, 8), seconds, 1e-12);
    CHECK_RELATIVE(check_members(study, 2, options, 8), seconds, 1e-12);
    // A Gaussian surface: the share of it above Z0 between flats, 2 pi R times its mean excess over Z0 under a sphere, at most all.
    for (const bool flats : {false, true}) {
        const Job rough = job_of(std::string("&surface n=512 L_lambda_l=8 L_lambda_s=128 sigma=0.004 L=1.3 / ") +
                                 (flats ? "&solids R=Infinity,Infinity / &indentation boundary='periodic' /" : "&solids R=2,2 /"));
        const double d2 = std::pow(rough.site.mean_spacing, 2);
        for (const double t : {2.0, 0.5, -1.0}) {
            const double above = 0.5 * std::erfc(t / std::sqrt(2.0)), density = std::exp(-0.5 * t * t) / std::sqrt(2 * 3.14159265358979);
            const double everywhere = 1.69 * above, under = 2 * 3.14159265358979 * 1.0 * 0.004 * (density - t * above);
            CHECK_RELATIVE(expected_candidates(rough, 0.004 * t), (flats ? everywhere : std::min(everywhere, under)) / d2, 1e-3);
        }
    }
    // Elements on a map: a microsecond a point and level between flats, five a point under the sphere.
    std::ofstream map(folder / "map.txt");
    for (int j = 0; j < 30; ++j, map << '\n')
        for (int i = 0; i < 40; ++i) map << std::sin(1.9 * i + 0.3 * j * j) << ' ';
    map.close();
    const std::string elements = "&surface source='heights' L=4 sigma=1 file='" + folder / "map.txt" + "' / &solver model='elements' / ";
    CHECK_RELATIVE(expected_seconds(job_of(elements + "&solids R=Infinity,Infinity / &indentation boundary='periodic' levels=1,2,3 /"), 1),
                   3 * 1200e-6, 1e-12);
    const double share = 0.5 * std::erfc(1 / std::sqrt(2.0));
    CHECK_RELATIVE(expected_seconds(job_of(elements + "&solids R=Infinity,Infinity / &indentation levels=1 /"), 1), 5e-6 * 1200 * share,
                   1e-3);
}

// A line of a campaign: means, scatter, time, and the rate of what this run has done.
void batch() {
    const Job job = prepare(read_case_text("&surface n=64 L_lambda_l=2 L_lambda_s=16 / &indentation levels=3,2 /", "case.nml").settings);
    Accumulators sums(job.observe, 2);
    sums.realization = {1, 2, 3};
    sums.rows.resize(6);
    for (std::size_t k = 0; k < 6; ++k) sums.rows[k].force = static_cast<double>(k * k), sums.rows[k].area = 0.5 * static_cast<double>(k);
    std::ostringstream out;
    print_batch(out, job, sums, 12.5, 2);
    // Of the last levels: forces 1, 9, 25, areas 0.5, 1.5, 2.5.
    CHECK(out.str() == "           3      11.666667       12.2            1.5          1       12.5 s       0.16\n");
}

}  // namespace

int main() {
    const Folder folder;
    thresholds();
    progress();
    forecast(folder);
    batch();
    return check::summary();
}
