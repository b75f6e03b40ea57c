// Files of contacts: what may be replaced and what is refused (how they continue: test_state_walk);
// many contacts in one call give the results of single calls, for any number of threads.
#include <sys/resource.h>
#include <sys/stat.h>

#include "check.hpp"
#include "support/asperities.hpp"
#include "support/library.hpp"
#include "support/temporary_folder.hpp"

namespace test_api_kept {

AsperitiesHandle make(unsigned seed) {
    return take(random_asperities(400, 0.01, 0.01, 5e-4, 0.4, seed));
}

TEST(contacts_in_files) {
    const Folder folder;
    const AsperitiesHandle asperities = make(1), others = make(2);
    ContactHandle contact, again;
    OK(rsc_contact_create(&contact, asperities, 94e3, 2.5, 0.5, 0.5, nullptr));
    const std::string file = folder / "contact";
    OK(rsc_contact_save(contact, file.c_str()));  // without a level
    OK(rsc_contact_restore(&again, asperities, file.c_str()));
    double N = 0, same = 0, E = 0, W = 0, Z0 = 0;
    CHECK(rsc_contact_energy(again, &E) == RSC_NO_RESULT);
    for (double z : {0.008, 0.007, 0.006, 0.005, 0.0045}) OK(rsc_contact_indent(contact, z, &N));
    OK(rsc_contact_energy(contact, &W));
    OK(rsc_contact_save(contact, file.c_str()));
    OK(rsc_contact_restore(&again, asperities, file.c_str()));
    OK(rsc_contact_result(again, &Z0, &same, nullptr, nullptr));
    OK(rsc_contact_energy(again, &E));
    CHECK(Z0 == 0.0045 && same == N && E == W && N > 0);
    // Other asperities, and a file that does not exist.
    CHECK(rsc_contact_restore(&again, others, file.c_str()) == -2 && says("asperities") && !again);
    CHECK(rsc_contact_restore(&again, asperities, (folder / "nothing").c_str()) == -3 &&
          says("cannot read"));
    // A full disk, here the limit of file sizes: reported, and the earlier file is unchanged.
    const std::string before = bytes(file);
    rlimit usual{};
    CHECK(getrlimit(RLIMIT_FSIZE, &usual) == 0 && std::signal(SIGXFSZ, SIG_IGN) != SIG_ERR);
    const rlimit little{100, usual.rlim_max};
    CHECK(setrlimit(RLIMIT_FSIZE, &little) == 0);
    const std::int32_t full = rsc_contact_save(contact, file.c_str());
    CHECK(setrlimit(RLIMIT_FSIZE, &usual) == 0);
    CHECK(full == RSC_FILE && says("cannot write") && bytes(file) == before &&
          !std::ifstream(file + ".new"));
    // Another's file is not overwritten, and neither a device nor a pipe that nobody writes is
    // read.
    const std::string source = folder.write("source.f90", "end"), fifo = folder / "fifo";
    CHECK(rsc_contact_save(contact, source.c_str()) == RSC_FILE && bytes(source) == "end");
    CHECK(mkfifo(fifo.c_str(), 0600) == 0 &&
          rsc_contact_restore(&again, asperities, fifo.c_str()) == -3);
    CHECK(rsc_contact_restore(&again, asperities, "/dev/zero") == -3 && !again);
    std::string spoilt = bytes(file);
    spoilt[spoilt.size() / 2] ^= 4;
    std::ofstream(folder / "spoilt", std::ios::binary) << spoilt;
    CHECK(rsc_contact_restore(&again, asperities, (folder / "spoilt").c_str()) == -3 &&
          says("damaged"));
    std::ofstream(folder / "short", std::ios::binary) << bytes(file).substr(0, 60);
    CHECK(rsc_contact_restore(&again, asperities, (folder / "short").c_str()) == -3 && !again);
}

TEST(many_contacts) {
    constexpr int n = 24;
    const AsperitiesHandle asperities = make(1);
    std::vector<double> one, force(n), separation(n), forces(n);
    std::vector<std::int32_t> status(n);
    for (const int k : indices(n)) force[k] = 0.1 + 0.2 * k;
    const auto contacts = [&] {
        std::vector<rsc_contact*> made(n, nullptr);
        for (const int k : indices(n))
            OK(rsc_contact_create(&made[k], asperities, 94e3, 2.5, 0.4 + 0.01 * k, 0.5, nullptr));
        return made;
    };
    for (std::int32_t threads : {1, 2, 0}) {
        auto made = contacts();
        OK(rsc_contacts_press(n, made.data(), force.data(), separation.data(), status.data(),
                              threads));
        if (one.empty()) {
            auto alone = contacts();
            one.resize(n);
            for (const std::size_t k : indices(n))
                OK(rsc_contact_press(alone[k], force[k], &one[k]));
            for (auto& c : alone) OK(rsc_contact_destroy(&c));
        }
        CHECK(separation == one);
        OK(rsc_contacts_indent(n, made.data(), separation.data(), forces.data(), nullptr, threads));
        for (const std::size_t k : indices(n))
            CHECK_RELATIVE(forces[k], force[k], 2e-6);  // solver%tolerance, twice
        for (auto& c : made) OK(rsc_contact_destroy(&c));
    }
    auto made = contacts();
    force[5] = -1;
    separation[5] = 7;
    CHECK(rsc_contacts_press(n, made.data(), force.data(), separation.data(), status.data(), 2) ==
              -2 &&
          says("contact 5:") && says("argument force"));
    CHECK(status[5] == -2 && status[4] == 0 && separation[5] == 7 && separation[4] == one[4]);
    rsc_contact* const kept = made[3];
    made[3] = made[2];
    CHECK(rsc_contacts_press(n, made.data(), force.data(), nullptr, nullptr, 1) == -2 &&
          says("different"));
    made[3] = kept;
    for (auto& c : made) OK(rsc_contact_destroy(&c));
}

// A step of many returns what each level alone does, with stiffness and without, also where two
// flats of asperities are pressed so far together that there is no level.
TEST(steps_of_many) {
    const Made made(
        "&surface n=64 L_lambda_l=4 L_lambda_s=16 / &solids R=Infinity,Infinity / "
        "&solver model='asperities' / &indentation boundary='periodic' /");
    for (const double Z0 : {0.01, -0.05}) {
        const ContactHandle alone = contact_on(made.asperities, made.c);
        double N = 0, separation = 7, force = 7, slope = 7;
        const std::int32_t status = rsc_contact_indent(alone, Z0, &N);
        CHECK(status == (Z0 > 0 ? RSC_SUCCESS : RSC_NOT_CONVERGED));
        for (double* stiffness : {static_cast<double*>(nullptr), &slope}) {
            const ContactHandle one = contact_on(made.asperities, made.c);
            rsc_contact* contacts[] = {one};
            std::int32_t level = -1, each = -1;
            CHECK(rsc_contacts_step(1, contacts, nullptr, nullptr, 0, &Z0, &separation, &force,
                                    stiffness, nullptr, nullptr, nullptr, nullptr, &level, &each,
                                    1) == status);
            CHECK(each == status && separation == Z0 &&
                  (level == RSC_LEVEL_NOT_CONVERGED) == (status != RSC_SUCCESS));
            CHECK(std::isnan(N) ? std::isnan(force) : force == N);
        }
        CHECK(std::isnan(N) ? std::isnan(slope) : slope < 0);
    }
}

}  // namespace test_api_kept
