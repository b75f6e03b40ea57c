#include "physics/stress/plane_stress.hpp"

#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "base/parallel.hpp"
#include "physics/stress/pixel_stress.hpp"

namespace rsc {
namespace {

using Complex = std::complex<double>;
constexpr int kRows = 8;  // that a thread takes at a time

// Real numbers on a plane, and in the same memory their modes exp(i(kx x + ky y)), kx >= 0.
class Plane {
public:
    Plane(int nx, int ny, Array<double>& memory) : stride_(2 * (at(nx) / 2 + 1)), rows_(ny) {
        memory.resize(stride_ * at(ny));
        values_ = memory.data();
    }
    void clear() {
        parallel_for(rows_, kRows, 0, [&](int j) { std::fill_n(row(j), stride_, 0.0); });
    }
    double* row(int j) { return values_ + at(j) * stride_; }
    Complex* modes(int j) { return reinterpret_cast<Complex*>(row(j)); }
    double* values() { return values_; }
    fftw_complex* fftw() { return reinterpret_cast<fftw_complex*>(values_); }

private:
    std::size_t stride_;
    int rows_;
    double* values_;
};

// The pressures, and the six components of the stress in the order of StressTensor.
class Planes {
public:
    Planes(int nx_, int ny_, StressMemory& memory) : nx(nx_), ny(ny_), pressure(nx, ny, memory[6]) {
        pressure.clear();
        for (const auto c : indices(6)) components.emplace_back(nx, ny, memory[c]);
        const auto lock = fftw_planning();
        forward_.reset(fftw_plan_dft_r2c_2d(ny, nx, pressure.values(), pressure.fftw(),
                                            FFTW_ESTIMATE | FFTW_UNALIGNED));
        backward_.reset(fftw_plan_dft_c2r_2d(ny, nx, pressure.fftw(), pressure.values(),
                                             FFTW_ESTIMATE | FFTW_UNALIGNED));
        if (!forward_ || !backward_)
            throw Error(Failure::internal, "FFTW made no plan for ", nx, " x ", ny, " points");
    }
    void to_modes(Plane& plane) {
        fftw_execute_dft_r2c(forward_.get(), plane.values(), plane.fftw());
    }
    void to_values(Plane& plane) {
        fftw_execute_dft_c2r(backward_.get(), plane.fftw(), plane.values());
    }
    void set(int i, int j, const StressTensor& s) {
        const std::array<double, 6> values{s.xx, s.yy, s.zz, s.xy, s.xz, s.yz};
        for (const auto c : indices(6)) components[c].row(j)[i] = values[c];
    }
    StressTensor stress(int i, int j) {
        const auto value = [&](std::size_t c) { return components[c].row(j)[i]; };
        return {value(0), value(1), value(2), value(3), value(4), value(5)};
    }

    int nx, ny;
    Plane pressure;
    std::vector<Plane> components;

private:
    FftwPlan forward_, backward_;
};

// The smallest window that holds all pixels under pressure or cohesive tension.
GridWindow loaded(const LevelPixels& pixels) {
    if (pixels.empty()) return {};
    const auto [left, right, top, bottom] = pixels.range();
    return {left, top, right - left + 1, bottom - top + 1};
}

void load(Planes& planes, const LevelPixels& pixels, const GridWindow& where, double factor) {
    pixels.each([&](std::int32_t pixel, double pressure, int) {
        const int i = pixel % pixels.columns - where.first_column;
        const int j = pixel / pixels.columns - where.first_row;
        planes.pressure.row(j)[i] = factor * pressure;
    });
    planes.to_modes(planes.pressure);
}

// Stress of a mode of pressure exp(i k x) and the traction that accompanies it, k = (kx, ky), in
// the half-space: plane strain along k (Airy's function (A + B z) exp(-k z)), and shear across k.
std::array<Complex, 6> mode_stress(double kx, double ky, double z, const StressedBody& body) {
    const double k = std::hypot(kx, ky);
    if (k == 0) {
        const double side = -body.nu / (1 - body.nu);
        return {side, side, -1.0, 0.0, -body.sliding.x, -body.sliding.y};
    }
    const double c = kx / k, s = ky / k, kz = k * z, decay = std::exp(-kz);
    const double along = body.sliding.x * c + body.sliding.y * s;
    const double across = body.sliding.y * c - body.sliding.x * s;
    const Complex i(0, 1);
    const Complex nn = (-(1 - kz) + i * along * (2 - kz)) * decay;
    const Complex zz = (-(1 + kz) + i * along * kz) * decay;
    const Complex tt = body.nu * (nn + zz);
    const Complex nz = (i * kz - along * (1 - kz)) * decay;
    const Complex nt = i * across * decay;
    const Complex tz = -across * decay;
    return {c * c * nn - 2 * c * s * nt + s * s * tt,
            s * s * nn + 2 * c * s * nt + c * c * tt,
            zz,
            c * s * (nn - tt) + (c * c - s * s) * nt,
            c * nz - s * tz,
            s * nz + c * tz};
}

void solve_periodic(Planes& planes, const PointGrid& grid, const StressedBody& body, double depth) {
    const double unit_x = 2 * pi / grid.Lx(), unit_y = 2 * pi / grid.Ly();
    parallel_for(planes.ny, kRows, 0, [&](int j) {
        const int row = 2 * j <= planes.ny ? j : j - planes.ny;
        for (int i = 0; i <= planes.nx / 2; ++i) {
            // An odd part of the highest mode of an even number of points has no value at them.
            const bool x_alone = 2 * i == planes.nx, y_alone = 2 * j == planes.ny;
            std::array<Complex, 6> stress = mode_stress(unit_x * i, unit_y * row, depth, body);
            if (x_alone || y_alone) {
                const std::array<Complex, 6> mirrored =
                    mode_stress(x_alone ? -unit_x * i : unit_x * i,
                                y_alone ? -unit_y * row : unit_y * row, depth, body);
                for (const auto c : indices(6)) stress[c] = 0.5 * (stress[c] + mirrored[c]);
            }
            for (const auto c : indices(6))
                planes.components[c].modes(j)[i] = stress[c] * planes.pressure.modes(j)[i];
        }
    });
    parallel_pieces(6, 0,
                    [&](std::size_t c, std::size_t) { planes.to_values(planes.components[c]); });
}

// One axis of a convolution: pressures on `sources` points from `from` on, stresses on `targets`
// points from `first` on. Without a period the plane is padded, with one it is the whole period.
struct Axis {
    Axis(int from_, int sources, int first_, int targets, int period)
        : offset(period > 0 ? -(period / 2) : first_ - from_ - sources + 1),
          kernel(period > 0 ? period : targets + sources - 1),
          size(period > 0 ? period : fast_size(kernel)),
          from(period > 0 ? 0 : from_),
          answer(period > 0 ? first_ + period / 2 : sources - 1),
          repeats(period > 0) {}

    int offset;  // of the first value of the kernel
    int kernel;  // number of its values
    int size;    // of the plane
    int from;    // grid point of the first value of the pressures
    int answer;  // place of the first target
    bool repeats;
    int place(int k) const { return (answer + k) % size; }
};

// The stress under one pixel and its images along y or x at multiples of a period L: those up to
// kImages one by one, those farther away as a uniform strip, whose error falls with the third power
// of kImages. Corner values are those of corner_stress().
class LineImages {
public:
    static constexpr int kImages = 2;

    LineImages(const Period& period, double step, double depth, const StressedBody& body)
        : along_x_(period.along_x()),
          L_(period.length()),
          share_(step / L_),
          depth_(depth),
          body_(body) {}

    // Sum of the corners at (x, y), one end of the pixel along the axis.
    StressTensor near(double x, double y) const {
        StressTensor sum;
        for (int m = -kImages; m <= kImages; ++m)
            sum += along_x_ ? corner(x + m * L_, y) : corner(x, y + m * L_);
        return sum;
    }
    // Of the strip, at one of its sides: `across` is the corner's coordinate, `along` that of the
    // pixel's middle.
    StressTensor far(double across, double along) const {
        const double near_end = (kImages + 0.5) * L_, far_end = 1e4 * L_;
        StressTensor sum = ends(across, along, far_end);
        sum += ends(across, along, near_end) * -1;
        return sum * share_;
    }

private:
    StressTensor corner(double x, double y) const {
        return corner_stress(x, y, depth_, body_.nu, body_.sliding);
    }
    StressTensor ends(double across, double along, double half) const {
        StressTensor sum = along_x_ ? corner(along + half, across) : corner(across, along + half);
        sum += (along_x_ ? corner(along - half, across) : corner(across, along - half)) * -1;
        return sum;
    }

    bool along_x_;
    double L_, share_, depth_;
    const StressedBody& body_;
};

// Fills the components with the stress under one pixel at all offsets of two axes.
void fill_kernel(Planes& planes, const Axis& columns, const Axis& rows, const PointGrid& grid,
                 const StressedBody& body, double depth) {
    const bool along_x = columns.repeats, line = columns.repeats || rows.repeats;
    const LineImages images(body.period, along_x ? grid.dx : grid.dy, depth, body);
    const auto corners = [&](int j) {
        const double y = (rows.offset + j - 0.5) * grid.dy;
        std::vector<StressTensor> row(at(columns.kernel) + 1);
        for (int i = 0; i <= columns.kernel; ++i) {
            const double x = (columns.offset + i - 0.5) * grid.dx;
            row[at(i)] =
                line ? images.near(x, y) : corner_stress(x, y, depth, body.nu, body.sliding);
        }
        return row;
    };
    // Of the far images: both sides of the strip.
    const auto add_strip = [&](StressTensor& s, int i, int j) {
        const double x = (columns.offset + i) * grid.dx, y = (rows.offset + j) * grid.dy;
        const double across = along_x ? y : x, along = along_x ? x : y,
                     half = 0.5 * (along_x ? grid.dy : grid.dx);
        s += images.far(across + half, along);
        s += images.far(across - half, along) * -1;
    };
    parallel_for((rows.kernel + kRows - 1) / kRows, 1, 0, [&](int block) {
        std::vector<StressTensor> above = corners(block * kRows), below;
        for (int j = block * kRows; j < std::min(rows.kernel, (block + 1) * kRows); ++j) {
            below = corners(j + 1);
            for (const int i : indices(columns.kernel)) {
                StressTensor s = below[at(i) + 1];
                s += below[at(i)] * -1;
                s += above[at(i) + 1] * -1;
                s += above[at(i)];
                if (line) add_strip(s, i, j);
                planes.set(i, j, s);
            }
            above.swap(below);
        }
    });
}

void convolve(Planes& planes) {
    parallel_pieces(6, 0, [&](std::size_t c, std::size_t) {
        Plane& plane = planes.components[c];
        planes.to_modes(plane);
        for (const int j : indices(planes.ny))
            for (int i = 0; i <= planes.nx / 2; ++i)
                plane.modes(j)[i] *= planes.pressure.modes(j)[i];
        planes.to_values(plane);
    });
}

// Measures of the stresses at the points of a window, which are at these places of the planes.
template <class Column, class Row>
LargestStress measure(Planes& planes, Column&& column, Row&& row, const PointGrid& grid,
                      const GridWindow& window, StressPlane* plane) {
    if (plane)
        for (auto* values : {&plane->mises, &plane->shear, &plane->tension})
            values->assign(window.points(), 0.0);
    std::vector<LargestStress> rows(at(window.rows));
    parallel_for(window.rows, kRows, 0, [&](int j) {
        for (const int i : indices(window.columns)) {
            const StressMeasures m = measures_of(planes.stress(column(i), row(j)));
            rows[at(j)].take(m, grid.x(window.first_column + i), grid.y(window.first_row + j));
            if (!plane) continue;
            const std::size_t k = at(j) * at(window.columns) + at(i);
            plane->mises[k] = m.mises;
            plane->shear[k] = m.shear;
            plane->tension[k] = m.tension;
        }
    });
    LargestStress all;
    for (const LargestStress& row : rows) all.take(row);
    return all;
}

}  // namespace

LargestStress stress_below(const PointGrid& grid, const LevelPixels& pixels,
                           const StressedBody& body, double depth, const GridWindow& window,
                           StressMemory& memory, StressPlane* plane) {
    if (body.period.finite()) {
        Planes planes(grid.nx, grid.ny, memory);
        load(planes, pixels, {}, 1 / double(grid.points()));
        solve_periodic(planes, grid, body, depth);
        return measure(
            planes, [&](int i) { return window.first_column + i; },
            [&](int j) { return window.first_row + j; }, grid, window, plane);
    }
    const GridWindow from = loaded(pixels);
    if (from.columns == 0) {
        const std::vector<double> none(window.points(), 0.0);
        if (plane) *plane = {none, none, none};
        return {};
    }
    const Axis columns(from.first_column, from.columns, window.first_column, window.columns,
                       body.period.along_x() ? grid.nx : 0);
    const Axis rows(from.first_row, from.rows, window.first_row, window.rows,
                    body.period.along_y() ? grid.ny : 0);
    Planes planes(columns.size, rows.size, memory);
    for (Plane& component : planes.components) component.clear();
    load(planes, pixels, {columns.from, rows.from, 0, 0}, 1 / (double(planes.nx) * planes.ny));
    fill_kernel(planes, columns, rows, grid, body, depth);
    convolve(planes);
    return measure(
        planes, [&](int i) { return columns.place(i); }, [&](int j) { return rows.place(j); }, grid,
        window, plane);
}

GridWindow stressed_window(const PointGrid& grid, const LevelPixels& pixels, const Period& period,
                           double depth) {
    const GridWindow contact = loaded(pixels);
    if (contact.columns == 0) return {};
    std::vector<double> areas;  // of the contacts, in pixels
    for (const std::int32_t c : pixels.contact) {
        if (at(c) >= areas.size()) areas.resize(at(c) + 1, 0.0);
        areas[at(c)] += 1;
    }
    const double largest = areas.empty() ? 0.0 : std::ranges::max(areas) * grid.dx * grid.dy,
                 beyond = std::max(2 * depth, std::sqrt(largest / pi));
    const auto widened = [&](int first, int count, double step, int n, double repeats, int& begin,
                             int& size) {
        const int margin = std::max(4, int(std::ceil(std::min(beyond / step, 1.0 * n))));
        begin = std::isfinite(repeats) ? 0 : std::max(0, first - margin);
        size = (std::isfinite(repeats) ? n : std::min(n, first + count + margin)) - begin;
    };
    GridWindow window;
    widened(contact.first_column, contact.columns, grid.dx, grid.nx, period.x, window.first_column,
            window.columns);
    widened(contact.first_row, contact.rows, grid.dy, grid.ny, period.y, window.first_row,
            window.rows);
    return window;
}

}  // namespace rsc
