/* A box of 6 x 4 x 20 cm, inside at most 8 spheres. */
#include <foam.h>

#include <stdio.h>

enum { most = 8 };

int main(void) {
    double vertices[8][3];
    const uint32_t triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (int i = 0; i < 8; ++i) {
        vertices[i][0] = i & 1 ? 0.03 : -0.03;
        vertices[i][1] = i & 2 ? 0.02 : -0.02;
        vertices[i][2] = i & 4 ? 0.1 : -0.1;
    }

    double spheres[most][4];
    const foam_options options = {.size = sizeof options, .effort = FOAM_FAST};
    foam_report report = {.size = sizeof report};
    if (foam_spherize(vertices[0], 8, triangles[0], 12, most, &options, spheres[0], &report) != FOAM_OK) {
        fprintf(stderr, "foam: error: %s\n", report.error);
        return 1;
    }
    for (size_t i = 0; i < report.spheres; ++i) {
        printf("%.17g %.17g %.17g %.17g\n", spheres[i][0], spheres[i][1], spheres[i][2], spheres[i][3]);
    }
    printf("foam %s: %zu spheres of %.3g m3, %s\n", foam_version(), report.spheres, report.volume,
           report.certified ? "proved" : "not proved");
    return 0;
}
