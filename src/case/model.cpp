// solver%model = 'auto'.
#include "case/case.hpp"

namespace rsc {

ModelChoice model_of(const Case& settings) {
    if (settings.solver.model != Model::automatic) return {settings.solver.model};
    switch (settings.surface.source) {
        case Source::synthetic:
        case Source::spectrum: return {Model::asperities, "the surface is made"};
        case Source::asperities: return {Model::asperities, "only summits are given"};
        case Source::heights: break;
    }
    // What elements do not have, or what would mean nothing to them.
    if (settings.compare.listed()) return {Model::asperities, "compare%levels sets elements beside them"};
    if (settings.solids.friction > 0) return {Model::asperities, "solids%friction is theirs"};
    if (settings.solids.hardness < Case::kInfinity && settings.solids.size_effect > 0)
        return {Model::asperities, "solids%size_effect is theirs"};
    if (settings.asperities.law != LawKind::hertz || settings.asperities.curvature != Curvature::geometric)
        return {Model::asperities, "&asperities says what they are"};
    if (settings.solver.method != Method::automatic) return {Model::asperities, "solver%method is theirs"};
    if (settings.solver.interaction != Interaction::point) return {Model::asperities, "solver%interaction is theirs"};
    if (settings.indentation.selection != Selection::overlap) return {Model::asperities, "indentation%selection is theirs"};
    return {Model::elements, "the heights are read from a file"};
}

}  // namespace rsc
