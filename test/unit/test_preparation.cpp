// One case, two ways: the program's (rsc_case_run and its result file) and the library's, step by step through its handles. Every number
// and every status is the same, to the last bit, whatever &surface source says; what cannot be had one way is refused.
#include <netcdf.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "check.hpp"
#include "rsc.h"
#include "temporary_folder.hpp"

namespace {

#define OK(call) CHECK((call) == RSC_SUCCESS)

std::string message() {
    char text[2000] = "";
    OK(rsc_message(text, sizeof text, nullptr));
    return text;
}

// A result file; a variable it does not have is empty.
class File {
public:
    explicit File(const std::string& name) { CHECK(nc_open(name.c_str(), NC_NOWRITE, &id_) == NC_NOERR); }
    ~File() { nc_close(id_); }
    std::vector<double> operator()(const char* name) const {
        int variable = -1, dimensions = 0, of[NC_MAX_VAR_DIMS];
        if (nc_inq_varid(id_, name, &variable) != NC_NOERR) return {};
        CHECK(nc_inq_var(id_, variable, nullptr, nullptr, &dimensions, of, nullptr) == NC_NOERR);
        std::size_t size = 1;
        for (int d = 0; d < dimensions; ++d) {
            std::size_t length = 0;
            CHECK(nc_inq_dimlen(id_, of[d], &length) == NC_NOERR);
            size *= length;
        }
        std::vector<double> values(size);
        CHECK(nc_get_var_double(id_, variable, values.data()) == NC_NOERR);
        return values;
    }

private:
    int id_ = -1;
};

struct Outcome {
    bool overlapping = false, out_of_validity = false;
};

// Values of the file from `first` on against the library's.
int differences(const std::vector<double>& file, std::size_t first, const std::vector<double>& library) {
    if (file.size() < first + library.size()) return 1;
    int n = 0;
    for (std::size_t k = 0; k < library.size(); ++k) n += std::memcmp(&file[first + k], &library[k], sizeof(double)) != 0;
    return n;
}

// `through_heights`: asperities from a surface handle and a copy of it, otherwise straight from the case.
Outcome compare(const std::string& text, const std::string& folder, std::int64_t realization = 1, bool through_heights = false) {
    Outcome outcome;
    rsc_case* c = nullptr;
    OK(rsc_case_create(&c));
    CHECK(rsc_case_read(c, text.c_str()) == RSC_SUCCESS);
    const std::string name = folder + "/compared.nc";
    OK(rsc_case_set(c, "output%file", ("'" + name + "'").c_str()));
    const std::int32_t ran = rsc_case_run(c, nullptr);
    CHECK(ran == RSC_SUCCESS || ran == RSC_NOT_CONVERGED);
    const int failures_before = check::failures;
    if (ran != RSC_SUCCESS && ran != RSC_NOT_CONVERGED) std::printf("%s\n", message().c_str());
    char control[40] = "";
    OK(rsc_case_get(c, "indentation%control", control, sizeof control, nullptr));
    const bool press = std::string(control) == "'force'";
    {
        const File file(name);
        rsc_surface *s = nullptr, *copy = nullptr;
        rsc_asperities* a = nullptr;
        rsc_contact* k = nullptr;
        if (through_heights) {
            OK(rsc_surface_synthesize(&s, c, realization));
            OK(rsc_surface_copy(&copy, s));
            OK(rsc_surface_destroy(&s));
            OK(rsc_asperities_find(&a, copy, c));
            OK(rsc_surface_destroy(&copy));
        } else {
            OK(rsc_asperities_make(&a, c, realization));
        }
        OK(rsc_contact_create_from_case(&k, a, c));
        std::int64_t n = 0;
        OK(rsc_asperities_count(a, &n));
        std::vector<double> x(static_cast<std::size_t>(n)), y(x), z(x), r(x);
        OK(rsc_asperities_get(a, n, x.data(), y.data(), z.data(), r.data()));
        CHECK(differences(file("asperity_x"), 0, x) == 0 && file("asperity_x").size() == x.size());
        CHECK(differences(file("asperity_y"), 0, y) == 0);
        CHECK(differences(file("asperity_z"), 0, z) == 0);
        CHECK(differences(file("asperity_radius"), 0, r) == 0);

        double x0 = 0, y0 = 0;
        OK(rsc_contact_tip(k, &x0, &y0));
        CHECK(differences(file("tip_x"), 0, {x0}) == 0 && differences(file("tip_y"), 0, {y0}) == 0);
        const std::vector<double> separation = file("separation"), force = file("force"), start = file("contact_start");
        CHECK(!separation.empty());
        // Under force control the file has the force reached, the case the one asked for.
        std::vector<double> asked = force;
        if (press) {
            char levels[1000];
            OK(rsc_case_get(c, "indentation%levels", levels, sizeof levels, nullptr));
            asked.clear();
            for (char* at = levels; *at;) {
                asked.push_back(std::strtod(at, &at));
                while (*at == ',' || *at == ' ') ++at;
            }
            CHECK(asked.size() == separation.size());
        }
        for (std::size_t i = 0; i < separation.size() && asked.size() == separation.size(); ++i) {
            const std::int32_t status = press ? rsc_contact_press(k, asked[i], nullptr) : rsc_contact_indent(k, separation[i], nullptr);
            double Z = 0, N = 0, A = 0, residual = 0, stiffness = 0;
            std::int64_t contacts = 0, candidates = 0, iterations = 0, pairs = 0;
            std::int32_t level = -1;
            OK(rsc_contact_result(k, &Z, &N, &A, &contacts));
            OK(rsc_contact_level(k, &level, &candidates, &iterations, &pairs, &residual));
            CHECK((status == RSC_NOT_CONVERGED) == (level == RSC_LEVEL_NOT_CONVERGED));
            CHECK(differences(separation, i, {Z}) == 0);
            CHECK(differences(force, i, {N}) == 0);
            CHECK(differences(file("contact_area"), i, {A}) == 0);
            CHECK(differences(file("contacts"), i, {static_cast<double>(contacts)}) == 0);
            CHECK(differences(file("candidates"), i, {static_cast<double>(candidates)}) == 0);
            CHECK(differences(file("iterations"), i, {static_cast<double>(iterations)}) == 0);
            CHECK(differences(file("overlapping_pairs"), i, {static_cast<double>(pairs)}) == 0);
            CHECK(differences(file("residual"), i, {residual}) == 0);
            CHECK(differences(file("status"), i, {static_cast<double>(level)}) == 0);
            outcome.overlapping |= level == RSC_LEVEL_OVERLAPPING;
            outcome.out_of_validity |= level == RSC_LEVEL_OUT_OF_VALIDITY;
            if (const auto told = file("stiffness"); press || !told.empty()) {
                OK(rsc_contact_stiffness(k, &stiffness));
                CHECK(differences(told, i, {stiffness}) == 0);
            }
            if (start.empty()) continue;
            std::vector<std::int32_t> which(static_cast<std::size_t>(contacts));
            std::vector<double> f(which.size()), a_(which.size()), index;
            OK(rsc_contact_spots(k, contacts, which.data(), f.data(), a_.data(), nullptr));
            for (const std::int32_t w : which) index.push_back(w + 1);
            const auto first = static_cast<std::size_t>(start[i]) - (contacts > 0);
            CHECK(differences(file("contact_asperity"), first, index) == 0);
            CHECK(differences(file("contact_force"), first, f) == 0);
            CHECK(differences(file("contact_radius"), first, a_) == 0);
        }
        OK(rsc_contact_destroy(&k));
        OK(rsc_asperities_destroy(&a));
    }
    OK(rsc_case_destroy(&c));
    if (check::failures > failures_before) std::printf("  above, in: %s\n", text.c_str());
    return outcome;
}

// What the library refuses because of the case has the case's number, and says why.
void refused(const std::string& text, std::int32_t (*call)(const rsc_case*), const char* why) {
    rsc_case* c = nullptr;
    OK(rsc_case_create(&c));
    OK(rsc_case_read(c, text.c_str()));
    CHECK(call(c) == -2);
    CHECK(message().find(why) != std::string::npos);
    OK(rsc_case_destroy(&c));
}

std::int32_t make(const rsc_case* c) {
    rsc_asperities* a = nullptr;
    const std::int32_t status = rsc_asperities_make(&a, c, 1);
    CHECK(a == nullptr);
    return status;
}

std::int32_t synthesize(const rsc_case* c) {
    rsc_surface* s = nullptr;
    const std::int32_t status = rsc_surface_synthesize(&s, c, 1);
    CHECK(s == nullptr);
    return status;
}

}  // namespace

int main() {
    const Folder folder;
    const std::string at = folder.path.string(), surface = "&surface n=128, L_lambda_l=4, L_lambda_s=32 ";
    {
        std::ofstream list(at + "/list.txt");
        for (int k = 0; k < 60; ++k) list << 0.1 * (k % 10) << ' ' << 0.1 * (k / 10) << ' ' << 0.01 * std::sin(7.3 * k) << " 0.05\n";
        std::ofstream(at + "/one.txt") << "0.3 0.4 0.01 0.05\n";
        std::ofstream(at + "/two.txt") << "0.3 0.4 0.01 0.5\n0.5 0.4 0.01 0.5\n";
        std::ofstream map(at + "/map.txt");
        map.precision(17);
        for (int j = 0; j < 40; ++j) {
            for (int i = 0; i < 50; ++i)
                map << 0.01 * (std::sin(0.9 * i + 0.31 * j) + std::cos(0.7 * j - 0.2 * i) + std::sin(1.7 * i * j)) + 0.001 * i << ' ';
            map << '\n';
        }
    }
    const std::string list = "source='asperities', file='" + at + "/list.txt'", map = "source='heights', file='" + at + "/map.txt'";
    const std::string kept = "source='asperities', file='" + at + "/kept.nc'";
    {
        rsc_case* c = nullptr;
        OK(rsc_case_create(&c));
        OK(rsc_case_read(
            c, (surface + "/ &asperities law='fourth_order' / &indentation steps=2 / &output heights=.true., file='" + at + "/kept.nc' /")
                   .c_str()));
        OK(rsc_case_run(c, nullptr));
        OK(rsc_case_destroy(&c));
    }
    const std::string few = "/ &indentation steps=4 /", deep = "/ &indentation levels=3,1.5,0,-1 /";
    Outcome seen;
    const auto add = [&seen](const Outcome& o) {
        seen.overlapping |= o.overlapping;
        seen.out_of_validity |= o.out_of_validity;
    };
    // Synthetic surfaces.
    add(compare(surface + deep, at));
    add(compare(surface + deep, at, 1, true));
    compare(surface + ", sigma=0.02, hurst=0.5, plateau=.true., normalise='ensemble'" + few, at, 1, true);
    compare(surface + ", L=2.5 / &indentation steps=4, centre=1.0, 1.5 /", at);
    compare(surface + few + " &run seed=9, first_realization=3, threads=2 /", at, 3);
    compare(surface + "/ &asperities curvature='algebraic' / &indentation levels=2.5,2, selection='paper', selection_factor=1.2 /", at);
    compare(surface + "/ &indentation steps=3 / &asperities law='elliptic' /", at, 1, true);
    compare(surface + "/ &indentation steps=3 / &asperities law='fourth_order' /", at);
    compare(surface + "/ &indentation steps=3 / &solver method='dgesv', delta0=0.02 /", at);
    compare(surface + "/ &indentation steps=3 / &solver method='mesh', tolerance=1e-8 /", at);
    compare(surface + "/ &indentation steps=3 / &solver interaction='none' / &solids R=3.0,2.5, E=1e5,2e5 /", at);
    compare(surface + "/ &indentation steps=3 / &solver max_iterations=2 /", at);  // some levels do not converge
    compare(surface + "/ &indentation control='force', levels=0.01,0.5,2,8 /", at);
    compare(surface + "/ &indentation levels=0.03,0.01,0.005, unit='length' /", at);
    // Measured ones.
    compare("&surface L=1.0, " + map + few, at);
    compare("&surface L=1.0, detrend='plane', sigma=0.02, " + map + deep, at, 1, true);
    compare("&surface source='heights', file='" + at + "/kept.nc'" + few, at, 5, true);  // the same whatever the realization
    // Lists.
    add(compare("&surface " + list + deep, at));
    compare("&surface L=1.5, sigma=0.01, " + list + "/ &indentation control='force', levels=0.1,5 /", at);
    compare("&surface L=1.0, " + kept + "/ &asperities law='fourth_order' / &indentation steps=3 /", at);
    add(compare("&surface source='asperities', sigma=0.01, file='" + at + "/two.txt' / &indentation levels=0,-2 /", at));
    compare("&surface source='asperities', sigma=0.01, file='" + at + "/one.txt' / &indentation levels=0,-2 /", at);
    CHECK(seen.overlapping && seen.out_of_validity);

    // A list taken from arrays says the same of the surface as the file it could come from: the same statuses.
    const double x[2] = {0.3, 0.5}, y[2] = {0.4, 0.4}, z[2] = {0.01, 0.01}, r[2] = {0.5, 0.5};
    rsc_asperities* a = nullptr;
    rsc_contact* k = nullptr;
    std::int32_t level = -1;
    double x0 = 0;
    OK(rsc_asperities_take(&a, 2, x, y, z, r, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_contact_create_from_case(&k, a, nullptr));
    OK(rsc_contact_indent(k, -0.01, nullptr));
    OK(rsc_contact_level(k, &level, nullptr, nullptr, nullptr, nullptr));
    CHECK(level == RSC_LEVEL_OUT_OF_VALIDITY);
    OK(rsc_contact_destroy(&k));
    rsc_case* c = nullptr;
    // Asperities of one height have no sigma to scale by; given one, they are like others.
    for (const auto& [key, value, back] :
         {std::array{"solver%method", "'dgesv'", "'auto'"}, {"indentation%selection", "'paper'", "'overlap'"}}) {
        OK(rsc_case_create(&c));
        OK(rsc_case_set(c, key, value));
        CHECK(rsc_contact_create_from_case(&k, a, c) == -3);
        CHECK(message().find(
                  "surface%sigma: needed by solver%method = 'dgesv' and indentation%selection = 'paper', and the asperities, all of "
                  "one height, give none") != std::string::npos);
        OK(rsc_case_set(c, "surface%sigma", "0.01"));
        OK(rsc_contact_create_from_case(&k, a, c));
        OK(rsc_contact_destroy(&k));
        OK(rsc_case_destroy(&c));
        OK(rsc_case_create(&c));
        OK(rsc_case_set(c, key, back));
        OK(rsc_contact_create_from_case(&k, a, c));
        OK(rsc_contact_destroy(&k));
        OK(rsc_case_destroy(&c));
    }
    OK(rsc_case_create(&c));
    OK(rsc_case_set(c, "surface%L", "1.0"));
    OK(rsc_contact_create_from_case(&k, a, c));
    OK(rsc_contact_tip(k, &x0, nullptr));
    CHECK(x0 == 0.5);
    OK(rsc_contact_destroy(&k));
    OK(rsc_case_set(c, "surface%L", "0.1"));
    CHECK(rsc_contact_create_from_case(&k, a, c) == -3 && message().find("extent of the asperities") != std::string::npos);
    // What a contact of asperities is not, it does not pretend to be.
    OK(rsc_case_set(c, "surface%L", "1.0"));
    if (rsc_case_set(c, "solver%model", "'elements'") == RSC_SUCCESS)
        CHECK(rsc_contact_create_from_case(&k, a, c) == -3 && message().find("'elements'") != std::string::npos);
    OK(rsc_case_destroy(&c));
    OK(rsc_asperities_destroy(&a));

    refused("&surface source='asperities', file='" + at + "/nowhere.txt' /", make, "nowhere.txt");
    refused("&surface source='heights', L=1.0, file='" + at + "/nowhere.txt' /", make, "nowhere.txt");
    refused("&surface source='heights', L=1.0, file='" + at + "/nowhere.txt' /", synthesize, "nowhere.txt");
    refused("&surface " + list + " /", synthesize, "&surface: source = 'asperities' has no heights, only summits");
    return check::summary();
}
