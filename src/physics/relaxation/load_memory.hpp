// The loads on a relaxing body (relaxation.hpp), of elements. Exact if loads change linearly within
// each step.
#pragma once

#include "elements/element_physics.hpp"
#include "physics/relaxation/relaxation.hpp"

namespace rsc {

class LoadMemory final : public LastingLoads {
public:
    explicit LoadMemory(const Relaxation& body);

    void step(double dt) override { passage_ = Passage(creep_, dt); }
    double compliance() const override { return passage_.compliance; }
    const Stepper& stepper() const override { return steps_; }
    const std::vector<std::int32_t>& places() const override { return places_; }
    std::vector<double> rest() const override;
    std::vector<double> lasting() const override;  // f + sum y_k
    void accept(std::span<const std::int32_t> where, std::span<const double> f,
                const Deflect& deflect) override;
    // f'Kf/2 and that of each retardation.
    double stored() const override;
    double lost() const override { return lost_; }
    void forget() override;
    void write(std::vector<double>& numbers) const override;
    std::size_t read(std::span<const double> numbers) override;

private:
    Relaxation body_;
    TimeSteps steps_;
    Creep creep_;
    Passage passage_;
    std::vector<std::int32_t> places_;
    std::vector<double> f_;
    std::vector<std::vector<double>> y_;  // loads of each retardation
    // f'Kf, y_k'Kf, y_k'Ky_k.
    double ff_ = 0, lost_ = 0;
    std::vector<double> yf_, yy_;
};

}  // namespace rsc
