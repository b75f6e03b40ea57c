// The screen of runs: the numbers of its tables are those of the result file, and remarks stand
// there when the levels ask for them (test_remarks has each threshold).
#include "run/screen.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"

namespace test_screen {

using namespace rsc;

using Vector = std::vector<double>;

struct Screen {
    std::string text, messages;
    long failed = 0;
    bool says(const char* words) const { return text.find(words) != std::string::npos; }
    // The rows of numbers below the line that begins with `head`.
    std::vector<Vector> table(const std::string& head) const {
        std::vector<Vector> rows;
        std::istringstream lines(text);
        bool inside = false;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with(head)) {
                inside = true;
                rows.clear();
            }
            if (!inside || line.starts_with(head)) continue;
            Vector row;
            std::istringstream words(line);
            for (double v; words >> v;) row.push_back(v);
            if (row.empty()) break;
            rows.push_back(row);
        }
        return rows;
    }
};

Screen run(const std::string& text, const std::string& file) {
    Case settings = settings_of(text);
    settings.output.file = file;
    settings.run.threads = 1;
    std::ostringstream table, messages;
    RunOptions options;
    options.table = &table;
    options.messages = &messages;
    options.progress = Progress::never;
    const long failed = run_case(settings, options);
    return {table.str(), messages.str(), failed};
}

// Column `c` of the screen's table against values of the file, to the digits that are printed.
void column(const std::vector<Vector>& rows, std::size_t c, const Vector& values, double digits) {
    CHECK(rows.size() == values.size());
    for (std::size_t k = 0; k < std::min(rows.size(), values.size()); ++k)
        CHECK(rows[k].size() > c &&
              std::abs(rows[k][c] - values[k]) <= digits * std::abs(values[k]));
}

const std::string kSurface = "&surface n=128 L_lambda_l=4 L_lambda_s=32 ";

TEST(levels) {
    const Folder folder;
    const std::string path = folder / "levels.nc";
    const std::string cases[] = {
        kSurface +
            "L=2.5 sigma=0.02 / &indentation levels=6, 3, 1.5, 0, -2.9, -3.1, centre=1.1, 1.4 / "
            "&run title='A title' length_unit='um' / "
            "&solids E=1e4,3e4 nu=0.1,0.4 R=3,7 /",
        kSurface +
            "/ &solver model='asperities' / &indentation control='force' levels=0.01,0.5,8 /",
        kSurface + "/ &solver model='elements' / &indentation levels=6,2,1 /",
        kSurface +
            "/ &solids R=Infinity,Infinity / &indentation boundary='periodic' control='pressure' "
            "unit='relative' levels=0.01,0.05 /"};
    std::string seen;
    for (const std::string& text : cases) {
        const Screen screen = run(text, path);
        const Reader file(path);
        const auto rows = screen.table("level ");
        Vector Z = file.values("separation"), over_sigma = Z;
        for (double& z : over_sigma) z /= file.values("sigma_reference")[0];
        std::size_t next = 1;
        column(rows, next++, Z, 1e-5);
        // a ball under a force is not placed by rms heights
        if (text.find("control='force'") == std::string::npos)
            column(rows, next++, over_sigma, 1e-4);
        column(rows, next++, file.values("force"), 1e-7);
        column(rows, next++, file.values("contact_area"), 1e-7);
        if (file.has("pressure")) {
            column(rows, next++, file.values("pressure"), 1e-5);
            column(rows, next++, file.values("area_fraction"), 1e-5);
        }
        for (const char* name : {"contacts", "candidates", "iterations"})
            column(rows, next++, file.values(name), 0);
        column(rows, next, file.values("residual"), 0.05);
        CHECK(screen.failed == 0 && screen.messages.empty() &&
              screen.says(("result: " + path).c_str()));
        seen += screen.text;
    }
    for (const char* words : {"A title", "[um]", "sphere R = ", "two flats", "by elements: "})
        CHECK(seen.find(words) != std::string::npos);
}

// How asperities differ from elements, against the values of both in the file.
TEST(comparisons) {
    const Folder folder;
    const std::string path = folder / "compared.nc";
    for (const bool by_force : {false, true}) {
        const std::string levels = by_force ? "levels=8,40" : "levels=1.5,0.5";
        const Screen screen =
            run(kSurface + "/ &solver model='asperities' / &compare " + levels +
                    " / &indentation " + levels + (by_force ? " control='force' /" : " /"),
                path);
        const Reader file(path);
        const auto error = [&](const char* name, std::size_t k) {
            return 100 *
                   (file.values(name)[k] / file.values("compare_" + std::string(name))[k] - 1);
        };
        std::size_t k = 0;
        for (std::size_t here = 0;
             (here = screen.text.find("; asp", here + 1)) != std::string::npos; ++k) {
            double first = 0, sigma = 0, area = 0, contacts = 0;
            const char* line = screen.text.c_str() + here;
            if (by_force) {
                CHECK(std::sscanf(line,
                                  "; asperities at the same force Z0 %lf mm (%lf sigma), A %lf %%, "
                                  "contacts %lf %%",
                                  &first, &sigma, &area, &contacts) == 4);
                const double higher =
                    file.values("separation")[k] - file.values("compare_separation")[k];
                CHECK_RELATIVE(first, higher, 5e-3);
                CHECK_CLOSE(sigma, higher / file.values("sigma_reference")[0], 5.1e-4);
            } else {
                CHECK(std::sscanf(line, "; asperities N %lf %%, A %lf %%, contacts %lf %%", &first,
                                  &area, &contacts) == 3);
                CHECK_CLOSE(first, error("force", k), 5.1e-3);
            }
            CHECK_CLOSE(area, error("contact_area", k), 5.1e-3);
            CHECK_CLOSE(contacts, error("contacts", k), 5.1e-2);
        }
        CHECK(k == 2);
    }
}

// A duration as it is told, in seconds.
double seconds_of(const std::string& told) {
    const std::map<std::string, double> units{{"ms", 1e-3}, {"s", 1}, {"min", 60}, {"h", 3600}};
    std::istringstream words(told);
    double sum = 0, number = 0;
    for (std::string unit; words >> number >> unit;) sum += number * units.at(unit);
    return sum;
}

TEST(durations) {
    for (const double seconds : {0.02, 7.3, 130.0, 3725.0, 7260.0, 1e6})
        CHECK_CLOSE(seconds_of(duration(seconds)), seconds, seconds < 5400 ? 0.5 : 60);
}

}  // namespace test_screen
