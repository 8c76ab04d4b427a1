// Typed access to the attributes of URDF elements. Every error has file and line.
#pragma once

#include <foam/geometry/vector.hpp>

#include <foam/xml/document.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace foam::urdf {

/// Reads elements of one file.
class Reader {
public:
    /// Makes a reader. `lenient`: a sphere model of another program may have spheres without size, and missing meshes.
    explicit Reader(std::string label, bool lenient = false) : label_(std::move(label)), lenient_(lenient) {}

    const std::string& label() const { return label_; }
    bool lenient() const { return lenient_; }
    /// Returns "file:line".
    std::string place(const xml::Element& element) const;
    /// Throws Error(input) "file:line: what".
    [[noreturn]] void fail(const xml::Element& element, const std::string& what) const;

    /// Returns the attribute's text. Fails if it is absent or empty.
    const std::string& required(const xml::Element& element, std::string_view attribute) const;
    /// Returns a finite number; nothing if the attribute is absent. Fails if it is not one.
    std::optional<double> number(const xml::Element& element, std::string_view attribute) const;
    double required_number(const xml::Element& element, std::string_view attribute) const;
    /// Returns three finite numbers.
    std::optional<Vec3> vector(const xml::Element& element, std::string_view attribute) const;
    /// Returns the only child element of that name, nullptr if there is none. Fails if there are several.
    const xml::Element* only_child(const xml::Element& element, std::string_view name) const;
    /// Returns the pose of the <origin> child; xyz and rpy are zero if absent.
    Pose origin(const xml::Element& element) const;

private:
    double parse(const xml::Element& element, std::string_view attribute, std::string_view text) const;

    std::string label_;
    bool lenient_;
};

/// Returns whether the text has an expression that xacro has not replaced: "${...}" or "$(...)".
bool is_xacro_expression(std::string_view text);

} // namespace foam::urdf
