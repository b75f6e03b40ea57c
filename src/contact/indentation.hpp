// A rough surface of asperities pressed by a sphere: the problem at one separation, and its answer (paper, section 4).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rough/asperities.hpp"

namespace rsc {

enum class Method { automatic, dgesv, direct, mesh };
enum class Selection { overlap, paper };
enum class Interaction { point, hertz, none };
enum class LawKind { hertz, elliptic, fourth_order };

// The equivalent problem: elastic half-space E_star, smooth rigid sphere of radius R (Infinity: flat) with its tip above (x0, y0).
struct Indenter {
    double E_star = 0;  // [force/length^2]
    double R = 0;       // [length]
    double x0 = 0, y0 = 0;
};

struct SolverOptions {
    Method method = Method::automatic;
    LawKind law = LawKind::hertz;
    Interaction interaction = Interaction::point;
    Selection selection = Selection::overlap;
    double selection_factor = 1.5;
    double sigma = 0;         // rms height: unit of delta0 and of selection='paper' [length]
    double tolerance = 1e-6;  // relative residual of F - C<G0 - B F>^(3/2)
    int max_iterations = 100;
    double delta0 = 0.01;     // first regularisation of the paper's method, in sigma
    double delta_cut = 5.0;   // the paper's method divides delta by this each iteration (the paper: 2 to 10)
    double mean_spacing = 0;  // <d> = 1/sqrt(D), for counting contacts with a > <d>/4; 0: not counted
};

// How a level ended; the larger is the more serious. Values are those of `status` in the result file.
enum class LevelStatus : std::int32_t { converged = 0, out_of_validity = 1, overlapping = 2, not_unique = 3, not_converged = 4 };

struct Level {
    double separation = 0;           // Z0 [length]
    double force = 0;                // N = sum f [force]
    double area = 0;                 // A = sum pi a^2 (hertz, the paper's), or of the union of the elliptic spots [length^2]
    double residual = 0;             // |F - C<G0 - B F>^(3/2)| / |F|, unregularised, over all candidates
    int candidates = 0;              // asperities the solver was given
    int iterations = 0;              // Newton steps
    long products = 0;               // products with B (matrix-free methods), solves (dgesv)
    long overlapping_pairs = 0;      // pairs with d < a_i + a_j
    int large_contacts = 0;          // contacts with a > <d>/4
    int beyond_law = 0;              // contacts past the range in which the law's profile describes a summit
    Method method = Method::direct;  // the one used
    LevelStatus status = LevelStatus::converged;
    // The contacts, by increasing asperity index (0-based):
    std::vector<int> asperity;
    std::vector<double> f;  // [force]
    std::vector<double> a;  // contact radius [length]; area pi a^2
    std::vector<double> u;  // penetration with interaction [length]
};

}  // namespace rsc
