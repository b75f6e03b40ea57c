// The result file: everything of the interface is there and described, values come back.
#include <netcdf.h>
#include <unistd.h>

#include "base/error.hpp"
#include "case/units.hpp"
#include "io/netcdf_writer.hpp"
#include "support/refused.hpp"
#include "support/sample_result.hpp"
#include "support/temporary_folder.hpp"

namespace test_result_file {

using namespace rsc;
namespace fs = std::filesystem;

// Every variable described, every dimension with its coordinate variable but those of lists, the
// classic data model only, nothing that is not finite.
void test_conventions(const Reader& file) {
    int ndims = 0, nvars = 0, natts = 0, unlimited = 0;
    CHECK(nc_inq(file.id(), &ndims, &nvars, &natts, &unlimited) == NC_NOERR);
    for (const int v : indices(nvars)) {
        char name[NC_MAX_NAME + 1] = "";
        nc_type type = NC_NAT;
        int attributes = 0;
        nc_inq_var(file.id(), v, name, &type, nullptr, nullptr, &attributes);
        CHECK(type == NC_DOUBLE || type == NC_INT);
        CHECK(!file.text(name, "units").empty() && !file.text(name, "long_name").empty());
        for (const int a : indices(attributes)) {
            char attribute[NC_MAX_NAME + 1] = "";
            nc_type att_type = NC_NAT;
            nc_inq_attname(file.id(), v, a, attribute);
            nc_inq_atttype(file.id(), v, attribute, &att_type);
            CHECK(att_type == NC_CHAR || att_type == NC_DOUBLE || att_type == NC_INT);
        }
        for (double x : file.values(name)) CHECK(std::isfinite(x));
    }
    const std::set<std::string> lists = {"asperity", "contact",
                                         "outline_point"};  // dimensions without a variable
    for (const int d : indices(ndims)) {
        char name[NC_MAX_NAME + 1] = "";
        nc_inq_dimname(file.id(), d, name);
        if (!lists.contains(name)) CHECK(file.has(name));
    }
    for (const char* attribute :
         {"Conventions", "title", "source", "history", "references", "case"})
        CHECK(!file.text("", attribute).empty());
    CHECK(file.text("", "Conventions") == "CF-1.10");
    CHECK(file.text("", "source").find("rsc 0.") == 0);
    CHECK(file.numbers("", "seed") == std::vector<double>{1});
    CHECK(file.numbers("status", "flag_values") == (std::vector<double>{0, 1, 2, 3, 4}));
    CHECK(file.text("status", "flag_meanings") ==
          "converged out_of_validity overlapping not_unique not_converged");
    CHECK(file.text("method", "flag_meanings") == "dgesv direct mesh");
}

void test_one_realization(const Folder& folder, Format format, int compression) {
    Result r = sample::result(1);
    r.settings.output.format = format;
    r.settings.output.compression = compression;
    const std::string path = folder / "one.nc";
    write_result(r, path, "");
    CHECK(folder.files() == 1);  // nothing but the file
    const Reader file(path);
    test_conventions(file);
    int kind = 0;
    nc_inq_format(file.id(), &kind);
    CHECK(kind == (format == Format::netcdf4 ? NC_FORMAT_NETCDF4_CLASSIC
                   : format == Format::cdf5  ? NC_FORMAT_CDF5
                                             : NC_FORMAT_CLASSIC));

    CHECK(file.text("", "case") == r.case_text);
    // Absent values are fill values, and say so.
    CHECK(file.values("force_std")[0] == NC_FILL_DOUBLE &&
          file.numbers("force_std", "_FillValue") == std::vector<double>{NC_FILL_DOUBLE});
    CHECK(!file.has("asperity_biharmonic"));
}

// Why read_sums refuses.
std::string refusal(const std::string& path, const ObserveOptions& options, std::size_t steps) {
    return ::refusal([&] { read_sums(path, options, steps); });
}

// Sums read back are those that were written, within rounding; a file whose axes are others is not
// taken for one of the case.
TEST(test_sums) {
    const Folder folder;
    const Result r = sample::result(3);
    const std::string path = folder / "sums.nc", one = folder / "one.nc";
    write_result(r, path, {});
    write_result(sample::result(1), one, {});
    const ObserveOptions options = r.observations.options;
    const Observations again = read_sums(path, options, sample::kSteps).finish();
    CHECK(again.map_pressure.cell == r.observations.map_pressure.cell);
    for (const auto k : indices(again.map_pressure.value))
        CHECK_RELATIVE(again.map_pressure.value[k], r.observations.map_pressure.value[k], 1e-15);
    CHECK(again.distributions[1].pressure_pdf == r.observations.distributions[1].pressure_pdf);
    CHECK(again.realization == (std::vector<std::int64_t>{1, 2, 3}) &&
          again.surface[2].m2 == r.observations.surface[2].m2);
    const auto with = [&](auto change) {
        ObserveOptions other = options;
        change(other);
        return refusal(path, other, sample::kSteps);
    };
    const std::string begins = " begins at another value than the case gives";
    CHECK(with([](auto& o) { o.map.x0 += 1e-9; }).find("x" + begins) != std::string::npos);
    CHECK(with([](auto& o) { o.map.y0 += 1e-9; }).find("y" + begins) != std::string::npos);
    CHECK(with([](auto& o) { o.pdf.pressure_max *= 1.01; }).find("pressure_mean_bin" + begins) !=
          std::string::npos);
    CHECK(with([](auto& o) { o.pdf.area_max *= 1.01; }).find("spot_area_bin" + begins) !=
          std::string::npos);
    CHECK(with([](auto& o) { o.map.nx += 1; }).find("the shape") != std::string::npos);
    CHECK(refusal(path, options, sample::kSteps + 1).find("the shape") != std::string::npos);
    CHECK(refusal(one, options, sample::kSteps).find("it has no variable pdf_sums") !=
          std::string::npos);

    Result bad = sample::result(1);
    bad.observations.rows[2].status = LevelStatus::not_converged;
    bad.observations.rows[3].status = LevelStatus::not_unique;
    bad.observations.rows[4].status = LevelStatus::not_unique;
    write_result(bad, one, {});
    const std::optional<LevelCount> count = count_levels(one);
    CHECK(count && count->levels == sample::kSteps && count->failed == 1);
}

TEST(test_edges) {
    const Folder folder;
    // No contact anywhere, no distributions, a flat punch beside the map: the file is still one.
    Case c = sample::make_case(1);
    c.output.pdf_levels = {};
    c.indentation.control = Control::force;
    c.run.length_unit = "1e-6 m";
    c.run.seed = 1234567890123;
    Indenter flat;
    flat.E_star = 1;
    flat.shape = kInfinity;
    flat.x0 = 3;
    const ObserveOptions options = observe_options(c, {0, 0, 1, 0.5}, flat, 0, 0);
    Accumulators sums(options, 2);
    sums.add(observe(options, 1, {}, {Level{}, Level{}}));
    Result r = make_result(c, "", flat, 0, std::nullopt, sums.finish());
    std::vector<Level> levels{Level{}, Level{}};
    keep_contacts(r, levels, Contacts::all);
    write_result(r, folder / "empty.nc", {});
    const Reader file(folder / "empty.nc");
    CHECK(file.values("contact_count") == (std::vector<double>{0, 0}) &&
          !file.has("contact_force") && !file.has("radius") && !file.has("pdf_level"));
    CHECK(file.values("area_hertz")[0] == NC_FILL_DOUBLE &&
          file.values("m2_theory")[0] == NC_FILL_DOUBLE &&
          file.values("area_I")[0] == NC_FILL_DOUBLE);
    CHECK(file.dimensions("separation") ==
          (std::vector<std::string>{"realization", "step"}));  // force control
    CHECK(file.values("y").size() == 10 && file.values("x").size() == 20);
    CHECK(file.text("contact_area", "units") == "(1e-6 m)2");
    CHECK(file.text("", "seed") == "1234567890123");
}

// A comparison whose elements did not converge, with the last iterate or without any, leaves the
// file: what there is, and nothing else.
TEST(test_failed_comparison) {
    const Folder folder;
    Result r = sample::result(1);
    const double none = std::nan("");
    r.compared.levels = {{.step = 0, .force = 2},
                         {.step = 1, .force = none, .area = none, .area_pixels = none}};
    write_result(r, folder / "compared.nc", {});
    const Reader file(folder / "compared.nc");
    CHECK(file.values("compare_step") == (std::vector<double>{1, 2}));
    CHECK(file.values("compare_force") == (std::vector<double>{2, NC_FILL_DOUBLE}));
    for (const char* name :
         {"compare_contact_area", "compare_contact_area_pixels", "area_error", "contacts_error"})
        CHECK(file.values(name)[1] == NC_FILL_DOUBLE);
    CHECK(file.values("force").size() == sample::kSteps);
}

// Numbers that are not finite never reach a file. Obstacles of the file system:
// test/door/cli/faults.sh, files.sh.
TEST(test_not_finite) {
    const Folder folder;
    const std::string path = folder / "never.nc";
    for (const char* variable : {"contact_force", "map_pressure", "height"}) {
        Result r = sample::result(1);
        const auto heights = std::make_shared<HeightMap>(r.heights->copy());
        (variable[0] == 'c'   ? r.contacts.force[5]
         : variable[0] == 'm' ? r.observations.map_pressure.value[0]
                              : heights->row(2)[3]) = std::nan("");
        r.heights = heights;
        const std::string message =
            ::refusal([&] { write_result(r, path, {}); }, Failure::internal);
        CHECK(message.find(variable) != std::string::npos && !fs::exists(path));
    }
}

TEST(result_file) {
    for (const auto& [format, compression] : {std::pair{Format::netcdf4, 4},
                                              {Format::netcdf4, 0},
                                              {Format::cdf5, 4},
                                              {Format::classic, 4}})
        test_one_realization(Folder(), format, compression);
}

}  // namespace test_result_file
