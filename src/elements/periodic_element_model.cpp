#include "base/error.hpp"
#include "base/format.hpp"
#include "base/parallel.hpp"
#include "elements/periodic_elements.hpp"
#include "elements/pixel_model.hpp"

namespace rsc {
namespace {

constexpr int kRows = 16;  // that a thread takes at a time

class PeriodicElementModel final : public PixelModel {
public:
    PeriodicElementModel(const HeightMap& heights, const Indenter& indenter,
                         const SolverOptions& options, ElementPhysics physics)
        : PixelModel(heights, indenter, options, std::move(physics)),
          changed_(history() || !indenter.shape->flat() ? less_face() : HeightMap{}),
          solver_({heights.nx, heights.ny, heights.dx, heights.dy, present().data.get(),
                   present().stride},
                  substrate_of(indenter), highest_) {
        set_heights();
    }

    double stiffness(Slope) override {
        if (!touches_) return 0;
        return solver_.full() ? kNotComputed : 0 - area() * solver_.stiffness(accepted_);
    }
    double energy() const override {
        if (loads_) return pixel_area() * loads_->stored();
        return touches_ ? area() * solver_.energy() : 0;
    }
    void move_tip(double x0, double y0) override {
        indenter_.x0 = x0;
        indenter_.y0 = y0;
        if (!indenter_.shape->flat()) set_heights();
    }

    Level solve(double Z0, bool) override {
        ElementsOutcome outcome;
        outcome.converged = true;
        if (Z0 < top_) outcome = solver_.approach(Z0, options_.tolerance, options_.max_iterations);
        return report(Z0, outcome);
    }
    std::optional<Level> solve_under(double N) override {
        const double p = N / area(), H = highest_;
        if (!(p < H))
            throw Error(Failure::bad_input,
                        format("a nominal pressure of %.9g exceeds the hardness %.9g", p, H));
        if (std::isfinite(H)) return std::nullopt;
        const ElementsOutcome outcome =
            solver_.press(scale() * p, options_.tolerance, options_.max_iterations);
        return report(solver_.separation(), outcome);
    }
    ContactRange contact_range() const override { return {solver_.closed(), top_}; }
    void keep(ArchiveWriter& to) const override {
        to(touches_, accepted_);
        solver_.keep(to);
    }
    void recall(ArchiveReader& from) override {
        from(touches_, accepted_);
        solver_.recall(from);
    }
    // Force of a flat punch as wide as the period, an upper bound also for yielding surfaces.
    double force_at_most(double depth) override {
        return indenter_.E_star * std::max(heights_.Lx(), heights_.Ly()) * depth;
    }

protected:
    void forget_solutions() override { touches_ = false; }  // solutions do not start from others
    void settle() override { solver_.settle(); }
    void step_changed() override {
        if (lowering_) solver_.set_diagonal(rate());
        if (!loads_) return;
        lowered_ = loads_->places().empty() ? std::vector<double>()
                                            : solver_.deflections(loaded_pixels(), loads_->rest());
        set_heights();
    }
    std::vector<std::pair<Pixel, double>> press_out() override { return solver_.press_out(); }
    void residual_changed() override { set_heights(); }
    std::vector<double> deflections(const std::vector<Pixel>& where,
                                    const std::vector<double>& q) override {
        const std::vector<double> all = solver_.deflections(loaded_pixels(), q);
        std::vector<double> there;
        for (const Pixel& pixel : where)
            there.push_back(all[static_cast<std::size_t>(place(pixel))]);
        return there;
    }

private:
    double area() const { return heights_.Lx() * heights_.Ly(); }
    const HeightMap& present() const { return changed_.data ? changed_ : heights_; }
    // Subtracts the indenter's face, the residual and the deflection by earlier loads from the
    // heights.
    void set_heights() {
        if (changed_.data) {
            subtract(changed_);
            solver_.heights_changed();
        }
        std::vector<double> tops(at(heights_.ny));
        parallel_for(heights_.ny, kRows, 0, [&](int j) {
            const double* const row = present().row(j);
            tops[at(j)] = *std::max_element(row, row + heights_.nx);
        });
        set_top(std::ranges::max(tops));
    }
    void subtract(HeightMap& changed) const {
        parallel_for(heights_.ny, kRows, 0, [&](int j) {
            for (int i = 0; i < heights_.nx; ++i) {
                double& z = changed.row(j)[i];
                z = indenter_.clearance(x(i), y(j), height(i, j));
                if (!lowered_.empty()) z -= lowered_[static_cast<std::size_t>(place({i, j}))];
            }
        });
    }
    // The heights that the solver takes its units from, so that body 1 may be smooth.
    HeightMap less_face() const {
        HeightMap changed = heights_.copy();
        subtract(changed);
        return changed;
    }
    Level report(double Z0, const ElementsOutcome& outcome) {
        touches_ = Z0 < top_;
        accepted_ = false;
        const auto candidates =
            static_cast<std::size_t>(heights_.nx) * static_cast<std::size_t>(heights_.ny);
        if (!touches_) return PixelModel::report(Z0, outcome, candidates, {}, {});
        return PixelModel::report(Z0, outcome, candidates, solver_.pixels(), solver_.pressures());
    }

    // Deflection of each point by earlier loads at the end of the step; empty: none. It is declared
    // before the heights, which are made with it.
    std::vector<double> lowered_;
    HeightMap changed_;  // the heights less what subtract() takes; without data where it is nothing
    PeriodicElements solver_;
    bool touches_ = false;  // the last level is in contact
};

}  // namespace

std::unique_ptr<Model> make_periodic_elements(const HeightMap& heights, const Indenter& indenter,
                                              const SolverOptions& options,
                                              ElementPhysics physics) {
    return std::make_unique<PeriodicElementModel>(heights, indenter, options, std::move(physics));
}

}  // namespace rsc
