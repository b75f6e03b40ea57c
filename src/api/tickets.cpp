#include "api/tickets.h"

#include "api/guard.hpp"

namespace rsc::api {
namespace {

using Place = const std::int64_t*;

#define RSC_ENUMERATOR(name, value, meaning) name = value,
enum Kind : std::int32_t { RSC_KIND_LIST(RSC_ENUMERATOR) };
#undef RSC_ENUMERATOR

struct Entry {
    void* handle;
    Kind kind;
    Place place;
    bool settled;  // the ticket belongs to the place, because the place has used it
};

void destroy(const Entry& entry) noexcept {
    const auto with = [&](auto* typed, auto* function) { function(&typed); };
    switch (entry.kind) {
        case RSC_KIND_CASE: return with(static_cast<rsc_case*>(entry.handle), rsc_case_destroy);
        case RSC_KIND_SURFACE: return with(static_cast<rsc_surface*>(entry.handle), rsc_surface_destroy);
        case RSC_KIND_ASPERITIES: return with(static_cast<rsc_asperities*>(entry.handle), rsc_asperities_destroy);
        case RSC_KIND_CONTACT: return with(static_cast<rsc_contact*>(entry.handle), rsc_contact_destroy);
        case RSC_KIND_FRICTION: return with(static_cast<rsc_friction*>(entry.handle), rsc_friction_destroy);
    }
}

// A copy of the object of a handle. Throws if the copy fails.
void* copy(const Entry& entry) {
    const auto with = [&](auto* typed, auto* function) -> void* {
        decltype(typed) made = nullptr;
        if (const std::int32_t status = function(&made, typed); status != RSC_SUCCESS)
            throw Outcome{status, "an object could not be copied"};
        return made;
    };
    switch (entry.kind) {
        case RSC_KIND_CASE: return with(static_cast<rsc_case*>(entry.handle), rsc_case_copy);
        case RSC_KIND_SURFACE: return with(static_cast<rsc_surface*>(entry.handle), rsc_surface_copy);
        case RSC_KIND_ASPERITIES: return with(static_cast<rsc_asperities*>(entry.handle), rsc_asperities_copy);
        case RSC_KIND_CONTACT: return with(static_cast<rsc_contact*>(entry.handle), rsc_contact_copy);
        case RSC_KIND_FRICTION: return with(static_cast<rsc_friction*>(entry.handle), rsc_friction_copy);
    }
    return nullptr;
}

class Tickets {
public:
    void issue(std::int64_t* ticket, const Entry& entry) {
        Entry before{};
        try {
            const std::lock_guard lock(mutex_);
            const std::int64_t number = ++last_;
            if (entry.settled) before = settle(number, entry.place);
            entries_[number] = entry;
            *ticket = number;
        } catch (...) {
            destroy(entry);
            throw;
        }
        if (before.handle) destroy(before);
    }

    // The entry of the ticket at a place, or one with a null handle. A copied ticket belongs to the first place
    // that uses it, and thus to this one.
    Entry find(Place place) {
        Entry before{}, found{};
        {
            const std::lock_guard lock(mutex_);
            const auto at = entries_.find(*place);
            if (at == entries_.end()) return {};
            if (!at->second.settled) {
                before = settle(*place, place);
                at->second.place = place;
                at->second.settled = true;
            }
            found = at->second;
        }
        if (before.handle) destroy(before);
        return found;
    }

    // A new number for a ticket that belongs to the place and will be changed, so that bitwise copies of it do not refer to the change.
    void renew(std::int64_t* ticket) {
        const std::lock_guard lock(mutex_);
        auto entry = entries_.extract(*ticket);
        if (entry.empty()) return;
        *ticket = at_place_[ticket] = entry.key() = ++last_;
        entries_.insert(std::move(entry));
    }

    // As find(), but without a change of ownership, because the place may be a temporary of the compiler.
    Entry look(Place place) {
        const std::lock_guard lock(mutex_);
        const auto at = entries_.find(*place);
        return at == entries_.end() ? Entry{} : at->second;
    }

    // Destroys the object of the ticket if it belongs to this place, but not if it belongs to another place or to none yet.
    void release(std::int64_t* ticket) {
        Entry found{};
        {
            const std::lock_guard lock(mutex_);
            const auto at = entries_.find(*ticket);
            if (at != entries_.end() && at->second.settled && at->second.place == ticket) {
                found = at->second;
                entries_.erase(at);
                at_place_.erase(ticket);
            }
            *ticket = 0;
        }
        if (found.handle) destroy(found);
    }

private:
    // Assigns the ticket to the place. A ticket that belonged to it before was overwritten by an assignment of the compiler;
    // its entry is returned for destruction.
    Entry settle(std::int64_t number, Place place) {
        Entry before{};
        std::int64_t& owned = at_place_[place];
        if (const auto old = entries_.find(owned); owned != 0 && old != entries_.end()) {
            before = old->second;
            entries_.erase(old);
        }
        owned = number;
        return before;
    }

    std::mutex mutex_;
    std::unordered_map<std::int64_t, Entry> entries_;
    std::unordered_map<Place, std::int64_t> at_place_;  // tickets of settled entries
    std::int64_t last_ = 0x5253435f00000000;            // unlike typical values of uninitialised memory
};

// Never destroyed, because objects may be released while the program ends.
Tickets& tickets() {
    static Tickets* const all = new Tickets;
    return *all;
}

}  // namespace
}  // namespace rsc::api

using namespace rsc::api;

int32_t rsc_ticket_issue(int64_t* ticket, int32_t kind, void* handle) {
    return guarded(0, [&] { tickets().issue(ticket, {handle, static_cast<Kind>(kind), ticket, true}); });
}

int32_t rsc_ticket_read(const int64_t* ticket, void** handle) {
    return guarded(0, [&] { *handle = tickets().find(ticket).handle; });
}

int32_t rsc_ticket_change(int64_t* ticket, void** handle) {
    return guarded(0, [&] {
        *handle = nullptr;
        Entry found = tickets().find(ticket);
        if (found.handle && found.place != ticket) {
            found.handle = copy(found);
            tickets().issue(ticket, {found.handle, found.kind, ticket, true});
        } else if (found.handle) {
            tickets().renew(ticket);
        }
        *handle = found.handle;
    });
}

int32_t rsc_ticket_copy(int64_t* ticket, const int64_t* original) {
    return guarded(0, [&] {
        if (original == ticket) return;
        const Entry found = tickets().look(original);
        Entry made = found;
        if (found.handle) made.handle = copy(found);
        tickets().release(ticket);
        if (!made.handle) return;
        made.place = ticket;
        made.settled = false;
        tickets().issue(ticket, made);
    });
}

int32_t rsc_ticket_release(int64_t* ticket) {
    return guarded(0, [&] { tickets().release(ticket); });
}
