#include "rough/refine.hpp"

#include "rough/dispatch.hpp"
#include "rough/summits.hpp"

namespace rsc {
namespace {

constexpr int kTaps = Stencil::kTaps;
constexpr int kOrders = Stencil::kOrders;
constexpr int kLanes = 8;  // partial sums, fixed so that a sum has the same bits on every machine

// derivative[p][q]: orders p in x and q in y (indices into Stencil::kOrder) from a square of `points` x `points` heights at `corner`.
RSC_ALWAYS_INLINE void contract_body(const double* corner, int points, int orders, const double (*wx)[kTaps], const double (*wy)[kTaps],
                                     double (*derivative)[kOrders]) {
    for (int q = 0; q < orders; ++q) {
        double line[kTaps] = {};
        for (int j = 0; j < points; ++j) {
            const double* const z = corner + j * Patch::kStride;
            const double w = wy[q][j];
            for (int i = 0; i < kTaps; ++i) line[i] += w * z[i];
        }
        for (int p = 0; p < orders; ++p) {
            double lanes[kLanes] = {};
            for (int i = 0; i < kTaps; i += kLanes)
                for (int l = 0; l < kLanes; ++l) lanes[l] += wx[p][i + l] * line[i + l];
            double sum = 0;
            for (int l = 0; l < kLanes; ++l) sum += lanes[l];
            derivative[p][q] = sum;
        }
    }
}

RSC_DISPATCH(contract, contract_body,
             (const double* corner, int points, int orders, const double (*wx)[kTaps], const double (*wy)[kTaps],
              double (*derivative)[kOrders]),
             (corner, points, orders, wx, wy, derivative))

struct Step {
    double x = 0, y = 0;
    bool peak = false;  // the step is Newton's, and the surface is concave
};

Step step_to_summit(const PointDifferences& d) {
    const double determinant = d.determinant();
    Step s;
    if (determinant > 0 && d.zxx + d.zyy < 0) {
        s = {d.step_x() / determinant, d.step_y() / determinant, true};
        const double longest = std::max(std::abs(s.x), std::abs(s.y));
        if (longest > 1) s = {s.x / longest, s.y / longest, true};
    } else if (const double slope = std::hypot(d.zx, d.zy); slope > 0) {
        s = {0.5 * d.zx / slope, 0.5 * d.zy / slope, false};
    }
    return s;
}

// First step from second differences about the middle point; saves one or two evaluations.
Step first_step(const Patch& patch) {
    constexpr int m = Patch::kMargin;
    return step_to_summit(differences(patch.z[m - 1], patch.z[m], patch.z[m + 1], m - 1, m, m + 1));
}

}  // namespace

std::optional<RefinedSummit> refine(const Stencil& stencil, const Patch& patch, int travel, const PatchAbove& less) {
    constexpr int kMostSteps = 40;  // three or four are usual; more along a ridge
    // The last step changes position and height only; the derivatives are those of the last evaluation.
    constexpr double kNear = 1e-4;     // after a shorter step the next evaluation is the last, with an error of kNear^2
    constexpr double kArrived = 1e-7;  // longest accepted step after the last evaluation
    const Step start = less.above ? Step{} : first_step(patch);
    double x = start.peak ? start.x : 0, y = start.peak ? start.y : 0;
    bool last = false;
    for (int k = 0; k < kMostSteps; ++k) {
        const double rx = std::round(x), ry = std::round(y);
        if (!(std::abs(rx) <= travel && std::abs(ry) <= travel)) return {};
        if (!(rx >= patch.first_x && rx <= patch.last_x && ry >= patch.first_y && ry <= patch.last_y)) return {};
        const int orders = last ? kOrders : 3;
        alignas(64) double wx[kOrders][kTaps], wy[kOrders][kTaps];
        stencil.weights(x - rx, orders, wx);
        stencil.weights(y - ry, orders, wy);
        double d[kOrders][kOrders];
        const int corner = Patch::kMargin - stencil.reach();
        contract(&patch.z[corner + static_cast<int>(ry)][corner + static_cast<int>(rx)], 2 * stencil.reach() + 1, orders, wx, wy, d);
        if (less.above) {
            const BodyAbove::Form f = less.above->at(less.x + x * less.dx, less.y + y * less.dy);
            if (!std::isfinite(f.height)) return {};
            d[0][0] -= f.height;
            d[1][0] -= f.x * less.dx, d[0][1] -= f.y * less.dy;
            d[2][0] -= f.xx * less.dx * less.dx, d[1][1] -= f.xy * less.dx * less.dy, d[0][2] -= f.yy * less.dy * less.dy;
        }
        const Step s = step_to_summit({d[1][0], d[0][1], d[2][0], d[1][1], d[0][2]});
        const double length = std::max(std::abs(s.x), std::abs(s.y));
        if (last && s.peak && length <= kArrived) {
            // The remaining height to the top is half of gradient times step.
            return RefinedSummit{
                x + s.x, y + s.y, d[0][0] + 0.5 * (d[1][0] * s.x + d[0][1] * s.y), d[2][0], d[1][1], d[0][2], d[4][0], d[3][1], d[2][2],
                d[1][3], d[0][4]};
        }
        last = s.peak && length <= kNear;
        x += s.x;
        y += s.y;
        if (!s.peak && length == 0) return {};  // stationary, but no peak
    }
    return {};
}

}  // namespace rsc
