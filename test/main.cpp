// Runs the tests of the files named, or of all: test_unit [NAME].
#include "check.hpp"

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "";
    int run = 0;
    for (const auto& [file, tests] : check::tests())
        for (auto* test : tests)
            if (name.empty() || name == file) test(), ++run;
    if (run > 0) return check::summary();
    std::printf("no tests named %s here\n", name.c_str());
    return 2;
}
