// Elements of all kinds in the files of writers and readers.
#pragma once

#include <foam/sdk/model.hpp>
#include <foam/sdk/stage.hpp>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// Returns the elements of links in the order of their first groups, as spheres_by_link() does. Throws Error(output) for a group without elements, and for an
/// element that no reader accepts.
std::vector<LinkSpheres> elements_by_link(const SphereModel& model, int level = -1);

/// Returns the link of a file; adds it at the end if it is missing.
LinkSpheres& link_of(SphereFile& file, const std::string& link);
/// Returns the elements of a file by link, as Writer::read() does.
std::map<std::string, Elements> elements_of(SphereFile file);

/// Returns the text of an edited file in which the line of provenance that foam wrote into the user's file is that of the
/// model: an old one says what was proved of other elements. Other comments stay, as do files without such a line.
std::string with_provenance(std::string text, const SphereModel& model);

struct Engine;

/// The words of a format that does not know all kinds. What it does not know becomes other elements, which contain it.
struct KnownKinds {
    bool capsules = true;    ///< else a cylinder and two spheres each
    bool ellipsoids = false; ///< else a hull each
    /// Whether meshes are rounded to single precision, as most programs read them: hulls become float32_hull().
    bool float32_hulls = true;
    int segments = 8; ///< around a circle, where a swept box or an ellipsoid becomes a hull
    const Engine* engine = nullptr; ///< that the file is for; null: any
};
/// Returns the links with elements that the format knows: spheres, capsules, cylinders, boxes, hulls, and ellipsoids if
/// it knows them. A swept box that is nearly a box becomes a box, a capsule that is nearly a sphere a sphere. Then those
/// for an engine are made as it needs them: stated_for().
std::vector<LinkSpheres> in_known_kinds(std::vector<LinkSpheres> links, const KnownKinds& known = {});

/// Returns the least number of elements that a file holds for these: a cylinder and two spheres may be one capsule.
std::size_t least_count(const Elements& elements);

/// The parameter of writers for KnownKinds::segments.
Parameter segments_parameter();
/// Returns its value. Throws Error(usage) for no multiple of 4. `writer`: its name, for the message.
int segments_of(const Parameters& parameters, std::string_view writer);

/// Numbers of an element by name, for formats that state an element in full: "position" (3), "rotation" (9, row-major;
/// absent: none), "length" (1: capsules and cylinders along z, without caps), "size" (3: edges of the box), "radius"
/// (1), "radii" (3: half axes), "vertices" (3 each).
using ElementNumbers = std::vector<std::pair<std::string, std::vector<double>>>;
ElementNumbers numbers_of(const Element& element);
/// Returns the element. Throws Error(input) for names that are missing or that the kind does not have, other counts,
/// and numbers of no valid element.
Element element_of(std::string_view kind, const ElementNumbers& numbers);

/// Returns the OBJ text of a mesh: `v` and `f` lines, numbers that read back to the same doubles.
std::string obj_text(const Mesh& mesh);
/// Returns the corners of an OBJ text of such lines, or of a binary or ASCII STL: what a hull needs. Throws
/// Error(input) with the reason, without the file.
std::vector<Vec3> corners_of(std::string_view bytes);
/// Returns the hull of a mesh file. Throws Error(input) if its corners lie in a plane.
Element hull_of(std::string_view bytes);

/// Names the mesh files of hulls beside a written file: "arm_hulls/forearm_2.obj". Letters, digits, '.', '_' and '-' of
/// link names stay; names differ by more than case.
class HullNames {
public:
    /// `file`: name of the written file, without folder.
    explicit HullNames(const std::string& file);
    /// Returns the name of the next hull of a link.
    std::string next(const std::string& link);

private:
    std::string folder_;
    std::map<std::string, int> uses_;
};

/// Returns the OBJ files of the hulls of links, by their names relative to the written file, named as HullNames does in
/// the order of the links. `file`: name of the written file, without folder.
std::map<std::string, std::string> hull_files(const std::vector<LinkSpheres>& links, const std::string& file);
/// Returns the text of the file beside a written one that a reference leads to: a relative path, or the end of another
/// one; nullptr if there is none.
const std::string* text_beside(const std::map<std::string, std::string>& beside, std::string_view reference);

} // namespace sdk
} // namespace foam
