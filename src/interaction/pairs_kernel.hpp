// Table of the pair loops of one instruction set, internal to this folder.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rsc {

// all counts and strides are multiples of it; arrays need no alignment
constexpr std::size_t kPairPadding = 16;
constexpr int kNearDegree = 31;      // largest degree of a near-field polynomial
constexpr double kSingleWeight = 2;  // single-precision loops return phi multiplied by this

// Short-range kernel w(d) = 1/d - F(d) for d^2 < cutoff2, 0 elsewhere, with the smooth F(d) = sum_k
// c[k] (cutoff2 - d^2)^k. Coinciding points (including a point with itself) contribute -F(0), which
// cancels their contribution to the smooth far field.
struct NearKernel {
    double cutoff2 = 0, reach = 0;  // reach^2 = cutoff2
    int degree = 0;
    double c[kNearDegree + 1] = {};
};

// largest number of mesh points per side over which a point is spread
constexpr int kWindowWidth = 16;
constexpr int kWindowDegree = 23;  // largest degree of its polynomials

// Spreading window, a product of two one-dimensional windows of `width` mesh points. Mesh point m,
// counted from the first one above u - width/2, has the weight sum_k c[k][m] t^k, with t in [-1, 1]
// across a mesh cell.
struct MeshWindow {
    int width = 0, degree = 0;
    double c[kWindowDegree + 1][kWindowWidth] = {};
};

// Coordinates are double if Real = double, and 32-bit integers whose differences fit if Real =
// float. All loops add to phi. Padding has f = 0.
template <class Real, class Coordinate>
struct PairLoops {
    // All pairs within n points, in both directions.
    void (*self)(std::size_t n, const Coordinate* x, const Coordinate* y, const Real* f, Real* phi);
    // All pairs between two disjoint sets, in both directions.
    void (*cross)(std::size_t ni, const Coordinate* xi, const Coordinate* yi, const Real* fi,
                  Real* phi_i, std::size_t nj, const Coordinate* xj, const Coordinate* yj,
                  const Real* fj, Real* phi_j);
    // Sources j onto targets i.
    void (*onto)(std::size_t ni, const Coordinate* xi, const Coordinate* yi, Real* phi_i,
                 std::size_t nj, const Coordinate* xj, const Coordinate* yj, const Real* fj);
};

struct PairKernels {
    const char* name;
    PairLoops<double, double> exact;
    PairLoops<float, std::int32_t> single;
    // Sums with a short-range kernel instead of 1/d, for strips of points by increasing x. n counts
    // points without padding; a strip is followed by kPairPadding points without force that lie
    // beyond the reach of all others.
    void (*near_own)(const NearKernel& kernel, std::size_t n, const double* x, const double* y,
                     const double* f, double* phi);
    void (*near_strips)(const NearKernel& kernel, std::size_t ni, const double* xi,
                        const double* yi, const double* fi, double* phi_i, std::size_t nj,
                        const double* xj, const double* yj, const double* fj, double* phi_j);
    // Spread forces onto the mesh and interpolate potentials from it. u and v are in units of the
    // mesh spacing; rows of the mesh (v) are
    // `stride` apart. From floor(u - width/2) + 1 on, kWindowWidth columns and `width` rows are
    // accessed.
    void (*spread)(const MeshWindow& window, std::size_t n, const double* u, const double* v,
                   const double* f, double* mesh, std::size_t stride);
    void (*interpolate)(const MeshWindow& window, std::size_t n, const double* u, const double* v,
                        double* phi, const double* mesh, std::size_t stride);
};

// Table for "sse2" ("generic" unless x86-64), "avx2" or "avx512"; nullptr if this build or
// processor does not support it.
const PairKernels* pair_kernels(const char* instruction_set);
// Table of the best supported instruction set.
const PairKernels& pair_kernels();

}  // namespace rsc
