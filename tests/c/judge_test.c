/* Proof, figures, growth and other forms of elements by foam.h. Prints what does not hold; exit code 1 then. */
#include <foam.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

#define EXPECT(condition)                                                                                              \
    ((condition) ? (void)0 : (void)(++failures, printf("%s:%d: not so: %s\n", __FILE__, __LINE__, #condition)))

/* A box of 0.6 x 0.4 x 2 m. */
static const double box[8][3] = {{-.3, -.2, -1}, {.3, -.2, -1}, {-.3, .2, -1}, {.3, .2, -1},
                                 {-.3, -.2, 1},  {.3, -.2, 1},  {-.3, .2, 1},  {.3, .2, 1}};
static const uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
/* It, and the room that the proof needs for rounding. */
static const foam_element exact = {.kind = FOAM_BOX, .half = {.3 + 1e-12, .2 + 1e-12, 1 + 1e-12}};

static foam_report report = {.size = sizeof report};

static foam_region* box_region(void) {
    foam_region* region = NULL;
    EXPECT(foam_region_of_mesh(box[0], 8, faces[0], 12, &region, &report) == FOAM_OK);
    return region;
}

static foam_elements* elements_of(const foam_element* array, size_t count) {
    foam_elements* elements = NULL;
    EXPECT(foam_elements_make(array, count, &elements, &report) == FOAM_OK);
    EXPECT(foam_elements_count(elements) == count);
    return elements;
}

static void test_certify(void) {
    foam_region* region = box_region();
    foam_certificate proof = {.size = sizeof proof};
    foam_elements* elements = elements_of(&exact, 1);
    EXPECT(foam_certify(region, elements, NULL, &proof, &report) == FOAM_OK);
    EXPECT(proof.holds && proof.solid && report.certified);
    foam_elements_free(elements);

    foam_element smaller = exact;
    smaller.half[2] = 0.99;
    elements = elements_of(&smaller, 1);
    EXPECT(foam_certify(region, elements, NULL, &proof, &report) == FOAM_OK);
    EXPECT(!proof.holds && !report.certified && !proof.cavity);
    EXPECT(fabs(proof.growth - 0.01) < 1e-6 && fabs(fabs(proof.witness[2]) - 1) < 1e-6);

    foam_elements* grown = NULL;
    EXPECT(foam_grow(region, elements, NULL, &grown, &report) == FOAM_OK && report.certified);
    foam_element element;
    EXPECT(foam_elements_get(grown, 0, &element) == FOAM_OK && element.half[2] >= 1 && element.half[2] < 1.001);
    foam_elements_free(grown);
    foam_elements_free(elements);

    /* A box with walls of six boxes is hollow. */
    foam_element walls[6];
    for (int i = 0; i < 6; ++i) {
        walls[i] = exact;
        walls[i].half[i / 2] = 0.05;
        walls[i].position[i / 2] = (i % 2 ? 1 : -1) * (exact.half[i / 2] - 0.05);
    }
    elements = elements_of(walls, 6);
    EXPECT(foam_certify(region, elements, NULL, &proof, &report) == FOAM_OK && !proof.holds && proof.cavity);
    EXPECT(fabs(proof.witness[0]) < .3 && fabs(proof.witness[1]) < .2 && fabs(proof.witness[2]) < 1);
    foam_elements_free(elements);
    elements = elements_of(walls, 0);
    EXPECT(foam_certify(region, elements, NULL, &proof, &report) == FOAM_OK && !proof.holds);
    foam_elements_free(elements);
    foam_region_free(region);
}

static void test_evaluate(void) {
    foam_region* region = box_region();
    foam_element larger = exact;
    larger.half[0] = 0.45;
    foam_elements* elements = elements_of(&larger, 1);
    foam_figures figures = {.size = sizeof figures};
    EXPECT(foam_evaluate(region, elements, NULL, &figures, &report) == FOAM_OK);
    EXPECT(figures.elements == 1 && figures.certified && figures.solid && figures.covered == 1 && figures.gap == 0);
    EXPECT(fabs(figures.volume - .48) < 1e-9 && fabs(figures.area - 4.48) < 1e-9);
    EXPECT(fabs(figures.excess - .5) < 3 * figures.excess_error + 1e-3 && figures.missing == 0);
    EXPECT(fabs(figures.protrusion_max - .15) < 1e-3);
    foam_elements_free(elements);
    foam_region_free(region);
}

static int count_kind(const foam_elements* elements, int kind) {
    int count = 0;
    for (size_t i = 0; i < foam_elements_count(elements); ++i) {
        foam_element element;
        count += foam_elements_get(elements, i, &element) == FOAM_OK && element.kind == kind;
    }
    return count;
}

static void test_other_kinds(void) {
    const foam_element both[2] = {{.kind = FOAM_CAPSULE, .half = {0, 0, 1}, .radius = .4}, exact};
    foam_region* region = box_region();
    foam_elements *elements = elements_of(both, 2), *other = NULL;
    foam_certificate proof = {.size = sizeof proof};
    EXPECT(foam_elements_in_kinds(elements, FOAM_CYLINDER | FOAM_SPHERE | FOAM_BOX, 16, &other, &report) == FOAM_OK);
    EXPECT(foam_elements_count(other) == 4 && count_kind(other, FOAM_SPHERE) == 2 && count_kind(other, FOAM_BOX) == 1);
    EXPECT(foam_certify(region, other, NULL, &proof, &report) == FOAM_OK && proof.holds);
    foam_elements_free(other);
    EXPECT(foam_elements_in_kinds(elements, FOAM_HULL, 16, &other, &report) == FOAM_OK);
    EXPECT(foam_elements_count(other) == 2 && count_kind(other, FOAM_HULL) == 2);
    EXPECT(foam_certify(region, other, NULL, &proof, &report) == FOAM_OK && proof.holds);
    foam_elements_free(other);
    EXPECT(foam_elements_in_kinds(elements, FOAM_BOX, 16, &other, &report) == FOAM_USAGE && !other);
    EXPECT(strstr(report.error, "element 0 is a capsule") && strstr(report.error, "remedy"));
    EXPECT(foam_elements_in_kinds(elements, FOAM_HULL, 6, &other, &report) == FOAM_USAGE && !other);

    foam_mesh* mesh = NULL;
    EXPECT(foam_elements_mesh(elements, 1, 16, &mesh, &report) == FOAM_OK);
    EXPECT(foam_mesh_vertex_count(mesh) == 8 && foam_mesh_triangle_count(mesh) == 12);
    for (size_t i = 0; i < 3 * foam_mesh_vertex_count(mesh); ++i) {
        EXPECT(fabs(foam_mesh_vertices(mesh)[i]) == exact.half[i % 3]);
    }
    foam_region* again = NULL;
    EXPECT(foam_region_of_mesh(foam_mesh_vertices(mesh), 8, foam_mesh_triangles(mesh), 12, &again, &report) == FOAM_OK);
    foam_region_free(again);
    foam_mesh_free(mesh);
    EXPECT(foam_elements_mesh(elements, 2, 16, &mesh, &report) == FOAM_USAGE && !mesh);
    EXPECT(!foam_mesh_vertices(NULL) && !foam_mesh_triangles(NULL) && foam_mesh_vertex_count(NULL) == 0);
    foam_mesh_free(NULL);
    foam_elements_free(elements);
    foam_region_free(region);
}

static void expect_refused(int status, const foam_element* array, size_t count, const char* word, int line) {
    foam_elements* elements = NULL;
    const int got = foam_elements_make(array, count, &elements, &report);
    if (got != status || elements || !strstr(report.error, word) || !strstr(report.error, "remedy: ")) {
        ++failures;
        printf("%s:%d: status %d, not %d; text '%s', not of '%s'\n", __FILE__, line, got, status, report.error, word);
    }
}

#define REFUSED(status, word, ...)                                                                                     \
    do {                                                                                                               \
        const foam_element two[2] = {exact, {__VA_ARGS__}};                                                            \
        expect_refused(status, two, 2, word, __LINE__);                                                                \
    } while (0)

static void test_wrong_elements(void) {
    static const double flat[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    REFUSED(FOAM_USAGE, "element 1 has the kind 3", .kind = 3);
    REFUSED(FOAM_USAGE, "element 1 has the kind 128", .kind = 128);
    REFUSED(FOAM_USAGE, "element 1 has the kind -2147483648", .kind = -2147483647 - 1);
    REFUSED(FOAM_GEOMETRY, "element 1 is not a sphere", .kind = FOAM_SPHERE);
    REFUSED(FOAM_GEOMETRY, "element 1 is not a sphere", .kind = FOAM_SPHERE, .radius = NAN);
    REFUSED(FOAM_GEOMETRY, "element 1 is not a swept box", .kind = FOAM_SWEPT_BOX, .half = {1, -1, 1}, .radius = 1);
    REFUSED(FOAM_GEOMETRY, "element 1 is not an ellipsoid", .kind = FOAM_ELLIPSOID, .half = {1, 1, 1}, .rotation = {2});
    REFUSED(FOAM_USAGE, "element 1 is a hull without vertices", .kind = FOAM_HULL, .vertex_count = 4);
    REFUSED(FOAM_GEOMETRY, "element 1: ", .kind = FOAM_HULL, .vertex_count = 4, .vertices = flat[0]);
    expect_refused(FOAM_USAGE, NULL, 1, "array is NULL", __LINE__);

    foam_region* region = box_region();
    foam_elements* elements = elements_of(&exact, 1);
    foam_certificate proof = {.size = 8};
    foam_figures figures = {.size = 8};
    foam_elements* grown = NULL;
    EXPECT(foam_certify(region, elements, NULL, &proof, &report) == FOAM_USAGE);
    EXPECT(strstr(report.error, "certificate->size is 8") && strstr(report.error, "remedy"));
    EXPECT(foam_certify(region, elements, NULL, NULL, &report) == FOAM_USAGE);
    EXPECT(foam_certify(NULL, elements, NULL, &proof, &report) == FOAM_USAGE);
    EXPECT(foam_evaluate(region, elements, NULL, &figures, &report) == FOAM_USAGE);
    EXPECT(foam_evaluate(region, NULL, NULL, &figures, &report) == FOAM_USAGE);
    EXPECT(foam_grow(region, NULL, NULL, &grown, &report) == FOAM_USAGE && !grown);
    foam_elements* none = elements_of(&exact, 0);
    EXPECT(foam_grow(region, none, NULL, &grown, &report) == FOAM_GEOMETRY && !grown);
    foam_elements_free(none);
    foam_elements_free(elements);
    foam_region_free(region);
}

static int cancel(void* calls) {
    ++*(int*)calls;
    return FOAM_CANCEL;
}

/* What has no result before its end is ended without one. */
static void test_end(void) {
    foam_region* region = box_region();
    foam_elements* elements = elements_of(&exact, 1);
    int calls = 0;
    const foam_options at_once = {.size = sizeof at_once, .poll = cancel, .user = &calls};
    const foam_options late = {.size = sizeof late, .time_limit = 1e-9};
    foam_figures figures = {.size = sizeof figures};
    EXPECT(foam_evaluate(region, elements, &at_once, &figures, &report) == FOAM_CANCELLED && calls > 0);
    EXPECT(figures.elements == 0 && report.error[0]);
    EXPECT(foam_evaluate(region, elements, &late, &figures, &report) == FOAM_CANCELLED);
    foam_elements_free(elements);
    foam_region_free(region);
}

/* The struct of a program that was compiled before it grew. */
static void test_older_options(void) {
    foam_options options;
    memset(&options, 0xff, sizeof options);
    memset(&options, 0, offsetof(foam_options, max_vertices));
    options.size = offsetof(foam_options, max_vertices);
    foam_region* region = box_region();
    foam_elements* elements = NULL;
    EXPECT(foam_cover(region, 1, FOAM_BOX, &options, &elements, &report) == FOAM_OK && report.certified);
    foam_elements_free(elements);
    options.size = sizeof options;
    options.max_vertices = 3;
    options.axis_aligned = 0;
    EXPECT(foam_cover(region, 1, FOAM_HULL, &options, &elements, &report) == FOAM_USAGE && !elements);
    EXPECT(strstr(report.error, "options->max_vertices is 3"));
    options.max_vertices = 8;
    options.axis_aligned = 2;
    EXPECT(foam_cover(region, 1, FOAM_HULL, &options, &elements, &report) == FOAM_USAGE && !elements);
    options.axis_aligned = 1;
    EXPECT(foam_cover(region, 1, FOAM_BOX, &options, &elements, &report) == FOAM_OK);
    foam_element element;
    EXPECT(foam_elements_get(elements, 0, &element) == FOAM_OK && element.rotation[0] == 1 && element.rotation[1] == 0);
    foam_elements_free(elements);
    foam_region_free(region);
}

int main(void) {
    test_certify();
    test_evaluate();
    test_other_kinds();
    test_wrong_elements();
    test_end();
    test_older_options();
    printf("%d failures\n", failures);
    return failures ? 1 : 0;
}
