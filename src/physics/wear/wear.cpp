#include "physics/wear/wear.hpp"

#include "base/error.hpp"
#include "surface/form.hpp"

namespace rsc {
namespace {

// Change of N, or of the depth, and of the area, when the steps of sliding to a level are halved.
constexpr double kAccuracy = 2e-3;

// rms height of the points that are worn, without their form: a quadratic surface, for two flats
// their mean. NaN where too few points are worn to have a form.
double worn_rms(const HeightMap& map, const std::vector<double>& depths, bool flats) {
    HeightMap worn = map.copy();
    worn.periodic = false;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            const double depth = depths.empty() ? 0.0 : depths[at(j) * at(map.nx) + at(i)];
            double& z = worn.row(j)[i];
            z = depth > 0 || flats ? z - depth : kNotComputed;
        }
    try {
        return detrend(worn, flats ? Detrend::mean : Detrend::quadratic).rms;
    } catch (const Error&) {
        return kNotComputed;
    }
}

class WornPoints final : public Lowering {
public:
    explicit WornPoints(double coefficient) : coefficient_(coefficient) {}

    void step(double length, double lasting) override {
        rate_ = coefficient_ * length;
        lasting_rate_ = coefficient_ * lasting;
    }
    double rate() const override { return rate_; }
    double lasting_rate() const override { return lasting_rate_; }
    PathClock clock() const override { return PathClock::distance; }
    double accuracy() const override { return kAccuracy; }

    void measure(Level& level, const HeightMap& map, const Indenter& indenter,
                 const std::vector<double>& depths,
                 const std::vector<double>& yielded) const override {
        double volume = 0, deepest = 0;
        for (const auto k : indices(depths)) {
            const double worn = depths[k] - (yielded.empty() ? 0.0 : yielded[k]);
            volume += worn;
            deepest = std::max(deepest, worn);
        }
        level.worn_volume = volume * map.dx * map.dy;
        level.wear_depth_max = deepest;
        level.worn_rms = worn_rms(map, depths, indenter.shape->flat());
    }

private:
    double coefficient_, rate_ = 0, lasting_rate_ = 0;
};

void refuse(const char* why) { bad_input("wear is not available ", why); }

}  // namespace

std::unique_ptr<Lowering> make_wear(const SolverOptions& options) {
    const double k = options.physics.wear.coefficient;
    if (k == 0) return nullptr;
    if (!(k > 0 && std::isfinite(k)))
        bad_input("the coefficient of wear must be positive and finite");
    if (options.physics.adhesion.work > 0) refuse("with adhesion");
    if (!options.physics.relaxation.none()) refuse("for bodies that relax");
    return std::make_unique<WornPoints>(k);
}

void require_no_wear(const SolverOptions& options) {
    if (options.physics.wear.coefficient != 0) refuse("for asperities; use elements");
}

}  // namespace rsc
