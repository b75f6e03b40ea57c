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

struct Entries {
    std::map<std::string, Numbers> numbers;
    std::map<std::string, std::string> texts;
    const Numbers& of(const std::string& name) const {
        const auto found = numbers.find(name);
        if (found == numbers.end()) bad_input(kBroken);
        return found->second;
    }
    double one(const std::string& name) const {
        if (of(name).size() != 1) bad_input(kBroken);
        return of(name)[0];
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
    Entries entries;
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
    const Numbers& tip = from.of(from.numbers.contains("first") ? "first" : "tip");
    if (tip.size() != 2 || !from.texts.contains("case")) bad_input(kBroken);
    const auto keys = std::make_shared<const Case>(read_namelist(from.texts.at("case")).settings);
    const SurfaceDomain domain = domain_of(*keys, on);
    const bool given = from.numbers.contains("given");
    Indenter indenter = given ? Indenter{from.of("given").at(0), from.of("given").at(1), 0, 0,
                                         period_of(*keys, domain)}
                              : indenter_of(*keys, domain);
    indenter.x0 = tip[0];
    indenter.y0 = tip[1];
    indenter = surrounded(std::move(indenter), domain);
    if (from.numbers.contains("moved") && from.one("moved") != 0)
        indenter.around = indenter.repeats;
    auto made = std::make_unique<rsc_contact>(asperities.model, keys, indenter);
    if (given) made->given = {from.of("given")[0], from.of("given")[1]};
    return made;
}

// --- states

// Visits the arrays of a level with their names.
template <class Visit>
void visit_arrays(Level& level, Visit&& visit) {
    visit("asperity", level.asperity);
    visit("yields", level.yields);
    visit("x", level.x);
    visit("y", level.y);
    visit("f", level.f);
    visit("a", level.a);
    visit("u", level.u);
    visit("pixel", level.pixels.index);
    visit("pixel_contact", level.pixels.contact);
    visit("pixel_pressure", level.pixels.pressure);
    LevelTractions& t = level.tractions;
    visit("attached_x", t.x);
    visit("attached_y", t.y);
    visit("attached_a", t.a);
    visit("attached_c", t.c);
    visit("attached_pressed", t.pressed);
    visit("attached_pulled", t.pulled);
    visit("pixel_cohesive", level.pixels.cohesive);
    visit("pixel_attraction", level.pixels.attraction);
    visit("own_area", level.own_area);
    visit("gaps", level.gaps.of_bin);
}

constexpr const char* kComponents[] = {"", ".y", ".z", ".yx"};  // of a quantity of a level

void put_state(Entries& to, const std::string& prefix, const Path::State& state) {
    to.numbers[prefix + "tip"] = {state.x0, state.y0};
    to.numbers[prefix + "clock"] = {state.clock, double(state.moved)};
    to.numbers[prefix + "accepted"] = {state.time, state.separation, state.force};
    to.numbers[prefix + "history"] = state.history;
    to.texts[prefix + "solution"] = state.solution;
    if (!state.level) return;
    Level level = *state.level;
    to.numbers[prefix + "level"] = {level.separation, state.level_x0, state.level_y0};
    for (const LevelQuantity& q : level_quantities())
        for (const auto c : indices(q.components()))
            to.numbers[prefix + "level." + q.name + kComponents[c]] = {q.of(level, c)};
    visit_arrays(level, [&](const char* name, const auto& values) {
        to.numbers[prefix + "level." + name] = {values.begin(), values.end()};
    });
    const LevelPixels& p = level.pixels;
    to.numbers[prefix + "level.pixels"] = {double(p.columns), p.x0, p.y0, p.dx, p.dy};
    Numbers& more = to.numbers[prefix + "level.more"];
    more = {double(level.converged), double(level.unique), double(level.gaps.beyond)};
    to.numbers[prefix + "level.errors"] = {level.errors.begin(), level.errors.end()};
    append(more, level.gaps.power);
    Numbers& spots = to.numbers[prefix + "level.spots"];
    for (const Spot& s : level.spots) append(spots, {s.x, s.y, s.major, s.minor, s.angle});
}

// Of what files of rsc 0.4 lack.
void get_rest(const Entries& from, const std::string& prefix, Level& level) {
    if (!from.numbers.contains(prefix + "level.more")) return;
    const Numbers &more = from.of(prefix + "level.more"), &spots = from.of(prefix + "level.spots");
    auto& power = level.gaps.power;
    if (more.size() != 3 + power.size() || spots.size() % 5 != 0) bad_input(kBroken);
    level.converged = more[0] != 0;
    level.unique = more[1] != 0;
    level.gaps.beyond = std::int32_t(more[2]);
    const Numbers& errors = from.of(prefix + "level.errors");
    if (errors.size() != level.errors.size()) bad_input(kBroken);
    std::ranges::copy(errors, level.errors.begin());
    std::copy(more.begin() + 3, more.end(), power.begin());
    for (std::size_t k = 0; k < spots.size(); k += 5)
        level.spots.push_back({spots[k], spots[k + 1], spots[k + 2], spots[k + 3], spots[k + 4]});
}

bool tip_moved(const rsc_contact& contact) { return contact.path.indenter().around.finite(); }

Path::State get_state(const Entries& from, const std::string& prefix, const rsc_contact& contact) {
    Path::State state;
    const Numbers& tip = from.of(prefix + "tip");
    const Numbers& accepted = from.of(prefix + "accepted");
    if (tip.size() != 2 || accepted.size() != 3) bad_input(kBroken);
    state.x0 = tip[0];
    state.y0 = tip[1];
    state.time = accepted[0];
    state.separation = accepted[1];
    state.force = accepted[2];
    state.history = from.of(prefix + "history");
    const bool whole = from.numbers.contains(prefix + "clock");
    const Numbers clock =
        whole ? from.of(prefix + "clock") : Numbers{kNotComputed, double(tip_moved(contact))};
    if (clock.size() != 2) bad_input(kBroken);
    state.clock = clock[0];
    state.moved = clock[1] != 0;
    if (whole && from.texts.at("rsc") == RSC_VERSION)
        state.solution = from.texts.at(prefix + "solution");
    if (!from.numbers.contains(prefix + "level")) return state;
    const Numbers& known = from.of(prefix + "level");
    const Numbers& pixels = from.of(prefix + "level.pixels");
    if (known.size() != 3 || pixels.size() != 5) bad_input(kBroken);
    Level level;
    level.separation = known[0];
    state.level_x0 = known[1];
    state.level_y0 = known[2];
    // Entries missing in files of earlier versions keep their defaults.
    for (const LevelQuantity& q : level_quantities())
        for (const auto c : indices(q.components()))
            if (const std::string name = prefix + "level." + q.name + kComponents[c];
                from.numbers.contains(name))
                q.put(level, from.one(name), c);
    visit_arrays(level, [&](const char* name, auto& values) {
        const auto found = from.numbers.find(prefix + "level." + name);
        if (found == from.numbers.end()) return;
        for (const double value : found->second)
            values.push_back(static_cast<std::decay_t<decltype(values[0])>>(value));
    });
    level.pixels.columns = int(pixels[0]);
    level.pixels.x0 = pixels[1];
    level.pixels.y0 = pixels[2];
    level.pixels.dx = pixels[3];
    level.pixels.dy = pixels[4];
    const auto& points = contact.on->points;
    const int places = points ? points->nx * points->ny : int(contact.path.asperities()->size());
    const auto outside = [&](int k) { return k < 0 || k >= places; };
    const std::size_t n = level.asperity.size();
    const LevelTractions& t = level.tractions;
    for (const auto* values : {&t.y, &t.a, &t.c, &t.pressed, &t.pulled})
        if (values->size() != t.x.size()) bad_input(kBroken);
    if (std::ranges::any_of(level.pixels.cohesive, outside) ||
        std::ranges::any_of(level.asperity, outside) ||
        std::ranges::any_of(level.pixels.index, outside) || level.x.size() != n ||
        level.y.size() != n || level.f.size() != n || level.a.size() != n || level.u.size() != n ||
        level.pixels.attraction.size() != level.pixels.cohesive.size())
        bad_input(kBroken);
    get_rest(from, prefix, level);
    state.level = std::move(level);
    return state;
}

void put_path(Entries& to, const std::string& prefix, const FrictionHistory::State& path) {
    to.numbers[prefix] = {double(path.begun), path.delta, path.xi.x,
                          path.xi.y,          path.lost,  path.step_lost};
    Numbers& nodes = to.numbers[prefix + ".nodes"];
    for (const auto& node : path.nodes)
        append(nodes,
               {node.approach, node.load, node.energy, node.deflection.x, node.deflection.y});
}

FrictionHistory::State get_path(const Entries& from, const std::string& prefix) {
    const Numbers &values = from.of(prefix), &nodes = from.of(prefix + ".nodes");
    if (values.size() != 6 || nodes.size() % 5 != 0) bad_input(kBroken);
    FrictionHistory::State path{values[0] != 0, values[1], {values[2], values[3]}, {},
                                values[4],      values[5]};
    for (std::size_t k = 0; k < nodes.size(); k += 5)
        path.nodes.push_back({nodes[k], nodes[k + 1], nodes[k + 2], {nodes[k + 3], nodes[k + 4]}});
    return path;
}

void put_friction(Entries& to, const std::string& prefix, const rsc_friction::State& state) {
    put_state(to, prefix + "outer.", state.outer);
    put_state(to, prefix + "inner.", state.inner);
    to.numbers[prefix + "known"] = {double(state.known[0]), double(state.known[1])};
    const ElementFriction::State& e = state.elements;
    if (!e.begun) return;
    const SlidingElements::State& t = e.tractions;
    to.numbers[prefix + "elements"] = {e.separation, e.load, e.energy, e.step_lost,
                                       e.xi.x,       e.xi.y, t.lost};
    to.numbers[prefix + "pixels"] = {t.pixels.begin(), t.pixels.end()};
    to.numbers[prefix + "limit"] = t.limit;
    to.numbers[prefix + "q"] = t.q;
    to.numbers[prefix + "u"] = t.u;
    to.numbers[prefix + "slip"] = t.slip;
}

ElementFriction::State get_elements(const Entries& from, const std::string& prefix) {
    if (!from.numbers.contains(prefix + "elements")) return {};
    const Numbers &e = from.of(prefix + "elements"), &pixels = from.of(prefix + "pixels");
    if (e.size() != 7) bad_input(kBroken);
    ElementFriction::State state{true, e[0], e[1], e[2], e[3], {e[4], e[5]}, {}};
    SlidingElements::State& t = state.tractions;
    for (const double k : pixels) t.pixels.push_back(std::int32_t(k));
    t.limit = from.of(prefix + "limit");
    t.q = from.of(prefix + "q");
    t.u = from.of(prefix + "u");
    t.slip = from.of(prefix + "slip");
    t.lost = e[6];
    return state;
}

rsc_friction::State get_friction(const Entries& from, const std::string& prefix,
                                 const std::string& path, const rsc_friction& friction) {
    rsc_friction::State state = friction.state();
    state.path = get_path(from, path);
    if (!from.numbers.contains(prefix + "known")) {  // files of rsc 0.4
        const Numbers& tip = from.of(prefix.empty() ? "tip" : "committed_tip");
        if (tip.size() != 2) bad_input(kBroken);
        state.known = {};
        for (Path::State* contact : {&state.outer, &state.inner}) {
            contact->x0 = tip[0];
            contact->y0 = tip[1];
            contact->solution.clear();
            contact->level.reset();
        }
        return state;
    }
    state.outer = get_state(from, prefix + "outer.", friction.outer);
    state.inner = get_state(from, prefix + "inner.", friction.inner);
    state.elements = get_elements(from, prefix);
    const Numbers& known = from.of(prefix + "known");
    if (known.size() != 2) bad_input(kBroken);
    state.known = {known[0] != 0, known[1] != 0};
    return state;
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
        put_state(entries, "", contact->path.state());
        put_state(entries, "committed.", contact->committed);
        write(path, kContact, entries);
    });
}

int32_t rsc_contact_restore(rsc_contact** contact, const rsc_asperities* asperities,
                            const char* path) {
    return constructed(3, contact, "contact", [&] {
        require(asperities, 2, "asperities");
        require_path(path, 3);
        const Entries entries = read(path, kContact);
        auto made = get_making(entries, *asperities);
        made->restore(get_state(entries, "", *made));
        made->committed = get_state(entries, "committed.", *made);
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
        put_friction(entries, "", friction->state());
        put_friction(entries, "committed.", friction->committed);
        put_path(entries, "path", friction->history.state());
        put_path(entries, "committed", friction->committed.path);
        write(path, kFriction, entries);
    });
}

int32_t rsc_friction_restore(rsc_friction** friction, const rsc_asperities* asperities,
                             const char* path) {
    return constructed(3, friction, "friction", [&] {
        require(asperities, 2, "asperities");
        require_path(path, 3);
        const Entries entries = read(path, kFriction);
        const Numbers& with = entries.of("friction");
        if (with.size() != 2) bad_input(kBroken);
        const auto like = get_making(entries, *asperities);
        auto made = std::make_unique<rsc_friction>(*like, like->first, Friction{with[0], with[1]});
        made->restore(get_friction(entries, "", "path", *made));
        made->committed = get_friction(entries, "committed.", "committed", *made);
        return made.release();
    });
}
