// A whole case run through the library: every value of its result file that the library has a call
// for is what that call gives, to the last bit.
#include "check.hpp"
#include "support/library.hpp"
#include "support/map_files.hpp"
#include "support/result_reader.hpp"
#include "support/temporary_folder.hpp"

namespace test_api_run {

using Values = std::vector<double>;

void same(const char* what, const Values& by_file, const Values& by_call) {
    bool equal = by_file.size() == by_call.size();
    for (std::size_t k = 0; equal && k < by_file.size(); ++k) equal = by_file[k] == by_call[k];
    if (!equal) std::printf("%s differs\n", what);
    CHECK(equal);
}

struct Run {
    const char* name;
    std::string namelist;
    bool force = false;  // levels are forces
};

std::set<std::string> compared;  // quantities of levels, by name

// Runs the case into a file.
std::int32_t run_to(const std::string& path, rsc_case* c, std::int64_t* failed) {
    OK(rsc_case_set(c, "output%file", ("'" + path + "'").c_str()));
    return rsc_case_run(c, failed);
}

// What a level's calls give against row s of the file. Quantities by name: whatever the file has of
// them.
void level_by_calls(const Reader& file, rsc_contact* contact, std::size_t s,
                    const std::vector<std::string>& names) {
    double Z = 0, N = 0, A = 0, S = 0, W = 0, x = 0, y = 0, residual = 0, value = 0;
    std::int32_t status = -1;
    std::int64_t n = 0, candidates = 0, iterations = 0, pairs = 0, large = 0, beyond = 0, edge = 0;
    for (const std::string& name : names) {
        const bool vector = name.ends_with("_x") || name.ends_with("_y");
        const std::string variable = vector ? name.substr(0, name.size() - 2) : name;
        if (!file.has(variable)) continue;
        const Values of_file = file.values(variable);
        const double wanted = vector ? of_file[2 * s + (name.ends_with("_y") ? 1 : 0)] : of_file[s];
        if (wanted > 1e36) continue;  // absent, as the resistance without contact
        // A variable names that of its error.
        if (const std::string error = file.text(variable, "ancillary_variables"); !error.empty()) {
            const double stated = file.values(error)[s];
            CHECK(rsc_contact_error(contact, name.c_str(), &value) ==
                  (stated < 1e36 ? RSC_SUCCESS : RSC_NO_RESULT));
            CHECK(!(stated < 1e36) || value == stated);
            compared.insert(error);
        } else {
            CHECK(rsc_contact_error(contact, name.c_str(), &value) == RSC_NO_RESULT);
        }
        OK(rsc_contact_value(contact, name.c_str(), &value));
        if (value != wanted)
            std::printf("%s: %.17g in the file, %.17g by name\n", name.c_str(), wanted, value);
        CHECK(value == wanted);
        if (value != 0 || name == "fallback" || name == "edge_contacts" ||
            name == "extreme_area_fraction")
            compared.insert(name);
    }
    OK(rsc_contact_answer(contact, &Z, &N, &S, &A, &W, &x, &y, &status, &n, &pairs, &large, &beyond,
                          &edge));
    const auto of = [&](const char* name) { return file.has(name) ? file.values(name)[s] : 0; };
    CHECK(Z == of("separation") && N == of("force") && A == of("contact_area"));
    CHECK(!file.has("stiffness") || (S == of("stiffness") && W == of("energy")));
    CHECK(double(n) == of("contacts") && double(pairs) == of("overlapping_pairs"));
    CHECK(!file.has("large_contacts") ||
          (double(large) == of("large_contacts") && double(edge) == of("edge_contacts") &&
           double(beyond) == of("beyond_law")));
    OK(rsc_contact_level(contact, &status, &candidates, &iterations, &pairs, &residual));
    CHECK(status == of("status") && double(pairs) == of("overlapping_pairs") &&
          residual == of("residual"));
    CHECK(double(candidates) == of("candidates") && double(iterations) == of("iterations"));
    // Spots: the file's contacts of this level, counted from 1 there.
    const auto first = std::size_t(of("contact_start")) - 1;
    CHECK(double(n) == of("contact_count"));
    std::vector<std::int32_t> which(n);
    Values force(n), radius(n), penetration(n);
    OK(rsc_contact_spots(contact, n, which.data(), force.data(), radius.data(),
                         penetration.data()));
    const auto part = [&](const char* name) {
        const Values all = file.values(name);
        return Values(all.begin() + static_cast<std::ptrdiff_t>(first),
                      all.begin() + static_cast<std::ptrdiff_t>(first + n));
    };
    same("contact_force", part("contact_force"), force);
    same("contact_radius", part("contact_radius"), radius);
    if (!file.has("contact_asperity")) return;
    Values from_1(which.begin(), which.end());
    for (double& k : from_1) k += 1;
    same("contact_asperity", part("contact_asperity"), from_1);
}

void every_value(const Folder& folder, const Run& run) {
    const int before = check::failures;
    AsperitiesHandle a;
    ContactHandle k;
    CaseHandle c = case_of(run.namelist.c_str());
    const std::string path = folder / "run.nc";
    std::int64_t failed = -1;
    OK(run_to(path, c, &failed));
    CHECK(failed == 0);
    const Reader file(path);
    OK(rsc_asperities_make(&a, c, 1));
    OK(rsc_contact_create_from_case(&k, a, c));
    double x = 0, y = 0, value = 0;
    OK(rsc_contact_tip(k, &x, &y));
    if (file.has("tip_x"))
        CHECK(x == file.values("tip_x")[0] && y == file.values("tip_y")[0] &&
              (x != y || file.has("pressure")));

    const Values separation = file.values("separation"), force = file.values("force");
    if (file.has("pull_off_force")) {
        const Values least = file.values("least_force");
        CHECK(least.back() < 0 &&
              file.values("pull_off_force") == Values{*std::ranges::min_element(least)});
    }
    std::vector<std::string> names;
    for (const auto s : indices(separation)) {
        OK(run.force ? rsc_contact_press(k, std::round(force[s] * 1e4) / 1e4, nullptr)
                     : rsc_contact_indent(k, separation[s], nullptr));
        if (names.empty()) {  // all that can be asked for
            CHECK(rsc_contact_value(k, "?", &value) == -2);
            std::string list = message();
            list = list.substr(list.find("one of ") + 7);
            for (std::size_t at = 0; at != std::string::npos;) {
                const std::size_t comma = list.find(", ", at);
                names.push_back(list.substr(at, comma - at));
                at = comma == std::string::npos ? comma : comma + 2;
            }
            CHECK(names.size() > 25);
        }
        level_by_calls(file, k, s, names);
    }
    CHECK(force.back() > 0 && separation.size() > 1);
    if (check::failures > before) std::printf("in the case '%s'\n", run.name);
}

// A case gives the same levels by the program and by calls, whatever 'auto' chooses. The program
// does not read points that elements cannot touch, so that its iterates differ by rounding.
void same_choice(const Folder& folder, const std::string& text) {
    const int before = check::failures;
    CaseHandle c = case_of(text);
    OK(run_to(folder / "auto.nc", c, nullptr));
    const Reader file(folder / "auto.nc");
    AsperitiesHandle a;
    OK(rsc_asperities_make(&a, c, 1));
    const ContactHandle contact = contact_on(a, c);
    std::int64_t summits = -1;
    OK(rsc_asperities_count(a, &summits));
    CHECK((summits > 0) == file.has("asperity_x"));
    const Values separation = file.values("separation");
    for (const auto s : indices(separation)) {
        OK(rsc_contact_indent(contact, separation[s], nullptr));
        for (const char* name : {"force", "contact_area", "stiffness", "energy", "status", "doubts",
                                 "contacts", "force_error_expected", "area_error_expected"}) {
            const double by_file = file.has(name) ? file.values(name)[s] : NC_FILL_DOUBLE;
            if (by_file < 1e36)
                CHECK_CLOSE(value(contact, name), by_file, 1e-7 * std::abs(by_file));
        }
    }
    CHECK(file.values("force").back() > 0);
    if (check::failures > before) std::printf("in the case '%s'\n", text.c_str());
}

TEST(api_run) {
    const Folder folder;
    // An oblong measured map, its steps different along x and y.
    map_files::Map map{24, 16, 2e-5, 3e-5, {}};  // in m: mm of the case are 1e3 of it
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx))
            map.z.push_back(((7 * i * i + 11 * j * j + 5 * i * j) % 61) * 1e-7);
    std::ofstream(folder / "map.gwy", std::ios::binary)
        << map_files::gwy_file(map_files::gwy_channel(0, "Topography", map));

    const std::string
        surface = "&surface n=128, L=1.5, L_lambda_l=4, L_lambda_s=16, sigma=0.02 / &run seed=7 / ",
        asperities = "&solver model='asperities' / ",
        output = "&output contacts='all', map_cells=9, radial_bins=7, pdf_bins=5 / ",
        solids = "&solids E=1e3, 3e3  nu=0.125, 0.375  R=3.0, 5.0";
    const Run runs[] = {
        {"off centre, with resistivity",
         surface + asperities + solids +
             "  resistivity=1e-5, 3e-5 / &asperities law='fourth_order' / &indentation levels=2.5, "
             "1, -2.9  centre=0.625, 0.875 / "
             "&output contacts='all', heights=.true. /"},
        {"by force",
         surface + asperities + solids +
             " / &asperities law='elliptic' / &indentation control='force', levels=0.5, 2, 8  "
             "centre=0.7, 0.8 / " +
             output,
         true},
        {"a measured map", "&surface source='heights', file='" + (folder / "map.gwy") +
                               "', detrend='mean' / " + solids +
                               " / &solver model='asperities' / &indentation unit='length', "
                               "levels=2e-3, 1e-3, 0  centre=0.2, 0.3 / "
                               "&output contacts='all', heights=.true. /"},
        {"no interaction, at the border",
         surface + solids +
             " / &solver interaction='none' / &indentation levels=1, 0  centre=0.125, 1.25 / " +
             output},
        {"adhesion", surface + asperities + solids +
                         "  adhesion=1e-3 / &indentation levels=1, 3, 0  centre=0.7, 0.8 / " +
                         output},
        {"yielding", surface + asperities + solids +
                         "  hardness=100.0 / &indentation levels=2, 0.5, 1  centre=0.7, 0.8 / " +
                         output},
        {"two flats", surface + asperities +
                          "&solids E=1e3, 3e3  nu=0.125, 0.375  R=Infinity, Infinity / "
                          "&indentation boundary='periodic', levels=2, 1 / " +
                          output},
        {"elements", surface + solids +
                         "  hardness=300.0 / &solver model='elements' / &indentation levels=2, 1  "
                         "centre=0.7, 0.8 / " +
                         output},
    };
    for (const Run& run : runs) every_value(folder, run);
    // The model, the law and the numbers of 'auto' are those of the program.
    struct Choice {
        std::string groups, of_surface = {}, of_indentation = {};
    };
    const std::string on_ball = "&solids R=Infinity, 3 ",
                      on_flats = "&solids R=Infinity, Infinity / ";
    for (const Choice& choice :
         {Choice{on_ball + "/"}, Choice{on_ball + "/ &asperities law='hertz' /"},
          Choice{on_ball + "/", "", "centre=0.4, 0.6"},
          Choice{on_ball + "/ &elements points_per_wave=5 /"},
          Choice{on_ball + "/", "aspect=3 direction=30"},
          Choice{on_ball + "/", "skewness=-1 kurtosis=4 plateau=T"},
          Choice{on_ball + "/ &solver method='direct' /"},
          Choice{on_ball + "/ &solver interaction='none' /"}, Choice{on_ball + "hardness=3e3 /"},
          Choice{on_ball + "adhesion=1e-4 /"}, Choice{on_ball + "friction=0.3 /"},
          Choice{on_ball + "E=1e3, 2e3 nu=0, 0.4 /"},
          Choice{on_ball + "layer_thickness=0.1 layer_E=1e5 layer_nu=0.3 /"},
          Choice{"&indenter shape='cone' slope=0.1 /"},
          Choice{"&indenter shape='punch' radius=0.2 /"},
          Choice{"&indenter shape='paraboloid' radii=2, 5 angle=20 /"},
          Choice{"&indenter shape='paraboloid' radii=2, Infinity /", "", "boundary='periodic_y'"},
          Choice{on_flats, "", "boundary='periodic'"},
          Choice{on_flats + "&asperities law='elliptic' /", "", "boundary='periodic'"}})
        same_choice(folder, "&surface L=1, L_lambda_l=2, L_lambda_s=8, sigma=2e-3, n=64, " +
                                choice.of_surface + " / &indentation levels=1.5, 0.5 " +
                                choice.of_indentation + " / &run seed=3 / " + choice.groups);
    same_choice(folder, "&surface source='heights', file='" + (folder / "map.gwy") +
                            "' / &solids R=Infinity, 0.1 / &indentation levels=1, 0 /");
    CHECK(compared.size() >= 30);

    // A count is in the file where it can be counted, also if it is 0: scripts ask for it by name.
    for (const auto& [key, count] :
         {std::pair{"adhesion=1e-6", "jumps"}, std::pair{"hardness=1e9", "plastic_contacts"}}) {
        CaseHandle away = case_of((surface + solids + " " + key +
                                   " / &indentation levels=5, 4 / &output contacts='none' /")
                                      .c_str());
        OK(run_to(folder / "away.nc", away, nullptr));
        CHECK((Reader(folder / "away.nc").values(count) == Values{0, 0}));
    }

    // Levels that do not converge are told, and the file is there all the same; a folder that
    // cannot be made leaves nothing.
    CaseHandle c = case_of(
        "&surface n=256, L_lambda_l=4, L_lambda_s=64 / &indentation steps=3 / &solver "
        "max_iterations=1 /");
    std::int64_t failed = -1;
    CHECK(run_to(folder / "unfinished.nc", c, &failed) == RSC_NOT_CONVERGED &&
          message().find("status = 4") != std::string::npos);
    std::int64_t with_4 = 0;
    for (const double status : Reader(folder / "unfinished.nc").values("status"))
        with_4 += status == 4;
    CHECK(failed > 0 && failed == with_4);
    // Flats pressed deeper than asperities bear: no state, and no numbers of one.
    const std::string flat =
        "&surface n=64 L_lambda_l=2 L_lambda_s=8 sigma=0.02 / &solids R=Infinity,Infinity / "
        "&solver model='asperities' / &asperities law='hertz' / "
        "&compare levels='none' / "
        "&indentation boundary='periodic' levels=1,-3 /";
    const Made deep(flat.c_str());
    for (const char* hardness : {"3e4", "6e4"}) {  // there the iteration goes on without bounds
        const CaseHandle hard = case_of(flat.c_str());
        OK(rsc_case_set(hard, "solids%hardness", hardness));
        OK(rsc_case_set(hard, "output%fields", "'pressure'"));
        CHECK(run_to(folder / "deep.nc", hard, &failed) == RSC_NOT_CONVERGED);
        CHECK(Reader(folder / "deep.nc").values("force")[1] == NC_FILL_DOUBLE &&
              !Reader(folder / "deep.nc").has("field_pressure"));
    }
    CHECK(run_to(folder / "deep.nc", deep.c, &failed) == RSC_NOT_CONVERGED && failed == 1);
    const Reader deep_file(folder / "deep.nc");
    const Values forces = deep_file.values("force");
    CHECK(deep_file.values("status")[1] == 4 && forces[0] > 0 && forces[0] < 1e6 &&
          forces[1] == NC_FILL_DOUBLE);
    const ContactHandle& flats = deep.contact;
    double force = 0, area = 0;
    std::int32_t level = 0;
    CHECK(rsc_contact_indent(flats, -0.06, nullptr) == RSC_NOT_CONVERGED);
    CHECK(rsc_contact_result(flats, nullptr, &force, &area, nullptr) == RSC_NO_RESULT &&
          force == 0 && area == 0);
    for (const char* name : {"force", "energy", "stiffness", "lateral_force_x", "moment_y"})
        CHECK(rsc_contact_value(flats, name, &force) == RSC_NO_RESULT && force == 0);
    CHECK(says("no state") &&
          rsc_contact_spots(flats, 0, nullptr, nullptr, nullptr, nullptr) == RSC_NO_RESULT);
    CHECK(rsc_contact_value(flats, "contact_area", &force) == RSC_NO_RESULT &&
          says("no such value"));
    CHECK(rsc_contact_level(flats, &level, nullptr, nullptr, nullptr, nullptr) == RSC_SUCCESS &&
          level == RSC_LEVEL_NOT_CONVERGED);
    failed = -1;
    CHECK(run_to("/proc/no/such/folder.nc", c, &failed) == -1);
    CHECK(failed == -1);
}

}  // namespace test_api_run
