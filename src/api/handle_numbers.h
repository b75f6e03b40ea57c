/* Numbers for handles, which the objects of rsc.f90 store. Not for C programs, which hold their
 * handles themselves.
 *
 * Fortran copies objects bit by bit: by assignment, in structure constructors, by source=, in
 * parallel regions. All copies hold the same number, and a number is never given twice: a copy
 * whose object was released meets an error instead of released memory. All functions may be called
 * by several threads at once. */
#ifndef RSC_HANDLE_NUMBERS_H
#define RSC_HANDLE_NUMBERS_H

#include "rsc.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A new number for a handle; 0 without memory for it. */
RSC_API int64_t rsc_number_of(void* handle);

/* The handle of a number: null for 0, and for a number whose object was released something that
 * every function of rsc.h refuses as a released handle. */
RSC_API void* rsc_handle_of(int64_t number);

/* The handle of a number, which becomes invalid; null if there is none. */
RSC_API void* rsc_handle_taken(int64_t number);

#ifdef __cplusplus
}
#endif

#endif /* RSC_HANDLE_NUMBERS_H */
