// A robot has grasped a box. Its planner needs spheres at once.
#include <foam/search/sphere_cache.hpp>

#include <chrono>
#include <iostream>

namespace {

using Clock = std::chrono::steady_clock;

/// A box of 6 x 4 x 20 cm about the gripper's origin, metres.
foam::Mesh grasped() {
    foam::Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.vertices.push_back({i & 1 ? 0.03 : -0.03, i & 2 ? 0.02 : -0.02, i & 4 ? 0.1 : -0.1});
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

} // namespace

int main() {
    foam::SphereCache cache;
    const foam::Mesh object = grasped();

    foam::CoverOptions options;
    options.effort = foam::Effort::fast;
    const auto cover = cache.spherize(object, 8, options);
    for (const foam::Sphere& s : cover->spheres) {
        std::cout << s.center.x << ' ' << s.center.y << ' ' << s.center.z << ' ' << s.radius << '\n';
    }
    std::cout << (cover->certificate.holds ? "proved: the box lies inside\n" : "not proved\n");

    // The same object again needs no search.
    const bool known = cache.spherize(object, 8, options) == cover;
    std::cout << (known ? "known object: from memory\n" : "searched again\n");

    // The search continues until the time is up, and returns the best covering spheres so far.
    const auto end = Clock::now() + std::chrono::milliseconds(50);
    const foam::SphereCover better = foam::spherize(object, 8, {.stop = [&] { return Clock::now() > end; }});
    std::cout << (better.certificate.holds ? "proved within the time\n" : "not proved\n");
    return cover->certificate.holds && known && better.certificate.holds ? 0 : 1;
}
