/* Tickets: what the objects of rsc.f90 hold instead of handles. Not for C programs, which own their handles themselves.
 *
 * Fortran compilers copy objects bit by bit where the module is not asked: structure constructors, sourced allocation, private and
 * firstprivate of OpenMP, and with gfortran 12 whatever holds an object and is assigned as an array. Such a copy must neither
 * release what it shows nor go on when that is gone. A ticket is a number that is never given out twice; the library knows which
 * handle stands behind it and the one place (the address of the object's ticket) that owns it. A number it does not know, as in
 * an object that was never set, stands for no handle.
 *
 * All functions return a status as those of rsc.h do, and may be called by several threads at once. */
#ifndef RSC_TICKETS_H
#define RSC_TICKETS_H

#include "rsc.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The kinds of objects behind tickets. */
#define RSC_KIND_LIST(X)                    \
    X(RSC_KIND_CASE, 1, "a case")           \
    X(RSC_KIND_SURFACE, 2, "heights")       \
    X(RSC_KIND_ASPERITIES, 3, "asperities") \
    X(RSC_KIND_CONTACT, 4, "a contact")     \
    X(RSC_KIND_FRICTION, 5, "a contact with friction")

/* A ticket for a handle just made, which this place owns from now on. ticket (out): its place; kind: of RSC_KIND_LIST; handle: is
 * released if that fails. Errors: RSC_NO_MEMORY. */
RSC_API int32_t rsc_ticket_issue(int64_t* ticket, int32_t kind, void* handle);

/* The handle behind a ticket, for reading: null if there is none. ticket: in its place; handle (out). */
RSC_API int32_t rsc_ticket_read(const int64_t* ticket, void** handle);

/* The same for changing it. Where another place owns it, this place gets a copy of its own first; where this one does, copies that a compiler
 * made of its ticket stand for no handle from now on, rather than for the changed one. ticket (in and out): in its place; handle (out).
 * Errors: RSC_NO_MEMORY. */
RSC_API int32_t rsc_ticket_change(int64_t* ticket, void** handle);

/* A copy of what is behind another ticket. The place may be a compiler's stand-in for the object assigned to, and go before the
 * object is used: the copy belongs to the first place that uses it, and is released with that. ticket (out): its place, which gives
 * up what it owned; original: the other. Errors: RSC_NO_MEMORY. */
RSC_API int32_t rsc_ticket_copy(int64_t* ticket, const int64_t* original);

/* Releases the handle if this place owns it, and forgets the ticket. ticket (in and out): its place, 0 afterwards. */
RSC_API int32_t rsc_ticket_release(int64_t* ticket);

#ifdef __cplusplus
}
#endif

#endif /* RSC_TICKETS_H */
