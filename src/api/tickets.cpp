#include "api/tickets.h"

#include "api/guard.hpp"

namespace rsc::api {
namespace {

using Place = const std::int64_t*;

struct Kind {
    void (*destroy)(void*);
    void* (*copy)(const void*);  // throws if the copy fails
};
#define RSC_KIND(type)                                                        \
    Kind {                                                                    \
        [](void* handle) {                                                    \
            auto* typed = static_cast<type*>(handle);                         \
            type##_destroy(&typed);                                           \
        },                                                                    \
            [](const void* handle) -> void* {                                 \
                type* made = nullptr;                                         \
                if (const std::int32_t status =                               \
                        type##_copy(&made, static_cast<const type*>(handle))) \
                    throw Outcome{status, "an object could not be copied"};   \
                return made;                                                  \
            }                                                                 \
    }
// In the order of RSC_KIND_LIST, which begins at 1.
const Kind kKinds[] = {RSC_KIND(rsc_case), RSC_KIND(rsc_surface), RSC_KIND(rsc_asperities),
                       RSC_KIND(rsc_contact), RSC_KIND(rsc_friction)};
#undef RSC_KIND

struct Entry {
    void* handle = nullptr;
    const Kind* kind = nullptr;
    Place place = nullptr;  // null: the ticket will belong to the first place that uses it
};

class Tickets {
public:
    void issue(std::int64_t* ticket, const Entry& entry) {
        const std::lock_guard lock(mutex_);
        try {
            std::int64_t* const owned = entry.place ? &at_place_[entry.place] : nullptr;
            entries_.emplace(last_ + 1, entry);
            *ticket = ++last_;
            if (owned) drop(std::exchange(*owned, last_));
        } catch (...) {
            entry.kind->destroy(entry.handle);
            throw;
        }
    }

    // The entry of the ticket at a place, or one with a null handle. A copied ticket belongs to the
    // first place that uses it, and thus to this one; a ticket that belonged to this place before
    // was overwritten by an assignment of the compiler.
    Entry find(Place place) {
        const std::lock_guard lock(mutex_);
        const auto at = entries_.find(*place);
        if (at == entries_.end()) return {};
        if (!at->second.place) {
            drop(std::exchange(at_place_[place], *place));
            at->second.place = place;
        }
        return at->second;
    }

    // As find(), but without a change of ownership, because the place may be a temporary of the
    // compiler.
    Entry look(Place place) {
        const std::lock_guard lock(mutex_);
        const auto at = entries_.find(*place);
        return at == entries_.end() ? Entry{} : at->second;
    }

    // A new number for a ticket that belongs to the place and will be changed, so that bitwise
    // copies of it do not refer to the change.
    void renew(std::int64_t* ticket) {
        const std::lock_guard lock(mutex_);
        auto entry = entries_.extract(*ticket);
        if (entry.empty()) return;
        *ticket = at_place_[ticket] = entry.key() = ++last_;
        entries_.insert(std::move(entry));
    }

    // Destroys the object of the ticket if it belongs to this place, but not if it belongs to
    // another place or to none yet.
    void release(std::int64_t* ticket) {
        const std::lock_guard lock(mutex_);
        if (const auto at = entries_.find(*ticket);
            at != entries_.end() && at->second.place == ticket) {
            drop(*ticket);
            at_place_.erase(ticket);
        }
        *ticket = 0;
    }

private:
    void drop(std::int64_t number) {
        const auto entry = entries_.extract(number);
        if (!entry.empty()) entry.mapped().kind->destroy(entry.mapped().handle);
    }

    std::mutex mutex_;
    std::unordered_map<std::int64_t, Entry> entries_;
    std::unordered_map<Place, std::int64_t> at_place_;  // tickets of the entries that have a place
    std::int64_t last_ = 0x5253435f00000000;  // unlike typical values of uninitialised memory
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
    return guarded(0, [&] { tickets().issue(ticket, {handle, &kKinds[kind - 1], ticket}); });
}

int32_t rsc_ticket_read(const int64_t* ticket, void** handle) {
    return guarded(0, [&] { *handle = tickets().find(ticket).handle; });
}

int32_t rsc_ticket_change(int64_t* ticket, void** handle) {
    return guarded(0, [&] {
        *handle = nullptr;
        Entry found = tickets().find(ticket);
        if (found.handle && found.place != ticket) {
            found.handle = found.kind->copy(found.handle);
            tickets().issue(ticket, {found.handle, found.kind, ticket});
        } else if (found.handle) {
            tickets().renew(ticket);
        }
        *handle = found.handle;
    });
}

int32_t rsc_ticket_copy(int64_t* ticket, const int64_t* original) {
    return guarded(0, [&] {
        if (original == ticket) return;
        Entry made = tickets().look(original);
        if (made.handle) made.handle = made.kind->copy(made.handle);
        made.place = nullptr;
        tickets().release(ticket);
        if (made.handle) tickets().issue(ticket, made);
    });
}

int32_t rsc_ticket_release(int64_t* ticket) {
    return guarded(0, [&] { tickets().release(ticket); });
}
