// Runs the tests of the files named, or of all: test_rooms [NAME].
#include "check.hpp"

namespace check {

static std::map<std::string, std::vector<void (*)()>>& tests() {
    static std::map<std::string, std::vector<void (*)()>> all;
    return all;
}

bool add(const char* file, void (*run)()) {
    tests()[std::filesystem::path(file).stem().string().substr(5)].push_back(run);  // behind test_
    return true;
}

void that(bool ok, const char* what, const char* file, int line) {
    ++checks;
    if (ok) return;
    ++failures;
    std::printf("%s:%d: failed: %s\n", file, line, what);
}

void close(double a, double b, double tolerance, const char* what, const char* file, int line) {
    ++checks;
    const double error = std::abs(a - b);
    if (error <= tolerance) return;  // false for NaN
    ++failures;
    std::printf("%s:%d: failed: %s: %.17g against %.17g, error %.3g > %.3g\n", file, line, what, a,
                b, error, tolerance);
}

}  // namespace check

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "";
    int run = 0;
    for (const auto& [file, tests] : check::tests())
        for (auto* test : tests)
            if (name.empty() || name == file) test(), ++run;
    std::printf("%d checks, %d failed\n", check::checks.load(), check::failures.load());
    if (run == 0) std::printf("no tests named %s here\n", name.c_str());
    return run == 0 ? 2 : check::failures == 0 ? 0 : 1;
}
