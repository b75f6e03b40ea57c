// The smooth part s(d) of the answer to a unit force, G(d) = 1/(pi E* d) + s(d): what layers change. Kept as a table.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace rsc {

// A smooth function of a square, v = value(t^2), as polynomials of degree 7 in y = 1 + t^2/unit^2, eight to an octave of y.
class SquareTable {
public:
    static constexpr int kDegree = 7, kPiecesPerOctave = 8, kOctaves = 80;
    static constexpr std::size_t kPieces = std::size_t{kOctaves} * kPiecesPerOctave;

    // `value(t)` for t >= 0. Beyond t = 2^40 unit the table keeps its last value.
    SquareTable(double unit, const std::function<double(double)>& value);

    double unit() const { return unit_; }
    double at_square(double t2) const;
    // The integral of v t dt from 0 to t.
    double moment(double t) const;
    // to[i] += sum over j of f[j] v((xt[i] - xs[j])^2 + (yt[i] - ys[j])^2). The arrays do not overlap.
    void add(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources, const double* xs, const double* ys,
             const double* f, double* to) const;

private:
    double unit_, inverse_square_;
    std::vector<double> coefficient_;  // [degree][piece], of powers of the distance from the middle of the piece over its octave
    std::vector<double> sum_;          // the integral of v dy up to each piece
};

class SmoothPart {
public:
    // s(d) for d >= 0 [length/force]; share(k) for k > 0, with which a mode of pressure of the wavenumber k [1/length] answers
    // 2/(E* k) (1 + share(k)) of itself: E* k/2 times the two-dimensional Fourier transform of s. `scale` [length]: s changes little
    // within it, that is, share(k) falls like exp(-k scale) and d^2 may be replaced by -scale^2 before s has a singularity.
    SmoothPart(const std::function<double(double)>& s, std::function<double(double)> share, double scale);

    double at(double d) const { return table_.at_square(d * d); }
    double at_square(double d2) const { return table_.at_square(d2); }
    double share(double k) const { return share_(k); }
    double scale() const { return table_.unit(); }
    // The integral of s over the rectangle |x' - x| < a, |y' - y| < b, d the distance of (x', y') from 0.
    double over_rectangle(double x, double y, double a, double b) const;
    const SquareTable& table() const { return table_; }

private:
    double corner(double s, double t) const;

    SquareTable table_;
    std::function<double(double)> share_;
};

}  // namespace rsc
