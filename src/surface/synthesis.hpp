// Synthesis of surfaces in two steps: drawing the modes and transforming their columns along y,
// then transforming along x row by row on demand. This avoids half of the work of a two-dimensional
// transform, and rows are used while they are in the cache.
#pragma once

#include "base/library_lock.hpp"
#include "surface/surface.hpp"

namespace rsc {

struct ModeSums;

// True if the lay is nearer to the y axis than to the x axis. Such a surface is synthesised as that
// of transposed(), with x and y exchanged, so that a direction of 90 degrees gives the same bits as
// 0 degrees.
bool made_as_transpose(const Spectrum& spectrum);
Spectrum transposed(const Spectrum& spectrum);

class RowSource {
public:
    // Draws the modes and transforms their columns. Throws Error(bad_input) unless the spectrum is
    // valid, n is even and shortest_wave() <= n/2; Error(no_memory). `difference_step` is the grid
    // step of differences(); 0: L/n.
    RowSource(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed,
              std::int64_t realization, int threads, double difference_step = 0);

    int n() const { return n_; }
    bool exchanged() const { return exchanged_; }        // x and y of rows(): made_as_transpose()
    const Moments& sampled() const { return sampled_; }  // exact sums over the modes drawn
    // Moments by finite differences with `difference_step` (grid_moments), as exact sums.
    const Moments& differences() const { return differences_; }

    // Work space of one thread for rows().
    class Scratch {
    public:
        explicit Scratch(const RowSource& source);

    private:
        friend class RowSource;
        std::unique_ptr<double[], HeightMap::Free> coefficients_;
    };

    // Whether some of the heights z[0 ... count - 1], at the points (first ..., row) of the map,
    // are needed; called on all threads.
    using Filter = std::function<bool(int row, int first, int count, const double* z)>;

    // All heights, x and y in their places. If `filter` is given, pieces of rows that it refuses
    // may be 0; they take no memory.
    HeightMap all(int threads, const Filter& filter = {}) const;

    // Writes rows j, j+1, ... j+count-1 (j modulo n) to out, out+stride, ...; rows must be aligned
    // to 64 bytes. The values of a row depend, bit for bit, only on j.
    void rows(int j, int count, double* out, std::ptrdiff_t stride, Scratch& scratch) const;

    static constexpr int kBlock = 16;  // most efficient `count`

private:
    void draw(const Spectrum& spectrum, Normalise normalise, std::int64_t seed,
              std::int64_t realization, int threads, double difference_step);
    FftwPlan make_plans(double* column, double* row, std::complex<double>* stored);
    void scale_moments(const Spectrum& spectrum, Normalise normalise, const ModeSums& total,
                       const HeightShape& shape, double difference_step);
    void make_rows(int j, int count, double* out, std::ptrdiff_t stride,
                   double* coefficients) const;

    int n_ = 0;
    double L_ = 0;
    bool exchanged_ = false;
    int columns_ = 0;                   // 0 ... columns_ - 1 hold modes
    std::ptrdiff_t column_stride_ = 0;  // in complex numbers
    std::ptrdiff_t row_stride_ = 0;     // of the scratch rows, in doubles
    std::unique_ptr<double[], HeightMap::Free> columns_data_;
    double factor_ = 1;  // converts relative amplitudes to lengths
    Moments sampled_, differences_;
    FftwPlan row_plan_;
};

// Surface number `realization` of `seed` on n x n points, n even. The noise of a mode depends only
// on (seed, realization, integer wavevector), so that the surface is the same on every grid that
// resolves it: shortest_wave() <= n/2, otherwise Error(bad_input). The rms height is sigma, over
// the points of this surface (sample) or in expectation (ensemble). `sampled` (optional) receives
// the moments as exact sums over the modes drawn, and the shape of non-Gaussian heights. Results
// are independent of `threads`, bit for bit. make_asperities() (detection.hpp) finds the summits of
// the same surface without storing it.
HeightMap synthesize(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed,
                     std::int64_t realization, Moments* sampled = nullptr, int threads = 1);

}  // namespace rsc
