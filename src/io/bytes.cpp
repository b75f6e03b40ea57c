#include "io/formats.hpp"

#include "base/parallel.hpp"

namespace rsc {

std::string shown(std::string_view word) {
    return format("'%s%s'", printable(word, 40).c_str(), word.size() > 40 ? "..." : "");
}

void check_memory(const std::string& path, const std::string& what, double count) {
    const double bytes = count * sizeof(double), machine = machine_memory();
    if (bytes > machine)
        bad_input(path, ": ", what, " needs ", bytes / 1e9, " GB; this machine has ", machine / 1e9,
                  " GB");
}

void check_grid(const std::string& path, std::size_t nx, std::size_t ny) {
    const std::string what = joined("a height map of ", nx, " x ", ny, " points");
    if (nx < 3 || ny < 3) bad_input(path, ": ", what, "; at least 3 x 3 are needed");
    if (std::max(nx, ny) > at(std::numeric_limits<int>::max()))
        bad_input(path, ": ", what, "; at most 2147483647 points a side are possible");
    check_memory(path, what, double(nx) * double(ny));
}

HeightMap allocate_map(std::size_t nx, std::size_t ny) {
    HeightMap map;
    map.allocate(int(nx), int(ny), std::ptrdiff_t(nx));
    return map;
}

void scale_heights(HeightMap& map, double factor) {
    for (double& z : std::span(map.data.get(), map.points())) z *= factor;
}

void reverse_columns(HeightMap& map) {
    for (const int j : indices(map.ny)) std::reverse(map.row(j), map.row(j) + map.nx);
}

void reverse_rows(HeightMap& map) {
    for (int j = 0; j < map.ny - 1 - j; ++j)
        std::swap_ranges(map.row(j), map.row(j) + map.nx, map.row(map.ny - 1 - j));
}

}  // namespace rsc
