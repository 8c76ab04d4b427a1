// The robot's URDF text with spheres in place of its collision geometry: what the writers of this plugin share.
#pragma once

#include "shapes.hpp"

#include <foam/sdk/stage.hpp>
#include <foam/xml/editor.hpp>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace foam {

/// A URDF text that is being changed.
class SphereUrdf {
public:
    /// A robot without URDF text gets one. Throws Error(output) if only the names of its links are known. `writer`: its
    /// name, for messages. The model must outlive it.
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

} // namespace foam
