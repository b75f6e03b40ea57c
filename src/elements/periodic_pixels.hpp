// Deflections of a periodic surface under pressures on all its pixels: products with K by Fourier
// transforms over the whole period.
#pragma once

#include "base/array.hpp"

namespace rsc {

// Half-space of modulus E* with nx x ny pixels of sides dx, dy, periodic in both directions.
// Pressures are samples of a band-limited function at the pixel centres. Each mode exp(i k x), |kx|
// <= pi/dx and |ky| <= pi/dy, causes a deflection of 2/(E* |k|) (1 + share(|k|)) times itself
// (Johnson 1985, section 13.2; kernel.hpp), and k = 0 none: deflections are measured from the mean
// plane. K is symmetric, and positive definite except for k = 0. Real is float or double; results
// do not depend on the number of threads.
template <class Real>
class PeriodicPixels {
public:
    // `share` is a function of the wavenumber times dx; empty: homogeneous half-space. `plane`,
    // which must outlive this, is memory for the plane, which others may use between calls. Throws
    // Error(no_memory), or Error(bad_input) if the grid is too large.
    PeriodicPixels(int nx, int ny, double dx, double dy,
                   const std::function<double(double)>& share = {}, Array<double>* plane = nullptr);
    // Any kernel that is even in both directions: modes[j (nx/2 + 1) + i], i <= nx/2, j <= ny/2, is
    // the factor of the modes of wavenumbers 2 pi i/(nx dx) and 2 pi j/(ny dy), of k = 0, too.
    PeriodicPixels(int nx, int ny, const std::vector<double>& modes);
    ~PeriodicPixels();
    PeriodicPixels(const PeriodicPixels&) = delete;
    PeriodicPixels& operator=(const PeriodicPixels&) = delete;

    // Row j of the plane on which the transforms operate, nx numbers.
    Real* row(int j) { return reinterpret_cast<Real*>(plane_->data()) + at(j) * stride_; }
    const Real* row(int j) const {
        return reinterpret_cast<const Real*>(plane_->data()) + at(j) * stride_;
    }

    enum class Answer { deflection, pressure };
    // Multiplies the plane by K/unit(), or by unit() K^-1 with mean 0. `load(j, row)` fills each
    // row before, `take(j, row)` may read it afterwards; both are called concurrently for different
    // rows.
    using Load = std::function<void(int, Real*)>;
    using Take = std::function<void(int, const Real*)>;
    void apply(const Load& load, const Take& take, Answer answer = Answer::deflection);

    // dx/E* for E* = 1 [length/pressure]. Values in the plane exclude this factor and are of order
    // 1, also in float.
    double unit() const { return dx_; }

    std::size_t bytes() const;

private:
    template <class>
    friend class VectorPixels;
    void columns(Answer answer);
    void forward_rows(const Load& load);
    void backward_rows(const Take& take);
    // The memory of a thread for a mode's column, and for a block of columns.
    struct Columns {
        Real *modes, *block;
    };
    Columns columns_from_plane(int block, std::size_t worker);
    void columns_to_plane(int block, std::size_t worker);
    void forward(const Columns& columns, int column);
    void backward(const Columns& columns, int column);
    void scale_row(Answer answer);
    void make_plans();
    template <class Factor>
    void set_factors(Factor&& factor);

    struct Plans;

    int nx_, ny_;
    double dx_, dy_;
    std::size_t stride_;
    bool threads_;
    Array<double> own_;  // unless the plane is of others
    Array<double>* plane_ = &own_;
    bool half_space_ = true;  // modes are multiplied by 2/|k|, too
    // Factors of the modes with ky >= 0, [column][row]: 1 + share; none for a homogeneous
    // half-space.
    Array<Real> layered_;
    std::unique_ptr<Plans> plans_;
};

extern template class PeriodicPixels<float>;
extern template class PeriodicPixels<double>;

// The modes of a kernel on a periodic plane of nx x ny pixels, by i <= nx/2 and j <= ny/2 as for
// PeriodicPixels. value(i, j), |i| <= nx/2 and |j| <= ny/2, is even in both offsets, or odd in
// both: it is called for i, j >= 0 only.
std::vector<double> modes_of(int nx, int ny, bool odd,
                             const std::function<double(int, int)>& value);

// The modes of a kernel between two components, symmetric: xx and yy are even in both directions,
// xy is odd in both.
struct VectorModes {
    std::vector<double> xx, xy, yy;
};

// Products of two components with such a kernel, as PeriodicPixels of each.
template <class Real>
class VectorPixels {
public:
    VectorPixels(int nx, int ny, const VectorModes& modes);
    using Load = std::function<void(int row, Real* x, Real* y)>;
    using Take = std::function<void(int row, const Real* x, const Real* y)>;
    void apply(const Load& load, const Take& take);

private:
    void mix(Real* x, Real* y, int column) const;

    PeriodicPixels<Real> x_, y_;
    Array<Real> xx_, xy_, yy_;  // [column][row <= ny/2]
};

extern template class VectorPixels<float>;
extern template class VectorPixels<double>;

}  // namespace rsc
