#include <foam/geometry/internal/likeness.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <unordered_map>
#include <utility>

namespace foam::inline geometry {
namespace {

/// Returns points that an image of the primitive has images of: its middle, and ends of its axes of symmetry.
std::vector<Vec3> landmarks(const Element& primitive) {
    if (primitive.kind == Element::Kind::hull) {
        std::vector<Vec3> points = primitive.hull->surface.vertices;
        for (Vec3& point : points) {
            point = primitive.pose * point;
        }
        return points;
    }
    std::vector<Vec3> points{primitive.pose.translation};
    const bool round = primitive.kind == Element::Kind::sphere || primitive.kind == Element::Kind::capsule ||
                       primitive.kind == Element::Kind::cylinder;
    for (int axis = primitive.kind == Element::Kind::sphere ? 3 : round ? 2 : 0; axis < 3; ++axis) {
        Vec3 end;
        end[axis] = primitive.half[axis];
        points.push_back(primitive.pose * end);
        points.push_back(primitive.pose * -end);
    }
    return points;
}

/// Returns whether two primitives are equal but for their pose, which landmarks tell, and the order of a box's axes.
bool same_size(const Element& a, const Element& b, double tolerance) {
    const auto sorted = [](const Vec3& half) {
        std::array<double, 3> lengths{half.x, half.y, half.z};
        std::sort(lengths.begin(), lengths.end());
        return lengths;
    };
    const auto first = sorted(a.half), second = sorted(b.half);
    const bool corners =
        !a.hull || !b.hull || a.hull->surface.vertices.size() == b.hull->surface.vertices.size();
    return a.kind == b.kind && corners && std::abs(a.radius - b.radius) <= tolerance &&
           std::equal(first.begin(), first.end(), second.begin(),
                      [&](double x, double y) { return std::abs(x - y) <= tolerance; });
}

/// The landmarks of a form's parts, one after another.
struct Landmarks {
    std::vector<Vec3> points;
    std::vector<std::size_t> begins; ///< of each part
    Vec3 middle;
    double diagonal = 0;

    explicit Landmarks(const Form& form) {
        Box box;
        for (const FormPart& part : form) {
            begins.push_back(points.size());
            const std::vector<Vec3> own = part.mesh ? std::vector<Vec3>{} : landmarks(part.primitive);
            for (const Vec3& point : part.mesh ? part.mesh->vertices : own) {
                points.push_back(part.pose * point);
                middle += points.back();
                box.add(points.back());
            }
        }
        begins.push_back(points.size());
        middle = points.empty() ? Vec3{} : middle / static_cast<double>(points.size());
        diagonal = box.diagonal();
        for (const FormPart& part : form) { // a sphere alone has one landmark
            diagonal = std::max(diagonal, part.mesh ? 0 : part.primitive.radius);
        }
    }
};

/// Finds the points of a set near another point. Points within the tolerance of each other count as one.
class PointIndex {
public:
    PointIndex(const Landmarks& of, double tolerance) : points_(of.points), tolerance_(tolerance) {
        for (std::size_t part = 0; part + 1 < of.begins.size(); ++part) {
            for (std::size_t i = of.begins[part]; i < of.begins[part + 1]; ++i) {
                first_.push_back(static_cast<std::uint32_t>(i));
                if (const std::optional<std::uint32_t> known = near(points_[i], part)) {
                    first_[i] = *known;
                } else {
                    cells_.emplace(key(points_[i], part, 0), static_cast<std::uint32_t>(i));
                }
            }
        }
    }
    /// Returns the first point of a part that is near.
    std::optional<std::uint32_t> near(const Vec3& point, std::size_t part) const {
        for (int corner = 0; corner < 8; ++corner) {
            const auto [begin, end] = cells_.equal_range(key(point, part, corner));
            for (auto it = begin; it != end; ++it) {
                if (squared_norm(points_[it->second] - point) <= tolerance_ * tolerance_) {
                    return it->second;
                }
            }
        }
        return {};
    }
    std::uint32_t first(std::size_t i) const { return first_[i]; }

private:
    /// Returns the key of the point's cell, or of one of the seven beside it that reach within the tolerance.
    std::uint64_t key(const Vec3& point, std::size_t part, int corner) const {
        const double edge = 4 * tolerance_;
        std::uint64_t hash = part;
        for (int axis = 0; axis < 3; ++axis) {
            const double at = point[axis] / edge, cell = std::floor(at);
            const double beside = at - cell < 0.5 ? cell - 1 : cell + 1;
            const auto number = static_cast<std::int64_t>((corner >> axis & 1) != 0 ? beside : cell);
            hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 32;
        }
        return hash;
    }

    const std::vector<Vec3>& points_;
    double tolerance_;
    std::vector<std::uint32_t> first_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

/// Returns the index in the image of each landmark; empty if one has none.
std::vector<std::uint32_t> images_of(const Landmarks& landmarks, const Likeness& likeness, const PointIndex& index) {
    std::vector<std::uint32_t> images;
    for (std::size_t part = 0; part + 1 < landmarks.begins.size(); ++part) {
        for (std::size_t i = landmarks.begins[part]; i < landmarks.begins[part + 1]; ++i) {
            const std::optional<std::uint32_t> found = index.near(likeness * landmarks.points[i], part);
            if (!found) {
                return {};
            }
            images.push_back(*found);
        }
    }
    return images;
}

/// Returns the triangles of a form by the landmarks at their corners, in order; the sense does not count.
template <class Corner> std::vector<Triangle> triangles_of(const Form& form, const Landmarks& marks, Corner corner) {
    std::vector<Triangle> triangles;
    for (std::size_t part = 0; part < form.size(); ++part) {
        if (!form[part].mesh) {
            continue;
        }
        for (Triangle triangle : form[part].mesh->triangles) {
            for (std::uint32_t& at : triangle) {
                at = corner(marks.begins[part] + at);
            }
            std::sort(triangle.begin(), triangle.end());
            triangles.push_back(triangle);
        }
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

/// Returns whether the forms have as many parts, vertices and triangles, and primitives where the other has them. Most
/// forms differ in these, which takes no look at the points.
bool same_counts(const Form& of, const Form& image) {
    return std::equal(of.begin(), of.end(), image.begin(), image.end(), [](const FormPart& a, const FormPart& b) {
        if (!a.mesh || !b.mesh) {
            return !a.mesh && !b.mesh;
        }
        return a.mesh->vertices.size() == b.mesh->vertices.size() &&
               a.mesh->triangles.size() == b.mesh->triangles.size();
    });
}

/// Returns whether the primitives have the same sizes. Precondition: same_counts().
bool same_sizes(const Form& of, const Form& image, double tolerance) {
    return std::equal(of.begin(), of.end(), image.begin(), [&](const FormPart& a, const FormPart& b) {
        return a.mesh || same_size(a.primitive, b.primitive, tolerance);
    });
}

/// Returns the 24 rotations that map axes to axes, the identity first.
std::vector<Pose> turns_of_axes() {
    std::vector<Pose> turns;
    constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
    for (const std::array<int, 3>& order : orders) {
        for (int signs = 0; signs < 8; ++signs) {
            Pose turn;
            for (int row = 0; row < 3; ++row) {
                Vec3 axis;
                axis[order[static_cast<std::size_t>(row)]] = (signs >> row & 1) != 0 ? -1 : 1;
                turn.rotation[static_cast<std::size_t>(row)] = axis;
            }
            if (dot(cross(turn.rotation[0], turn.rotation[1]), turn.rotation[2]) > 0) {
                turns.push_back(turn);
            }
        }
    }
    return turns;
}

/// Returns the element reflected at the origin. All kinds but the hull are symmetric about their middle.
Element reflected(Element element) {
    element.pose.translation = -element.pose.translation;
    if (element.hull) {
        Polytope other = *element.hull;
        for (Vec3& vertex : other.surface.vertices) {
            vertex = -vertex;
        }
        for (Triangle& triangle : other.surface.triangles) {
            std::swap(triangle[1], triangle[2]);
        }
        for (Polytope::Face& face : other.faces) {
            face.normal = -face.normal;
        }
        element.hull = std::make_shared<const Polytope>(std::move(other));
    }
    return element;
}

} // namespace

Elements imaged(Elements elements, const Likeness& likeness) {
    if (likeness.mirrored) {
        for (Sphere& sphere : elements.spheres()) {
            sphere.center = -sphere.center;
        }
        for (Element& element : elements.shaped()) {
            element = reflected(std::move(element));
        }
    }
    return moved(std::move(elements), likeness.pose);
}

std::optional<Likeness> likeness(const Form& of, const Form& image) {
    constexpr double share = 2e-6; // single precision, some decimals of a text format
    if (!same_counts(of, image)) {
        return {};
    }
    const Landmarks marks(of), images(image);
    const double tolerance = share * images.diagonal;
    if (!(tolerance > 0) || !same_sizes(of, image, tolerance)) {
        return {};
    }
    const PointIndex index(images, tolerance);
    const std::vector<Triangle> wanted =
        triangles_of(image, images, [&](std::size_t i) { return index.first(i); });
    for (const bool mirrored : {false, true}) {
        for (Pose turn : turns_of_axes()) {
            turn.translation = images.middle - turn.rotate(mirrored ? -marks.middle : marks.middle);
            const Likeness found{turn, mirrored};
            const std::vector<std::uint32_t> at = images_of(marks, found, index);
            if (!at.empty() && triangles_of(of, marks, [&](std::size_t i) { return at[i]; }) == wanted) {
                return found;
            }
        }
    }
    return {};
}

} // namespace foam::inline geometry
