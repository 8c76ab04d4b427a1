/* foam.h as a C program uses it, rightly and wrongly. Prints what does not hold; exit code 1 then. */
#include <foam.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { most = 16, side = 40, grid_vertices = (side + 1) * (side + 1), grid_triangles = 2 * side * side };

static int failures = 0;

#define EXPECT(condition)                                                                                              \
    ((condition) ? (void)0 : (void)(++failures, printf("%s:%d: not so: %s\n", __FILE__, __LINE__, #condition)))

static const double box[8][3] = {{-3, -2, -10}, {3, -2, -10}, {-3, 2, -10}, {3, 2, -10},
                                 {-3, -2, 10},  {3, -2, 10},  {-3, 2, 10},  {3, 2, 10}};
static const uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

/* The arguments of a call, right until a test changes some. */
struct call {
    double vertices[8][3];
    uint32_t triangles[12][3];
    const double* vertex_array;
    const uint32_t* triangle_array;
    size_t vertex_count, triangle_count, count;
    foam_options options;
    double spheres[most][4];
    double* sphere_array;
    foam_report report;
};

static void begin(struct call* call) {
    memset(call, 0, sizeof *call);
    memcpy(call->vertices, box, sizeof box);
    memcpy(call->triangles, faces, sizeof faces);
    call->vertex_array = call->vertices[0];
    call->triangle_array = call->triangles[0];
    call->vertex_count = 8;
    call->triangle_count = 12;
    call->count = most;
    call->options.size = sizeof(foam_options);
    call->options.effort = FOAM_FAST;
    call->sphere_array = call->spheres[0];
    call->report.size = sizeof(foam_report);
    strcpy(call->report.error, "of another call");
}

static int run(struct call* call) {
    return foam_spherize(call->vertex_array, call->vertex_count, call->triangle_array, call->triangle_count,
                         call->count, &call->options, call->sphere_array, &call->report);
}

/* Expects the status and a text with the word and a remedy, and that no sphere is written. */
static void expect_refusal(struct call* call, int status, const char* word, int line) {
    const int got = run(call);
    const foam_report* report = &call->report;
    if (got != status || !strstr(report->error, word) || !strstr(report->error, "remedy: ") || report->spheres != 0 ||
        report->certified || call->spheres[0][3] != 0) {
        ++failures;
        printf("%s:%d: status %d, not %d; %zu spheres; text '%s', not of '%s'\n", __FILE__, line, got, status,
               report->spheres, report->error, word);
    }
}

/* One change of a right call. */
#define REFUSED(status, word, change)                                                                                  \
    do {                                                                                                               \
        struct call call;                                                                                              \
        begin(&call);                                                                                                  \
        change;                                                                                                        \
        expect_refusal(&call, status, word, __LINE__);                                                                 \
    } while (0)

static int answer(void* user) {
    return *(const int*)user;
}

static void test_wrong_arguments(void) {
    int nine = 9;
    REFUSED(FOAM_USAGE, "vertices is NULL", call.vertex_array = NULL);
    REFUSED(FOAM_USAGE, "triangles is NULL", call.triangle_array = NULL);
    REFUSED(FOAM_USAGE, "spheres is NULL", call.sphere_array = NULL);
    REFUSED(FOAM_USAGE, "count is 0", call.count = 0);
    REFUSED(FOAM_USAGE, "count is 1000001", call.count = FOAM_MAX_SPHERES + 1);
    REFUSED(FOAM_USAGE, "count is 18446744073709551615", call.count = SIZE_MAX);
    REFUSED(FOAM_USAGE, "18446744073709551615 vertices", call.vertex_count = SIZE_MAX);
    REFUSED(FOAM_USAGE, "18446744073709551615 triangles", call.triangle_count = SIZE_MAX);
    REFUSED(FOAM_USAGE, "options->size", call.options.size = 8);
    REFUSED(FOAM_USAGE, "options->effort is 3", call.options.effort = 3);
    REFUSED(FOAM_USAGE, "options->objective is -1", call.options.objective = -1);
    REFUSED(FOAM_USAGE, "options->time_limit is -1", call.options.time_limit = -1);
    REFUSED(FOAM_USAGE, "options->time_limit is nan", call.options.time_limit = NAN);
    REFUSED(FOAM_USAGE, "options->threads", call.options.threads = UINT32_MAX);
    REFUSED(FOAM_USAGE, "options->reserved", call.options.reserved = 1);
    REFUSED(FOAM_USAGE, "options->poll returned 9", (call.options.poll = answer, call.options.user = &nine));
    struct call call;
    begin(&call);
    EXPECT(foam_spherize(call.vertices[0], 8, call.triangles[0], 12, most, NULL, call.spheres[0], NULL) == FOAM_USAGE);
    call.report.size = 1;
    EXPECT(run(&call) == FOAM_USAGE);
    EXPECT(strcmp(call.report.error, "of another call") == 0);
}

static void test_wrong_meshes(void) {
    REFUSED(FOAM_GEOMETRY, "no triangle", call.triangle_count = 0);
    REFUSED(FOAM_GEOMETRY, "no triangle", (call.triangle_count = 0, call.vertex_count = 0));
    REFUSED(FOAM_GEOMETRY, "0 vertices", call.vertex_count = 0);
    REFUSED(FOAM_GEOMETRY, "triangle 2 has the corner 5, but there are 5 vertices", call.vertex_count = 5);
    REFUSED(FOAM_GEOMETRY, "triangle 11 has the corner 4294967295", call.triangles[11][2] = UINT32_MAX);
    REFUSED(FOAM_GEOMETRY, "vertex 7 is (3, nan, 10)", call.vertices[7][1] = NAN);
    REFUSED(FOAM_GEOMETRY, "vertex 0 is (-inf, -2, -10)", call.vertices[0][0] = -INFINITY);
    REFUSED(FOAM_GEOMETRY, "", call.vertices[0][0] = 1e300);
}

static void test_right_call(void) {
    struct call call;
    begin(&call);
    EXPECT(run(&call) == FOAM_OK);
    EXPECT(call.report.error[0] == 0 && call.report.certified == 1 && call.report.finished_early == 0);
    EXPECT(call.report.spheres >= 1 && call.report.spheres <= most);
    EXPECT(call.report.volume > 6 * 4 * 20 && call.report.volume < 3 * 6 * 4 * 20);
    for (int v = 0; v < 8; ++v) {
        int inside = 0;
        for (size_t i = 0; i < call.report.spheres; ++i) {
            const double* s = call.spheres[i];
            const double x = box[v][0] - s[0], y = box[v][1] - s[1], z = box[v][2] - s[2];
            inside |= x * x + y * y + z * z <= s[3] * s[3];
        }
        EXPECT(inside);
    }
    EXPECT(foam_spherize(box[0], 8, faces[0], 12, 1, NULL, call.spheres[0], &call.report) == FOAM_OK);
    EXPECT(call.report.spheres == 1 && fabs(call.spheres[0][3] - sqrt(113)) < 1e-3);
    EXPECT(strlen(foam_version()) >= 5);
}

/* Meshes that are odd, and can be covered. */
static void test_odd_meshes(void) {
    struct call call;
    begin(&call);
    call.triangle_count = 1; /* a sheet */
    EXPECT(run(&call) == FOAM_OK && call.report.certified);
    begin(&call);
    memset(call.vertices, 0, sizeof call.vertices); /* a point */
    EXPECT(run(&call) == FOAM_OK && call.report.certified);
    begin(&call);
    for (int v = 0; v < 8; ++v) {
        call.vertices[v][1] = call.vertices[v][2] = 0; /* a line */
    }
    EXPECT(run(&call) == FOAM_OK && call.report.certified);
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* A wavy sheet that takes a while. */
static double grid[grid_vertices][3];
static uint32_t grid_faces[grid_triangles][3];

static void make_grid(void) {
    uint32_t t = 0;
    for (uint32_t i = 0; i <= side; ++i) {
        for (uint32_t j = 0; j <= side; ++j) {
            double* const p = grid[i * (side + 1) + j];
            p[0] = i;
            p[1] = j;
            p[2] = 5 * sin(0.3 * i) * cos(0.2 * j);
            if (i < side && j < side) {
                const uint32_t a = i * (side + 1) + j, b = a + side + 1;
                const uint32_t corners[6] = {a, b, a + 1, a + 1, b, b + 1};
                memcpy(grid_faces[t], corners, sizeof corners);
                t += 2;
            }
        }
    }
}

static int spherize_grid(const foam_options* options, double* spheres, foam_report* report) {
    report->size = sizeof *report;
    return foam_spherize(grid[0], grid_vertices, grid_faces[0], grid_triangles, most, options, spheres, report);
}

struct ticks {
    int answer, calls;
    double answer_at, last, longest;
    pthread_t caller;
};

static int tick(void* user) {
    struct ticks* const ticks = user;
    const double time = now();
    ++ticks->calls;
    ticks->longest = time - ticks->last > ticks->longest ? time - ticks->last : ticks->longest;
    ticks->last = time;
    EXPECT(pthread_equal(ticks->caller, pthread_self()));
    return time >= ticks->answer_at ? ticks->answer : FOAM_CONTINUE;
}

static void test_poll(void) {
    static const int answers[] = {FOAM_FINISH, FOAM_CANCEL};
    for (int i = 0; i < 2; ++i) {
        double spheres[most][4] = {{0}};
        const double start = now();
        struct ticks ticks = {.answer = answers[i], .answer_at = start + 0.1, .last = start, .caller = pthread_self()};
        const foam_options options = {.size = sizeof options, .effort = FOAM_BEST, .poll = tick, .user = &ticks};
        foam_report report;
        const int status = spherize_grid(&options, spheres[0], &report);
        printf("answer %d: %.3f s, %d calls, at most %.3f s apart\n", answers[i], now() - start, ticks.calls,
               ticks.longest);
        EXPECT(ticks.calls > 3);
        EXPECT(now() - start < 5); /* alone 0.2 s; the whole search takes over a minute */
        if (answers[i] == FOAM_FINISH) {
            EXPECT(status == FOAM_OK && report.finished_early && report.certified && report.spheres >= 1);
        } else {
            EXPECT(status == FOAM_CANCELLED && report.spheres == 0 && spheres[0][3] == 0 && report.error[0] != 0);
        }
    }
}

static void test_time_limit(void) {
    double spheres[most][4];
    const foam_options options = {.size = sizeof options, .effort = FOAM_BEST, .time_limit = 0.1};
    foam_report report;
    const double start = now();
    EXPECT(spherize_grid(&options, spheres[0], &report) == FOAM_OK);
    EXPECT(report.finished_early && report.certified);
    EXPECT(now() - start < 5);
}

struct job {
    foam_options options;
    foam_report report;
    double spheres[most][4];
    int status;
};

static void* work(void* user) {
    struct job* const job = user;
    job->status = spherize_grid(&job->options, job->spheres[0], &job->report);
    return NULL;
}

/* Calls at once, each with another number of threads, give the bytes of one call alone. */
static void test_threads(void) {
    enum { jobs = 4 };
    static struct job all[jobs + 1];
    pthread_t threads[jobs];
    for (int i = 0; i <= jobs; ++i) {
        all[i].options = (foam_options){.size = sizeof(foam_options), .effort = FOAM_FAST, .threads = (uint32_t)i};
    }
    work(&all[jobs]);
    for (int i = 0; i < jobs; ++i) {
        EXPECT(pthread_create(&threads[i], NULL, work, &all[i]) == 0);
    }
    for (int i = 0; i < jobs; ++i) {
        pthread_join(threads[i], NULL);
        EXPECT(all[i].status == FOAM_OK && all[i].report.spheres == all[jobs].report.spheres);
        EXPECT(memcmp(all[i].spheres, all[jobs].spheres, sizeof all[i].spheres) == 0);
    }
}

/* Three points with radii, and a mesh: by each kind, read back, freed. */
static void test_cover(void) {
    static const double points[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, radii[3] = {0.1, 0.2, 0};
    static const int kinds[] = {FOAM_SPHERE, FOAM_CAPSULE, FOAM_CYLINDER, FOAM_BOX, FOAM_SWEPT_BOX, FOAM_HULL, FOAM_ELLIPSOID};
    foam_report report = {.size = sizeof report};
    const foam_options fast = {.size = sizeof fast, .effort = FOAM_FAST};
    foam_region* region = NULL;
    EXPECT(foam_region_of_points(points[0], radii, 3, &region, &report) == FOAM_OK && region);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
        foam_elements* elements = NULL;
        EXPECT(foam_cover(region, 2, (unsigned)kinds[k], &fast, &elements, &report) == FOAM_OK);
        EXPECT(report.certified && report.volume > 0 && report.spheres == foam_elements_count(elements));
        EXPECT(foam_elements_count(elements) >= 1 && foam_elements_count(elements) <= 2);
        for (size_t i = 0; i < foam_elements_count(elements); ++i) {
            foam_element element;
            EXPECT(foam_elements_get(elements, i, &element) == FOAM_OK && element.kind == kinds[k]);
            EXPECT((element.vertex_count >= 4) == (kinds[k] == FOAM_HULL) && !element.vertices == !element.vertex_count);
        }
        foam_element none;
        EXPECT(foam_elements_get(elements, 2, &none) == FOAM_USAGE);
        foam_elements_free(elements);
    }
    foam_elements* elements = NULL;
    EXPECT(foam_cover(region, 2, 0, &fast, &elements, &report) == FOAM_USAGE && !elements && report.error[0]);
    EXPECT(foam_cover(region, 2, 128, &fast, &elements, &report) == FOAM_USAGE && !elements);
    EXPECT(foam_cover(NULL, 2, FOAM_BOX, &fast, &elements, &report) == FOAM_USAGE && !elements);
    const foam_options radius = {.size = sizeof radius, .objective = FOAM_RADIUS};
    EXPECT(foam_cover(region, 2, FOAM_BOX, &radius, &elements, &report) == FOAM_USAGE && strstr(report.error, "remedy"));
    EXPECT(foam_cover(region, 0, FOAM_BOX, &fast, &elements, &report) == FOAM_USAGE && !elements);
    EXPECT(!strcmp(report.error, "count is 0; remedy: 1 to 1000000 elements"));
    foam_region_free(region);
    const double wrong[3] = {-1, 0, 0};
    EXPECT(foam_region_of_points(points[0], wrong, 3, &region, &report) == FOAM_GEOMETRY && !region);
    EXPECT(foam_region_of_points(NULL, NULL, 0, &region, &report) == FOAM_GEOMETRY && !region);
    EXPECT(foam_region_of_points(points[0], radii, SIZE_MAX, &region, &report) == FOAM_USAGE && !region);
    EXPECT(!strcmp(report.error, "count is 18446744073709551615; remedy: at most 4294967295 points"));
    EXPECT(foam_region_of_mesh(grid[0], grid_vertices, grid_faces[0], grid_triangles, &region, &report) == FOAM_OK);
    EXPECT(foam_cover(region, 4, FOAM_CAPSULE | FOAM_BOX, &fast, &elements, &report) == FOAM_OK && report.certified);
    foam_elements_free(elements);
    foam_region_free(region);
    foam_region_free(NULL);
    foam_elements_free(NULL);
    EXPECT(foam_elements_count(NULL) == 0);
}

int main(void) {
    make_grid();
    test_cover();
    test_wrong_arguments();
    test_wrong_meshes();
    test_right_call();
    test_odd_meshes();
    test_poll();
    test_time_limit();
    test_threads();
    printf("%d failures\n", failures);
    return failures ? 1 : 0;
}
