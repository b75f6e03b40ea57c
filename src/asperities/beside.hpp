// Summits under tips a small step beside the present one, and the lateral force from them: the
// gradient of the energy.
#pragma once

#include "asperities/asperity_level.hpp"

namespace rsc {

// With forces f_i in equilibrium, the energy at a fixed separation is stationary with respect to
// them,
//     dW = sum f_i dg0_i - f'dB f/2 + sum dW_i,
// where the place of summit i, which determines g0_i and its row of B, and its curvatures, which
// determine the work W_i at a given penetration, change with the tip if it is a summit of the
// difference. The differentials are central differences between four tips.
class SummitsBeside {
public:
    // A tip beside, with the summits there under the numbers of those of the present tip, and their
    // law.
    struct Tip {
        Indenter indenter;
        FoundSummits found;
        std::unique_ptr<Law> law;
    };
    using LawOf = std::function<std::unique_ptr<Law>(const FoundSummits&, const Indenter&)>;

    // The bodies must outlive this object. `jumps`: the work may jump between the tips (most loaded
    // ellipses).
    explicit SummitsBeside(const ContactBodies& bodies, bool jumps = false)
        : bodies_(bodies), jumps_(jumps) {}

    // True if summits change with the tip in a way that can be followed: those of the difference,
    // if they were moved or their heights are kept.
    bool known() const {
        return bodies_.of_difference &&
               (bodies_.of_difference->map || !bodies_.of_difference->renumbered);
    }

    // Follows these summits to all tips, besides those followed since the tip moved, and makes the
    // laws.
    void follow(std::span<const int> asperities, const LawOf& law_of);
    void forget() { tips_.clear(); }

    // -dW/d(x0, y0) for the forces f of `asperities`, which are followed. work(tip, k): W_k beside
    // the present tip, and the force that belongs to it; f_k may be a share of it, of a pressure of
    // the same kind. `lasting`: the instantaneous loads on other asperities are those forces, not f
    // (relaxing bodies).
    Vec2 lateral(const std::vector<int>& asperities, const std::vector<double>& f, bool lasting,
                 const std::function<Response(Tip&, std::size_t)>& work);

private:
    double step() const {
        return 5e-4 * (bodies_.of_difference->map ? bodies_.of_difference->map->dx
                                                  : bodies_.options.grid_step);
    }

    const ContactBodies& bodies_;
    bool jumps_;
    std::deque<Tip>
        // west, east, south, north, and if the work jumps the present one; laws refer to them
        tips_;
    double x0_ = 0, y0_ = 0;  // the tip between them
    std::vector<bool> followed_;
};

}  // namespace rsc
