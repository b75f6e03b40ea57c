// Campaigns: what is written comes back, what is torn is left out, sums over realizations are those
// of the realizations.
#include <sys/resource.h>

#include <netcdf.h>
#include <zlib.h>

#include "base/error.hpp"
#include "case/namelist.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "run/checkpoint.hpp"
#include "run/realize.hpp"
#include "run/run.hpp"
#include "run/team.hpp"
#include "support/refused.hpp"
#include "support/temporary_folder.hpp"

namespace test_campaign {

using namespace rsc;

Case small_case() {
    Case c;
    c.surface.n = 128;
    c.surface.L_lambda_l = 4;
    c.surface.L_lambda_s = 40;
    c.indentation.levels = {3.0, 2.5, 2.0, 1.5};
    c.output.pdf_levels = {2.0, 1.5};
    c.output.map_cells = 16;
    return c;
}

RealizationRecord observed(const Job& job, int k) {
    const Realization r = realize(job, k, 1);
    return observe(job.observe, k, r.statistics, r.levels);
}

// Within the rounding of a mean and of a sum.
bool alike(const std::vector<CellSums>& a, const std::vector<CellSums>& b) {
    const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-15 * std::abs(y); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](const CellSums& x, const CellSums& y) {
                          return x.cell == y.cell && near(x.area, y.area) && near(x.force, y.force);
                      });
}

TEST(test_archive) {
    const Job job = prepare(small_case());
    Accumulators sums(job.observe, job.levels.size()), again = sums, restored = sums;
    for (int k = 1; k <= 6; ++k) {
        const RealizationRecord record = observed(job, k);
        const std::string bytes = to_bytes(record);
        CHECK(realization_of(bytes) == k);
        CHECK(to_bytes(record_from_bytes(bytes)) == bytes);
        CHECK_THROWS(record_from_bytes(bytes + "x"), Error);
        for (std::size_t length = 0; length < bytes.size(); length += 97)
            CHECK_THROWS(record_from_bytes(std::string_view(bytes).substr(0, length)), Error);
        sums.add(record);
        again.add(record_from_bytes(bytes));
        if (k <= 3) sums_from_bytes(to_bytes(sums), restored);  // interrupted after three
        if (k > 3) restored.add(record_from_bytes(bytes));
    }
    CHECK(to_bytes(again) == to_bytes(sums));
    CHECK(to_bytes(restored) == to_bytes(sums));
    // Summed in groups, and after a way through a file, they are the same within rounding.
    Accumulators left(job.observe, job.levels.size()), right = left;
    for (int k = 1; k <= 6; ++k) (k <= 2 ? left : right).add(observed(job, k));
    CHECK_THROWS(Accumulators(right).append(left), Error);
    left.append(right);
    for (const std::size_t s : indices(sums.steps)) CHECK(alike(left.maps[s], sums.maps[s]));
    const Observations o = sums.finish();
    std::vector<double> area(job.observe.map.cells()), pressure = area;
    for (const std::size_t s : indices(sums.steps)) {
        o.map_area_fraction.fill(s, area);
        o.map_pressure.fill(s, pressure);
        restored.restore_map(s, area, pressure);
        CHECK(alike(restored.maps[s], sums.maps[s]));
    }
    Accumulators other(job.observe, job.levels.size() + 1);
    CHECK_THROWS(sums_from_bytes(to_bytes(sums), other), Error);
}

std::vector<std::string> some_records() {
    std::vector<std::string> records;
    for (const int k : indices(4)) records.push_back(std::string(40 + 13 * k, char('a' + k)));
    return records;
}

void write_bytes(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::string refusal(const std::string& file, const Case& c, bool resume) {
    return ::refusal([&] { Checkpoint(file, c, resume); });
}

TEST(test_torn) {
    const Folder folder;
    const std::string file = folder / "out.nc", state = checkpoint_name(file);
    const Case c = small_case();
    const std::vector<std::string> records = some_records();
    std::vector<std::size_t> ends;  // of the header and of each record
    {
        Checkpoint checkpoint(file, c, false);
        ends.push_back(bytes(state).size());
        for (const std::string& record : records) {
            checkpoint.append(record);
            ends.push_back(bytes(state).size());
        }
        CHECK(refusal(file, c, true).find("another process") != std::string::npos);
    }
    const auto says = [&](const std::string& words, const Case& now = small_case(),
                          bool resume = true) {
        return refusal(file, now, resume).find(words) != std::string::npos;
    };
    CHECK(says("--resume", c, false));
    Case other = c;
    other.solids.R[1] = 3;
    other.surface.L = 2;
    CHECK(says("solids%R: Infinity, 2.5 there, Infinity, 3.0 now", other) &&
          says("surface%L: unset there, 2.0 now", other));
    const std::string whole = bytes(state);
    // Killed at any moment: the records that are whole are there, and the next one is taken.
    for (std::size_t length = 0; length <= whole.size(); length += 3) {
        write_bytes(state, whole.substr(0, length));
        std::size_t kept = 0;
        while (kept < records.size() && ends[kept + 1] <= length) ++kept;
        {
            Checkpoint checkpoint(file, c, true);
            const auto contents = checkpoint.take_contents();
            CHECK(!contents.sums && contents.records.size() == kept);
            for (const auto k : indices(contents.records)) CHECK(contents.records[k] == records[k]);
            checkpoint.append("one more");
        }
        Checkpoint checkpoint(file, c, true);
        const auto contents = checkpoint.take_contents();
        CHECK(contents.records.size() == kept + 1 && contents.records.back() == "one more");
    }
    // A spoilt byte: the records before it are there, and nothing wrong is.
    for (std::size_t at = 0; at < whole.size(); at += 5) {
        std::string spoilt = whole;
        spoilt[at] = char(spoilt[at] ^ 0x20);
        write_bytes(state, spoilt);
        if (at < ends[0]) {
            CHECK(!refusal(file, c, true).empty());
            continue;
        }
        std::size_t kept = 0;
        while (ends[kept + 1] <= at) ++kept;
        Checkpoint checkpoint(file, c, true);
        const auto contents = checkpoint.take_contents();
        CHECK(contents.records.size() == kept);
        for (const auto k : indices(contents.records)) CHECK(contents.records[k] == records[k]);
    }
    write_bytes(state,
                "something else that has nothing to do with rsc but has this name\n" + whole);
    CHECK(says("damaged"));
    // Whole frames that are no header of this version.
    write_bytes(state, whole.substr(ends[0]));
    CHECK(says("not a checkpoint"));
    const std::string header = whole.substr(16, ends[0] - 16);
    const auto framed = [&](const std::string& bytes) {
        // kind, checksum of kind, length and bytes, length
        std::string frame = whole.substr(0, 16);
        const std::uint64_t length = bytes.size();
        std::memcpy(frame.data() + 8, &length, sizeof length);
        uLong crc = crc32_z(0, reinterpret_cast<const Bytef*>(frame.data()), 4);
        crc = crc32_z(crc, reinterpret_cast<const Bytef*>(frame.data() + 8), 8);
        const auto sum = static_cast<std::uint32_t>(
            crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
        std::memcpy(frame.data() + 4, &sum, sizeof sum);
        return frame + bytes;
    };
    write_bytes(state, framed(header));
    CHECK(refusal(file, c, true).empty());
    write_bytes(state, framed(header + "&nothing /\n"));
    CHECK(says("damaged"));
    write_bytes(state, framed("rsc 0.0.9\n" + header.substr(header.find('\n') + 1)));
    CHECK(says("rsc 0.0.9"));
    std::filesystem::remove(state);
}

TEST(test_rewrite) {
    const Folder folder;
    const std::string file = folder / "out.nc", state = checkpoint_name(file);
    const std::vector<std::string> records = some_records();
    {
        Checkpoint checkpoint(file, small_case(), false);
        for (const std::string& record : records) checkpoint.append(record);
        checkpoint.rewrite("the sums", {&records[3]});
        CHECK(!checkpoint.wants_rewrite());
        checkpoint.append("after it");
    }
    {
        const std::string whole = bytes(state);
        std::string spoilt = whole;
        spoilt[whole.find("the sums")] = 'T';
        write_bytes(state, spoilt);
        CHECK(refusal(file, small_case(), true).find("checksum") != std::string::npos);
        write_bytes(state, whole);
    }
    {
        Checkpoint checkpoint(file, small_case(), true);
        const auto contents = checkpoint.take_contents();
        CHECK(contents.sums && *contents.sums == "the sums");
        CHECK((contents.records == std::vector<std::string>{records[3], "after it"}));
        // No room for the new file: the old one goes on.
        rlimit usual{};
        CHECK(getrlimit(RLIMIT_FSIZE, &usual) == 0 && std::signal(SIGXFSZ, SIG_IGN) != SIG_ERR);
        const rlimit little{10, usual.rlim_max};
        CHECK(setrlimit(RLIMIT_FSIZE, &little) == 0);
        checkpoint.rewrite("newer sums", {});
        // No room for a whole record: what is written of it is taken away.
        const rlimit some{bytes(state).size() + 20, usual.rlim_max};
        CHECK(setrlimit(RLIMIT_FSIZE, &some) == 0);
        CHECK_THROWS(checkpoint.append(std::string(100, 'x')), Error);
        CHECK(setrlimit(RLIMIT_FSIZE, &usual) == 0);
        checkpoint.append("and on");
    }
    Checkpoint checkpoint(file, small_case(), true);
    const auto contents = checkpoint.take_contents();
    CHECK(contents.sums && *contents.sums == "the sums" && contents.records.size() == 3 &&
          contents.records.back() == "and on");
    // It outgrows the sums after some 16 MB.
    const std::string large(std::size_t{1} << 20, 'x');
    int appended = 0;
    while (!checkpoint.wants_rewrite() && appended < 40) {
        checkpoint.append(large);
        ++appended;
    }
    CHECK(appended > 10 && appended < 40);
    checkpoint.remove();
    CHECK(folder.files() == 0);
}

// Another value of a key, in namelist syntax.
std::string other_value(const Key& key, const std::string& value) {
    if (key.type == Type::logical) return value == ".true." ? ".false." : ".true.";
    if (key.type == Type::choice) {
        for (const char* choice : key.choices)
            if (std::string("'") + choice + "'" != value) return std::string("'") + choice + "'";
    }
    if (std::string(key.name) == "length_unit") return "'um'";
    if (std::string(key.name) == "force_unit") return "'kN'";
    if (std::string(key.name) == "time_unit") return "'ms'";
    for (const std::string_view unit : {"height_unit", "coordinate_unit"})
        if (key.name == unit) return "'um'";
    for (const std::string_view rises : {"times", "distances", "stress_depths"})
        if (key.name == rises) return "1.25, 2.75";
    if (std::string(key.name) == "relaxation_share") return "0.25, 0.375";
    if (key.type == Type::string || key.type == Type::choice) return "'another'";
    if (key.type != Type::real)
        return std::to_string(std::stoll(value) + (std::stod(value) < key.bounds.high ? 2 : -2));
    if (key.list) return std::string(key.name) == "layer_nu" ? "0.25, 0.375" : "1.25, 0.75";
    const double number = value.empty() ? 0 : std::stod(value);
    return std::isfinite(number) && number != 0 ? namelist::from_real(0.75 * number) : "0.25";
}

// A campaign goes on with the case it was begun with: no key that acts on a number of the file may
// be another one.
TEST(test_every_difference) {
    const std::set<std::string> free = {"run%title",   "run%realizations", "run%threads",
                                        "output%file", "output%format",    "output%compression"};
    for (const Key& key : registry()) {
        const std::string name = std::string(key.group) + "%" + key.name,
                          element = name + (key.size == 2 && !key.list ? "(2)" : "");
        if (free.contains(name)) continue;
        Case there = small_case();
        if (name == "indenter%radii")
            there.indenter.radii[0] = there.indenter.radii[1] = 1.0;  // they are given both
        Case now = there;
        set_key(now, element, other_value(key, get_key(there, element)));
        const auto lines = Checkpoint::differences(there, now);
        const bool named = std::ranges::any_of(
            lines, [&](const std::string& line) { return line.starts_with(name + ": "); });
        if (!named) std::printf("  %s may change unnoticed\n", name.c_str());
        CHECK(named);
    }
}

TEST(test_team) {
    for (int threads : {1, 3}) {
        std::atomic<int> running{0}, most{0};
        ThreadTeam team(
            [&](const Task& task, const std::atomic<bool>&) {
                const int now = ++running;
                for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                --running;
                return std::to_string(task.realization);
            },
            threads);
        std::int64_t next = 0;
        std::set<std::string> answers;
        std::size_t calls = 0;
        team.run(
            [&]() -> std::optional<Task> {
                return next < 50 ? std::optional<Task>({0, ++next}) : std::nullopt;
            },
            [&](const Task& task, std::string&& answer) {
                CHECK(answer == std::to_string(task.realization));
                answers.insert(answer);
                ++calls;
            },
            1);
        CHECK(calls == 50 && answers.size() == 50 && most <= threads);
    }
    // A task that fails ends the run, and tells the others.
    std::atomic<int> abandoned_ones{0};
    ThreadTeam team(
        [&](const Task& task, const std::atomic<bool>& abandoned) -> std::string {
            if (task.realization == 2) throw std::runtime_error("the second");
            while (!abandoned) std::this_thread::yield();
            ++abandoned_ones;
            return {};
        },
        2);
    std::int64_t next = 0;
    CHECK_THROWS(team.run(
                     [&]() -> std::optional<Task> {
                         return Task{0, ++next};
                     },
                     [](const Task&, std::string&&) {}, 0),
                 std::runtime_error);
    CHECK(abandoned_ones >= 1);
}

}  // namespace test_campaign
