#include "shapes.hpp"

#include <foam/base/random.hpp>

#include <numbers>

namespace foam::test {
namespace {

/// Closes a grid of rows × columns points (column count wraps round) into triangles, rows wrapping if `closed`.
void add_grid(Mesh& mesh, std::uint32_t first, int rows, int columns, bool closed) {
    const auto at = [&](int row, int column) {
        return first + static_cast<std::uint32_t>((row % rows) * columns + column % columns);
    };
    for (int i = 0; i < (closed ? rows : rows - 1); ++i) {
        for (int j = 0; j < columns; ++j) {
            mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    }
}

Vec3 around(double angle, double radius, double z) {
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

double turn(int i, int n) {
    return 2 * std::numbers::pi * i / n;
}

} // namespace

Mesh box(const Vec3& center, const Vec3& size) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner = {(i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2 & 1) - 0.5};
        mesh.vertices.push_back(center + Vec3{corner.x * size.x, corner.y * size.y, corner.z * size.z});
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

Mesh ball(const Vec3& center, double radius, int sectors) {
    Mesh mesh;
    const int rows = sectors / 2 - 1;
    for (int i = 0; i < rows; ++i) {
        const double latitude = std::numbers::pi * ((i + 1.0) / (rows + 1) - 0.5);
        for (int j = 0; j < sectors; ++j) {
            mesh.vertices.push_back(center +
                                    around(turn(j, sectors), radius * std::cos(latitude), radius * std::sin(latitude)));
        }
    }
    add_grid(mesh, 0, rows, sectors, false);
    const auto south = static_cast<std::uint32_t>(mesh.vertices.size()), north = south + 1;
    mesh.vertices.push_back(center + Vec3{0, 0, -radius});
    mesh.vertices.push_back(center + Vec3{0, 0, radius});
    for (int j = 0; j < sectors; ++j) {
        const auto a = static_cast<std::uint32_t>(j), b = static_cast<std::uint32_t>((j + 1) % sectors);
        const auto top = static_cast<std::uint32_t>((rows - 1) * sectors);
        mesh.triangles.push_back({south, b, a});
        mesh.triangles.push_back({north, top + a, top + b});
    }
    return mesh;
}

Mesh torus(double major, double minor, int sectors) {
    Mesh mesh;
    const int columns = sectors / 2;
    for (int i = 0; i < sectors; ++i) {
        for (int j = 0; j < columns; ++j) {
            const double tilt = turn(j, columns);
            mesh.vertices.push_back(around(turn(i, sectors), major + minor * std::cos(tilt), -minor * std::sin(tilt)));
        }
    }
    add_grid(mesh, 0, sectors, columns, true);
    return mesh;
}

Mesh open_cylinder(double radius, double height, int sectors) {
    Mesh mesh;
    constexpr int rows = 9;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < sectors; ++j) {
            mesh.vertices.push_back(around(turn(j, sectors), radius, height * i / (rows - 1)));
        }
    }
    add_grid(mesh, 0, rows, sectors, false);
    return mesh;
}

Mesh flat_grid(int n) {
    Mesh mesh;
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            mesh.vertices.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n, 0});
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

Mesh soup(int triangles) {
    Random random(5);
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const Vec3 center = {random.uniform(), random.uniform(), random.uniform()};
        for (int k = 0; k < 3; ++k) {
            mesh.vertices.push_back(
                center + Vec3{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)});
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

Mesh noisy(Mesh mesh, double amplitude) {
    Random random(3);
    for (Vec3& p : mesh.vertices) {
        p += Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)} * amplitude;
    }
    return mesh;
}

Mesh reversed(Mesh mesh) {
    for (Triangle& t : mesh.triangles) {
        std::swap(t[1], t[2]);
    }
    return mesh;
}

Mesh without(Mesh mesh, std::size_t first, std::size_t count) {
    const auto begin = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first);
    mesh.triangles.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    return mesh;
}

Mesh united(Mesh a, const Mesh& b) {
    append(a, b);
    return a;
}

Mesh scaled(Mesh mesh, double factor, const Vec3& shift) {
    for (Vec3& p : mesh.vertices) {
        p = p * factor + shift;
    }
    return mesh;
}

std::vector<Named> sound_meshes() {
    return {{"box", box({0.1, 0.2, 0.3}, {0.2, 0.3, 0.4})},
            {"thin plate", box({}, {0.3, 0.2, 0.0005})},
            {"ball", ball({}, 0.1)},
            {"torus", torus(0.2, 0.06)},
            {"two boxes", united(box({}, {0.1, 0.1, 0.1}), box({0.3, 0, 0}, {0.1, 0.2, 0.1}))},
            {"overlapping", united(box({}, {0.2, 0.2, 0.2}), ball({0.1, 0.1, 0.1}, 0.1))},
            {"cavity", united(ball({}, 0.1), reversed(ball({}, 0.06, 16)))},
            {"tiny", scaled(torus(1, 0.3), 1e-7)},
            {"far", scaled(ball({}, 0.1), 1, {10'000, 0, 0})}};
}

std::vector<Named> defective_meshes() {
    Mesh t_junction = without(box({}, {1, 1, 1}), 0, 1); // 0-2-1, whose side 2-1 gets a point that only one side knows
    t_junction.vertices.push_back({0, 0, -0.5});
    t_junction.triangles.push_back({0, 2, 8});
    t_junction.triangles.push_back({0, 8, 1});
    Mesh mixed = torus(0.2, 0.06);
    for (std::size_t i = 0; i < mixed.triangles.size(); i += 3) {
        std::swap(mixed.triangles[i][0], mixed.triangles[i][1]);
    }
    Mesh slivers = box({}, {1, 1, 1});
    slivers.triangles.push_back({0, 0, 1});
    slivers.vertices.push_back({0, -0.5, -0.5});
    slivers.triangles.push_back({0, 8, 1});
    const Mesh cube = box({}, {1, 1, 1});
    return {
        {"open box", without(cube, 0, 2)},
        {"ball with a hole", without(ball({}, 0.1), 100, 12)},
        {"inside out", reversed(ball({}, 0.1))},
        {"mixed winding", mixed},
        {"every face twice", united(cube, cube)},
        {"double sided", united(cube, reversed(cube))},
        {"T junction", t_junction},
        {"shared edge", united(cube, box({1, 1, 0}, {1, 1, 1}))},
        {"shared corner", united(cube, box({1, 1, 1}, {1, 1, 1}))},
        {"shared face", united(cube, box({1, 0, 0}, {1, 1, 1}))},
        {"no area", slivers},
        {"open cylinder", open_cylinder(0.1, 0.3)},
        {"flat", flat_grid(10)},
        {"single triangle", Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}},
        {"needle", Mesh{{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-6, 0}}, {{0, 1, 2}}}},
        {"two far apart", Mesh{{{0, 0, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}, {1, 1, 1}, {1, 1 + 1e-6, 1}, {1, 1, 1 + 1e-6}},
                               {{0, 1, 2}, {3, 4, 5}}}},
        {"soup", soup(60)},
        {"tiny and open", scaled(without(ball({}, 1), 0, 1), 1e-7)},
        {"far and open", scaled(without(ball({}, 0.1), 0, 40), 1, {10'000, -5'000, 0})}};
}

bool is_usable(const Mesh& mesh) {
    return !mesh.triangles.empty() && std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_finite) &&
           std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
               return std::all_of(t.begin(), t.end(), [&](std::uint32_t c) { return c < mesh.vertices.size(); });
           });
}

} // namespace foam::test
