/* Tickets, which the objects of rsc.f90 store instead of handles. Not for C programs, which own their handles.
 *
 * Fortran compilers copy objects bit by bit without calling the module: in structure constructors, sourced allocation, private and
 * firstprivate of OpenMP, and with gfortran 12 in array assignments of types that contain an object. Such a copy must neither
 * release the original nor be used after its release. A ticket is a number that is never issued twice; the library stores its handle
 * and the one place (the address of the object's ticket) that owns it. An unknown number, as in an object that was never set, means
 * no handle.
 *
 * All functions return a status as those of rsc.h do, and may be called by several threads at once. */
#ifndef RSC_TICKETS_H
#define RSC_TICKETS_H

#include "rsc.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The kinds of objects of tickets. */
#define RSC_KIND_LIST(X)                    \
    X(RSC_KIND_CASE, 1, "a case")           \
    X(RSC_KIND_SURFACE, 2, "heights")       \
    X(RSC_KIND_ASPERITIES, 3, "asperities") \
    X(RSC_KIND_CONTACT, 4, "a contact")     \
    X(RSC_KIND_FRICTION, 5, "a contact with friction")

/* Issues a ticket for a new handle, which this place then owns. ticket (out): its place; kind: of RSC_KIND_LIST; handle: released
 * on failure. Errors: RSC_NO_MEMORY. */
RSC_API int32_t rsc_ticket_issue(int64_t* ticket, int32_t kind, void* handle);

/* The handle of a ticket, for reading: null if there is none. ticket: in its place; handle (out). */
RSC_API int32_t rsc_ticket_read(const int64_t* ticket, void** handle);

/* The handle of a ticket, for changing it. If another place owns it, this place first gets its own copy; if this place owns it, copies of
 * the ticket made by the compiler lose their handle, so that they do not refer to the changed one. ticket (in and out): in its place;
 * handle (out). Errors: RSC_NO_MEMORY. */
RSC_API int32_t rsc_ticket_change(int64_t* ticket, void** handle);

/* Copies the object of another ticket. The place may be a temporary of the compiler that is gone before the object is used; therefore
 * the copy belongs to the first place that uses it, and is released with that place. ticket (out): its place, whose former object is
 * released; original: the other ticket. Errors: RSC_NO_MEMORY. */
RSC_API int32_t rsc_ticket_copy(int64_t* ticket, const int64_t* original);

/* Releases the handle if this place owns it, and clears the ticket. ticket (in and out): its place, 0 afterwards. */
RSC_API int32_t rsc_ticket_release(int64_t* ticket);

#ifdef __cplusplus
}
#endif

#endif /* RSC_TICKETS_H */
