// The library in tests: handles that release themselves, messages, values of a contact.
#pragma once

#include "check.hpp"
#include "rsc.h"
#include "surface/asperities.hpp"

#define OK(call) CHECK((call) == RSC_SUCCESS)

// Passes as a handle of rsc.h; its address, for a call that makes a new one, first releases what it
// holds.
template <class T, std::int32_t (*release)(T**)>
class Handle {
public:
    Handle() = default;
    Handle(Handle&& other) noexcept : held_(std::exchange(other.held_, nullptr)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(held_, other.held_);
        return *this;
    }
    ~Handle() { let_go(); }
    operator T*() const { return held_; }
    T* get() const { return held_; }
    T** operator&() {
        let_go();
        return &held_;
    }

private:
    void let_go() { CHECK(release(&held_) == RSC_SUCCESS && !held_); }
    T* held_ = nullptr;
};
using CaseHandle = Handle<rsc_case, rsc_case_destroy>;
using SurfaceHandle = Handle<rsc_surface, rsc_surface_destroy>;
using AsperitiesHandle = Handle<rsc_asperities, rsc_asperities_destroy>;
using ContactHandle = Handle<rsc_contact, rsc_contact_destroy>;
using FrictionHandle = Handle<rsc_friction, rsc_friction_destroy>;

inline std::string message() {
    char text[4096] = "";
    OK(rsc_message(text, sizeof text, nullptr));
    return text;
}
inline bool says(const char* what) { return message().find(what) != std::string::npos; }

inline CaseHandle case_of(const std::string& text) {
    CaseHandle c;
    OK(rsc_case_create(&c));
    OK(rsc_case_read(c, text.c_str()));
    return c;
}

inline AsperitiesHandle take(const rsc::Asperities& a) {
    AsperitiesHandle handle;
    OK(rsc_asperities_take(&handle, static_cast<std::int64_t>(a.size()), a.x.data(), a.y.data(),
                           a.z.data(), a.radius.data(), nullptr, nullptr, nullptr, nullptr));
    return handle;
}

inline ContactHandle contact_on(const rsc_asperities* asperities, const rsc_case* c) {
    ContactHandle contact;
    OK(rsc_contact_create_from_case(&contact, asperities, c));
    return contact;
}

// A case, its asperities and its contact: of asperities, unless the text names a model.
struct Made {
    CaseHandle c;
    AsperitiesHandle asperities;
    ContactHandle contact;
    explicit Made(const std::string& text) : c(case_of(text)) {
        if (text.find("model") == text.npos) OK(rsc_case_set(c, "solver%model", "'asperities'"));
        OK(rsc_asperities_make(&asperities, c, 1));
        contact = contact_on(asperities, c);
    }
};

inline double value(rsc_contact* contact, const char* name) {
    double found = std::nan("");
    OK(rsc_contact_value(contact, name, &found));
    return found;
}

// Of a path with friction: separation, slide, forces, energies, work lost in all, and the
// separation at which spots stick.
struct FrictionState {
    double Z = 0, x = 0, y = 0, N = 0, Qx = 0, Qy = 0, normal = 0, tangential = 0, lost = 0,
           stick = 0;
};
inline FrictionState state(const rsc_friction* friction) {
    FrictionState s;
    OK(rsc_friction_state(friction, &s.Z, &s.x, &s.y, &s.N, &s.Qx, &s.Qy, &s.normal, &s.tangential,
                          &s.lost, &s.stick));
    return s;
}

inline double force_at(rsc_contact* contact, double Z0) {
    double N = std::nan("");
    OK(rsc_contact_indent(contact, Z0, &N));
    return N;
}
