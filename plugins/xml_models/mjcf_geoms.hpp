// The geoms of an MJCF file with the attributes that default classes give them.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/xml/document.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam::xml_models {

struct MjcfGeom {
    const xml::Element* geom = nullptr;
    const xml::Element* body = nullptr; ///< or the <worldbody>
    /// The element that states each attribute: itself or the <geom> of a class.
    std::map<std::string, const xml::Element*, std::less<>> stated;

    /// Returns the text of an attribute; nullptr if it is stated nowhere.
    const std::string* text(std::string_view attribute) const;
    /// Whether it is a sphere: a geom without type is one, unless a mesh says otherwise.
    bool sphere() const;
    bool collides() const; ///< contype or conaffinity is not 0
};

/// Returns the geoms in the order of the file. Throws Error(input) for a default class that does not exist.
std::vector<MjcfGeom> geoms_of(const xml::Element& root, const std::string& file);

/// Returns the name of a body: "world" for the <worldbody>, "" for one without a name.
std::string name_of_body(const xml::Element& body);

/// Makes elements of geoms as MuJoCo's compiler does.
class MjcfElements {
public:
    /// Throws Error(input) for settings of the compiler that are no numbers.
    MjcfElements(const xml::Element& root, const std::filesystem::path& file);
    /// Returns the element of a geom; nothing with a reason for what is no convex element. Of meshes MuJoCo takes the
    /// convex hull. Throws Error(input) naming file and line.
    std::optional<Element> element_of(const MjcfGeom& geom, std::string& why) const;

private:
    std::vector<double> numbers(const MjcfGeom& geom, std::string_view attribute, std::size_t least) const;
    Pose pose_of(const MjcfGeom& geom) const;
    std::optional<Element> between(const MjcfGeom& geom, Element element) const;
    std::optional<Element> hull_of_mesh(const std::string& name, std::string& why) const;

    std::filesystem::path file_;
    std::map<std::string, const xml::Element*> meshes_;
    bool degrees_ = true;
    std::string eulerseq_ = "xyz", mesh_folder_;
};

} // namespace foam::xml_models
