// solver%model = 'auto': elements, unless the case asks for what only asperities have; the choice
// does not depend on which groups are present.

#include "case/case.hpp"
#include "case/read_case.hpp"
#include "check.hpp"
#include "physics/indenter/shapes.hpp"

namespace test_model_choice {

using namespace rsc;

bool elements(const Case& settings) { return model_of(settings).model == ModelKind::elements; }

// A steel ball of 10 mm on steel; rms heights of 0.1 um are too smooth for summits under it.
Case ball(double sigma, double force) {
    Case c;
    c.solids.E[0] = c.solids.E[1] = 210e3;
    c.solids.nu[0] = c.solids.nu[1] = 0.3;
    c.solids.R[1] = 5;
    c.surface.L = 0.4;
    c.surface.sigma = sigma;
    c.surface.L_lambda_l = 12;
    c.surface.L_lambda_s = 24;
    c.indentation.control = Control::force;
    c.indentation.levels = {0.1 * force, force};
    return c;
}

TEST(auto_model) {
    CHECK(elements(Case{}));
    CHECK(elements(ball(1e-4, 10)) && elements(ball(1e-2, 10)));
    for (const LawKind law : {LawKind::hertz, LawKind::elliptic, LawKind::fourth_order}) {
        Case with = ball(1e-2, 10);
        with.asperities.law = law;
        with.asperities.curvature = Curvature::algebraic;
        CHECK(elements(with));
    }

    Case cone;
    cone.indenter.shape = shape_number("cone");
    cone.indenter.slope = 0.1;
    CHECK(elements(cone));

    Case sticky = ball(1e-4, 10);
    sticky.solids.adhesion = 1e-5;
    CHECK(!elements(sticky));
    sticky.solids.E[0] = 0.1;  // soft: the roughness is flattened
    CHECK(elements(sticky));

    // What only asperities have keeps them.
    Case yielding = ball(1e-4, 10);
    yielding.solids.hardness = 3e3;
    yielding.solids.size_effect = 1e-3;
    CHECK(!elements(yielding));
    Case listed;
    listed.surface.source = Source::asperities;
    CHECK(!elements(listed));
    Case asked;
    asked.solver.model = ModelKind::asperities;
    CHECK(!elements(asked));
}

}  // namespace test_model_choice
