// A whole case run through the library: the values of its result file are those the library gives step by step, to the last bit.
#include <netcdf.h>

#include <string>
#include <vector>

#include "check.hpp"
#include "rsc.h"
#include "temporary_folder.hpp"

namespace {

#define OK(call) CHECK((call) == RSC_SUCCESS)

std::vector<double> read(int file, const char* name, std::size_t n) {
    std::vector<double> values(n, -1);
    int id = -1;
    CHECK(nc_inq_varid(file, name, &id) == NC_NOERR);
    CHECK(nc_get_var_double(file, id, values.data()) == NC_NOERR);
    return values;
}

void compare(const std::string& folder, bool force_control) {
    rsc_case* c = nullptr;
    OK(rsc_case_create(&c));
    OK(rsc_case_read(c, "&surface n=256, L_lambda_l=4, L_lambda_s=64, sigma=0.01 / &run seed=7 /"));
    const std::string file = folder + (force_control ? "/force.nc" : "/separation.nc");
    OK(rsc_case_set(c, "output%file", ("'" + file + "'").c_str()));
    const std::vector<double> levels = force_control ? std::vector<double>{0.5, 2, 8, 32} : std::vector<double>{3, 2.5, 2, 1.5, 1};
    OK(rsc_case_set(c, "indentation%levels", force_control ? "0.5, 2, 8, 32" : "3, 2.5, 2, 1.5, 1"));
    if (force_control) OK(rsc_case_set(c, "indentation%control", "'force'"));
    std::int64_t failed = -1;
    OK(rsc_case_run(c, &failed));
    CHECK(failed == 0);

    int nc = -1;
    CHECK(nc_open(file.c_str(), NC_NOWRITE, &nc) == NC_NOERR);
    const auto separation = read(nc, "separation", levels.size()), force = read(nc, "force", levels.size());
    const auto area = read(nc, "contact_area", levels.size()), contacts = read(nc, "contacts", levels.size());
    nc_close(nc);

    rsc_asperities* a = nullptr;
    rsc_contact* k = nullptr;
    OK(rsc_asperities_make(&a, c, 1));
    OK(rsc_contact_create_from_case(&k, a, c));
    for (std::size_t i = 0; i < levels.size(); ++i) {
        double N = 0, A = 0, Z = 0;
        std::int64_t n = 0;
        OK(force_control ? rsc_contact_press(k, levels[i], nullptr) : rsc_contact_indent(k, levels[i] * 0.01, nullptr));
        OK(rsc_contact_result(k, &Z, &N, &A, &n));
        CHECK(N == force[i] && A == area[i] && Z == separation[i] && static_cast<double>(n) == contacts[i]);
    }
    CHECK(force.back() > 1);
    OK(rsc_contact_destroy(&k));
    OK(rsc_asperities_destroy(&a));
    OK(rsc_case_destroy(&c));
}

}  // namespace

int main() {
    const Folder folder;
    compare(folder.path.string(), false);
    compare(folder.path.string(), true);

    // Levels that do not converge are told, and the file is there all the same; a folder that cannot be made leaves nothing.
    rsc_case* c = nullptr;
    OK(rsc_case_create(&c));
    OK(rsc_case_read(c, "&surface n=256, L_lambda_l=4, L_lambda_s=64 / &indentation steps=3 / &solver max_iterations=1 /"));
    OK(rsc_case_set(c, "output%file", ("'" + folder.path.string() + "/unfinished.nc'").c_str()));
    std::int64_t failed = -1;
    CHECK(rsc_case_run(c, &failed) == RSC_NOT_CONVERGED);
    CHECK(failed > 0);
    int nc = -1;
    CHECK(nc_open((folder.path.string() + "/unfinished.nc").c_str(), NC_NOWRITE, &nc) == NC_NOERR);
    nc_close(nc);
    OK(rsc_case_set(c, "output%file", "'/proc/no/such/folder.nc'"));
    failed = -1;
    CHECK(rsc_case_run(c, &failed) == -1);
    CHECK(failed == -1);
    OK(rsc_case_destroy(&c));
    return check::summary();
}
