#include "read/inputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <unistd.h>

#include "error.hpp"
#include "read/input_netcdf.hpp"
#include "read/input_text.hpp"
#include "rough/magnitude.hpp"

namespace rsc {
namespace {

constexpr double kUniform = 1e-6;  // of a step: how far a coordinate may be from where a uniform grid has it
constexpr double kSameL = 1e-6;    // relative: how far nx dx may be from the L that was given

[[noreturn]] void refuse(const std::string& message) { throw Error(Failure::bad_input, message); }

std::string text(double v) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.9g", v);
    return buffer;
}

// A file may announce any size; more than the machine holds is refused before memory is asked for. `what` has `count` doubles.
void check_memory(const std::string& path, const std::string& what, double count) {
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    const double machine = pages > 0 && page > 0 ? static_cast<double>(pages) * static_cast<double>(page) : 1e15;
    const double bytes = count * sizeof(double);
    if (bytes > machine)
        refuse(path + ": " + what + " needs " + text(bytes / 1e9) + " GB; this machine has " + text(machine / 1e9) + " GB");
}

void check_size(const std::string& path, std::size_t nx, std::size_t ny) {
    const std::string what = "a height map of " + std::to_string(nx) + " x " + std::to_string(ny) + " points";
    if (nx < 3 || ny < 3) refuse(path + ": " + what + "; at least 3 x 3 are needed");
    if (std::max(nx, ny) > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        refuse(path + ": " + what + "; at most 2147483647 a side are possible");
    check_memory(path, what, static_cast<double>(nx) * static_cast<double>(ny));
}

void check_L(const std::string& path, double L) {
    if (!(L > 0 && std::isfinite(L))) refuse(path + ": L must be positive and finite, not " + text(L));
}

HeightMap allocate(std::size_t nx, std::size_t ny) {
    HeightMap map;
    map.allocate(static_cast<int>(nx), static_cast<int>(ny), static_cast<std::ptrdiff_t>(nx));
    return map;
}

HeightMap read_text_heights(const std::string& path, std::optional<double> L) {
    if (!L) refuse(path + ": a text matrix has no spacing; L, its extent in x, must be given");
    check_L(path, *L);
    const TextTable table = read_table(path, 0);
    check_size(path, table.columns, table.rows);
    HeightMap map = allocate(table.columns, table.rows);
    std::copy(table.values.begin(), table.values.end(), map.data.get());
    map.dx = map.dy = *L / map.nx;
    return map;
}

// A uniform axis: value of point 0 (the smallest) and the step; `reversed` if the file counts downwards.
struct Axis {
    double first = 0, step = 0;
    bool reversed = false;
};

std::optional<Axis> read_axis(const NetcdfInput& file, const NetcdfInput::Variable& heights, std::size_t dimension) {
    const std::string& name = heights.axes[dimension];
    const auto variable = file.find(name);
    if (!variable || variable->dimensions != std::vector<int>{heights.dimensions[dimension]} || !variable->numeric()) return std::nullopt;
    const std::size_t n = variable->lengths[0];
    std::vector<double> c(n);
    file.read(*variable, c.data());
    Axis axis;
    axis.reversed = c.back() < c.front();
    if (axis.reversed) std::reverse(c.begin(), c.end());
    axis.first = c.front();
    axis.step = (c.back() - c.front()) / static_cast<double>(n - 1);
    if (!(axis.step > 0)) refuse(file.path() + ": coordinate " + name + " does not vary: it begins and ends at " + text(c.front()));
    // Coordinates stored in single precision are as uniform as that allows.
    const double largest = std::max(std::abs(c.front()), std::abs(c.back()));
    const double rounding = variable->type == NC_FLOAT ? 1.2e-7 * largest : 4.5e-16 * largest;
    for (std::size_t i = 0; i < n; ++i) {
        const double uniform = axis.first + static_cast<double>(i) * axis.step;
        if (std::abs(c[i] - uniform) > kUniform * axis.step + rounding)
            refuse(file.path() + ": coordinate " + name + " is not uniform to 1e-6 of its step " + text(axis.step) + ": " + name + "(" +
                   std::to_string(axis.reversed ? n - 1 - i : i) + "), counted from 0, is " + text(c[i]) + " where " + text(uniform) +
                   " was expected");
    }
    return axis;
}

NetcdfInput::Variable find_heights(const NetcdfInput& file) {
    if (const auto named = file.find("height")) {
        if (named->lengths.size() != 2 || !named->numeric())
            refuse(file.path() + ": height(y, x), numeric, was expected, not " + named->shape());
        return *named;
    }
    std::vector<NetcdfInput::Variable> maps;
    std::string names;
    for (const auto& v : file.variables())
        if (v.lengths.size() == 2 && v.numeric()) {
            names += (maps.empty() ? "" : ", ") + v.shape();
            maps.push_back(v);
        }
    if (maps.empty()) refuse(file.path() + ": there is no variable height(y, x) and no other of two dimensions");
    if (maps.size() > 1) refuse(file.path() + ": there is no variable height(y, x), and it cannot be told which is meant: " + names);
    return maps[0];
}

// Heights in nanometres over micrometres are common, and a thousand times too steep when taken as they are.
void check_units(const NetcdfInput& file, const NetcdfInput::Variable& heights, const std::string& axis) {
    const auto coordinate = file.find(axis);
    if (!coordinate) return;
    const auto of_heights = file.text_attribute(heights, "units"), of_axis = file.text_attribute(*coordinate, "units");
    if (of_heights && of_axis && *of_heights != *of_axis)
        refuse(file.path() + ": " + heights.name + " is in '" + *of_heights + "' but " + axis + " in '" + *of_axis +
               "'; one unit of length is expected");
}

void reverse_columns(HeightMap& map) {
    for (int j = 0; j < map.ny; ++j) std::reverse(map.row(j), map.row(j) + map.nx);
}

void reverse_rows(HeightMap& map) {
    for (int j = 0; j < map.ny - 1 - j; ++j) std::swap_ranges(map.row(j), map.row(j) + map.nx, map.row(map.ny - 1 - j));
}

HeightMap read_netcdf_heights(const std::string& path, std::optional<double> L) {
    const NetcdfInput file(path);
    const auto variable = find_heights(file);
    check_size(path, variable.lengths[1], variable.lengths[0]);
    const auto x = read_axis(file, variable, 1), y = read_axis(file, variable, 0);
    if (x.has_value() != y.has_value())
        refuse(path + ": " + variable.shape() + " has a coordinate variable for one dimension alone; for both or neither was expected");
    if (!x && !L) refuse(path + ": " + variable.shape() + " has no coordinate variables; L, its extent in x, must be given");
    HeightMap map = allocate(variable.lengths[1], variable.lengths[0]);
    if (L) {
        check_L(path, *L);
        map.dx = map.dy = *L / map.nx;
    }
    if (x) {
        check_units(file, variable, variable.axes[1]);
        check_units(file, variable, variable.axes[0]);
        const double extent = map.nx * x->step;
        if (L && !(std::abs(extent - *L) <= kSameL * *L))
            refuse(path + ": its coordinate " + variable.axes[1] + " spans " + std::to_string(map.nx) + " steps of " + text(x->step) +
                   " = " + text(extent) + ", but L = " + text(*L) + " was given");
        map.x0 = x->first;
        map.y0 = y->first;
        map.dx = x->step;
        map.dy = y->step;
    }
    file.read(variable, map.data.get());
    if (x && x->reversed) reverse_columns(map);
    if (y && y->reversed) reverse_rows(map);
    return map;
}

Asperities read_netcdf_asperities(const std::string& path) {
    const NetcdfInput file(path);
    Asperities a;
    std::optional<std::size_t> size;
    const auto take = [&](const char* name, std::vector<double>& values, bool required) {
        const auto v = file.find(name);
        if (!v && !required) return;
        if (!v) refuse(path + ": there is no variable " + name + "; asperity_x, asperity_y, asperity_z and asperity_radius were expected");
        if (v->lengths.size() != 1 || !v->numeric()) refuse(path + ": " + name + "(asperity), numeric, was expected, not " + v->shape());
        if (size && *size != v->lengths[0])
            refuse(path + ": " + v->shape() + ": " + std::to_string(*size) + " values as of asperity_x were expected");
        if (v->lengths[0] > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            refuse(path + ": " + v->shape() + ": more asperities than rsc can number");
        check_memory(path, v->shape(), 8.0 * static_cast<double>(v->lengths[0]));
        size = v->lengths[0];
        values.resize(*size);
        file.read(*v, values.data());
    };
    take("asperity_x", a.x, true);
    take("asperity_y", a.y, true);
    take("asperity_z", a.z, true);
    take("asperity_radius", a.radius, true);
    if (file.find("asperity_kappa1") && file.find("asperity_kappa2") && file.find("asperity_angle")) {
        take("asperity_kappa1", a.kappa1, true);
        take("asperity_kappa2", a.kappa2, true);
        take("asperity_angle", a.angle, true);
    }
    take("asperity_biharmonic", a.biharmonic, false);
    if (a.size() == 0) refuse(path + ": there is no asperity in it");
    validate(a, [&](std::size_t i) { return path + ": asperity " + std::to_string(i) + ", counted from 0"; });
    return a;
}

Asperities read_text_asperities(const std::string& path) {
    const TextTable table = read_table(path, 4);
    Asperities a;
    for (std::size_t i = 0; i < table.rows; ++i) {
        const double* const row = table.values.data() + 4 * i;
        a.x.push_back(row[0]), a.y.push_back(row[1]), a.z.push_back(row[2]), a.radius.push_back(row[3]);
    }
    validate(a, [&](std::size_t i) { return path + ":" + std::to_string(table.line[i]); });
    return a;
}

}  // namespace

HeightMap read_heights(const std::string& path, std::optional<double> L) {
    HeightMap map = is_netcdf(path) ? read_netcdf_heights(path, L) : read_text_heights(path, L);
    for (const double step : {map.dx, map.dy})
        if (!usable_positive(step)) refuse(path + ": the spacing " + kPositiveBounds + ", not " + text(step));
    for (const double origin : {map.x0, map.y0})
        if (!usable(origin)) refuse(path + ": the first coordinate " + kNumberBounds + ", not " + text(origin));
    for (int j = 0; j < map.ny; ++j)
        for (int i = 0; i < map.nx; ++i)
            if (!usable(map(i, j)))
                refuse(path + ": a height " + kNumberBounds + ", not " + text(map(i, j)) + " as in column " + std::to_string(i) +
                       " of row " + std::to_string(j) + ", counted from 0");
    return map;
}

Asperities read_asperities(const std::string& path) { return is_netcdf(path) ? read_netcdf_asperities(path) : read_text_asperities(path); }

Extent extent(const Asperities& a) {
    Extent e;
    if (a.size() == 0) return e;
    const auto [x_min, x_max] = std::minmax_element(a.x.begin(), a.x.end());
    const auto [y_min, y_max] = std::minmax_element(a.y.begin(), a.y.end());
    return {*x_min, *x_max, *y_min, *y_max};
}

}  // namespace rsc
