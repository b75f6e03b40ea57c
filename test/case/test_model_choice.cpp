// solver%model = 'auto': the choice depends on dimensionless quantities of the case alone, and goes
// to elements where asperities do not hold.

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

Case flats(double pressure) {
    Case c;
    c.solids.R[1] = kInfinity;
    c.indentation.boundary = Boundary::periodic;
    c.indentation.control = Control::pressure;
    c.indentation.unit = LevelUnit::relative;
    c.indentation.levels = {pressure};
    return c;
}

// The same case in other units: lengths times l, forces times f.
Case in_units(Case c, double l, double f) {
    for (double& E : c.solids.E) E *= f / (l * l);
    for (double& R : c.solids.R) R *= l;
    *c.surface.L *= l;
    *c.surface.sigma *= l;
    for (double& level : c.indentation.levels) level *= f;
    return c;
}

TEST(auto_model) {
    CHECK(!elements(Case{}));  // the paper's case
    CHECK(elements(ball(1e-4, 10)));
    CHECK(!elements(ball(1e-2, 10)));

    // The choice changes once as the surface gets rougher, and once as the load grows, and does not
    // depend on the units.
    int changes = 0;
    for (double sigma = 1e-5; sigma < 1e-1; sigma *= 1.3) {
        const bool smoother = elements(ball(sigma, 1)), rougher = elements(ball(1.3 * sigma, 1));
        CHECK(smoother || !rougher);
        changes += smoother != rougher;
        CHECK(elements(in_units(ball(sigma, 1), 1e-3, 1)) == smoother);
        CHECK(elements(in_units(ball(sigma, 1), 1e3, 1e6)) == smoother);
    }
    CHECK(changes == 1);
    changes = 0;
    for (double force = 1e-3; force < 1e6; force *= 2) {
        const bool less = elements(ball(5e-3, force)), more = elements(ball(5e-3, 2 * force));
        CHECK(more || !less);
        changes += less != more;
    }
    CHECK(changes == 1);

    CHECK(!elements(flats(0.01)));
    CHECK(elements(flats(0.5)));
    Case by_force = flats(0.01);
    by_force.indentation.control = Control::force;
    by_force.indentation.levels = {1e-6};
    CHECK(!elements(by_force));
    by_force.indentation.levels = {1e9};
    CHECK(elements(by_force));

    Case cone;
    cone.indenter.shape = shape_number("cone");
    cone.indenter.slope = 0.1;
    CHECK(elements(cone));

    // A lay and skewed heights need elements.
    Case lay = flats(0.01), skewed = flats(0.01);
    lay.surface.aspect = 3;
    skewed.surface.skewness = -0.5;
    skewed.surface.kurtosis = 3.4;
    CHECK(elements(lay) && elements(skewed));

    // Layers: thick ones leave the choice as it is, thin ones need elements.
    Case layered;
    layered.solids.layer_E = {1e5};
    layered.solids.layer_nu = {0.3};
    layered.solids.layer_thickness = {10};
    CHECK(!elements(layered));
    layered.solids.layer_thickness = {1e-5};
    CHECK(elements(layered));

    // What only asperities have keeps them.
    Case yielding = ball(1e-4, 10);
    yielding.solids.hardness = 3e3;
    yielding.solids.size_effect = 1e-3;
    CHECK(!elements(yielding));
}

}  // namespace test_model_choice
