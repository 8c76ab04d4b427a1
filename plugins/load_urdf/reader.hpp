// Typed access to the attributes of URDF elements; every complaint names file and line.
#pragma once

#include <foam/vector.hpp>
#include <xml/document.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace foam::urdf {

/// Reads elements of one file.
class Reader {
public:
    /// `lenient`: a sphere model of another program may hold spheres without size, and meshes that are not here.
    explicit Reader(std::string label, bool lenient = false) : label_(std::move(label)), lenient_(lenient) {}

    const std::string& label() const { return label_; }
    bool lenient() const { return lenient_; }
    /// "file:line"
    std::string place(const xml::Element& element) const;
    /// Throws Error(input) "file:line: what".
    [[noreturn]] void fail(const xml::Element& element, const std::string& what) const;

    /// The attribute's text; fails if it is absent or empty.
    const std::string& required(const xml::Element& element, std::string_view attribute) const;
    /// A finite number. Fails if the attribute is there but is none; nothing if it is absent.
    std::optional<double> number(const xml::Element& element, std::string_view attribute) const;
    double required_number(const xml::Element& element, std::string_view attribute) const;
    /// Three finite numbers.
    std::optional<Vec3> vector(const xml::Element& element, std::string_view attribute) const;
    /// The only child element of that name, nullptr if there is none; fails if there are several.
    const xml::Element* only_child(const xml::Element& element, std::string_view name) const;
    /// The pose of the <origin> child; xyz and rpy are zero if absent.
    Pose origin(const xml::Element& element) const;

private:
    double parse(const xml::Element& element, std::string_view attribute, std::string_view text) const;

    std::string label_;
    bool lenient_;
};

/// Whether the text holds an expression that xacro has not replaced: "${...}" or "$(...)".
bool is_xacro_expression(std::string_view text);

} // namespace foam::urdf
