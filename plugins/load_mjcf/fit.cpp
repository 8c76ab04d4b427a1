// As MuJoCo's compiler does it (src/user/user_mesh.cc: mjCMesh::Process and FitGeom).
#include "fit.hpp"

#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace foam::mjcf {
namespace {

constexpr double least = 1e-15; // mjMINVAL

using Matrix = std::array<Vec3, 3>; ///< rows

/// What a triangle adds: its area, or the volume of the pyramid on it.
struct Weights {
    bool shell, magnitude; ///< areas, not volumes; volumes without sign

    double of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& apex) const {
        const Vec3 doubled = cross(b - a, c - a);
        if (shell) {
            return norm(doubled) / 2;
        }
        const double volume = dot((a + b + c) / 3 - apex, doubled) / 6;
        return magnitude ? std::abs(volume) : volume;
    }
};

/// Returns the mean of the triangles' centres, weighed by area.
Vec3 centre_of_surface(const Mesh& mesh) {
    double area = 0;
    Vec3 sum;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        const double own = norm(cross(b - a, c - a)) / 2;
        area += own;
        sum += (a + b + c) / 3 * own;
    }
    if (area < least) {
        throw Error(ErrorCode::geometry, "its surface area is too small to fit a geom to");
    }
    return sum / area;
}

Vec3 centre_of_mass(const Mesh& mesh, const Weights& weights) {
    const Vec3 apex = centre_of_surface(mesh);
    double total = 0;
    Vec3 sum;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        const double own = weights.of(a, b, c, apex);
        total += own;
        sum += ((a + b + c) / 3 * 0.75 + apex * 0.25) * own;
    }
    if (total < least) {
        throw Error(ErrorCode::geometry, "its volume is too small, or its triangles are turned inside out; remedy: "
                                         "inertia=\"shell\" of <mesh>");
    }
    return sum / total;
}

struct Inertia {
    Matrix moments{};
    double total = 0; ///< volume, or area
};

Inertia inertia_about(const Mesh& mesh, const Vec3& centre, const Weights& weights) {
    Inertia inertia;
    Matrix products{};
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[t[0]] - centre, b = mesh.vertices[t[1]] - centre, c = mesh.vertices[t[2]] - centre;
        const double own = weights.of(a, b, c, {});
        inertia.total += own;
        const double share = own / (weights.shell ? 12 : 20);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                products[static_cast<std::size_t>(i)][j] +=
                    share * (2 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j]) + a[i] * b[j] + a[j] * b[i] + a[i] * c[j] +
                             a[j] * c[i] + b[i] * c[j] + b[j] * c[i]);
            }
        }
    }
    const double trace = products[0].x + products[1].y + products[2].z;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            inertia.moments[static_cast<std::size_t>(i)][j] =
                (i == j ? trace : 0) - products[static_cast<std::size_t>(i)][j];
        }
    }
    return inertia;
}

/// Principal axes as columns, moments descending.
struct Axes {
    Pose pose;
    std::array<double, 3> moments{};
};

/// Returns R I Rᵀ of the transposed rotation: the matrix in the axes of `pose`.
Matrix in_axes(const Matrix& matrix, const Pose& pose) {
    const Pose inverse = pose.inverse();
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& row = inverse.rotation[i];
        for (int j = 0; j < 3; ++j) {
            const Vec3& other = inverse.rotation[static_cast<std::size_t>(j)];
            result[i][j] = dot(row, {dot(matrix[0], other), dot(matrix[1], other), dot(matrix[2], other)});
        }
    }
    return result;
}

/// Returns the turn of Jacobi's method that removes an entry; nothing if it is small already. `about`: the axis.
std::optional<Pose> jacobi_turn(const Matrix& m, int& about) {
    constexpr double small = 1e-12; // kEigEPS
    const double xy = std::abs(m[0].y), xz = std::abs(m[0].z), yz = std::abs(m[1].z);
    const auto [row, column, axis] = xy > xz && xy > yz ? std::array{0, 1, 2}
                                     : xz > yz          ? std::array{0, 2, 1}
                                                        : std::array{1, 2, 0};
    const double entry = m[static_cast<std::size_t>(row)][column];
    if (std::abs(entry) < small) {
        return {};
    }
    const double tau =
        (m[static_cast<std::size_t>(column)][column] - m[static_cast<std::size_t>(row)][row]) / (2 * entry);
    const double t = tau >= 0 ? 1 / (tau + std::sqrt(1 + tau * tau)) : -1 / (-tau + std::sqrt(1 + tau * tau));
    const double cosine = 1 / std::sqrt(1 + t * t);
    if (cosine == 1) {
        return {};
    }
    about = axis;
    double half_sine = (tau >= 0 ? -1 : 1) * std::sqrt(0.5 - 0.5 * cosine);
    half_sine = axis == 1 ? -half_sine : half_sine;
    std::array<double, 4> turn{std::sqrt(1 - half_sine * half_sine), 0, 0, 0};
    turn[static_cast<std::size_t>(axis) + 1] = half_sine;
    return from_quaternion({}, turn);
}

/// Returns the axes by Jacobi's method, with the steps and the order of MuJoCo: where moments are equal, the axes that
/// are left are the same.
Axes principal_axes(const Matrix& inertia) {
    constexpr double small = 1e-12;
    Axes axes;
    for (int step = 0; step < 500; ++step) {
        const Matrix m = in_axes(inertia, axes.pose);
        axes.moments = {m[0].x, m[1].y, m[2].z};
        int about = 0;
        const std::optional<Pose> turn = jacobi_turn(m, about);
        if (!turn) {
            break;
        }
        axes.pose = axes.pose * *turn;
    }
    for (const std::size_t first : {0, 1, 0}) {
        if (axes.moments[first] + small < axes.moments[first + 1]) {
            std::swap(axes.moments[first], axes.moments[first + 1]);
            std::array<double, 4> quarter{1, 0, 0, 0};
            quarter[(first + 2) % 3 + 1] = 1;
            axes.pose = axes.pose * from_quaternion({}, quarter);
        }
    }
    return axes;
}

/// Returns half the edges of the box with the same moments of inertia.
Vec3 box_of_inertia(const std::array<double, 3>& m, double total) {
    const auto half = [&](double sum) { return 0.5 * std::sqrt(std::max(0.0, 6 * sum / total)); };
    return {half(m[1] + m[2] - m[0]), half(m[0] + m[2] - m[1]), half(m[0] + m[1] - m[2])};
}

Element by_inertia(Element::Kind kind, const Vec3& box) {
    using Kind = Element::Kind;
    const double radius = (box.x + box.y) / 2;
    switch (kind) {
    case Kind::sphere:
        return Element::sphere((box.x + box.y + box.z) / 3);
    case Kind::capsule:
        return Element::capsule(radius, 2 * std::max(0.0, box.z - radius / 2));
    case Kind::cylinder:
        return Element::cylinder(radius, 2 * box.z);
    case Kind::ellipsoid:
        return Element::ellipsoid(box);
    default:
        return Element::box(box * 2);
    }
}

/// Returns the primitive about a box along the axes, by half its edges.
Element about_box(Element::Kind kind, const Vec3& half) {
    using Kind = Element::Kind;
    const double radius = std::max(half.x, half.y);
    switch (kind) {
    case Kind::sphere:
        return Element::sphere(std::max(radius, half.z));
    case Kind::capsule:
        return Element::capsule(radius, 2 * (half.z - radius));
    case Kind::cylinder:
        return Element::cylinder(radius, 2 * half.z);
    case Kind::ellipsoid:
        return Element::ellipsoid(half);
    default:
        return Element::box(half * 2);
    }
}

} // namespace

Element fitted(const Mesh& mesh, const Fit& fit) {
    const Weights weights{fit.inertia == "shell", fit.inertia == "legacy"};
    const Mesh hull = fit.inertia == "convex" ? convex_hull(mesh.vertices)->surface : Mesh{};
    const Mesh& weighed = fit.inertia == "convex" ? hull : mesh;
    const Vec3 centre = centre_of_mass(weighed, weights);
    const Inertia inertia = inertia_about(weighed, centre, weights);
    const Axes axes = principal_axes(inertia.moments);
    Pose frame = axes.pose;
    frame.translation = centre;
    Element element;
    if (fit.by_box) {
        const Pose inverse = frame.inverse();
        Box box;
        for (const Vec3& v : mesh.vertices) {
            box.add(inverse * v);
        }
        element = about_box(fit.kind, box.size() * 0.5);
        frame.translation = frame * box.center();
    } else {
        element = by_inertia(fit.kind, box_of_inertia(axes.moments, inertia.total));
    }
    element.half *= fit.scale;
    element.radius *= fit.scale;
    element.pose = frame;
    return element;
}

} // namespace foam::mjcf
