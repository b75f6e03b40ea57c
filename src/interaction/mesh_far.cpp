#include "interaction/mesh_far.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/std.hpp"

namespace rsc {
namespace {

constexpr double kPi = pi;

double bell(double beta, double t) {
    return boost::math::cyl_bessel_i(0, beta * std::sqrt(std::max(0.0, 1 - t * t)));
}

template <class Function>
double integral(double a, double b, Function function) {
    return boost::math::quadrature::gauss<double, 40>::integrate(function, a, b);
}

// Coefficients of t^k, t in [-1, 1], of the Chebyshev interpolant of a function, truncated where
// the rest is below `tolerance`.
std::vector<long double> polynomial(const std::function<double(double)>& function, double tolerance,
                                    int largest_degree) {
    constexpr int kNodes = 48;
    long double value[kNodes], chebyshev[kNodes];
    for (int i = 0; i < kNodes; ++i) value[i] = function(std::cos(kPi * (i + 0.5) / kNodes));
    for (int k = 0; k < kNodes; ++k) {
        long double sum = 0;
        for (int i = 0; i < kNodes; ++i)
            sum += value[i] * std::cos(std::numbers::pi_v<long double> * k * (i + 0.5L) / kNodes);
        chebyshev[k] = sum * (k == 0 ? 1 : 2) / kNodes;
    }
    int degree = largest_degree;
    long double tail = 0;
    while (degree > 1 && (tail += std::abs(chebyshev[degree])) < tolerance) --degree;
    std::vector<long double> sum(static_cast<std::size_t>(degree) + 1), t0(sum.size()),
        t1(sum.size()), t2(sum.size());
    t0[0] = 1;
    t1[1] = 1;
    for (int k = 0; k <= degree; ++k) {
        for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += chebyshev[k] * t0[m];
        for (std::size_t m = 0; m < sum.size(); ++m) t2[m] = (m > 0 ? 2 * t1[m - 1] : 0) - t0[m];
        t0.swap(t1);
        t1.swap(t2);
    }
    return sum;
}

// Sorted by decreasing error, which beta and the shape of the window minimise. The script
// input/trust/mesh_designs.py finds them again.
constexpr MeshDesign kDesigns[] = {
    {6.6e-04, 4, 2.0, 8.27, 5.53},    {3.8e-04, 4, 2.5, 8.34, 6.65},
    {2.0e-04, 4, 3.0, 10.26, 6.48},   {7.3e-05, 6, 2.5, 10.45, 7.71},
    {2.3e-05, 6, 3.0, 12.05, 8.72},   {9.2e-06, 6, 3.5, 13.12, 9.69},
    {4.4e-06, 7, 3.5, 13.73, 10.42},  {2.6e-06, 8, 3.5, 14.06, 10.83},
    {8.0e-07, 8, 4.0, 15.48, 11.92},  {2.7e-07, 8, 4.5, 16.23, 13.03},
    {1.2e-07, 8, 5.0, 16.95, 13.90},  {6.1e-08, 8, 5.5, 18.00, 14.46},
    {3.3e-08, 8, 6.0, 18.68, 14.98},  {9.9e-09, 10, 5.5, 19.59, 16.19},
    {4.2e-09, 10, 6.0, 20.67, 17.07}, {1.2e-09, 12, 6.0, 21.74, 18.27},
    {4.9e-10, 12, 6.5, 23.64, 19.20}, {1.6e-10, 12, 7.0, 24.35, 20.17},
    {5.9e-11, 12, 7.5, 24.93, 21.15}, {2.5e-11, 12, 8.0, 25.28, 22.11},
};

// Points more uniform than random have smaller potentials and therefore larger relative errors.
constexpr double kMargin = 0.6;

}  // namespace

const MeshDesign& mesh_design(double relative_error) {
    for (const MeshDesign& design : kDesigns)
        if (design.error <= kMargin * relative_error) return design;
    return kDesigns[std::size(kDesigns) - 1];
}

namespace {

// F for a cutoff of 1.
NearKernel unit_kernel(const MeshDesign& design) {
    const double whole = integral(0, 1, [&](double t) { return bell(design.beta, t); });
    // As a function of s = 1 - d^2 in [0, 1]: the mean of the bell over [0, d], which is finite at
    // d = 0.
    const auto smooth = [&](double s) {
        const double d = std::sqrt(std::max(0.0, 1 - s));
        return integral(0, 1, [&](double t) { return bell(design.beta, t * d); }) / whole;
    };
    const auto p =
        polynomial([&](double t) { return smooth((t + 1) / 2); }, 0.1 * design.error, kNearDegree);
    std::vector<long double> q(p.size());  // converts powers of t = 2 s - 1 to powers of s
    for (std::size_t k = p.size(); k-- > 0;) {
        for (std::size_t m = q.size() - 1; m > 0; --m) q[m] = 2 * q[m - 1] - q[m];
        q[0] = -q[0] + p[k];
    }
    NearKernel kernel;
    kernel.degree = static_cast<int>(q.size()) - 1;
    std::copy(q.begin(), q.end(), kernel.c);
    return kernel;
}

MeshWindow make_window(const MeshDesign& design) {
    MeshWindow window;
    window.width = design.width;
    const double scale = 1 / bell(design.shape, 0);
    for (int m = 0; m < design.width; ++m) {
        const auto piece = [&](double t) {
            return scale * bell(design.shape, (2 * m + t + 1) / design.width - 1);
        };
        const auto p = polynomial(piece, 0.1 * design.error, kWindowDegree);
        window.degree = std::max(window.degree, static_cast<int>(p.size()) - 1);
        for (std::size_t k = 0; k < p.size(); ++k) window.c[k][m] = static_cast<double>(p[k]);
    }
    return window;
}

// Tables are computed once for each design, because operators are created again whenever the points
// change.
struct Tables {
    std::once_flag made;
    NearKernel kernel;
    MeshWindow window;
};

const Tables& tables(const MeshDesign& design) {
    static Tables all[std::size(kDesigns)];
    Tables& mine = all[&design - kDesigns];
    std::call_once(mine.made, [&] {
        mine.kernel = unit_kernel(design);
        mine.window = make_window(design);
    });
    return mine;
}

}  // namespace

NearKernel near_kernel(const MeshDesign& design, double cutoff) {
    NearKernel kernel = tables(design).kernel;
    kernel.reach = cutoff;
    kernel.cutoff2 = cutoff * cutoff;
    double unit = cutoff;
    for (int k = 0; k <= kernel.degree; ++k, unit *= kernel.cutoff2) kernel.c[k] /= unit;
    return kernel;
}

MeshWindow mesh_window(const MeshDesign& design) { return tables(design).window; }

namespace {

// Fourier transform of the window at wavenumber k, and the sum of its squares at k + 2 pi m over
// all m.
double window_transform(const MeshDesign& design, double k) {
    const double z = design.shape * design.shape - std::pow(design.width * k / 2, 2),
                 root = std::sqrt(std::abs(z));
    const double value = root < 1e-6 ? 1 : z > 0 ? std::sinh(root) / root : std::sin(root) / root;
    return design.width * value / bell(design.shape, 0);
}

double window_alias_sum(const MeshDesign& design, double k) {
    double sum = 0;
    for (int m = -2; m <= 2; ++m) sum += std::pow(window_transform(design, k + 2 * kPi * m), 2);
    return sum;
}

// A smooth periodic function that equals x^2 for |x| <= period/2 - bend. It replaces (x_i - x_j)^2
// on a periodic mesh, so that the kernel has no kink where it wraps around: the kink is smoothed by
// the bell over +- bend. Around it the squared distance to the nearest multiple of the period is
// x^2 - 2 period (x - period/2)_+, and the ramp is replaced by its mean over the bell.
double periodic_square(const MeshDesign& design, double x, double period, double bend) {
    x = std::abs(std::remainder(x, period));
    const double from = (x - period / 2) / bend;  // in [-period/(2 bend), 0]
    if (from <= -1) return x * x;
    const double whole = integral(-1, 1, [&](double t) { return bell(design.beta, t); });
    const double ramp =
        integral(-1, from, [&](double t) { return bell(design.beta, t) * (from - t); }) / whole;
    return x * x - 2 * period * bend * ramp;
}

// The smallest even number >= n with no prime factor above 7.
std::size_t transform_length(double n) {
    for (auto length = static_cast<std::size_t>(std::ceil(n / 2)) * 2;; length += 2) {
        std::size_t rest = length;
        for (std::size_t factor : {2, 3, 5, 7})
            while (rest % factor == 0) rest /= factor;
        if (rest == 1) return length;
    }
}

// The doubled mesh contains all signed differences of two points and a margin for smoothing the
// kernel where it wraps around.
double period_needed(const MeshDesign& design, double length) {
    return 2 * length + 4 * design.cutoff + 2;
}

constexpr int kRows = 8;  // rows or columns of a mesh processed by a thread at a time

// Small meshes use one thread.
int threads_for(std::size_t points) {
    return points < 65536 ? 1 : static_cast<int>(most_threads(0));
}

// A buffer for each thread.
std::vector<FftwArray> buffers(int threads, std::size_t n) {
    std::vector<FftwArray> all;
    for (int t = 0; t < threads; ++t) all.push_back(fftw_array(n));
    return all;
}

// F at the squared distance d2.
double far_part(const NearKernel& kernel, double d2) {
    if (d2 >= kernel.cutoff2) return 1 / std::sqrt(d2);
    double value = 0;
    for (int k = kernel.degree; k >= 0; --k) value = value * (kernel.cutoff2 - d2) + kernel.c[k];
    return value;
}

fftw_complex* as_complex(double* p) { return reinterpret_cast<fftw_complex*>(p); }

}  // namespace

FftwArray fftw_array(std::size_t n) {
    FftwArray array(static_cast<double*>(fftw_malloc(n * sizeof(double))));
    if (!array)
        throw Error(Failure::no_memory,
                    "no memory for a mesh of " + std::to_string(n * sizeof(double) >> 20) + " MB");
    return array;
}

double FarField::points_needed(const MeshDesign& design, double length_x, double length_y) {
    return period_needed(design, length_x) * period_needed(design, length_y);
}

FarField::FarField(const MeshDesign& design, double length_x, double length_y, double spacing,
                   const Kernel& of)
    : period_x_(transform_length(period_needed(design, length_x))),
      period_y_(transform_length(period_needed(design, length_y))) {
    rows_ = static_cast<std::size_t>(length_y) + static_cast<std::size_t>(design.width) + 1;
    // All windows are written with the full width kWindowWidth.
    const std::size_t complex_columns = std::max(
        period_x_ / 2 + 1, (static_cast<std::size_t>(length_x) + 2 + kWindowWidth) / 2 + 1);
    columns_ = (complex_columns + kColumns - 1) / kColumns * kColumns;

    make_plans();
    const NearKernel kernel = near_kernel(design, design.cutoff);
    const auto squares = [&design](std::size_t period, double length) {
        const auto size = static_cast<double>(period);
        std::vector<double> square(period / 2 + 1);
        for (std::size_t m = 0; m <= period / 2; ++m)
            square[m] = periodic_square(design, static_cast<double>(m), size, size / 2 - length);
        return square;
    };
    const std::vector<double> x2 = squares(period_x_, length_x), y2 = squares(period_y_, length_y);
    const SmoothPart* smooth = of.smooth();
    const double unit = spacing / of.near(), square = spacing * spacing;
    make_multiplier(design, [&](std::size_t m, std::size_t n) {
        const double d2 = x2[m] + y2[n], far = far_part(kernel, d2);
        return smooth ? far + unit * smooth->at_square(square * d2) : far;
    });
}

FarField::FarField(const MeshDesign& design, const Lattice& lattice, double spacing, double cutoff)
    : period_x_(transform_length(lattice.period().x / spacing)),
      period_y_(transform_length(lattice.period().y / spacing)),
      periodic_(true) {
    rows_ = period_y_ + static_cast<std::size_t>(design.width) + 1;
    const std::size_t complex_columns = (period_x_ + 2 + kWindowWidth) / 2 + 1;
    columns_ = (complex_columns + kColumns - 1) / kColumns * kColumns;
    make_plans();
    const NearKernel kernel = near_kernel(design, cutoff);
    const double dx = lattice.period().x / static_cast<double>(period_x_),
                 dy = lattice.period().y / static_cast<double>(period_y_);
    make_multiplier(design, [&](std::size_t m, std::size_t n) {
        const double x = static_cast<double>(m) * dx, y = static_cast<double>(n) * dy;
        return far_part(kernel, x * x + y * y) + lattice.nearest_smooth(x, y) + lattice.rest(x, y) -
               lattice.least();
    });
}

void FarField::make_plans() {
    const int nx = static_cast<int>(period_x_), ny = static_cast<int>(period_y_),
              many = static_cast<int>(kColumns);
    const FftwArray row = fftw_array(stride()), block = fftw_array(2 * kColumns * period_y_);
    {
        const auto lock = fftw_planning();
        row_forward_.reset(
            fftw_plan_dft_r2c_1d(nx, row.get(), as_complex(row.get()), FFTW_ESTIMATE));
        row_backward_.reset(
            fftw_plan_dft_c2r_1d(nx, as_complex(row.get()), row.get(), FFTW_ESTIMATE));
        fftw_complex* b = as_complex(block.get());
        column_forward_.reset(fftw_plan_many_dft(1, &ny, many, b, nullptr, many, 1, b, nullptr,
                                                 many, 1, FFTW_FORWARD, FFTW_ESTIMATE));
        column_backward_.reset(fftw_plan_many_dft(1, &ny, many, b, nullptr, many, 1, b, nullptr,
                                                  many, 1, FFTW_BACKWARD, FFTW_ESTIMATE));
    }
    if (!row_forward_ || !row_backward_ || !column_forward_ || !column_backward_)
        throw Error(Failure::internal, "FFTW made no plan for a mesh of " + std::to_string(nx) +
                                           " x " + std::to_string(ny));
}

// fold() makes every mesh point occur once before the transforms; unfold() copies the border
// afterwards, so that windows may cross it.
void FarField::fold(double* mesh) const {
    for (std::size_t n = period_y_; n < rows_; ++n) {
        double *from = mesh + n * stride(), *to = from - period_y_ * stride();
        for (std::size_t m = 0; m < stride(); ++m) to[m] += from[m];
    }
    for (std::size_t n = 0; n < period_y_; ++n) {
        double* row = mesh + n * stride();
        for (std::size_t m = period_x_; m < stride(); ++m) row[m - period_x_] += row[m];
    }
}

void FarField::unfold(double* mesh) const {
    for (std::size_t n = 0; n < period_y_; ++n) {
        double* row = mesh + n * stride();
        for (std::size_t m = period_x_; m < stride(); ++m) row[m] = row[m - period_x_];
    }
    for (std::size_t n = period_y_; n < rows_; ++n)
        std::copy_n(mesh + (n - period_y_) * stride(), stride(), mesh + n * stride());
}

// Transform of F on the periodic mesh, multiplied by the optimal correction for spreading and
// interpolation, u^2 / (sum of squares of the window's aliases)^2, where u is the transform of the
// window.
void FarField::make_multiplier(const MeshDesign& design,
                               const std::function<double(std::size_t, std::size_t)>& value) {
    const std::size_t half_x = period_x_ / 2, half_y = period_y_ / 2;
    const auto corrections = [&design](std::size_t period) {
        std::vector<double> correction(period / 2 + 1);
        for (std::size_t m = 0; m <= period / 2; ++m) {
            const double k = 2 * pi * static_cast<double>(m) / static_cast<double>(period);
            correction[m] = std::pow(window_transform(design, k) / window_alias_sum(design, k), 2) /
                            static_cast<double>(period);
        }
        return correction;
    };
    const std::vector<double> cx = corrections(period_x_), cy = corrections(period_y_);

    // The kernel is even, so half of the rows and real transforms suffice.
    const FftwArray half = fftw_array((half_y + 1) * (half_x + 1));
    const int threads = threads_for(points());
    const std::vector<FftwArray> row_of = buffers(threads, stride()),
                                 block_of = buffers(threads, 2 * kColumns * period_y_);
    parallel_for(half_y + 1, kRows, threads, [&](std::size_t n, std::size_t worker) {
        double* const row = row_of[worker].get();
        for (std::size_t m = 0; m <= half_x; ++m) {
            const double part = value(m, n);
            row[m] = part;
            if (m > 0) row[period_x_ - m] = part;
        }
        fftw_execute_dft_r2c(row_forward_.get(), row, as_complex(row));
        for (std::size_t m = 0; m <= half_x; ++m) half[n * (half_x + 1) + m] = row[2 * m] * cx[m];
    });

    multiplier_ = fftw_array(columns_ * (half_y + 1));
    const std::size_t blocks = columns_ / kColumns;
    parallel_for(blocks, 1, threads, [&](std::size_t b, std::size_t worker) {
        double* const block = block_of[worker].get();
        std::fill_n(block, 2 * kColumns * period_y_, 0.0);
        for (std::size_t n = 0; n < period_y_; ++n)
            for (std::size_t c = 0; c < kColumns && b * kColumns + c <= half_x; ++c)
                block[2 * (n * kColumns + c)] =
                    half[std::min(n, period_y_ - n) * (half_x + 1) + b * kColumns + c];
        fftw_execute_dft(column_forward_.get(), as_complex(block), as_complex(block));
        double* to = multiplier_.get() + b * (half_y + 1) * kColumns;
        for (std::size_t n = 0; n <= half_y; ++n)
            for (std::size_t c = 0; c < kColumns; ++c)
                to[n * kColumns + c] = block[2 * (n * kColumns + c)] * cy[n];
    });
}

void FarField::convolve(double* mesh) const {
    const std::size_t half_y = period_y_ / 2, blocks = columns_ / kColumns,
                      used = (period_x_ / 2) / kColumns + 1;
    const std::size_t rows = periodic_ ? period_y_ : rows_;
    if (periodic_) fold(mesh);
    const int threads = threads_for(points());
    const std::vector<FftwArray> block_of = buffers(threads, 2 * kColumns * period_y_);
    parallel_for(rows, kRows, threads, [&](std::size_t n) {
        fftw_execute_dft_r2c(row_forward_.get(), mesh + n * stride(),
                             as_complex(mesh + n * stride()));
    });
    // Columns are transformed, multiplied and transformed back a few at a time, in the cache; rows
    // without points are never stored.
    parallel_for(std::min(blocks, used), 1, threads, [&](std::size_t b, std::size_t worker) {
        constexpr std::size_t kRow = 2 * kColumns;
        double* const block = block_of[worker].get();
        for (std::size_t n = 0; n < rows; ++n)
            std::copy_n(mesh + n * stride() + b * kRow, kRow, block + n * kRow);
        std::fill(block + rows * kRow, block + period_y_ * kRow, 0.0);
        fftw_execute_dft(column_forward_.get(), as_complex(block), as_complex(block));
        const double* factors = multiplier_.get() + b * (half_y + 1) * kColumns;
        for (std::size_t n = 0; n < period_y_; ++n) {
            const double* factor = factors + std::min(n, period_y_ - n) * kColumns;
            double* value = block + n * kRow;
            for (std::size_t c = 0; c < kColumns; ++c) {
                value[2 * c] *= factor[c];
                value[2 * c + 1] *= factor[c];
            }
        }
        fftw_execute_dft(column_backward_.get(), as_complex(block), as_complex(block));
        for (std::size_t n = 0; n < rows; ++n)
            std::copy_n(block + n * kRow, kRow, mesh + n * stride() + b * kRow);
    });
    parallel_for(rows, kRows, threads, [&](std::size_t n) {
        fftw_execute_dft_c2r(row_backward_.get(), as_complex(mesh + n * stride()),
                             mesh + n * stride());
    });
    if (periodic_) unfold(mesh);
}

}  // namespace rsc
