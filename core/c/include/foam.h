/* foam in C: a triangle mesh or points in, spheres or other convex elements that are proved to cover them out; and the
 * proof and the figures of elements from anywhere.
 *
 * C99, no C++ types, no global state. Every function may be called from any number of threads at once; none keeps a
 * pointer that it was given, and no C++ exception leaves it. Lengths are metres, numbers are double precision. What is
 * to be covered and what covers it are in one frame, which is the caller's.
 *
 * Functions that can fail return FOAM_OK or the kind of error. Then a handle that they were to make is NULL, and
 * report->error says what is wrong and what to do. Without a report, or with a wrong report->size, they return
 * FOAM_USAGE without a text.
 *
 * Structs begin with their size. Later versions of the library may add members to foam_options at its end; they take
 * the smaller struct of older programs, too. */
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
    FOAM_CANCELLED = 4, /* the time limit or the callback ended the call */
    FOAM_INTERNAL = 5   /* a bug in foam */
};

/* foam_options.effort: how long to search. FOAM_FAST takes some milliseconds, FOAM_BEST longest. */
enum { FOAM_NORMAL = 0, FOAM_FAST = 1, FOAM_BEST = 2 };

/* foam_options.objective: what the search minimises. */
enum {
    FOAM_EXCESS = 0,     /* the excess volume: the volume of the spheres outside the mesh */
    FOAM_PROTRUSION = 1, /* how far the spheres extend beyond the mesh at most */
    FOAM_RADIUS = 2,     /* the largest radius; of spheres alone */
    FOAM_MEAN_PROTRUSION = 3 /* the mean protrusion, weighted by area */
};

/* Kinds of elements: foam_cover() takes the sum of those that may be used, foam_element.kind is one of them. */
enum {
    FOAM_SPHERE = 1,
    FOAM_CAPSULE = 2,
    FOAM_CYLINDER = 4,
    FOAM_BOX = 8,
    FOAM_SWEPT_BOX = 16, /* a box with round edges */
    FOAM_HULL = 32,
    FOAM_ELLIPSOID = 64
};

/* What foam_options.poll returns. */
enum {
    FOAM_CONTINUE = 0,
    FOAM_FINISH = 1, /* end a search with the best elements so far, which are proved to cover the region; for a call
                        that has no result before its end: as FOAM_CANCEL */
    FOAM_CANCEL = 2  /* end the call without elements: FOAM_CANCELLED */
};

/* The most spheres that a call may ask for. */
#define FOAM_MAX_SPHERES 1000000

/* The settings of a call. 0 is the default of every member but `size`:
 *     foam_options options = {.size = sizeof options, .effort = FOAM_FAST}; */
typedef struct foam_options {
    size_t size;   /* sizeof(foam_options): which version of this struct the caller was compiled with */
    int effort;    /* FOAM_NORMAL, FOAM_FAST or FOAM_BEST */
    int objective; /* FOAM_EXCESS, FOAM_PROTRUSION, FOAM_RADIUS or FOAM_MEAN_PROTRUSION */
    uint64_t seed; /* of the random starts of the search; the same seed gives the same bytes */
    /* Seconds after which a call ends as by FOAM_FINISH; 0: no limit. A first cover and the proof are always
     * completed, so that a search for a large mesh may take longer. With a limit, results depend on the machine. */
    double time_limit;
    /* The most threads to use; 0: one per core, and never more. The number does not affect the result. */
    uint32_t threads;
    uint32_t reserved; /* 0 */
    /* Called every few milliseconds in the calling thread; NULL: not called. It must return, not jump. */
    int (*poll)(void* user);
    void* user; /* handed to `poll` */
    uint32_t max_vertices; /* of a hull, at least 4; 0: 64 */
    int axis_aligned;      /* 1: boxes have the axes of the frame */
} foam_options;

/* What a call reports. Before the call the caller sets `size`:
 *     foam_report report = {.size = sizeof report}; */
typedef struct foam_report {
    size_t size;        /* sizeof(foam_report) */
    size_t spheres;     /* number of spheres, or of elements of any kind; 0 unless FOAM_OK */
    double volume;      /* of their union, m^3 */
    int certified;      /* 1: it is proved that every point of the mesh lies in one of them; always 1 with FOAM_OK */
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
 * Returns FOAM_OK, or the kind of error; then no sphere is written. Time: some milliseconds with FOAM_FAST; it grows
 * about linearly with the triangles, and for many elements with their number. */
FOAM_API int foam_spherize(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                           size_t triangle_count, size_t count, const foam_options* options, double* spheres,
                           foam_report* report);

/* What is to be covered: made once, for any number of calls of foam_cover(), by any number of threads at once. */
typedef struct foam_region foam_region;

/* Makes a region of a mesh; vertices and triangles are those of foam_spherize(). Sets *region, which foam_region_free()
 * frees; NULL unless FOAM_OK. O(n log n) in the triangles: a program that covers the same mesh again keeps its
 * region. */
FOAM_API int foam_region_of_mesh(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                                 size_t triangle_count, foam_region** region, foam_report* report);
/* Makes a region of points, `count` times x, y, z in metres, with one radius each: the surface of the union of
 * these balls is to be covered.
 * radii: NULL: the points alone. */
FOAM_API int foam_region_of_points(const double* points, const double* radii, size_t count, foam_region** region,
                                   foam_report* report);
/* Frees a region; NULL does nothing. */
FOAM_API void foam_region_free(foam_region* region);

/* The elements of a cover. They are not changed any more: any number of threads may read them at once. */
typedef struct foam_elements foam_elements;

/* An element. A point p of its own frame is at rotation * p + position. */
typedef struct foam_element {
    int kind; /* FOAM_SPHERE, … */
    double position[3];
    double rotation[9]; /* row by row; where it is given to foam_elements_make(), all 0 means none */
    double half[3];     /* half the edges of a box; of a capsule or cylinder, along z, the last one; half axes */
    double radius;      /* 0 for a kind that has none */
    size_t vertex_count;    /* of a hull; 0 for other kinds */
    const double* vertices; /* vertex_count times x, y, z; they live as long as the foam_elements */
} foam_element;

/* Covers a region with at most `count` elements, by the search and with the result of foam::cover() in C++.
 *
 * kinds           the sum of the kinds that may be used: FOAM_CAPSULE | FOAM_BOX
 * options         NULL: the defaults
 * elements        gets the elements, spheres first, which foam_elements_free() frees; NULL unless FOAM_OK
 * report          how many there are, or why there are none
 *
 * Returns FOAM_OK, or the kind of error, as foam_spherize(). */
FOAM_API int foam_cover(const foam_region* region, size_t count, unsigned kinds, const foam_options* options,
                        foam_elements** elements, foam_report* report);
/* Returns the number of elements; 0 for NULL. */
FOAM_API size_t foam_elements_count(const foam_elements* elements);
/* Sets *element to the element at an index. Returns FOAM_OK, or FOAM_USAGE if there is none. */
FOAM_API int foam_elements_get(const foam_elements* elements, size_t index, foam_element* element);
/* Frees elements; NULL does nothing. */
FOAM_API void foam_elements_free(foam_elements* elements);

/* Makes elements of an array of descriptions: those of another program, or changed ones. Sets *elements, which
 * foam_elements_free() frees; their order stays. FOAM_GEOMETRY names an element that is none: a length that is not
 * above 0, a rotation that is not orthonormal to 1e-6, points of a hull in one plane. Of a hull, points that are not
 * corners are left out. */
FOAM_API int foam_elements_make(const foam_element* array, size_t count, foam_elements** elements, foam_report* report);

/* Replaces elements of kinds that another program lacks by elements of the given kinds that contain them: a capsule by
 * a cylinder and two spheres, any element by a hull of few corners. What covered a region still does.
 *
 * kinds           the sum of the kinds that there may be; FOAM_USAGE if an element has no replacement among them
 * segments        corners of a hull around a circle: a multiple of 4, from 4 to 1024; 16 is usual
 * converted       gets the new elements, which foam_elements_free() frees */
FOAM_API int foam_elements_in_kinds(const foam_elements* elements, unsigned kinds, int segments,
                                    foam_elements** converted, foam_report* report);

/* A triangle mesh that foam has made. */
typedef struct foam_mesh foam_mesh;

/* Makes a closed mesh around an element, wound outwards, for pictures and files of meshes. Exact for boxes and hulls;
 * round parts are circumscribed, with `segments` around a circle. foam_mesh_free() frees it. */
FOAM_API int foam_elements_mesh(const foam_elements* elements, size_t index, int segments, foam_mesh** mesh,
                                foam_report* report);
/* Return the numbers of vertices and triangles, and their arrays, which live as long as the mesh. For NULL they return
 * 0 or NULL. */
FOAM_API size_t foam_mesh_vertex_count(const foam_mesh* mesh);
FOAM_API size_t foam_mesh_triangle_count(const foam_mesh* mesh);
FOAM_API const double* foam_mesh_vertices(const foam_mesh* mesh);      /* x, y, z of each vertex */
FOAM_API const uint32_t* foam_mesh_triangles(const foam_mesh* mesh);   /* three indices of vertices each */
/* Frees a mesh; NULL does nothing. */
FOAM_API void foam_mesh_free(foam_mesh* mesh);

/* What is proved of elements, or why it is not. Before the call the caller sets `size`. */
typedef struct foam_certificate {
    size_t size;       /* sizeof(foam_certificate) */
    int holds;         /* 1: it is proved that the region lies in the union of the elements */
    int solid;         /* 1: with its inside; 0: its surface alone, for points and meshes with holes have no inside */
    int cavity;        /* if it does not hold: the elements hold the surface, and the witness is inside */
    int reserved;      /* 0 */
    double growth;     /* if it does not hold: growth of the nearest element that would close the worst place found */
    double witness[3]; /* if it does not hold: a point of that place */
} foam_certificate;

/* Proves that elements cover a region, or finds where they do not. Elements from anywhere may be asked about: no test
 * by samples, and rounding is on the safe side, so that an uncovered point never passes. Elements whose boundary is that
 * of the region exactly have no room for rounding; foam_grow() gives it.
 *
 * options         NULL: the defaults; poll, time_limit and threads count
 * certificate     the result; FOAM_OK also where it does not hold */
FOAM_API int foam_certify(const foam_region* region, const foam_elements* elements, const foam_options* options,
                          foam_certificate* certificate, foam_report* report);

/* How good elements are. Before the call the caller sets `size`. S is the region, U the union of the elements. */
typedef struct foam_figures {
    size_t size;           /* sizeof(foam_figures) */
    size_t elements;       /* those with a volume */
    int certified;         /* 1: foam_certify() holds */
    int solid;             /* what it proves, as in foam_certificate */
    double area;           /* of the surface of S, m^2 */
    double volume;         /* of S, m^3 */
    double covered;        /* area of the surface of S inside U / area */
    double gap;            /* largest distance from a point of the surface of S to U, m */
    double excess;         /* vol(U outside S) / vol(S); infinite without an inside */
    double excess_error;   /* standard error of it */
    double missing;        /* vol(S outside U) / vol(S) */
    double missing_error;  /* standard error of it */
    double protrusion_max; /* largest distance from the exposed surface of U to S, m */
    double protrusion_mean; /* mean of it, weighted by area, m */
} foam_figures;

/* Measures elements against a region; takes from 0.1 s on.
 *
 * options         NULL: the defaults; seed, poll, time_limit and threads count. The same seed gives the same bytes. */
FOAM_API int foam_evaluate(const foam_region* region, const foam_elements* elements, const foam_options* options,
                           foam_figures* figures, foam_report* report);

/* Grows elements by about the least that makes them cover a region; none becomes smaller. Spheres come first in the
 * result, else the order stays.
 *
 * options         NULL: the defaults; poll, time_limit and threads count
 * grown           gets the new elements, which foam_elements_free() frees
 * report          certified: 1 if the new elements are proved to cover the region */
FOAM_API int foam_grow(const foam_region* region, const foam_elements* elements, const foam_options* options,
                       foam_elements** grown, foam_report* report);

/* Returns the version of the library, "0.2.0". The text lives as long as the library. */
FOAM_API const char* foam_version(void);

#ifdef __cplusplus
}
#endif

#endif
