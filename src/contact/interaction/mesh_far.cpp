#include "contact/interaction/mesh_far.hpp"

#include <omp.h>

#include "error.hpp"
#include "rough/parallel.hpp"

namespace rsc {

namespace {

// The smallest even number >= n with no prime factor above 7.
std::size_t transform_length(double n) {
    for (auto length = static_cast<std::size_t>(std::ceil(n / 2)) * 2;; length += 2) {
        std::size_t rest = length;
        for (std::size_t factor : {2, 3, 5, 7})
            while (rest % factor == 0) rest /= factor;
        if (rest == 1) return length;
    }
}

// The doubled mesh holds every difference of two points with its sign, and room for the kernel to bend where it wraps around.
double period_needed(const MeshDesign& design, double length) { return 2 * length + 4 * design.cutoff + 2; }

// A mesh this small is not worth the threads.
int threads_for(std::size_t points) { return points < 65536 ? 1 : static_cast<int>(most_threads(0)); }

// A buffer a thread, made before the threads start: what is thrown inside of a parallel region is lost.
std::vector<FftwArray> buffers(int threads, std::size_t n) {
    std::vector<FftwArray> all;
    for (int t = 0; t < threads; ++t) all.push_back(fftw_array(n));
    return all;
}

// F at the square distance d2 of a kernel's cutoff.
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
    if (!array) throw Error(Failure::no_memory, "no memory for a mesh of " + std::to_string(n * sizeof(double) >> 20) + " MB");
    return array;
}

double FarField::points_needed(const MeshDesign& design, double length_x, double length_y) {
    return period_needed(design, length_x) * period_needed(design, length_y);
}

FarField::FarField(const MeshDesign& design, double length_x, double length_y, double spacing, const Kernel& of)
    : period_x_(transform_length(period_needed(design, length_x))), period_y_(transform_length(period_needed(design, length_y))) {
    rows_ = static_cast<std::size_t>(length_y) + static_cast<std::size_t>(design.width) + 1;
    // A window is written kWindowWidth wide whatever its width.
    const std::size_t complex_columns = std::max(period_x_ / 2 + 1, (static_cast<std::size_t>(length_x) + 2 + kWindowWidth) / 2 + 1);
    columns_ = (complex_columns + kColumns - 1) / kColumns * kColumns;

    make_plans();
    const NearKernel kernel = near_kernel(design, design.cutoff);
    const auto squares = [&design](std::size_t period, double length) {
        const auto size = static_cast<double>(period);
        std::vector<double> square(period / 2 + 1);
        for (std::size_t m = 0; m <= period / 2; ++m) square[m] = periodic_square(design, static_cast<double>(m), size, size / 2 - length);
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
    const double dx = lattice.period().x / static_cast<double>(period_x_), dy = lattice.period().y / static_cast<double>(period_y_);
    make_multiplier(design, [&](std::size_t m, std::size_t n) {
        const double x = static_cast<double>(m) * dx, y = static_cast<double>(n) * dy;
        return far_part(kernel, x * x + y * y) + lattice.rest(x, y) - lattice.least();
    });
}

void FarField::make_plans() {
    const int nx = static_cast<int>(period_x_), ny = static_cast<int>(period_y_), many = static_cast<int>(kColumns);
    const FftwArray row = fftw_array(stride()), block = fftw_array(2 * kColumns * period_y_);
    {
        const auto lock = fftw_planning();
        row_forward_.reset(fftw_plan_dft_r2c_1d(nx, row.get(), as_complex(row.get()), FFTW_ESTIMATE));
        row_backward_.reset(fftw_plan_dft_c2r_1d(nx, as_complex(row.get()), row.get(), FFTW_ESTIMATE));
        fftw_complex* b = as_complex(block.get());
        column_forward_.reset(fftw_plan_many_dft(1, &ny, many, b, nullptr, many, 1, b, nullptr, many, 1, FFTW_FORWARD, FFTW_ESTIMATE));
        column_backward_.reset(fftw_plan_many_dft(1, &ny, many, b, nullptr, many, 1, b, nullptr, many, 1, FFTW_BACKWARD, FFTW_ESTIMATE));
    }
    if (!row_forward_ || !row_backward_ || !column_forward_ || !column_backward_)
        throw Error(Failure::internal, "FFTW made no plan for a mesh of " + std::to_string(nx) + " x " + std::to_string(ny));
}

// Before the transforms every point of the mesh stands once; afterwards windows reach across the border again.
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
    for (std::size_t n = period_y_; n < rows_; ++n) std::copy_n(mesh + (n - period_y_) * stride(), stride(), mesh + n * stride());
}

// Transform of F on the periodic mesh, times what makes up for spreading and interpolating: u^2 / (sum of squares of the window's
// aliases)^2 with u^2 the window's transform squared, the choice of least error.
void FarField::make_multiplier(const MeshDesign& design, const std::function<double(std::size_t, std::size_t)>& value) {
    const std::size_t half_x = period_x_ / 2, half_y = period_y_ / 2;
    const auto corrections = [&design](std::size_t period) {
        std::vector<double> correction(period / 2 + 1);
        for (std::size_t m = 0; m <= period / 2; ++m) {
            const double k = 2 * std::numbers::pi * static_cast<double>(m) / static_cast<double>(period);
            correction[m] = std::pow(window_transform(design, k) / window_alias_sum(design, k), 2) / static_cast<double>(period);
        }
        return correction;
    };
    const std::vector<double> cx = corrections(period_x_), cy = corrections(period_y_);

    // Rows: the kernel is even, so half of them, and real transforms.
    const FftwArray half = fftw_array((half_y + 1) * (half_x + 1));
    const int threads = threads_for(points());
    const std::vector<FftwArray> row_of = buffers(threads, stride()), block_of = buffers(threads, 2 * kColumns * period_y_);
#pragma omp parallel num_threads(omp_team(kEveryThread, threads))
    {
        double* row = row_of[static_cast<std::size_t>(omp_get_thread_num())].get();
#pragma omp for schedule(static)
        for (std::size_t n = 0; n <= half_y; ++n) {
            for (std::size_t m = 0; m <= half_x; ++m) {
                const double part = value(m, n);
                row[m] = part;
                if (m > 0) row[period_x_ - m] = part;
            }
            fftw_execute_dft_r2c(row_forward_.get(), row, as_complex(row));
            for (std::size_t m = 0; m <= half_x; ++m) half[n * (half_x + 1) + m] = row[2 * m] * cx[m];
        }
    }

    multiplier_ = fftw_array(multiplier_size());
    const std::size_t blocks = columns_ / kColumns;
#pragma omp parallel num_threads(omp_team(kEveryThread, threads))
    {
        double* block = block_of[static_cast<std::size_t>(omp_get_thread_num())].get();
#pragma omp for schedule(static)
        for (std::size_t b = 0; b < blocks; ++b) {
            std::fill_n(block, 2 * kColumns * period_y_, 0.0);
            for (std::size_t n = 0; n < period_y_; ++n)
                for (std::size_t c = 0; c < kColumns && b * kColumns + c <= half_x; ++c)
                    block[2 * (n * kColumns + c)] = half[std::min(n, period_y_ - n) * (half_x + 1) + b * kColumns + c];
            fftw_execute_dft(column_forward_.get(), as_complex(block), as_complex(block));
            double* to = multiplier_.get() + b * (half_y + 1) * kColumns;
            for (std::size_t n = 0; n <= half_y; ++n)
                for (std::size_t c = 0; c < kColumns; ++c) to[n * kColumns + c] = block[2 * (n * kColumns + c)] * cy[n];
        }
    }
}

void FarField::convolve(double* mesh) const {
    const std::size_t half_y = period_y_ / 2, blocks = columns_ / kColumns, used = (period_x_ / 2) / kColumns + 1;
    const std::size_t rows = periodic_ ? period_y_ : rows_;
    if (periodic_) fold(mesh);
    const int threads = threads_for(points());
    const std::vector<FftwArray> block_of = buffers(threads, 2 * kColumns * period_y_);
#pragma omp parallel num_threads(omp_team(kEveryThread, threads))
    {
#pragma omp for schedule(static)
        for (std::size_t n = 0; n < rows; ++n)
            fftw_execute_dft_r2c(row_forward_.get(), mesh + n * stride(), as_complex(mesh + n * stride()));

        // Columns, a few at a time: there and back while they are in the cache; the rows that hold no points are never stored.
        double* block = block_of[static_cast<std::size_t>(omp_get_thread_num())].get();
#pragma omp for schedule(static)
        for (std::size_t b = 0; b < std::min(blocks, used); ++b) {
            constexpr std::size_t kRow = 2 * kColumns;
            for (std::size_t n = 0; n < rows; ++n) std::copy_n(mesh + n * stride() + b * kRow, kRow, block + n * kRow);
            std::fill(block + rows * kRow, block + period_y_ * kRow, 0.0);
            fftw_execute_dft(column_forward_.get(), as_complex(block), as_complex(block));
            const double* factors = multiplier_.get() + b * (half_y + 1) * kColumns;
            for (std::size_t n = 0; n < period_y_; ++n) {
                const double* factor = factors + std::min(n, period_y_ - n) * kColumns;
                double* value = block + n * kRow;
                for (std::size_t c = 0; c < kColumns; ++c) value[2 * c] *= factor[c], value[2 * c + 1] *= factor[c];
            }
            fftw_execute_dft(column_backward_.get(), as_complex(block), as_complex(block));
            for (std::size_t n = 0; n < rows; ++n) std::copy_n(block + n * kRow, kRow, mesh + n * stride() + b * kRow);
        }

#pragma omp for schedule(static)
        for (std::size_t n = 0; n < rows; ++n)
            fftw_execute_dft_c2r(row_backward_.get(), as_complex(mesh + n * stride()), mesh + n * stride());
    }
    if (periodic_) unfold(mesh);
}

}  // namespace rsc
