#include "contact/make.hpp"

#include "asperities/asperity_model.hpp"
#include "elements/element_model.hpp"
#include "elements/pixel_spots.hpp"
#include "physics/adhesion/adhesive_contact.hpp"
#include "physics/adhesion/adhesive_elements.hpp"
#include "physics/hardness/hardness.hpp"
#include "physics/relaxation/relaxing_asperities.hpp"
#include "physics/wear/wear.hpp"

namespace rsc {
namespace {

AsperityPhysics physics_of(const ContactBodies& bodies) {
    const SolverOptions& options = bodies.options;
    AsperityPhysics physics = make_yielding_asperities(
        bodies, make_law(options.law, bodies.asperities, bodies.indenter.E_star,
                         bodies.of_difference.get()));
    if (options.physics.relaxation.none()) return physics;
    return make_relaxing_asperities(bodies, std::move(physics.law));
}

}  // namespace

std::unique_ptr<Path> make_asperity_contact(const Asperities& asperities, const Indenter& indenter,
                                            const SolverOptions& options) {
    require_no_wear(options);
    if (options.physics.adhesion.work > 0)
        return std::make_unique<Path>(make_adhesive_asperities(asperities, indenter, options),
                                      options.tolerance);
    return std::make_unique<Path>(
        std::make_unique<AsperityModel>(asperities, indenter, options, physics_of),
        options.tolerance);
}

std::unique_ptr<Path> make_element_contact(const HeightMap& heights, const Indenter& indenter,
                                           const SolverOptions& options) {
    std::unique_ptr<Lowering> wear = make_wear(options);
    if (options.physics.adhesion.work > 0)
        return std::make_unique<Path>(
            make_adhesive_elements(require_elements(heights, indenter, options), indenter, options),
            options.tolerance);
    return std::make_unique<Path>(make_elements(heights, indenter, options, std::move(wear)),
                                  options.tolerance);
}

}  // namespace rsc
