// Common part of the boundary-element models of element_model.hpp: what accepted levels leave
// behind, a plastic residual or the loads on a relaxing body.
#pragma once

#include "contact/model.hpp"
#include "elements/bounded.hpp"
#include "elements/cut_map.hpp"
#include "physics/relaxation/load_memory.hpp"

namespace rsc {

class PixelModel : public Model, private History, protected CutMap {
public:
    double first_touch() const final { return top_; }
    const Indenter& indenter() const final { return indenter_; }
    History* history() final { return loads_ || yields() ? this : nullptr; }
    void solve_again(double z, const Level& level) final;
    void forget() final;

protected:
    PixelModel(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);

    bool yields() const { return std::isfinite(options_.hardness.H0); }
    // Pixels that penetrate at the hardness, and their penetration, by which they are lowered; the
    // same pressures then cause none.
    virtual std::vector<std::pair<Pixel, double>> press_out() = 0;
    // Called when the residual has changed.
    virtual void residual_changed() = 0;
    // The duration of the step of time has changed.
    virtual void step_changed() = 0;
    // The solution at this level is the starting point of the next.
    virtual void start_from(double z, const Level& level) {
        (void)z;
        (void)level;
    }
    virtual void forget_solutions() = 0;
    // K q at some pixels, for pressures q on the points of the load memory.
    virtual std::vector<double> deflections(const std::vector<Pixel>& where,
                                            const std::vector<double>& q) = 0;

    // Ratio of the pressures of the solver to the true ones (relaxing bodies).
    double scale() const { return loads_ ? loads_->compliance() : 1.0; }
    double pixel_area() const { return heights_.dx * heights_.dy; }
    // Height of a point of the map less its residual.
    double height(int column, int row) const {
        const std::int32_t k = row * heights_.nx + column;
        return heights_(column, row) -
               (!lowered_.empty() && lowered_[static_cast<std::size_t>(k)] ? residual_.at(k) : 0.0);
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
    std::optional<LoadMemory> loads_;  // relaxing bodies

private:
    void accept(Level& level) final;
    // Triples of column, row and residual depth of a yielded point, or loads on a relaxing body.
    std::vector<double> write() const final;
    void read(const std::vector<double>& numbers) final;
    double shortest_time() const final { return options_.relaxation.shortest(); }
    void step(double dt) final {
        loads_->step(dt);
        step_changed();
    }
    std::optional<Level> lasting_loads(const Level& level) const final;
    ResidualProfile residual_profile() const final;

    std::vector<std::pair<std::int32_t, double>> residual() const;  // row by row

    using Depths = std::unordered_map<std::int32_t, double>;
    void set_residual(Depths depths);

    Depths residual_;  // depths by the index of the point on the map [length]
    std::vector<bool>
        lowered_;  // whether a point has a residual, which is looked up often; empty: none has
};

// Two rough flats: contact with periodic boundaries.
std::unique_ptr<Model> make_periodic_elements(const HeightMap& heights, const Indenter& indenter,
                                              const SolverOptions& options);

}  // namespace rsc
