// Contacts and friction kept in files go on bit for bit; many contacts at once are what they are one by one, whatever the threads.
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "check.hpp"
#include "physics/random_asperities.hpp"
#include "rsc.h"
#include "unit/temporary_folder.hpp"

namespace {

#define OK(call) CHECK((call) == RSC_SUCCESS)

bool says(const char* what) {
    char text[400];
    rsc_message(text, sizeof text, nullptr);
    return std::string(text).find(what) != std::string::npos;
}

rsc_asperities* make(unsigned seed) {
    const rsc::Asperities list = random_asperities(400, 0.01, 0.01, 5e-4, 0.4, seed);
    rsc_asperities* handle = nullptr;
    OK(rsc_asperities_take(&handle, static_cast<std::int64_t>(list.size()), list.x.data(), list.y.data(), list.z.data(), list.radius.data(),
                           nullptr, nullptr, nullptr, nullptr));
    return handle;
}

// Force, place and stiffness along a path that moves the tip and presses as well.
std::vector<double> go_on(rsc_contact* contact) {
    std::vector<double> answers;
    for (int k = 0; k < 12; ++k) {
        double force = 0, separation = 0, stiffness = 0, energy = 0;
        if (k % 5 == 2) OK(rsc_contact_move_tip(contact, 0.5 + 0.003 * k, 0.5 - 0.002 * k));
        if (k % 4 == 3)
            OK(rsc_contact_press(contact, 0.5 + 0.1 * k, &separation));
        else
            OK(rsc_contact_indent(contact, 0.004 - 0.0003 * k, &force));
        OK(rsc_contact_stiffness(contact, &stiffness));
        OK(rsc_contact_energy(contact, &energy));
        answers.insert(answers.end(), {force, separation, stiffness, energy});
    }
    return answers;
}

void contacts_in_files(const Folder& folder) {
    rsc_asperities *asperities = make(1), *others = make(2);
    rsc_contact *contact = nullptr, *again = nullptr;
    OK(rsc_contact_create(&contact, asperities, 94e3, 2.5, 0.5, 0.5, nullptr));
    const std::string file = folder / "contact";
    OK(rsc_contact_save(contact, file.c_str()));  // without a level
    OK(rsc_contact_restore(&again, asperities, file.c_str()));
    double N = 0, same = 0, E = 0, W = 0, Z0 = 0;
    CHECK(rsc_contact_energy(again, &E) == RSC_NO_RESULT);
    OK(rsc_contact_destroy(&again));
    for (double z : {0.008, 0.007, 0.006, 0.005, 0.0045}) OK(rsc_contact_indent(contact, z, &N));
    OK(rsc_contact_energy(contact, &W));
    OK(rsc_contact_save(contact, file.c_str()));
    OK(rsc_contact_restore(&again, asperities, file.c_str()));
    OK(rsc_contact_result(again, &Z0, &same, nullptr, nullptr));
    OK(rsc_contact_energy(again, &E));
    CHECK(Z0 == 0.0045 && same == N && E == W && N > 0);
    for (const char* name : {"force", "contact_area", "energy", "lateral_force_x", "lateral_force_y", "moment_x", "moment_y", "contacts"}) {
        double here = 0, there = 0;
        OK(rsc_contact_value(contact, name, &here));
        OK(rsc_contact_value(again, name, &there));
        CHECK(here == there && here != 0);
    }
    CHECK(go_on(contact) == go_on(again));
    // Saved after the tip moved: the level is that of the old place.
    OK(rsc_contact_move_tip(contact, 0.45, 0.52));
    OK(rsc_contact_result(contact, &Z0, &N, nullptr, nullptr));
    OK(rsc_contact_save(contact, file.c_str()));
    OK(rsc_contact_destroy(&again));
    OK(rsc_contact_restore(&again, asperities, file.c_str()));
    OK(rsc_contact_result(again, nullptr, &same, nullptr, nullptr));
    CHECK(same == N);
    const auto energies = [](rsc_contact* c) {
        double by_name = 0, by_answer = 0, alone = 0;
        OK(rsc_contact_value(c, "energy", &by_name));
        OK(rsc_contact_energy(c, &alone));
        OK(rsc_contact_answer(c, nullptr, nullptr, nullptr, nullptr, &by_answer, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                              nullptr, nullptr));
        return std::vector<double>{by_name, by_answer, alone};
    };
    CHECK(energies(again) == energies(contact) && energies(again) == std::vector<double>(3, energies(contact)[0]));
    double here = 0, there = 0;
    OK(rsc_contact_indent(contact, Z0, &here));
    OK(rsc_contact_indent(again, Z0, &there));
    CHECK(here == there && here != N);
    CHECK(go_on(contact) == go_on(again));
    OK(rsc_contact_destroy(&again));
    // Asperities that differ in one column only are others.
    const double place[] = {0.5}, curvature[] = {1e3}, angle[] = {0.2}, bent[] = {1e9}, more[] = {2e9}, radius[] = {1e-3};
    rsc_asperities* single[2] = {nullptr, nullptr};
    rsc_contact* held = nullptr;
    for (int k = 0; k < 2; ++k)
        OK(rsc_asperities_take(&single[k], 1, place, place, place, radius, curvature, curvature, angle, k == 0 ? bent : more));
    OK(rsc_contact_create(&held, single[0], 94e3, 2.5, 0.5, 0.5, nullptr));
    OK(rsc_contact_save(held, (folder / "single").c_str()));
    CHECK(rsc_contact_restore(&again, single[1], (folder / "single").c_str()) == -2 && says("asperities") && !again);
    OK(rsc_contact_restore(&again, single[0], (folder / "single").c_str()));
    for (rsc_contact** c : {&held, &again}) OK(rsc_contact_destroy(c));
    for (rsc_asperities*& one : single) OK(rsc_asperities_destroy(&one));
    // What is not that.
    CHECK(rsc_contact_restore(&again, others, file.c_str()) == -2 && says("asperities") && !again);
    CHECK(rsc_contact_restore(&again, asperities, (folder / "nothing").c_str()) == -3 && says("cannot read"));
    rsc_friction* friction = nullptr;
    CHECK(rsc_friction_restore(&friction, asperities, file.c_str()) == -3 && says("friction"));
    CHECK(rsc_contact_restore(&again, asperities, "") == -3 && rsc_contact_restore(&again, nullptr, file.c_str()) == -2);
    CHECK(rsc_contact_save(contact, (folder / "no/folder").c_str()) == RSC_FILE && says("cannot write"));
    CHECK(rsc_contact_save(nullptr, file.c_str()) == -1 && rsc_contact_save(contact, nullptr) == -2);
    // A disk that takes no more: told, and the file of before is as it was.
    const std::string before = bytes(file);
    rlimit usual{};
    CHECK(getrlimit(RLIMIT_FSIZE, &usual) == 0 && std::signal(SIGXFSZ, SIG_IGN) != SIG_ERR);
    const rlimit little{100, usual.rlim_max};
    CHECK(setrlimit(RLIMIT_FSIZE, &little) == 0);
    const std::int32_t full = rsc_contact_save(contact, file.c_str());
    CHECK(setrlimit(RLIMIT_FSIZE, &usual) == 0);
    CHECK(full == RSC_FILE && says("cannot write") && bytes(file) == before && !std::ifstream(file + ".new"));
    std::string spoilt = bytes(file);
    spoilt[spoilt.size() / 2] ^= 4;
    std::ofstream(folder / "spoilt", std::ios::binary) << spoilt;
    CHECK(rsc_contact_restore(&again, asperities, (folder / "spoilt").c_str()) == -3 && says("damaged"));
    std::ofstream(folder / "short", std::ios::binary) << bytes(file).substr(0, 60);
    CHECK(rsc_contact_restore(&again, asperities, (folder / "short").c_str()) == -3 && !again);
    OK(rsc_contact_destroy(&contact));
    OK(rsc_asperities_destroy(&asperities));
    OK(rsc_asperities_destroy(&others));
}

// Two flats: what force control remembers of earlier levels is no start, either. Resistivities are kept; elements are saved, too.
void other_contacts(const Folder& folder) {
    const std::string file = folder / "flats";
    const auto of = [](const char* text, rsc_asperities** asperities, rsc_contact** contact) {
        rsc_case* a_case = nullptr;
        OK(rsc_case_create(&a_case));
        OK(rsc_case_read(a_case, text));
        OK(rsc_asperities_make(asperities, a_case, 1));
        OK(rsc_contact_create_from_case(contact, *asperities, a_case));
        OK(rsc_case_destroy(&a_case));
    };
    rsc_asperities *asperities = nullptr, *points = nullptr;
    rsc_contact *contact = nullptr, *again = nullptr, *elements = nullptr;
    of("&surface n=128, L_lambda_l=4, L_lambda_s=32, sigma=1e-3 / &solids R=Infinity, Infinity  resistivity=1e-5, 2e-5 / "
       "&indentation boundary='periodic' control='pressure' unit='relative' start=0.001 stop=0.01 /",
       &asperities, &contact);
    double Z0 = 0, R = 0, same = 0;
    OK(rsc_contact_press(contact, 5.0, &Z0));
    OK(rsc_contact_indent(contact, 0.98 * Z0, nullptr));
    OK(rsc_contact_save(contact, file.c_str()));
    OK(rsc_contact_restore(&again, asperities, file.c_str()));
    OK(rsc_contact_value(contact, "resistance", &R));
    OK(rsc_contact_value(again, "resistance", &same));
    CHECK(R == same && R > 0);
    for (double z : {0.96, 0.93, 0.97}) {
        double here = 0, there = 0;
        OK(rsc_contact_indent(contact, z * Z0, &here));
        OK(rsc_contact_indent(again, z * Z0, &there));
        CHECK(here == there && here > 0);
        OK(rsc_contact_press(contact, 0.8 * here, &here));
        OK(rsc_contact_press(again, 0.8 * there, &there));
        CHECK(here == there);
    }
    of("&surface n=64, L_lambda_l=4, L_lambda_s=16 / &solver model='elements' /", &points, &elements);
    OK(rsc_contact_save(elements, file.c_str()));
    for (rsc_contact* c : {contact, again, elements}) OK(rsc_contact_destroy(&c));
    for (rsc_asperities* a : {asperities, points}) OK(rsc_asperities_destroy(&a));
}

void friction_in_files(const Folder& folder) {
    rsc_asperities* asperities = make(1);
    rsc_contact* contact = nullptr;
    rsc_friction *friction = nullptr, *again = nullptr;
    OK(rsc_contact_create(&contact, asperities, 94e3, 2.5, 0.5, 0.5, nullptr));
    OK(rsc_friction_create(&friction, contact, 0.3, 0.8));
    const auto lead = [](rsc_friction* f, int from, int to) {
        std::vector<double> answers;
        for (int k = from; k < to; ++k) {
            double out[4];
            OK(rsc_friction_update(f, 0.004 - 0.001 * std::sin(0.7 * k), 1e-3 * std::sin(1.3 * k), 4e-4 * std::cos(0.9 * k), out, out + 1,
                                   out + 2, out + 3));
            answers.insert(answers.end(), out, out + 4);
        }
        return answers;
    };
    lead(friction, 0, 20);
    OK(rsc_friction_commit(friction));
    lead(friction, 20, 23);
    const std::string file = folder / "friction";
    OK(rsc_friction_save(friction, file.c_str()));
    OK(rsc_friction_restore(&again, asperities, file.c_str()));
    CHECK(lead(friction, 23, 40) == lead(again, 23, 40));
    OK(rsc_friction_rollback(friction));
    OK(rsc_friction_rollback(again));
    CHECK(lead(friction, 20, 25) == lead(again, 20, 25));
    OK(rsc_friction_destroy(&friction));
    OK(rsc_friction_destroy(&again));
    OK(rsc_contact_destroy(&contact));
    OK(rsc_asperities_destroy(&asperities));
}

void many_contacts() {
    constexpr int n = 24;
    rsc_asperities* asperities = make(1);
    std::vector<double> one, force(n), separation(n), forces(n);
    std::vector<std::int32_t> status(n);
    for (int k = 0; k < n; ++k) force[static_cast<std::size_t>(k)] = 0.1 + 0.2 * k;
    const auto contacts = [&] {
        std::vector<rsc_contact*> made(n, nullptr);
        for (int k = 0; k < n; ++k)
            OK(rsc_contact_create(&made[static_cast<std::size_t>(k)], asperities, 94e3, 2.5, 0.4 + 0.01 * k, 0.5, nullptr));
        return made;
    };
    for (std::int32_t threads : {1, 2, 0}) {
        auto made = contacts();
        OK(rsc_contacts_press(n, made.data(), force.data(), separation.data(), status.data(), threads));
        if (one.empty()) {
            auto alone = contacts();
            one.resize(n);
            for (std::size_t k = 0; k < n; ++k) OK(rsc_contact_press(alone[k], force[k], &one[k]));
            for (auto& c : alone) OK(rsc_contact_destroy(&c));
        }
        CHECK(separation == one);
        OK(rsc_contacts_indent(n, made.data(), separation.data(), forces.data(), nullptr, threads));
        for (std::size_t k = 0; k < n; ++k) CHECK_RELATIVE(forces[k], force[k], 2e-6);  // solver%tolerance, twice
        for (auto& c : made) OK(rsc_contact_destroy(&c));
    }
    auto made = contacts();
    force[5] = -1;
    separation[5] = 7;
    CHECK(rsc_contacts_press(n, made.data(), force.data(), separation.data(), status.data(), 2) == -2 && says("contact 5:") &&
          says("argument force"));
    CHECK(status[5] == -2 && status[4] == 0 && separation[5] == 7 && separation[4] == one[4]);
    CHECK(rsc_contacts_press(-1, made.data(), force.data(), nullptr, nullptr, 1) == -1);
    CHECK(rsc_contacts_press(n, made.data(), force.data(), nullptr, nullptr, -1) == -6);
    CHECK(rsc_contacts_press(n, nullptr, force.data(), nullptr, nullptr, 1) == -2 &&
          rsc_contacts_press(n, made.data(), nullptr, nullptr, nullptr, 1) == -3);
    OK(rsc_contacts_press(0, nullptr, nullptr, nullptr, nullptr, 1));
    rsc_contact* const kept = made[3];
    made[3] = made[2];
    CHECK(rsc_contacts_press(n, made.data(), force.data(), nullptr, nullptr, 1) == -2 && says("different"));
    made[3] = kept;
    for (auto& c : made) OK(rsc_contact_destroy(&c));
    // One with nothing under it is a wrong argument of its own call, and of the whole.
    rsc_contact* apart[2] = {nullptr, nullptr};
    for (auto& c : apart) OK(rsc_contact_create(&c, asperities, 94e3, 0.25, 0.5, 0.5, nullptr));
    OK(rsc_contact_move_tip(apart[1], 1.24, 1.24));
    const double both[2] = {1, 1};
    CHECK(rsc_contacts_press(2, apart, both, nullptr, status.data(), 1) == -2 &&
          says("contact 1: argument contact has no asperity under its sphere"));
    CHECK(status[0] == 0 && status[1] == -1);
    for (auto& c : apart) OK(rsc_contact_destroy(&c));
    // One that does not converge is no wrong argument: its numbers are there.
    rsc_case* few = nullptr;
    OK(rsc_case_create(&few));
    OK(rsc_case_set(few, "solver%max_iterations", "1"));
    rsc_contact* two[2] = {nullptr, nullptr};
    OK(rsc_contact_create(&two[0], asperities, 94e3, 2.5, 0.5, 0.5, nullptr));
    OK(rsc_contact_create(&two[1], asperities, 94e3, 2.5, 0.5, 0.5, few));
    const double deep[2] = {0.002, 0.002};
    CHECK(rsc_contacts_indent(2, two, deep, forces.data(), status.data(), 1) == RSC_NOT_CONVERGED && says("contact 1:"));
    CHECK(status[0] == RSC_SUCCESS && status[1] == RSC_NOT_CONVERGED && forces[0] > 0 && forces[1] > 0);
    for (auto& c : two) OK(rsc_contact_destroy(&c));
    OK(rsc_case_destroy(&few));
    OK(rsc_asperities_destroy(&asperities));
}

}  // namespace

TESTS {
    const Folder folder;
    contacts_in_files(folder);
    other_contacts(folder);
    friction_in_files(folder);
    many_contacts();
}
