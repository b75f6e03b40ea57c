// Matrix-vector products with the interaction matrix B (kernel.hpp; paper, section 4), which is not
// stored.
#pragma once

#include "interaction/kernel.hpp"

namespace rsc {

// Products over a working set of points, of which the active ones carry force. `full` products
// determine the final residual; `inner` products serve the iterations and may be less accurate.
class Products {
public:
    virtual ~Products() = default;

    // Sets the working set; coordinates are copied.
    virtual void set_points(int n, const double* x, const double* y) = 0;
    // The coordinates of the working set.
    const std::vector<double>& x() const { return x_; }
    const std::vector<double>& y() const { return y_; }
    // Sets the positions in the working set that carry force, in increasing order. Valid until the
    // next set_points().
    virtual void set_active(const std::vector<int>& active) = 0;

    // phi = B f at the active points; f, phi in the order of the active list.
    virtual void inner(const double* f, double* phi) = 0;
    // phi = B f at the passive (not active) points in increasing order; f over the active list;
    // inner accuracy.
    virtual void inner_passive(const double* f, double* phi) = 0;
    // phi = B f at every point of the working set, in inner accuracy.
    void inner_everywhere(const double* f, double* phi);
    // phi = B f of the active points at n other points, with an error of at most 1e-5 (2-norm).
    virtual void elsewhere(const double* f, int n, const double* x, const double* y,
                           double* phi) = 0;
    // phi = B f at every point of the working set, in full accuracy; f over the active list.
    virtual void full(const double* f, double* phi) = 0;

    const Kernel& kernel() const { return *kernel_; }

    // Relative error (2-norm) of full products.
    virtual double full_error() const = 0;
    virtual double inner_error() const = 0;
    const std::vector<int>& active() const { return active_; }
    const std::vector<int>& passive() const { return passive_; }
    long count() const { return count_; }  // number of products so far, a full one counting as one

protected:
    explicit Products(std::shared_ptr<const Kernel> kernel) : kernel_(std::move(kernel)) {}
    // Sets active_, and passive_ to the other positions in the working set.
    void divide(const std::vector<int>& active);
    // Coordinates of some points of the working set.
    void gather(const std::vector<int>& which, std::vector<double>& x,
                std::vector<double>& y) const;
    std::vector<double> x_, y_;  // of the working set
    std::vector<int> active_, passive_;
    std::shared_ptr<const Kernel> kernel_;
    std::vector<double> part_;
    long count_ = 0;
};

// Pairs per second on one core in direct inner sums among the given number of candidates, for the
// choice of the method.
double direct_rate(const Kernel& kernel, std::size_t candidates);

// Largest number of values that direct sums store for kernels with layers.
inline constexpr std::size_t kMostStoredValues = 8'000'000;

// Direct sums over pairs.
std::unique_ptr<Products> make_direct_products(std::shared_ptr<const Kernel> kernel);
// Particle-mesh sums; relative errors of full and inner products (2-norm).
std::unique_ptr<Products> make_mesh_products(std::shared_ptr<const Kernel> kernel,
                                             double full_error, double inner_error);

}  // namespace rsc
