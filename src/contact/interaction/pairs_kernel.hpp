// The table of pair loops that one instruction set provides. Inside the room only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rsc {

constexpr std::size_t kPairPadding = 16;  // every count and stride is a multiple of it, arrays need no alignment
constexpr int kNearDegree = 31;           // the largest degree of a near-field polynomial
constexpr double kSingleWeight = 2;       // the single precision loops return this times phi

// Short-range kernel w(d) = 1/d - F(d) for d^2 < cutoff2, 0 elsewhere, with the smooth F(d) = sum_k c[k] (cutoff2 - d^2)^k.
// Points that coincide (a point with itself among them) get -F(0): that takes away what a smooth far field gives them.
struct NearKernel {
    double cutoff2 = 0, reach = 0;  // reach^2 = cutoff2
    int degree = 0;
    double c[kNearDegree + 1] = {};
};

constexpr int kWindowWidth = 16;   // the largest number of mesh points a side that a point is spread over
constexpr int kWindowDegree = 23;  // the largest degree of its polynomials

// Spreading window, a product of two one-dimensional ones of `width` mesh points. Mesh point m of the width, counted from the
// first one above u - width/2, has the weight sum_k c[k][m] t^k, t in [-1, 1] across a mesh cell.
struct MeshWindow {
    int width = 0, degree = 0;
    double c[kWindowDegree + 1][kWindowWidth] = {};
};

// Real = double: coordinates double. Real = float: coordinates 32-bit integers whose differences fit.
// phi is added to everywhere. Pads carry f = 0.
template <class Real, class Coordinate>
struct PairLoops {
    // All pairs within n points, both ways.
    void (*self)(std::size_t n, const Coordinate* x, const Coordinate* y, const Real* f, Real* phi);
    // All pairs between two disjoint sets, both ways.
    void (*cross)(std::size_t ni, const Coordinate* xi, const Coordinate* yi, const Real* fi, Real* phi_i, std::size_t nj,
                  const Coordinate* xj, const Coordinate* yj, const Real* fj, Real* phi_j);
    // Sources j onto targets i.
    void (*onto)(std::size_t ni, const Coordinate* xi, const Coordinate* yi, Real* phi_i, std::size_t nj, const Coordinate* xj,
                 const Coordinate* yj, const Real* fj);
};

struct PairKernels {
    const char* name;
    PairLoops<double, double> exact;
    PairLoops<float, std::int32_t> single;
    // The same with a short-range kernel instead of 1/d, for strips of points by increasing x: n counts points without pads; a
    // strip has room for kPairPadding more after it, where points without force lie farther off than the reach.
    void (*near_own)(const NearKernel& kernel, std::size_t n, const double* x, const double* y, const double* f, double* phi);
    void (*near_strips)(const NearKernel& kernel, std::size_t ni, const double* xi, const double* yi, const double* fi, double* phi_i,
                        std::size_t nj, const double* xj, const double* yj, const double* fj, double* phi_j);
    // Adds forces to the mesh, and reads potentials off it. u and v are in mesh spacings; the mesh is row by row (v), `stride`
    // apart, and is touched from floor(u - width/2) + 1 on, kWindowWidth columns and width rows.
    void (*spread)(const MeshWindow& window, std::size_t n, const double* u, const double* v, const double* f, double* mesh,
                   std::size_t stride);
    void (*interpolate)(const MeshWindow& window, std::size_t n, const double* u, const double* v, double* phi, const double* mesh,
                        std::size_t stride);
};

// The table for "sse2" ("generic" elsewhere than on x86-64), "avx2" or "avx512"; nullptr if this build or this processor has not got it.
const PairKernels* pair_kernels(const char* instruction_set);
// The best one.
const PairKernels& pair_kernels();

}  // namespace rsc
