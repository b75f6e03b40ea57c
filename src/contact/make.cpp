#include "contact/make.hpp"

#include "asperities/asperity_model.hpp"
#include "base/error.hpp"
#include "elements/element_model.hpp"
#include "physics/physics.hpp"

namespace rsc {
namespace {

// Throws Error(bad_input) for physics out of range, or that exclude each other or the model.
void require_compatible(const SolverOptions& options, const Indenter& indenter, bool elements) {
    for (const Physics* p : physics_asked(options.physics))
        if (p->require_sound) p->require_sound(options.physics);
    const Combination all{.bodies = options.physics,
                          .elements = elements,
                          .line = indenter.period.line(),
                          .layers = indenter.layers.count > 0,
                          .method = options.method,
                          .selection = options.selection,
                          .law = options.law};
    find_exclusions(all, [](std::initializer_list<std::string_view> keys, const std::string& text) {
        bad_input(*keys.begin(), ": ", text);
    });
}

AsperityPhysics law_of(const ContactBodies& bodies) {
    const SolverOptions& options = bodies.options;
    AsperityPhysics physics{make_law(options.law, bodies.asperities, bodies.indenter.E_star,
                                     bodies.of_difference.get()),
                            std::make_unique<AsperityHistory>()};
    for (const Physics* p : physics_asked(options.physics))
        if (p->law) physics = p->law(bodies, std::move(physics.law));
    return physics;
}

}  // namespace

std::unique_ptr<Path> make_asperity_contact(const Asperities& asperities, const Indenter& indenter,
                                            const SolverOptions& options) {
    require_compatible(options, indenter, false);
    std::unique_ptr<Model> model;
    for (const Physics* p : physics_asked(options.physics))
        if (p->asperities) model = p->asperities(asperities, indenter, options);
    if (!model) model = std::make_unique<AsperityModel>(asperities, indenter, options, law_of);
    return std::make_unique<Path>(std::move(model), options.tolerance);
}

std::unique_ptr<Path> make_element_contact(const HeightMap& heights, const Indenter& indenter,
                                           const SolverOptions& options) {
    require_compatible(options, indenter, true);
    std::unique_ptr<Model> model;
    ElementPhysics physics;
    for (const Physics* p : physics_asked(options.physics)) {
        if (p->elements) model = p->elements(heights, indenter, options);
        if (p->lowering) physics.lowering = p->lowering(options.physics);
        if (p->loads) physics.loads = p->loads(options.physics);
        if (p->largest_pressure) physics.highest = p->largest_pressure(options.physics, kInfinity);
    }
    if (!model) model = make_elements(heights, indenter, options, std::move(physics));
    return std::make_unique<Path>(std::move(model), options.tolerance);
}

}  // namespace rsc
