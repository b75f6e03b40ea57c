#include "physics/wear/wear.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

// Error of N, or of the depth, by the steps of sliding to a level.
constexpr double kAccuracy = 2e-3;

class WornPoints final : public Lowering {
public:
    explicit WornPoints(double coefficient) : coefficient_(coefficient) {}

    void step(double length) override { rate_ = coefficient_ * length; }
    double rate() const override { return rate_; }
    PathClock clock() const override { return PathClock::distance; }
    double accuracy() const override { return kAccuracy; }

    void measure(Level& level, const HeightMap& map,
                 const std::vector<double>& depths) const override {
        double volume = 0, deepest = 0, sum = 0, squares = 0;
        const auto each = [&](auto&& visit) {
            for (const int j : indices(map.ny))
                for (const int i : indices(map.nx))
                    visit(map(i, j), depths.empty() ? 0.0 : depths[at(j) * at(map.nx) + at(i)]);
        };
        each([&](double height, double depth) {
            volume += depth;
            deepest = std::max(deepest, depth);
            sum += height - depth;
        });
        const double points = double(map.nx) * map.ny, mean = sum / points;
        each([&](double height, double depth) {
            squares += (height - depth - mean) * (height - depth - mean);
        });
        level.worn_volume = volume * map.dx * map.dy;
        level.wear_depth_max = deepest;
        level.worn_rms = std::sqrt(squares / points);
    }

private:
    double coefficient_, rate_ = 0;
};

void refuse(const char* why) { bad_input("wear is not available ", why); }

}  // namespace

std::unique_ptr<Lowering> make_wear(const SolverOptions& options) {
    const double k = options.physics.wear.coefficient;
    if (k == 0) return nullptr;
    if (!(k > 0 && std::isfinite(k)))
        bad_input("the coefficient of wear must be positive and finite");
    if (std::isfinite(options.physics.hardness.H0)) refuse("with a hardness");
    if (options.physics.adhesion.work > 0) refuse("with adhesion");
    if (!options.physics.relaxation.none()) refuse("for bodies that relax");
    return std::make_unique<WornPoints>(k);
}

void require_no_wear(const SolverOptions& options) {
    if (options.physics.wear.coefficient != 0) refuse("for asperities; use elements");
}

}  // namespace rsc
