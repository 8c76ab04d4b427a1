// URDF: its elements as links, geometry and the model; what another parser thinks of it; spheres in it.
#pragma once

#include <foam/geometry/vector.hpp>
#include <foam/robot/robot.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/plugin.hpp>
#include <foam/xml/document.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam::urdf {

/// Reads elements of one file.
class Reader {
public:
    /// Makes a reader. `lenient`: a sphere model of another program may have spheres without size.
    explicit Reader(std::string label, bool lenient = false) : label_(std::move(label)), lenient_(lenient) {}

    const std::string& label() const { return label_; }
    /// Keeps a warning for report(): what other readers take, and the remedy.
    void warn(const xml::Element& element, const std::string& what) const { warn(element.line, what); }
    void warn(int line, const std::string& what) const;
    /// Logs the warnings, those with the same words as one.
    void report(Context& context) const;
    bool lenient() const { return lenient_; }
    /// Returns "file:line".
    std::string place(const xml::Element& element) const;
    /// Throws Error(input) "file:line: what".
    [[noreturn]] void fail(const xml::Element& element, const std::string& what) const { fail(element.line, what); }
    [[noreturn]] void fail(int line, const std::string& what) const;

    /// Returns the attribute's text. Fails if it is absent or empty.
    const std::string& required(const xml::Element& element, std::string_view attribute) const;
    /// Returns a finite number; nothing if the attribute is absent, or empty, with a warning. Fails if it is not one.
    std::optional<double> number(const xml::Element& element, std::string_view attribute) const;
    double required_number(const xml::Element& element, std::string_view attribute) const;
    /// Returns three finite numbers; nothing if the attribute is absent, or empty, with a warning. Of more the first
    /// three count, and commas may stand between them, with a warning. Fails on all else.
    std::optional<Vec3> vector(const xml::Element& element, std::string_view attribute) const;
    /// Returns the first child element of that name, with a warning if there are several; nullptr if there is none.
    const xml::Element* only_child(const xml::Element& element, std::string_view name) const;
    /// Returns the pose of the <origin> child; xyz and rpy are zero if absent.
    Pose origin(const xml::Element& element) const;

private:
    double parse(const xml::Element& element, std::string_view attribute, std::string_view text) const;
    /// Returns the attribute's text, of "$(optenv NAME DEFAULT)" the default, with a warning.
    std::string evaluated(const xml::Element& element, std::string_view attribute) const;
    bool is_empty(const xml::Element& element, std::string_view attribute) const;

    std::string label_;
    bool lenient_;
    mutable std::vector<std::pair<std::string, std::vector<int>>> warnings_; ///< with their lines
};

/// Returns whether the text has an expression that xacro has not replaced: "${...}" or "$(...)".
bool is_xacro_expression(std::string_view text);

/// Returns the text as UTF-8 if it is UTF-16 or UTF-32, with the declaration to match and a warning; else unchanged.
/// Fails if it is not valid.
std::string utf8_text(std::string_view text, const Reader& reader);
/// Returns the name of the root element of a text in any of these encodings; empty if it does not begin like XML.
std::string root_name_of(std::string_view text);

/// Returns the element with its pose and geometry; mesh paths are not resolved yet. Supports all shapes of the URDF
/// specification, and capsules (Bullet, Drake, MuJoCo: `length` without the caps). Returns nothing, with a warning, for
/// planes and for shapes without size. Fails on anything else, and on negative sizes.
std::optional<GeometryElement> read_geometry_element(const xml::Element& element, const Reader& reader);

/// Returns the materials of <robot> and of visuals, whose names others may use before them.
std::map<std::string, Material> materials_by_name(const xml::Element& root);
/// Returns the link; a visual that cannot be read is left out with a warning.
Link read_link(const xml::Element& element, const std::map<std::string, Material>& materials, const Reader& reader,
               Context& context);

/// Returns the links and joints of <robot>, checked to be one tree; mesh paths are not resolved yet. `name`: for a
/// robot without one.
Robot read_robot(const xml::Element& root, const std::string& name, const Reader& reader, Context& context);

/// Returns urdfdom's messages on links, joints and inertias; empty if it accepts the model. It does not get the
/// geometry: it does not support capsules and refuses geometry that foam reads, and foam checks geometry itself.
std::vector<std::string> complaints_of_urdfdom(std::string_view text, const xml::Element& root);

class SphereReader final : public ModelReader {
public:
    SphereReader(const Parameters& parameters, const StageMaker& maker);
    bool recognises(std::string_view text) const override;
    SphereFile read(const std::string& text, const std::filesystem::path& file, Context& context) const override;

private:
    void read_link(const Link& link, SphereFile& result, Context& context) const;
    std::optional<Element> read_hull(const MeshReference& mesh, std::string& why, Context& context) const;

    std::unique_ptr<RobotLoader> loader_;
    std::unique_ptr<MeshLoader> meshes_; ///< null if no plugin has it
};

} // namespace foam::urdf
