// Functions on many contacts.

#include "api/guard.hpp"
#include "api/handles.hpp"
#include "base/parallel.hpp"

namespace rsc::api {
namespace {

std::string last_message() {
    char text[500] = "";
    rsc_message(text, sizeof text, nullptr);
    return text;
}

// `value`, `last`: numbers of the arguments with the values and the threads.
template <class Each>
std::int32_t for_all(std::int64_t n, rsc_contact** contacts, const double* given, int value,
                     std::int32_t* status, std::int32_t threads, int last, Each&& each) {
    std::int32_t first = RSC_SUCCESS;
    const std::int32_t whole = guarded(0, [&] {
        if (n < 0) refuse(1, "n", "must not be negative");
        if (threads < 0) refuse(last, "threads", "must not be negative");
        if (n == 0) return;
        require(contacts, 2, "contacts");
        require(given, value, "the values");
        std::set<const rsc_contact*> different;
        for (std::int64_t k = 0; k < n; ++k) {
            require(contacts[k], 2, "contacts: one of them");
            if (!different.insert(contacts[k]).second)
                refuse(2, "contacts", "must be different handles");
        }
        std::vector<std::int32_t> outcome(at(n), RSC_SUCCESS);
        std::vector<std::string> reason(at(n));
        parallel_for(at(n), 1, threads, [&](std::size_t k) {
            outcome[k] = each(std::int64_t(k));
            if (outcome[k] == RSC_SUCCESS) return;
            reason[k] = last_message();
        });
        if (status) std::ranges::copy(outcome, status);
        const auto bad =
            std::ranges::find_if(outcome, [](std::int32_t s) { return s != RSC_SUCCESS; });
        if (bad == outcome.end()) return;
        const auto k = at(bad - outcome.begin());
        first = failed(*bad < 0 ? -2 : *bad, "contact " + std::to_string(k) + ": " + reason[k]);
    });
    return whole != RSC_SUCCESS ? whole : first;
}

}  // namespace
}  // namespace rsc::api

using namespace rsc;
using namespace rsc::api;

int32_t rsc_contacts_press(int64_t n, rsc_contact** contacts, const double* force,
                           double* separation, int32_t* status, int32_t threads) {
    return for_all(n, contacts, force, 3, status, threads, 6, [&](int64_t k) {
        return rsc_contact_press(contacts[k], force[k], separation ? separation + k : nullptr);
    });
}

int32_t rsc_contacts_indent(int64_t n, rsc_contact** contacts, const double* separation,
                            double* force, int32_t* status, int32_t threads) {
    return for_all(n, contacts, separation, 3, status, threads, 6, [&](int64_t k) {
        return rsc_contact_indent(contacts[k], separation[k], force ? force + k : nullptr);
    });
}

int32_t rsc_contacts_step(int64_t n, rsc_contact** contacts, const double* x0, const double* y0,
                          int32_t by_force, const double* value, double* separation, double* force,
                          double* stiffness, double* lateral_x, double* lateral_y, double* moment_x,
                          double* moment_y, int32_t* level_status, int32_t* status,
                          int32_t threads) {
    const int32_t sound = guarded(0, [&] {
        if (!x0 != !y0) refuse(x0 ? 4 : 3, x0 ? "y0" : "x0", "must be null if the other is");
        if (by_force != 0 && by_force != 1) refuse(5, "by_force", "must be 0 or 1");
    });
    if (sound != RSC_SUCCESS) return sound;
    return for_all(n, contacts, value, 6, status, threads, 16, [&](int64_t k) {
        rsc_contact* const contact = contacts[k];
        if (x0)
            if (const int32_t moved = rsc_contact_move_tip(contact, x0[k], y0[k]);
                moved != RSC_SUCCESS)
                return moved;
        const int32_t reached = by_force ? rsc_contact_press(contact, value[k], nullptr)
                                         : rsc_contact_indent(contact, value[k], nullptr);
        if (reached != RSC_SUCCESS && reached != RSC_NOT_CONVERGED) return reached;
        LevelSource source = source_of(*contact);
        const Level& level = source.level;
        const bool none = std::isnan(level.force);  // the solver found no state
        if (!none && (lateral_x || lateral_y)) (void)compute_lateral_force(source);
        if (!none && (moment_x || moment_y)) (void)compute_moment(source);
        const auto to = [&](auto* output, auto of) {
            if (output) output[k] = static_cast<std::decay_t<decltype(*output)>>(of);
        };
        to(separation, level.separation);
        to(force, level.force);
        to(lateral_x, level.lateral_x);
        to(lateral_y, level.lateral_y);
        to(moment_x, level.moment_x);
        to(moment_y, level.moment_y);
        to(level_status, level.status);
        if (!stiffness) return reached;
        // Last, and its status only after that of the level.
        stiffness[k] = kNotComputed;
        if (none) return reached;
        const std::string why = last_message();
        const int32_t found = rsc_contact_stiffness(contact, stiffness + k);
        return reached == RSC_SUCCESS ? found : failed(reached, why);
    });
}
