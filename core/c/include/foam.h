/* foam in C: a triangle mesh in, spheres that are proved to cover it out.
 *
 * C99, no C++ types, no global state. Every function may be called from any number of threads at once; none keeps a
 * pointer that it was given, and no C++ exception leaves it. */
#ifndef FOAM_H
#define FOAM_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define FOAM_API __attribute__((visibility("default")))
#else
#define FOAM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The outcome of a call. */
enum {
    FOAM_OK = 0,
    FOAM_USAGE = 1,    /* an argument is wrong */
    FOAM_GEOMETRY = 2, /* the mesh cannot be covered: no triangle, a number that is not finite, an index out of range */
    FOAM_MEMORY = 3,   /* there is not enough memory */
    FOAM_CANCELLED = 4, /* the callback returned FOAM_CANCEL */
    FOAM_INTERNAL = 5   /* a bug in foam */
};

/* foam_options.effort: how long to search. FOAM_FAST takes some milliseconds, FOAM_BEST longest. */
enum { FOAM_NORMAL = 0, FOAM_FAST = 1, FOAM_BEST = 2 };

/* foam_options.objective: what the search minimises. */
enum {
    FOAM_EXCESS = 0,     /* the excess volume: the volume of the spheres outside the mesh */
    FOAM_PROTRUSION = 1, /* how far the spheres extend beyond the mesh at most */
    FOAM_RADIUS = 2      /* the largest radius */
};

/* What foam_options.poll returns. */
enum {
    FOAM_CONTINUE = 0,
    FOAM_FINISH = 1, /* end the search; return the best spheres so far, which cover the mesh and are proved to */
    FOAM_CANCEL = 2  /* end the call without spheres: FOAM_CANCELLED */
};

/* The most spheres that a call may ask for. */
#define FOAM_MAX_SPHERES 1000000

/* The settings of a call. 0 is the default of every member but `size`:
 *     foam_options options = {.size = sizeof options, .effort = FOAM_FAST}; */
typedef struct foam_options {
    size_t size;   /* sizeof(foam_options): which version of this struct the caller was compiled with */
    int effort;    /* FOAM_NORMAL, FOAM_FAST or FOAM_BEST */
    int objective; /* FOAM_EXCESS, FOAM_PROTRUSION or FOAM_RADIUS */
    uint64_t seed; /* of the random starts of the search; the same seed gives the same bytes */
    /* Seconds after which the search ends as by FOAM_FINISH; 0: no limit. A first cover and the proof are always
     * completed, so that a call for a large mesh may take longer. With a limit, results depend on the machine. */
    double time_limit;
    /* The most threads to use; 0: one per core, and never more. The number does not affect the result. */
    uint32_t threads;
    uint32_t reserved; /* 0 */
    /* Called every few milliseconds in the calling thread; NULL: not called. It must return, not jump. */
    int (*poll)(void* user);
    void* user; /* handed to `poll` */
} foam_options;

/* What a call reports. Before the call the caller sets `size`:
 *     foam_report report = {.size = sizeof report}; */
typedef struct foam_report {
    size_t size;        /* sizeof(foam_report) */
    size_t spheres;     /* number of spheres that were written; 0 unless FOAM_OK */
    double volume;      /* of the union of the spheres, m^3 */
    int certified;      /* 1: it is proved that every point of the mesh lies in a sphere; always 1 with FOAM_OK */
    int finished_early; /* 1: the time limit or `poll` ended the search; without them the result may be better */
    char error[512];    /* reason and remedy, UTF-8 in one line; empty with FOAM_OK */
} foam_report;

/* Computes at most `count` spheres that cover a mesh, by the search and with the result of foam::spherize() in C++.
 *
 * vertices        vertex_count times x, y, z, in metres, in any frame
 * triangles       triangle_count times three indices of vertices, from 0; the mesh may have holes or be inside out
 * count           1 to FOAM_MAX_SPHERES
 * options         NULL: the defaults
 * spheres         room for 4 * count numbers; gets x, y, z, radius of each sphere, in metres, in the frame of the mesh
 * report          how many spheres there are, or why there are none
 *
 * Returns FOAM_OK, or the kind of error; then no sphere is written. Without a report, or with a wrong report->size, it
 * returns FOAM_USAGE without a text. */
FOAM_API int foam_spherize(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                           size_t triangle_count, size_t count, const foam_options* options, double* spheres,
                           foam_report* report);

/* Returns the version of the library, "0.1.0". The text lives as long as the library. */
FOAM_API const char* foam_version(void);

#ifdef __cplusplus
}
#endif

#endif
