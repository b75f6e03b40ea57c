#include "contact/equivalent.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

[[noreturn]] void refuse(const std::string& what, int body, const std::string& expected) {
    bad_input(what, " of body ", body + 1, " must be ", expected);
}

}  // namespace

double equivalent_modulus(const double (&E)[2], const double (&nu)[2]) {
    double compliance = 0;
    for (const int i : indices(2)) {
        if (!(E[i] > 0)) refuse("Young's modulus", i, "positive (Infinity for a rigid body)");
        if (!(nu[i] >= -1 && nu[i] <= 0.5)) refuse("Poisson's ratio", i, "between -1 and 0.5");
        compliance += (1 - nu[i] * nu[i]) / E[i];  // 0 for E = Infinity
    }
    if (!(compliance > 0))
        bad_input("both bodies are rigid: at least one modulus E must be finite");
    return 1 / compliance;
}

double equivalent_radius(const double (&R)[2]) {
    for (const int i : indices(2))
        if (R[i] == 0 || std::isnan(R[i]))
            refuse("radius", i, "other than 0 (Infinity for a flat body)");
    const double curvature = 1 / R[0] + 1 / R[1];
    if (!(curvature > 0) && !(std::isinf(R[0]) && std::isinf(R[1])))
        bad_input("bodies of radii ", R[0], " and ", R[1],
                  " do not touch at one point: 1/R1 + 1/R2 must be positive (a concave body needs "
                  "a larger radius than the convex one)");
    return curvature > 0 ? 1 / curvature : kInfinity;
}

double tangential_ratio(const double (&E)[2], const double (&nu)[2]) {
    const double E_star = equivalent_modulus(E, nu);
    double compliance = 0;  // 1/(2 G*)
    for (const int i : indices(2)) compliance += (2 - nu[i]) * (1 + nu[i]) / E[i];
    return 2 / (E_star * compliance);
}

}  // namespace rsc
