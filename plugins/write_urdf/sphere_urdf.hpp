// The robot's URDF text with spheres in place of its collision geometry: what the writers of this plugin share.
#pragma once

#include <foam/sdk/context.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/plugin.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/xml/document.hpp>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foam {

/// The words for what plain URDF lacks.
struct UrdfWords {
    std::string capsule{};           ///< "capsule" of URDF 1.1, Drake's "drake:capsule"; empty: a cylinder and spheres
    bool declares_convex = false;    ///< Drake: meshes are declared convex
    std::string properties{};        ///< elements that each <collision> gets besides
};

/// Returns the numbers with blanks between them, each with all its digits.
std::string three_numbers(const Vec3& v);

/// Returns the shape of an element that is centred at its origin: a sphere, box, cylinder or capsule.
std::string shape_text(const Element& element, const UrdfWords& words);

/// Returns the <collision> elements of a link's elements. `uri_of_hull`: the reference to the mesh of the next hull, as
/// text for an attribute.
std::vector<std::string> collision_elements(const LinkSpheres& link, const UrdfWords& words,
                                            const std::function<std::string()>& uri_of_hull);

/// Returns the elements of the <collision> children as another program computes them; meshes are looked up in `beside`,
/// others left out. A cylinder and spheres at its ends are one capsule. Throws Error(output) for numbers that are none.
Elements elements_of_collisions(const xml::Element& parent, const std::map<std::string, std::string>& beside);

/// The file name of a <mesh> or <texture>.
struct Reference {
    std::string path; ///< as written
    xml::Span span;   ///< of the attribute's value in the text
};

/// Returns all of them in the order of the text, except those in the <collision> elements of the links `replaced`.
std::vector<Reference> references_of(std::string_view text, const xml::Element& robot,
                                     const std::set<std::string>& replaced);

/// What becomes of references in another file, and what is reported of them.
struct MovedReferences {
    std::vector<Reference> moved; ///< with their new paths
    std::vector<std::pair<Severity, std::string>> messages;
};

/// Returns the references that change, as `mesh_paths` says: rewrite, keep, absolute or package.
MovedReferences moved_references(const std::vector<Reference>& references, const std::string& mesh_paths,
                                 const SphereModel& model);

/// Returns the reference to a file beside the one that is written, as `mesh_paths` says: relative, absolute or package.
/// `name`: relative to the folder of the written file. Logs where a package was asked for and there is none.
std::string uri_of_beside(const std::string& name, const std::string& mesh_paths, const SphereModel& model,
                          Context& context);

/// Returns the value for an attribute, in any quotes and in the encoding of the text.
std::string attribute_text(std::string_view value, std::string_view text);

/// A URDF text that is being changed.
class SphereUrdf {
public:
    /// A robot without URDF text gets one. Throws Error(output) if only the names of its links are known. `writer`: its name, for messages. The model must outlive it.
    SphereUrdf(const SphereModel& model, std::string writer);

    const std::string& writer() const { return writer_; }
    const SphereModel& model() const { return model_; }
    const xml::Element& root() const { return *root_; }
    xml::Editor& editor() { return editor_; }
    /// Returns the <link>. Throws Error(output) if there is none.
    const xml::Element& link(const std::string& name) const;
    /// Returns the <joint>. Throws Error(output) if there is none.
    const xml::Element& joint(const std::string& name) const;
    /// Returns the file and line of an element, for messages; the robot's name if it is of no file.
    std::string place_of(const xml::Element& element) const;
    /// Returns whether the link's collision geometry is replaced: by spheres, or by none.
    bool is_replaced(const std::string& name) const { return replaced_.contains(name); }
    /// Returns a text for an attribute, in any quotes and in the encoding of the text.
    std::string attribute_text(std::string_view value) const;

    /// Replaces collision geometry by elements of kinds that URDF knows, and removes that of
    /// SphereModel::without_collision. `mesh_paths`: how the meshes of hulls are referred to, as in move_references().
    void put_elements(const std::vector<LinkSpheres>& links, const UrdfWords& words, const std::string& mesh_paths,
                      Context& context);
    /// Changes paths of meshes and textures, as `mesh_paths` says: rewrite, keep, absolute or package.
    void move_references(const std::string& mesh_paths, Context& context);
    std::string result() { return editor_.result(); }

private:
    const xml::Element& element(const char* kind, const std::string& name) const;

    const SphereModel& model_;
    std::string writer_, text_;
    std::unique_ptr<const xml::Element> root_;
    std::map<std::pair<std::string, std::string>, const xml::Element*> elements_; ///< by kind and name
    std::set<std::string> replaced_;
    xml::Editor editor_;
};

/// Returns the name of the file that is written, or one after the robot where it is not known.
std::string file_name_of(const SphereModel& model);
/// Returns the elements by link, without links whose collision geometry has none. Throws Error(output).
std::map<std::string, Elements> elements_of_urdf(const std::string& bytes,
                                                             const std::map<std::string, std::string>& beside);

/// The parameter of the writers for move_references().
Parameter mesh_paths_parameter();

/// The links that get an <inertial> if they lack it.
enum class InertialOf {
    none,
    moving, ///< those between which and the root a joint moves
    all,    ///< Gazebo drops every link without
};

/// Adds the mass, centre and inertia of the original collision geometry at a density, kg/m³. Logs which links got one,
/// and which did not.
void add_inertials(SphereUrdf& urdf, InertialOf which, double density, Context& context);

// What Drake reads of a URDF beyond other programs: pairs of links that need no check, and properties of contact.
// Parsing: RobotLocomotion/drake 018bf81c12, multibody/parsing/detail_urdf_geometry.cc; 007f5fc932, detail_common.cc.

/// Declares Drake's namespace in the <robot>, if it is not there.
void declare_drake(SphereUrdf& urdf);
/// Adds a group for each link of an ignored pair, with the groups that it ignores.
void add_collision_filter_groups(SphereUrdf& urdf, Context& context);
/// Returns <drake:proximity_properties>; empty if both are 0.
std::string proximity_properties(double mu_static, double mesh_resolution_hint);

/// Turns locked joints, what mimics them, and planar and floating joints to fixed ones where they stand; continuous
/// joints to revolute ones from -π to π. Throws Error(output) for a joint that mimics one that is planned, and if no
/// joint is left to plan.
void fix_joints(SphereUrdf& urdf, Context& context);

/// Writes the collision elements of each link as a macro of xacro.
class XacroWriter final : public Writer {
public:
    explicit XacroWriter(const Parameters& parameters);
    std::string write(const SphereModel& model, Context& context) const override;
    std::map<std::string, Elements> read(const std::string& bytes, const std::map<std::string, std::string>& beside) const override;
    std::map<std::string, std::string> files_beside(const SphereModel& model, Context& context) const override;

private:
    int level_;
};

StageInfo info_of_xacro();

// Robots of VAMP: the sphere URDF, the SRDF and the job that cricket compiles to VAMP's code.
// Parsing: CoMMALab/cricket a2ad9d6db7 and 0a1eff2513, src/fkcc_gen.cc; output for KavrakiLab/vamp f6de6a72e0.

class VampWriter final : public Writer {
public:
    VampWriter(const Parameters& parameters, const StageMaker& maker);
    std::string write(const SphereModel& model, Context& context) const override;
    std::map<std::string, Elements> read(const std::string& bytes, const std::map<std::string, std::string>&) const override;
    std::string companion(const std::string& ending, const SphereModel& model, Context& context) const override;

private:
    std::string srdf(const SphereModel& model, Context& context) const;
    std::string job(const SphereModel& model) const;

    const Engine* engine_; ///< null: VAMP's rounding is not made up for
    std::string mesh_paths_, name_, templates_, language_;
    std::int64_t resolution_;
    std::unique_ptr<Writer> srdf_; ///< write.srdf; null if no plugin has it
};

StageInfo info_of_vamp();

} // namespace foam
