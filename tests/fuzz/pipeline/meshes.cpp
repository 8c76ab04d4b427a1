#include "meshes.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numbers>

namespace foam::fuzz {
namespace {

constexpr double pi = std::numbers::pi;

void add(Mesh& mesh, const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const Triangle& t : other.triangles) {
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
}

Mesh moved(Mesh mesh, double scale, const Vec3& offset) {
    for (Vec3& v : mesh.vertices) {
        v = scale * v + offset;
    }
    return mesh;
}

Mesh turned_inside_out(Mesh mesh) {
    for (Triangle& t : mesh.triangles) {
        std::swap(t[1], t[2]);
    }
    return mesh;
}

Mesh box() {
    Mesh mesh;
    for (int k = 0; k < 8; ++k) {
        mesh.vertices.push_back({k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5});
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

Mesh tetrahedron(Dice& dice) {
    Mesh mesh;
    for (int k = 0; k < 4; ++k) {
        mesh.vertices.push_back({dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)});
    }
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return mesh;
}

/// Rings of `around` points, the first and last shrunk to a pole.
Mesh lathe(int around, const std::vector<std::pair<double, double>>& profile) {
    Mesh mesh;
    const auto point = [&](std::size_t ring, int k) {
        const double angle = 2 * pi * k / around;
        return Vec3{profile[ring].first * std::cos(angle), profile[ring].first * std::sin(angle), profile[ring].second};
    };
    const std::size_t rings = profile.size();
    mesh.vertices.push_back({0, 0, profile.front().second});
    for (std::size_t ring = 1; ring + 1 < rings; ++ring) {
        for (int k = 0; k < around; ++k) {
            mesh.vertices.push_back(point(ring, k));
        }
    }
    mesh.vertices.push_back({0, 0, profile.back().second});
    const auto n = static_cast<std::uint32_t>(around), last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t next = (k + 1) % n;
        mesh.triangles.push_back({0, 1 + next, 1 + k});
        for (std::uint32_t ring = 0; ring + 3 < rings; ++ring) {
            const std::uint32_t a = 1 + ring * n, b = a + n;
            mesh.triangles.push_back({a + k, a + next, b + next});
            mesh.triangles.push_back({a + k, b + next, b + k});
        }
        mesh.triangles.push_back({last, last - n + k, last - n + next});
    }
    return mesh;
}

Mesh ball(Dice& dice) {
    const int rings = dice.between(3, 8);
    std::vector<std::pair<double, double>> profile;
    for (int k = 0; k <= rings; ++k) {
        profile.emplace_back(std::sin(pi * k / rings), -std::cos(pi * k / rings));
    }
    return lathe(dice.between(3, 14), profile);
}

Mesh cylinder(Dice& dice) {
    const double h = dice.magnitude(0.1, 5);
    return lathe(dice.between(3, 24), {{0, -h}, {1, -h}, {1, h}, {0, h}});
}

Mesh cone(Dice& dice) {
    return lathe(dice.between(3, 24), {{0, 0}, {1, 0}, {0, dice.magnitude(0.05, 5)}});
}

Mesh vase(Dice& dice) {
    std::vector<std::pair<double, double>> profile{{0, 0}};
    const int rings = dice.between(2, 7);
    for (int k = 0; k < rings; ++k) {
        profile.emplace_back(dice.uniform(0.1, 1), 0.4 * k);
    }
    profile.emplace_back(0, 0.4 * (rings - 1) - (dice.chance(0.5) ? 0.3 : 0));
    return lathe(dice.between(3, 16), profile);
}

Mesh torus(Dice& dice) {
    Mesh mesh;
    const int n = dice.between(3, 14), m = dice.between(3, 9);
    const double tube = dice.uniform(0.05, 0.9);
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < m; ++k) {
            const double a = 2 * pi * i / n, b = 2 * pi * k / m, r = 1 + tube * std::cos(b);
            mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), tube * std::sin(b)});
        }
    }
    const auto at = [&](int i, int k) { return static_cast<std::uint32_t>((i % n) * m + k % m); };
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < m; ++k) {
            mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    }
    return mesh;
}

Mesh spiky(Dice& dice) {
    Mesh mesh = ball(dice);
    for (Vec3& v : mesh.vertices) {
        v = dice.chance(0.3) ? dice.magnitude(0.1, 8) * v : v;
    }
    return mesh;
}

Mesh two(Dice& dice) {
    Mesh mesh = dice.chance(0.5) ? box() : ball(dice);
    const Mesh other = dice.chance(0.5) ? box() : ball(dice);
    switch (dice.below(6)) {
    case 0: // hollow: the inner one is a cavity
        add(mesh, turned_inside_out(moved(mesh, dice.uniform(0.2, 0.999), {})));
        break;
    case 1: // nested, wound alike
        add(mesh, moved(other, dice.uniform(0.05, 0.4), {}));
        break;
    case 2: // faces touch
        add(mesh, moved(mesh, 1, {1, dice.chance(0.5) ? 0 : 0.5, 0}));
        break;
    case 3: // overlap
        add(mesh, moved(other, dice.uniform(0.3, 1.5), {dice.uniform(0, 0.9), dice.uniform(0, 0.9), 0}));
        break;
    case 4: // apart, by little or much
        add(mesh, moved(other, dice.magnitude(0.01, 1), {dice.sign() * dice.magnitude(1, 100), 0, 0}));
        break;
    default: // touch along an edge or in a corner
        add(mesh, moved(box(), 1, {1, 1, dice.chance(0.5) ? 1.0 : 0.0}));
    }
    return mesh;
}

Mesh several_boxes(Dice& dice) {
    Mesh mesh;
    const int count = dice.between(2, 12);
    for (int k = 0; k < count; ++k) {
        Mesh one = box();
        const Vec3 size{dice.magnitude(0.01, 1), dice.magnitude(0.01, 1), dice.magnitude(0.01, 1)},
            at{dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)};
        for (Vec3& v : one.vertices) {
            v = {v.x * size.x + at.x, v.y * size.y + at.y, v.z * size.z + at.z};
        }
        add(mesh, one);
    }
    return mesh;
}

Mesh soup(Dice& dice) {
    Mesh mesh;
    const int count = dice.between(1, 60);
    const double grid = dice.chance(0.5) ? dice.between(1, 4) : 0;
    const auto coordinate = [&] {
        const double x = dice.uniform(-1, 1);
        return grid > 0 ? std::round(grid * x) / grid : x;
    };
    for (int k = 0; k < 3 * count; ++k) {
        mesh.vertices.push_back({coordinate(), coordinate(), coordinate()});
    }
    for (int k = 0; k < count; ++k) {
        const auto first = static_cast<std::uint32_t>(3 * k);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

Mesh needles(Dice& dice) {
    Mesh mesh;
    const int count = dice.between(1, 30);
    for (int k = 0; k < count; ++k) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const Vec3 tip{dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)};
        const double width = dice.magnitude(1e-12, 1e-2);
        mesh.vertices.push_back({});
        mesh.vertices.push_back(tip);
        mesh.vertices.push_back(tip + Vec3{width, 0, dice.chance(0.5) ? width : 0});
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

Mesh sheet(Dice& dice) {
    Mesh mesh;
    const int n = dice.between(1, 10), m = dice.between(1, 10);
    const double wave = dice.chance(0.5) ? 0 : dice.magnitude(1e-9, 0.5);
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k <= m; ++k) {
            mesh.vertices.push_back({1.0 * i / n, 1.0 * k / m, wave * std::sin(3.0 * i + 2.0 * k)});
        }
    }
    const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * (m + 1) + k); };
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < m; ++k) {
            mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    }
    if (dice.chance(0.2)) { // double-sided
        add(mesh, turned_inside_out(mesh));
    }
    return mesh;
}

/// Everything in one point, or on one line.
Mesh collapsed(Dice& dice) {
    Mesh mesh = soup(dice);
    const bool line = dice.chance(0.6);
    const Vec3 along{dice.uniform(-1, 1), dice.uniform(-1, 1), dice.chance(0.5) ? 0 : 1.0};
    for (Vec3& v : mesh.vertices) {
        v = line ? v.x * along : along;
    }
    return mesh;
}

Mesh shape(Dice& dice) {
    using Maker = std::function<Mesh(Dice&)>;
    static const std::vector<std::pair<int, Maker>> makers{{12, [](Dice&) { return box(); }},
                                                           {6, tetrahedron},
                                                           {14, ball},
                                                           {12, cylinder},
                                                           {6, cone},
                                                           {10, vase},
                                                           {10, torus},
                                                           {6, spiky},
                                                           {14, two},
                                                           {8, several_boxes},
                                                           {6, soup},
                                                           {3, needles},
                                                           {6, sheet},
                                                           {3, collapsed}};
    int all = 0;
    for (const auto& [weight, maker] : makers) {
        all += weight;
    }
    int at = dice.between(0, all - 1);
    for (const auto& [weight, maker] : makers) {
        if ((at -= weight) < 0) {
            return maker(dice);
        }
    }
    return box();
}

void turn(Mesh& mesh, Dice& dice) {
    const Pose pose = Pose::from_xyz_rpy({}, {dice.uniform(-pi, pi), dice.uniform(-pi, pi), dice.uniform(-pi, pi)});
    for (Vec3& v : mesh.vertices) {
        v = pose * v;
    }
}

/// An ordinary size and place: a centimetre to three metres, near the origin or some metres off.
void place(Mesh& mesh, Dice& dice) {
    if (dice.chance(0.6)) {
        turn(mesh, dice);
    }
    const double size = dice.magnitude(0.01, 3);
    Vec3 scale{size, size, size};
    if (dice.chance(0.4)) {
        scale = {size, size * dice.magnitude(0.02, 1), size * dice.magnitude(0.02, 1)};
    }
    const Vec3 at = dice.chance(0.5) ? Vec3{} : dice.magnitude(0.01, 10) * Vec3{dice.sign(), dice.sign(), dice.sign()};
    for (Vec3& v : mesh.vertices) {
        v = Vec3{v.x * scale.x, v.y * scale.y, v.z * scale.z} + at;
    }
}

std::uint32_t any_vertex(const Mesh& mesh, Dice& dice) {
    return static_cast<std::uint32_t>(dice.below(mesh.vertices.size()));
}

void repeat_triangles(Mesh& mesh, Dice& dice) {
    for (int k = dice.between(1, 8); k > 0; --k) {
        mesh.triangles.push_back(dice.of(mesh.triangles));
    }
}

void turn_triangles(Mesh& mesh, Dice& dice) {
    for (Triangle& t : mesh.triangles) {
        if (dice.chance(0.2)) {
            std::swap(t[0], t[1]);
        }
    }
}

void open_it(Mesh& mesh, Dice& dice) {
    const double share = dice.uniform(0, 0.6);
    std::erase_if(mesh.triangles, [&](const Triangle&) { return mesh.triangles.size() > 1 && dice.chance(share); });
}

void add_slivers(Mesh& mesh, Dice& dice) {
    for (int k = dice.between(1, 6); k > 0; --k) {
        const std::uint32_t a = any_vertex(mesh, dice), b = any_vertex(mesh, dice);
        const Vec3 p = dice.chance(0.5) ? mesh.vertices[a] : 0.5 * (mesh.vertices[a] + mesh.vertices[b]);
        mesh.vertices.push_back(p + Vec3{dice.chance(0.5) ? 0 : dice.magnitude(1e-14, 1e-4), 0, 0});
        mesh.triangles.push_back({a, b, static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
    }
}

void degenerate_some(Mesh& mesh, Dice& dice) {
    for (int k = dice.between(1, 5); k > 0; --k) {
        const std::uint32_t a = any_vertex(mesh, dice);
        mesh.triangles.push_back({a, dice.chance(0.5) ? a : any_vertex(mesh, dice), a});
    }
}

/// Every triangle gets vertices of its own, some of them moved by a hair.
void unweld(Mesh& mesh, Dice& dice) {
    const double hair = dice.chance(0.5) ? 0 : dice.magnitude(1e-12, 1e-3);
    Mesh loose;
    for (const Triangle& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(loose.vertices.size());
        for (const std::uint32_t corner : t) {
            loose.vertices.push_back(mesh.vertices[corner] + Vec3{dice.uniform(-hair, hair), 0, 0});
        }
        loose.triangles.push_back({first, first + 1, first + 2});
    }
    mesh = std::move(loose);
}

void jitter(Mesh& mesh, Dice& dice) {
    const double size = dice.magnitude(1e-15, 0.3);
    for (Vec3& v : mesh.vertices) {
        v = v + size * Vec3{dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)};
    }
}

void move_unused_far(Mesh& mesh, Dice& dice) {
    const double far = dice.odd_magnitude();
    mesh.vertices.push_back({far, -far, far});
}

void merge_vertices(Mesh& mesh, Dice& dice) {
    for (int k = dice.between(1, 4); k > 0; --k) {
        mesh.vertices[any_vertex(mesh, dice)] = mesh.vertices[any_vertex(mesh, dice)];
    }
}

void damage(Mesh& mesh, Dice& dice) {
    for (const auto& harm : {repeat_triangles, turn_triangles, open_it, add_slivers, degenerate_some, unweld, jitter,
                             move_unused_far, merge_vertices}) {
        if (dice.chance(0.08)) {
            harm(mesh, dice);
        }
    }
}

void scale_all(Mesh& mesh, Dice& dice) {
    const double factor = dice.odd_magnitude();
    mesh = moved(std::move(mesh), factor, {});
}

void move_all(Mesh& mesh, Dice& dice) {
    const double far = dice.odd_magnitude();
    mesh = moved(std::move(mesh), 1, {dice.chance(0.7) ? far : 0, dice.chance(0.5) ? -far : 0, 0});
}

void scale_and_move(Mesh& mesh, Dice& dice) {
    scale_all(mesh, dice);
    move_all(mesh, dice);
}

void one_spike(Mesh& mesh, Dice& dice) {
    Vec3& v = mesh.vertices[any_vertex(mesh, dice)];
    const double far = dice.chance(0.5) ? dice.magnitude(1e2, 1e12) : dice.odd_magnitude();
    v = {dice.chance(0.6) ? far : v.x, dice.chance(0.6) ? far : v.y, dice.chance(0.3) ? -far : v.z};
}

void flatten(Mesh& mesh, Dice& dice) {
    const double thin = dice.chance(0.3) ? 0 : dice.odd_magnitude(),
                 other = dice.chance(0.5) ? 1 : dice.odd_magnitude();
    for (Vec3& v : mesh.vertices) {
        v = {v.x, v.y * other, v.z * thin};
    }
}

void odd_coordinates(Mesh& mesh, Dice& dice) {
    for (Vec3& v : mesh.vertices) {
        if (dice.chance(0.15)) {
            v = {dice.sign() * dice.odd_magnitude(), v.y, dice.chance(0.3) ? dice.odd_magnitude() : v.z};
        }
    }
}

void make_numbers_odd(Mesh& mesh, Dice& dice) {
    using Harm = void (*)(Mesh&, Dice&);
    const Harm harm =
        dice.of<Harm>({scale_all, scale_all, move_all, scale_and_move, one_spike, one_spike, flatten, odd_coordinates});
    harm(mesh, dice);
}

std::string row(const Vec3& v) {
    return text_of(v.x) + " " + text_of(v.y) + " " + text_of(v.z);
}

std::string obj(const Mesh& mesh) {
    std::string text;
    for (const Vec3& v : mesh.vertices) {
        text += "v " + row(v) + "\n";
    }
    for (const Triangle& t : mesh.triangles) {
        text +=
            "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
    }
    return text;
}

std::string ascii_stl(const Mesh& mesh) {
    std::string text = "solid s\n";
    for (const Triangle& t : mesh.triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const std::uint32_t corner : t) {
            text += "vertex " + row(mesh.vertices[corner]) + "\n";
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid s\n";
}

std::string binary_stl(const Mesh& mesh) {
    std::string bytes(80, ' ');
    const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    append(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const Triangle& t : mesh.triangles) {
        bytes.append(12, '\0');
        for (const std::uint32_t corner : t) {
            const Vec3& v = mesh.vertices[corner];
            for (const double x : {v.x, v.y, v.z}) {
                append(std::abs(x) > 3.4e38 ? static_cast<float>(std::copysign(3.4e38, x)) : static_cast<float>(x));
            }
        }
        append(std::uint16_t{0});
    }
    return bytes;
}

/// What OFF and ASCII PLY have in common after their heads.
std::string rows(const Mesh& mesh) {
    std::string text;
    for (const Vec3& v : mesh.vertices) {
        text += row(v) + "\n";
    }
    for (const Triangle& t : mesh.triangles) {
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    }
    return text;
}

} // namespace

Mesh random_mesh(Dice& dice, bool odd_numbers) {
    Mesh mesh = shape(dice);
    place(mesh, dice);
    damage(mesh, dice);
    if (odd_numbers) {
        make_numbers_odd(mesh, dice);
    }
    return mesh;
}

std::string mesh_file(const Mesh& mesh, const std::string& format) {
    const std::string vertices = std::to_string(mesh.vertices.size()),
                      triangles = std::to_string(mesh.triangles.size());
    if (format == "stl") {
        return ascii_stl(mesh);
    }
    if (format == "stlb") {
        return binary_stl(mesh);
    }
    if (format == "off") {
        return "OFF\n" + vertices + " " + triangles + " 0\n" + rows(mesh);
    }
    if (format == "ply") {
        return "ply\nformat ascii 1.0\nelement vertex " + vertices +
               "\nproperty double x\nproperty double y\nproperty double z\nelement face " + triangles +
               "\nproperty list uchar int vertex_indices\nend_header\n" + rows(mesh);
    }
    return obj(mesh);
}

std::string random_format(Dice& dice) {
    return dice.chance(0.94) ? dice.of({"obj", "obj", "stl", "stlb"}) : dice.of({"off", "ply"});
}

std::string ending_of(const std::string& format) {
    return format == "stlb" ? "stl" : format;
}

} // namespace foam::fuzz
