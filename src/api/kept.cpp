// Many contacts at once, and contacts and friction kept in files.
#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "api/guard.hpp"
#include "api/handles.hpp"
#include "archive.hpp"
#include "contact/indenter/shapes.hpp"
#include "version.h"

namespace rsc::api {
namespace {

// --- files: a line that says what it is, a checksum, and the values as they lie in memory ---------------------------------------

std::uint64_t mix(std::uint64_t hash, const void* data, std::size_t n) {  // FNV-1a
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < n; ++k) hash = (hash ^ bytes[k]) * 0x100000001b3ull;
    return hash;
}
constexpr std::uint64_t kHash = 0xcbf29ce484222325ull;

std::uint64_t digest(const Asperities& a) {
    std::uint64_t hash = kHash;
    for (const AsperityColumn& column : kAsperityColumns) {
        const auto& values = a.*column.values;
        const std::uint64_t n = values.size();
        hash = mix(mix(hash, &n, sizeof n), values.data(), values.size() * sizeof(double));
    }
    return hash;
}

std::string first_line(const char* what) { return std::string("rsc ") + what + " " RSC_VERSION "\n"; }

void write(const std::string& path, const char* what, const std::string& bytes) {
    const std::string fresh = path + ".new";
    const std::uint64_t hash = mix(kHash, bytes.data(), bytes.size());
    std::ofstream out(fresh, std::ios::binary | std::ios::trunc);
    out << first_line(what);
    out.write(reinterpret_cast<const char*>(&hash), sizeof hash);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out || std::rename(fresh.c_str(), path.c_str()) != 0) {
        std::remove(fresh.c_str());
        throw Error(Failure::file_system, "cannot write '" + path + "'");
    }
}

// The values in it.
std::string read(const std::string& path, const char* what) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Error(Failure::bad_input, "cannot read '" + path + "'");
    std::string all{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const std::string head = first_line(what);
    std::uint64_t hash = 0;
    if (!all.starts_with(head) || all.size() < head.size() + sizeof hash)
        throw Error(Failure::bad_input, "'" + path + "' is not " + what + " kept by rsc " RSC_VERSION);
    std::memcpy(&hash, all.data() + head.size(), sizeof hash);
    all.erase(0, head.size() + sizeof hash);
    if (mix(kHash, all.data(), all.size()) != hash) throw Error(Failure::bad_input, "'" + path + "' is damaged");
    return all;
}

ArchiveReader reader_of(const std::string& bytes) { return {bytes, Failure::bad_input, "the file is damaged"}; }

void require_path(const char* path, int argument) {
    require(path, argument, "path");
    if (!*path) refuse(argument, "path", "must not be empty");
}

template <class Archive, class L>
void visit(Archive& archive, L& level) {
    archive(static_cast<std::conditional_t<std::is_const_v<L>, const LevelValues&, LevelValues&>>(level));
    archive(level.asperity), archive(level.x), archive(level.y), archive(level.f), archive(level.a), archive(level.u);
}

template <class Archive, class State>
void visit_state(Archive& archive, State& state) {
    archive(state.begun), archive(state.delta), archive(state.xi), archive(state.nodes), archive(state.lost), archive(state.step_lost);
}

// What a handle knows of its last level beside the level itself.
template <class Archive, class Handle>
void visit_known(Archive& archive, Handle& contact) {
    archive(contact.energy);
    archive(contact.moved), archive(contact.lateral), archive(contact.moment);
}

// The indenter by what its shape was made from.
void visit_indenter(ArchiveWriter& writer, const Indenter& indenter) {
    const ShapeKeys& keys = indenter.shape->keys();
    writer(indenter.E_star), writer(indenter.x0), writer(indenter.y0), writer(indenter.period);
    writer(shape_number(indenter.shape->name()));
    if (keys.map) throw Error(Failure::bad_input, "a contact with a second rough body cannot be kept");
    writer(keys.R), writer(keys.radii), writer(keys.angle), writer(keys.slope), writer(keys.radius), writer(keys.rim_radius);
}
void visit_indenter(ArchiveReader& reader, Indenter& indenter) {
    ShapeKeys keys;
    int shape = 0;
    reader(indenter.E_star), reader(indenter.x0), reader(indenter.y0), reader(indenter.period);
    reader(shape);
    reader(keys.R), reader(keys.radii), reader(keys.angle), reader(keys.slope), reader(keys.radius), reader(keys.rim_radius);
    indenter.shape = make_shape(shape, keys);
}

// What makes a contact of the same asperities.
void put_making(ArchiveWriter& writer, const rsc_contact& contact) {
    writer(digest(contact.on->asperities));
    visit_indenter(writer, contact.contact.indenter());
    writer(contact.options);
    writer(contact.resistivity);
}
struct Making {
    Indenter indenter;
    SolverOptions options;
    double resistivity[2];
    std::unique_ptr<rsc_contact> contact(const rsc_asperities& asperities) const {
        auto made = std::make_unique<rsc_contact>(asperities.ground, indenter, options);
        std::copy_n(resistivity, 2, made->resistivity);
        return made;
    }
};

// Contacts by elements are not saved: a level of theirs is many pixels, and a file could not tell later whether it belongs to a surface
// (for asperities a checksum of the summits does).
void require_keepable(const rsc_contact& contact) {
    if (contact.on->points) refuse(1, "contact", "must be one of asperities: a contact of elements cannot be kept");
}
Making get_making(ArchiveReader& reader, const rsc_asperities& asperities) {
    std::uint64_t hash = 0;
    Making making;
    reader(hash);
    visit_indenter(reader, making.indenter);
    reader(making.options);
    reader(making.resistivity);
    if (hash != digest(asperities.ground->asperities)) refuse(2, "asperities", "must be those the file was saved with");
    return making;
}

// --- many contacts ------------------------------------------------------------------------------------------------------------------

template <class Each>
std::int32_t for_all(std::int64_t n, rsc_contact** contacts, const double* given, std::int32_t* status, std::int32_t threads, Each&& each) {
    std::int32_t first = RSC_SUCCESS;
    const std::int32_t whole = guarded(0, [&] {
        if (n < 0) refuse(1, "n", "must not be negative");
        if (threads < 0) refuse(6, "threads", "must not be negative");
        if (n == 0) return;
        require(contacts, 2, "contacts");
        require(given, 3, "the values");
        std::set<const rsc_contact*> different;
        for (std::int64_t k = 0; k < n; ++k) {
            if (!contacts[k]) refuse(2, "contacts", "must not hold a null handle");
            if (!different.insert(contacts[k]).second) refuse(2, "contacts", "must be different handles");
        }
        std::vector<std::int32_t> outcome(static_cast<std::size_t>(n), RSC_SUCCESS);
        std::vector<std::string> reason(static_cast<std::size_t>(n));
#pragma omp parallel for schedule(dynamic) num_threads(threads > 0 ? threads : omp_get_max_threads())
        for (std::int64_t k = 0; k < n; ++k) {
            outcome[static_cast<std::size_t>(k)] = each(k);
            if (outcome[static_cast<std::size_t>(k)] != RSC_SUCCESS) {
                char text[500] = "";
                rsc_message(text, sizeof text, nullptr);
                (void)guarded(0, [&] { reason[static_cast<std::size_t>(k)] = text; });
            }
        }
        if (status) std::copy(outcome.begin(), outcome.end(), status);
        const auto bad = std::find_if(outcome.begin(), outcome.end(), [](std::int32_t s) { return s != RSC_SUCCESS; });
        if (bad == outcome.end()) return;
        first = *bad < 0 ? -2 : *bad;
        const auto k = static_cast<std::size_t>(bad - outcome.begin());
        remember("contact " + std::to_string(k) + ": " + reason[k]);
    });
    return whole != RSC_SUCCESS ? whole : first;
}

}  // namespace
}  // namespace rsc::api

using rsc::ArchiveReader;
using rsc::ArchiveWriter;
using namespace rsc::api;

extern "C" {

int32_t rsc_contacts_press(int64_t n, rsc_contact** contacts, const double* force, double* separation, int32_t* status, int32_t threads) {
    return for_all(n, contacts, force, status, threads,
                   [&](int64_t k) { return rsc_contact_press(contacts[k], force[k], separation ? separation + k : nullptr); });
}

int32_t rsc_contacts_indent(int64_t n, rsc_contact** contacts, const double* separation, double* force, int32_t* status, int32_t threads) {
    return for_all(n, contacts, separation, status, threads,
                   [&](int64_t k) { return rsc_contact_indent(contacts[k], separation[k], force ? force + k : nullptr); });
}

int32_t rsc_contact_save(rsc_contact* contact, const char* path) {
    return guarded(2, [&] {
        require(contact, 1, "contact");
        require_path(path, 2);
        require_keepable(*contact);
        if (contact->contact.path_dependent()) refuse(1, "contact", "must be elastic: a contact that remembers its path cannot be kept");
        ArchiveWriter writer;
        put_making(writer, *contact);
        writer(contact->level.has_value());
        if (contact->level) {
            visit(writer, std::as_const(*contact->level));
            visit_known(writer, *contact);
        }
        write(path, "a contact", writer.bytes);
        contact->contact.forget();
        if (contact->level) (void)contact->contact.at_separation(contact->level->separation);
    });
}

int32_t rsc_contact_restore(rsc_contact** contact, const rsc_asperities* asperities, const char* path) {
    return guarded(3, [&] {
        construct(contact, "contact", [&] {
            require(asperities, 2, "asperities");
            require_path(path, 3);
            const std::string bytes = read(path, "a contact");
            ArchiveReader reader = reader_of(bytes);
            const Making making = get_making(reader, *asperities);
            auto made = making.contact(*asperities);
            bool has_level = false;
            reader(has_level);
            if (has_level) {
                rsc::Level level;
                visit(reader, level);
                visit_known(reader, *made);
                (void)made->contact.at_separation(level.separation);
                made->level = std::move(level);
            }
            return made.release();
        });
    });
}

int32_t rsc_friction_save(rsc_friction* friction, const char* path) {
    return guarded(2, [&] {
        require(friction, 1, "friction");
        require_path(path, 2);
        require_keepable(friction->outer);
        ArchiveWriter writer;
        put_making(writer, friction->outer);
        writer(friction->history.friction());
        visit_state(writer, friction->history.state());
        visit_state(writer, friction->history.committed());
        write(path, "a contact with friction", writer.bytes);
        friction->outer.contact.forget();
        friction->inner.contact.forget();
        friction->curve.forget();
    });
}

int32_t rsc_friction_restore(rsc_friction** friction, const rsc_asperities* asperities, const char* path) {
    return guarded(3, [&] {
        construct(friction, "friction", [&] {
            require(asperities, 2, "asperities");
            require_path(path, 3);
            const std::string bytes = read(path, "a contact with friction");
            ArchiveReader reader = reader_of(bytes);
            const Making making = get_making(reader, *asperities);
            rsc::Friction with;
            rsc::FrictionHistory::State now, committed;
            reader(with);
            visit_state(reader, now);
            visit_state(reader, committed);
            auto made = std::make_unique<rsc_friction>(*making.contact(*asperities), with);
            made->history.restore(now, committed);
            return made.release();
        });
    });
}

}  // extern "C"
