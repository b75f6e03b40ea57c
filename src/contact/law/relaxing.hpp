// Asperities of a body that relaxes (law/relaxation.hpp), for any law f = F(u) whose slope S(u) rises with the penetration.
//
// The contact is one of springs side by side (Popov and Hess, Method of Dimensionality Reduction, 2015): the spring s is touched where the
// penetration is s, and those between s and s + ds have the stiffness S'(s) ds. Each relaxes: pressed down by w it carries
//     q = g w + sum g_k d_k,   d_k' = w' - d_k/tau_k
// of its stiffness; it is in contact, w = u - s, as long as q > 0, and creeps back freely, q = 0, when the indenter is gone. The force is
//     f = int S'(s) q(s) ds = -int S(s) dq.
// While a contact grows this is Lee and Radok's f = int phi(t - t') dF(u(t')) (J. Appl. Mech. 27, 1960), while it shrinks Ting's solution
// (J. Appl. Mech. 33, 1966); it goes on through holds and any number of turns (Argatov, Popov, ZAMM 96, 2016).
//
// Between nodes, which are the edges of the contact at the levels so far, w and d_k are taken as linear in s, and between levels w as linear
// in time: the error is of second order in the steps. At the end of a step a node carries q = m (u - U), m = the mean of the
// relaxation function over the step (Passage::modulus), and U the penetration at which it lets go, rising with s; so the edge of the
// contact s(u), the inverse of U, gives all: the area is that of the elastic law at s(u), and df/du = m S(s(u)).
//
// Elsewhere an asperity acts as the load that would press its springs down by w at once, int S' w ds: the creep function of q is w, of springs
// that are free, too. Those alone make the rest R of a step; with what this law gives as the force, F = f/m, the equations
//     u + B F(u) = g0 - B R
// have the instantaneous interaction B. While all contacts grow they are those of the elastic contact.
#pragma once

#include "contact/law/law.hpp"
#include "contact/law/relaxation.hpp"

namespace rsc {

class RelaxingLaw : public Law {
public:
    // The step after the last commit takes dt. The true forces at its end are modulus() times those of this law.
    virtual void step(double dt) = 0;
    virtual double modulus() const = 0;
    // Asperities that were ever touched, in the order in which they were, and the rest R of each at the end of the step [force].
    virtual const std::vector<int>& touched() const = 0;
    virtual std::vector<double> rests() const = 0;
    // Theirs after the last commit: true forces, and the loads that add the retardations (relaxation.hpp) to them, [retardation][touched].
    virtual std::vector<double> forces() const = 0;
    virtual std::vector<std::vector<double>> retarded() const = 0;
    // Of all asperities since they were first touched: what their springs hold, and what is lost [force length].
    virtual double stored() const = 0;
    virtual double lost() const = 0;
    virtual void write(std::vector<double>& numbers) const = 0;
    virtual void read(std::span<const double> numbers) = 0;  // throws Error(bad_input)
};

std::unique_ptr<RelaxingLaw> make_relaxing(std::unique_ptr<Law> elastic, std::size_t asperities, const Creep& creep);

}  // namespace rsc
