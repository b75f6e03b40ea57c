// Common part of the boundary-element models of element_model.hpp: what accepted levels leave
// behind, a plastic residual, worn heights or the loads on a relaxing body.
#pragma once

#include "contact/model.hpp"
#include "elements/bounded.hpp"
#include "elements/cut_map.hpp"
#include "elements/element_physics.hpp"

namespace rsc {

class PixelModel : public Model, private History, protected CutMap {
public:
    const Indenter& indenter() const final { return indenter_; }
    History* history() final { return loads_ || lowering_ || limited() ? this : nullptr; }
    void solve_again(double z, const Level& level) final;
    void forget() final;

protected:
    PixelModel(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options,
               ElementPhysics physics);

    bool limited() const { return std::isfinite(highest_); }
    // Pixels that penetrate at the hardness, and their penetration, by which they are lowered; the
    // same pressures then cause none.
    virtual std::vector<std::pair<Pixel, double>> press_out() = 0;
    // Lowers the pixels of the last solution by rate() times their pressures.
    virtual void settle() = 0;
    // Called when the residual has changed.
    virtual void residual_changed() = 0;
    // The length of the step, of time or of the path, has changed.
    virtual void step_changed() = 0;
    virtual void forget_solutions() = 0;
    // Later solutions start from this level at the separation z.
    virtual void start_from(double z, const Level& level) {
        (void)z;
        (void)level;
    }
    // K q at some pixels, for pressures q on the points of the load memory.
    virtual std::vector<double> deflections(const std::vector<Pixel>& where,
                                            const std::vector<double>& q) = 0;

    // Ratio of the pressures of the solver to the true ones (relaxing bodies).
    double scale() const { return loads_ ? loads_->compliance() : 1.0; }
    double rate() const { return lowering_ ? lowering_->rate() : 0.0; }
    double pixel_area() const { return heights_.dx * heights_.dy; }
    // Height of a point of the map less what was pressed out and worn off.
    double height(int column, int row) const {
        const std::size_t k = at(row) * at(heights_.nx) + at(column);
        return heights_(column, row) - (lowered_points_.empty() ? 0.0 : lowered_points_[k]);
    }
    std::vector<Pixel> loaded_pixels() const;
    // The tip, the residual or the load memory has changed, and with them the highest point.
    void set_top(double top) { top_ = top; }
    // Level with these pixels under pressures scale() times the true ones.
    Level report(double Z0, const ElementsOutcome& outcome, std::size_t candidates,
                 const std::vector<Pixel>& touching, std::vector<double> pressure);

    const HeightMap& heights_;
    Indenter indenter_;
    SolverOptions options_;
    double top_ = -kInfinity;  // highest point under the indenter
    // the last level is accepted: the contact is elastic until loaded further
    bool accepted_ = false;
    std::unique_ptr<LastingLoads> loads_;  // relaxing bodies
    std::unique_ptr<Lowering> lowering_;   // bodies that wear
    double highest_;                       // limit of the pressures

private:
    void accept(Level& level) final;
    // Triples of column, row and residual depth of a yielded point, after the depths of all points
    // of bodies that wear; or loads on a relaxing body.
    std::vector<double> write() const final;
    void read(const std::vector<double>& numbers) final;
    const Stepper* stepper() const final {
        return loads_ ? &loads_->stepper() : lowering_ ? &lowering_->stepper() : nullptr;
    }
    void step(double length, double lasting) final {
        if (loads_) loads_->step(length);
        if (lowering_) lowering_->step(length, lasting);
        step_changed();
    }
    void accept_loads(Level& level);
    void read_depths(const std::vector<double>& numbers);
    Remains remains(const Level& level) const final;

    // Adds to the depths of the pixels with which `visit` calls its argument.
    template <class Visit>
    void lower(std::vector<double>& depths, Visit&& visit);

    // Depths of all points of the map [length]: by wear and yielding together, and, of bodies that
    // wear, the part by yielding. Empty: none.
    std::vector<double> lowered_points_, yielded_;
    const std::vector<double>& yielded() const { return lowering_ ? yielded_ : lowered_points_; }
};

// Two rough flats: contact with periodic boundaries.
std::unique_ptr<Model> make_periodic_elements(const HeightMap& heights, const Indenter& indenter,
                                              const SolverOptions& options, ElementPhysics physics);

}  // namespace rsc
