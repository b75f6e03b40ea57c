// Asperities of a relaxing body (relaxation.hpp), for any law f = F(u) whose slope S(u)
// increases with the penetration.
//
// The contact is represented by independent springs (Popov and Hess, Method of Dimensionality
// Reduction, 2015). Spring s is touched at the penetration s; the springs between s and s + ds have
// the stiffness S'(s) ds. Compressed by w, a spring has the relative force
//     q = g w + sum g_k d_k,   d_k' = w' - d_k/tau_k
// It is in contact (w = u - s) as long as q > 0, and creeps back freely (q = 0) afterwards. The
// force is
//     f = int S'(s) q(s) ds = -int S(s) dq.
// For growing contacts this is Lee and Radok's f = int phi(t - t') dF(u(t')) (J. Appl. Mech. 27,
// 1960), for shrinking contacts Ting's solution (J. Appl. Mech. 33, 1966). It holds for any number
// of reversals and for constant loads (Argatov, Popov, ZAMM 96, 2016).
//
// w and d_k are linear in s between nodes, the edges of the contact at earlier levels, and w is
// linear in time between levels; the error is of second order in the steps. At the end of a step q
// = m (u - U) at a node, where m is the mean of the relaxation function over the step
// (Passage::modulus) and U, which increases with s, is the penetration at which the node is
// released. The edge of the contact s(u) is the inverse of U; the area is that of the elastic law
// at s(u), and df/du = m S(s(u)).
//
// On other asperities it acts like the instantaneous load int S' w ds, because w is the creep
// response to q, also for free springs. Free springs contribute the rest R of a step. With F = f/m,
// the force returned by this law, the equations
//     u + B F(u) = g0 - B R
// contain the instantaneous interaction B. If all contacts grow, they are the equations of elastic
// contact.
#pragma once

#include "asperities/law.hpp"
#include "physics/relaxation/relaxation.hpp"

namespace rsc {

class RelaxingLaw : public Law, public LawMemory {
public:
    // Accepts a level with penetrations u[k] of asperity[k]; all others are out of contact.
    virtual void commit(int n, const int* asperity, const double* u) = 0;
    virtual void forget() = 0;
    // Sets the duration dt of the step after the last commit. The true forces at its end are
    // modulus() times those of this law.
    virtual void step(double dt) = 0;
    virtual double modulus() const = 0;
    // Asperities that have been touched, in order of first touch, and the rest R of each at the end
    // of the step [force].
    virtual const std::vector<int>& touched() const = 0;
    virtual std::vector<double> rests() const = 0;
    // True forces of these asperities after the last commit, and the loads y_k of the retardations
    // (relaxation.hpp),
    // [retardation][touched].
    virtual std::vector<double> forces() const = 0;
    virtual std::vector<std::vector<double>> retarded() const = 0;
    // The largest contact area of each so far.
    virtual std::vector<double> widest() const = 0;
    // Energy stored in the springs of all asperities, and energy dissipated since first touch
    // [force length].
    virtual double stored() const = 0;
    virtual double lost() const = 0;
    virtual void write(std::vector<double>& numbers) const = 0;
    virtual void read(std::span<const double> numbers) = 0;  // throws Error(bad_input)
};

// Throws Error(bad_input) unless the slope of the law increases with the penetration.
std::unique_ptr<RelaxingLaw> make_relaxing(std::unique_ptr<Law> elastic, std::size_t asperities,
                                           const Creep& creep);

}  // namespace rsc
