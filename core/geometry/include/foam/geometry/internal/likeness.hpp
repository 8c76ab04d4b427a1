// Geometry that is the same at another place, or the mirror image of another.
#pragma once

#include <foam/geometry/elements.hpp>

#include <optional>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A rotation and a translation, after a reflection at the origin where `mirrored`. Any mirror image is one of these.
struct Likeness {
    Pose pose;
    bool mirrored = false;

    Vec3 operator*(const Vec3& p) const { return pose * (mirrored ? -p : p); }
    bool operator==(const Likeness&) const = default;
};

/// Returns the image of elements: of the same kinds and sizes.
Elements imaged(Elements elements, const Likeness& likeness);

/// A mesh or a primitive of a form, at its pose in the form's frame.
struct FormPart {
    const Mesh* mesh = nullptr; ///< null: a primitive
    Element primitive{};
    Pose pose;
};
using Form = std::vector<FormPart>;

/// Returns how a form is the image of another: each vertex and end of a primitive has its image within 2e-6 of the
/// form's diagonal, and triangles have triangles as images. Parts are compared in order. Tries the 48 rotations and
/// reflections that map axes of the frame to axes, with a translation: mirrored links of a robot have such frames.
/// Nothing: none of these. O(n) for each that is tried, most end at the first vertex.
std::optional<Likeness> likeness(const Form& of, const Form& image);

} // namespace geometry
} // namespace foam
