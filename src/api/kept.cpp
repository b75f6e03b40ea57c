// Contacts and friction saved in files.
//
// The file has a line with its kind, a checksum, and named entries: texts and arrays of numbers in
// the machine's format. Later additions get new names, so that later versions can read files of
// earlier ones.

#include <unistd.h>

#include "api/guard.hpp"
#include "api/handles.hpp"
#include "base/archive.hpp"
#include "base/version.h"
#include "case/read_case.hpp"
#include "contact/quantities.hpp"
#include "io/whole_file.hpp"

namespace rsc::api {
namespace {

using Numbers = std::vector<double>;
constexpr const char* kBroken = "the file is damaged";
constexpr double kFormat = 2;  // increased when earlier versions would misread the entries

std::uint64_t mix(std::uint64_t hash, const void* data, std::size_t n) {  // FNV-1a
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (const auto k : indices(n)) hash = (hash ^ bytes[k]) * 0x100000001b3ull;
    return hash;
}
constexpr std::uint64_t kHash = 0xcbf29ce484222325ull;

// Checksum of the asperities, or points of a surface, to recognise those of a saved contact.
// Missing columns are not included.
double digest(const SurfaceModel& on) {
    std::uint64_t hash = kHash;
    for (const AsperityColumn& column : kAsperityColumns) {
        const auto& values = on.asperities.*column.values;
        if (values.empty()) continue;
        hash = mix(mix(hash, column.name, std::strlen(column.name)), values.data(),
                   values.size() * sizeof(double));
    }
    if (on.points)
        for (const int j : indices(on.points->ny))
            hash = mix(hash, on.points->row(j), at(on.points->nx) * sizeof(double));
    return double(hash >> 11);  // exact as a double
}

// Texts and numbers by name, written or read. What a file of an earlier version lacks keeps its
// default.
struct Entries {
    bool reading = false;
    std::map<std::string, Numbers> numbers = {};
    std::map<std::string, std::string> texts = {};
    bool has(const std::string& name) const { return numbers.contains(name); }
    const Numbers& of(const std::string& name) const {
        const auto found = numbers.find(name);
        if (found == numbers.end()) bad_input(kBroken);
        return found->second;
    }
    double one(const std::string& name) const {
        if (of(name).size() != 1) bad_input(kBroken);
        return of(name)[0];
    }

    // An entry of several values; false if it is not there.
    template <class... T>
    bool row(const std::string& name, T&... values) {
        if (!reading) numbers[name] = {double(values)...};
        if (!has(name)) return false;
        const Numbers& found = of(name);
        if (found.size() != sizeof...(values)) bad_input(kBroken);
        auto next = found.begin();
        if (reading) ((values = static_cast<T>(*next++)), ...);
        return true;
    }
    // An entry of many objects, of whose values `fields` makes a tuple of references.
    template <class Vector, class Fields>
    void rows(const std::string& name, Vector& all, Fields fields) {
        if (reading && !has(name)) return;
        Numbers& flat = numbers[name];
        if (!reading) {
            for (auto& one : all)
                std::apply([&](auto&... v) { append(flat, {double(v)...}); }, fields(one));
            return;
        }
        typename Vector::value_type one{};
        if (flat.size() % std::tuple_size_v<decltype(fields(one))> != 0) bad_input(kBroken);
        all.clear();
        for (auto next = flat.begin(); next != flat.end(); all.push_back(one))
            std::apply(
                [&](auto&... v) { ((v = static_cast<std::decay_t<decltype(v)>>(*next++)), ...); },
                fields(one));
    }
    void list(const std::string& name, auto& values) {
        rows(name, values, [](auto& value) { return std::tie(value); });
    }
};

const std::string kStart = "rsc save of ";
constexpr const char *kContact = "a contact", *kFriction = "a contact with friction";
const FileKind kSave{"saved contact",
                     [](const std::string& path) { return begins_with(path, kStart); }};

std::vector<char> characters(const std::string& text) { return {text.begin(), text.end()}; }

void write(const std::string& path, const char* what, Entries& entries) {
    entries.numbers["format"] = {kFormat};
    entries.texts["rsc"] = RSC_VERSION;
    ArchiveWriter writer;
    writer(std::uint64_t(entries.texts.size()));
    for (const auto& [name, text] : entries.texts) {
        writer(characters(name));
        writer(characters(text));
    }
    writer(std::uint64_t(entries.numbers.size()));
    for (const auto& [name, numbers] : entries.numbers) {
        writer(characters(name));
        writer(numbers);
    }
    const std::uint64_t hash = mix(kHash, writer.bytes.data(), writer.bytes.size());
    write_whole(path, kSave, kStart + what + "\n" + bytes_of(hash) + writer.bytes);
}

Entries read(const std::string& path, const char* what) {
    const std::string head = kStart + what + "\n";
    const auto refuse = [&](const auto&... why) { bad_input("'", path, "' ", why...); };
    if (access(path.c_str(), R_OK) != 0)  // not by opening it: a FIFO would wait for a writer
        bad_input("cannot read '", path, "'");
    if (!begins_with(path, head)) refuse("is not ", what, " saved by rsc");
    std::ifstream in(path, std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    std::uint64_t hash = 0;
    if (all.size() < head.size() + sizeof hash) refuse("is damaged");
    std::memcpy(&hash, all.data() + head.size(), sizeof hash);
    const std::string_view body = std::string_view(all).substr(head.size() + sizeof hash);
    if (mix(kHash, body.data(), body.size()) != hash) refuse("is damaged");
    ArchiveReader reader(body, Failure::bad_input, kBroken);
    Entries entries{true};
    std::vector<char> name, text;
    std::uint64_t count = 0;
    for (reader(count); count > 0; --count) {
        reader(name);
        reader(text);
        entries.texts[{name.begin(), name.end()}] = {text.begin(), text.end()};
    }
    for (reader(count); count > 0; --count) {
        reader(name);
        reader(entries.numbers[{name.begin(), name.end()}]);
    }
    reader.end();
    if (entries.one("format") > kFormat || begins_with(entries.texts["rsc"], "0.3"))
        refuse("was saved by rsc ", entries.texts["rsc"],
               ", which this version (" RSC_VERSION ") cannot read");
    return entries;
}

void require_path(const char* path, int argument) {
    require(path, argument, "path");
    if (!*path) refuse(argument, "path", "must not be empty");
}

// --- definition of a contact

void put_making(Entries& to, const rsc_contact& contact) {
    const Indenter& indenter = contact.path.indenter();
    to.numbers["ground"] = {digest(*contact.on)};
    to.numbers["tip"] = {indenter.x0, indenter.y0};
    to.numbers["first"] = {contact.first.x0, contact.first.y0};
    to.numbers["moved"] = {double(indenter.around.finite())};
    if (contact.given) to.numbers["given"] = {(*contact.given)[0], (*contact.given)[1]};
    to.texts["case"] = effective_namelist(*contact.keys);
}

std::unique_ptr<rsc_contact> get_making(const Entries& from, const rsc_asperities& asperities) {
    const SurfaceModel& on = *asperities.model;
    if (from.one("ground") != digest(on))
        refuse(2, "asperities", "must be the ones that the file was saved with");
    const Numbers& tip = from.of(from.has("first") ? "first" : "tip");
    if (tip.size() != 2 || !from.texts.contains("case")) bad_input(kBroken);
    const auto keys = std::make_shared<const Case>(read_namelist(from.texts.at("case")).settings);
    const SurfaceDomain domain = domain_of(*keys, on);
    const bool given = from.has("given");
    Indenter indenter = given ? Indenter{from.of("given").at(0), from.of("given").at(1), 0, 0,
                                         period_of(*keys, domain)}
                              : indenter_of(*keys, domain);
    indenter.x0 = tip[0];
    indenter.y0 = tip[1];
    indenter = surrounded(std::move(indenter), domain);
    if (from.has("moved") && from.one("moved") != 0) indenter.around = indenter.repeats;
    auto made = std::make_unique<rsc_contact>(asperities.model, keys, indenter);
    if (given) made->given = {from.of("given")[0], from.of("given")[1]};
    return made;
}

// --- states

constexpr const char* kComponents[] = {"", ".y", ".z", ".yx"};  // of a quantity of a level

void transfer(Entries& entries, const std::string& prefix, Level& level) {
    for (const LevelQuantity& q : level_quantities())
        for (const auto c : indices(q.components())) {
            double value = q.of(level, c);
            if (entries.row(prefix + q.name + kComponents[c], value) && entries.reading)
                q.put(level, value, c);
        }
    const auto list = [&](const char* name, auto& values) { entries.list(prefix + name, values); };
    list("asperity", level.asperity);
    list("yields", level.yields);
    list("x", level.x);
    list("y", level.y);
    list("f", level.f);
    list("a", level.a);
    list("u", level.u);
    list("own_area", level.own_area);
    LevelPixels& p = level.pixels;
    entries.row(prefix + "pixels", p.columns, p.x0, p.y0, p.dx, p.dy);
    list("pixel", p.index);
    list("pixel_contact", p.contact);
    list("pixel_pressure", p.pressure);
    list("pixel_cohesive", p.cohesive);
    list("pixel_attraction", p.attraction);
    LevelTractions& t = level.tractions;
    list("attached_x", t.x);
    list("attached_y", t.y);
    list("attached_a", t.a);
    list("attached_c", t.c);
    list("attached_pressed", t.pressed);
    list("attached_pulled", t.pulled);
    list("gaps", level.gaps.of_bin);
    auto& [first, second, third, fourth] = level.gaps.power;
    entries.row(prefix + "more", level.converged, level.unique, level.gaps.beyond, first, second,
                third, fourth);
    Numbers errors(level.errors.begin(), level.errors.end());
    list("errors", errors);
    if (errors.size() != level.errors.size()) bad_input(kBroken);
    std::ranges::copy(errors, level.errors.begin());
    entries.rows(prefix + "spots", level.spots,
                 [](Spot& s) { return std::tie(s.x, s.y, s.major, s.minor, s.angle); });
}

// Throws unless the level is one on `places` asperities or points.
void require_sound(const Level& level, int places) {
    const auto outside = [&](int k) { return k < 0 || k >= places; };
    const std::size_t n = level.asperity.size();
    const LevelTractions& t = level.tractions;
    const LevelPixels& p = level.pixels;
    bool sound = p.attraction.size() == p.cohesive.size() && p.pressure.size() == p.index.size() &&
                 (p.contact.empty() || p.contact.size() == p.index.size());
    for (const auto* values : {&t.y, &t.a, &t.c, &t.pressed, &t.pulled})
        sound = sound && values->size() == t.x.size();
    for (const auto* values : {&level.x, &level.y, &level.f, &level.a, &level.u})
        sound = sound && values->size() == n;
    for (const auto* where : {&p.cohesive, &level.asperity, &p.index})
        sound = sound && std::ranges::none_of(*where, outside);
    if (!sound) bad_input(kBroken);
}

void transfer(Entries& entries, const std::string& prefix, Path::State& state,
              const rsc_contact& contact) {
    if (entries.reading) {
        state = {};
        state.moved = contact.path.indenter().around.finite();
        state.clock = kNotComputed;
        if (entries.has(prefix + "level")) state.level.emplace();
        const auto solution = entries.texts.find(prefix + "solution");
        if (solution != entries.texts.end() && entries.texts["rsc"] == RSC_VERSION)
            state.solution = solution->second;
    } else {
        entries.texts[prefix + "solution"] = state.solution;
    }
    entries.row(prefix + "tip", state.x0, state.y0);
    entries.row(prefix + "clock", state.clock, state.moved);
    entries.row(prefix + "accepted", state.time, state.separation, state.force);
    entries.list(prefix + "history", state.history);
    if (!state.level) return;
    entries.row(prefix + "level", state.level->separation, state.level_x0, state.level_y0);
    transfer(entries, prefix + "level.", *state.level);
    const auto& points = contact.on->points;
    require_sound(*state.level,
                  points ? points->nx * points->ny : int(contact.path.asperities()->size()));
}

void transfer(Entries& entries, const std::string& prefix, FrictionHistory::State& path) {
    entries.row(prefix, path.begun, path.delta, path.xi.x, path.xi.y, path.lost, path.step_lost);
    entries.rows(prefix + ".nodes", path.nodes, [](auto& node) {
        return std::tie(node.approach, node.load, node.energy, node.deflection.x,
                        node.deflection.y);
    });
}

void transfer(Entries& entries, const std::string& prefix, ElementFriction::State& e) {
    if (entries.reading) e.begun = entries.has(prefix + "elements");
    if (!e.begun) return;
    SlidingElements::State& t = e.tractions;
    entries.row(prefix + "elements", e.separation, e.load, e.energy, e.step_lost, e.xi.x, e.xi.y,
                t.lost);
    entries.list(prefix + "pixels", t.pixels);
    entries.list(prefix + "limit", t.limit);
    entries.list(prefix + "q", t.q);
    entries.list(prefix + "u", t.u);
    entries.list(prefix + "slip", t.slip);
}

// `path`: the prefix of the loading path.
void transfer(Entries& entries, const std::string& prefix, const std::string& path,
              rsc_friction::State& state, const rsc_friction& friction) {
    transfer(entries, path, state.path);
    if (entries.reading && !entries.has(prefix + "known")) {  // files of rsc 0.4
        state.known = {};
        for (Path::State* contact : {&state.outer, &state.inner}) {
            entries.row(prefix.empty() ? "tip" : "committed_tip", contact->x0, contact->y0);
            contact->solution.clear();
            contact->level.reset();
        }
        return;
    }
    transfer(entries, prefix + "outer.", state.outer, friction.outer);
    transfer(entries, prefix + "inner.", state.inner, friction.inner);
    entries.row(prefix + "known", state.known[0], state.known[1]);
    transfer(entries, prefix, state.elements);
}

// Both states of a contact, or of friction.
void transfer(Entries& entries, rsc_contact& contact, Path::State& state) {
    transfer(entries, "", state, contact);
    transfer(entries, "committed.", contact.committed, contact);
}
void transfer(Entries& entries, rsc_friction& friction, rsc_friction::State& state) {
    transfer(entries, "", "path", state, friction);
    transfer(entries, "committed.", "committed", friction.committed, friction);
}

}  // namespace
}  // namespace rsc::api

using namespace rsc;
using namespace rsc::api;

int32_t rsc_contact_save(rsc_contact* contact, const char* path) {
    return on(contact, "contact", 2, [&] {
        require_path(path, 2);
        Entries entries;
        put_making(entries, *contact);
        Path::State state = contact->path.state();
        transfer(entries, *contact, state);
        write(path, kContact, entries);
    });
}

int32_t rsc_contact_restore(rsc_contact** contact, const rsc_asperities* asperities,
                            const char* path) {
    return constructed(3, contact, "contact", [&] {
        require(asperities, 2, "asperities");
        require_path(path, 3);
        Entries entries = read(path, kContact);
        auto made = get_making(entries, *asperities);
        Path::State state;
        transfer(entries, *made, state);
        made->restore(state);
        return made.release();
    });
}

int32_t rsc_friction_save(rsc_friction* friction, const char* path) {
    return on(friction, "friction", 2, [&] {
        require_path(path, 2);
        Entries entries;
        put_making(entries, friction->outer);
        entries.numbers["friction"] = {friction->history.friction().coefficient,
                                       friction->history.friction().ratio};
        rsc_friction::State state = friction->state();
        transfer(entries, *friction, state);
        write(path, kFriction, entries);
    });
}

int32_t rsc_friction_restore(rsc_friction** friction, const rsc_asperities* asperities,
                             const char* path) {
    return constructed(3, friction, "friction", [&] {
        require(asperities, 2, "asperities");
        require_path(path, 3);
        Entries entries = read(path, kFriction);
        const Numbers& with = entries.of("friction");
        if (with.size() != 2) bad_input(kBroken);
        const auto like = get_making(entries, *asperities);
        auto made = std::make_unique<rsc_friction>(*like, like->first, Friction{with[0], with[1]});
        rsc_friction::State state = made->state();
        transfer(entries, *made, state);
        made->restore(state);
        return made.release();
    });
}
