// Models in XML: MJCF with its geoms and edits, SRDF.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/plugin.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/sdk/writing.hpp>
#include <foam/xml/document.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace foam::xml_models {

/// Returns the numbers with blanks between them; each reads back to the same double.
std::string numbers_text(std::span<const double> numbers);
std::string vector_text(const Vec3& v);
/// Returns ` name="value"`, escaped.
std::string attribute_text(std::string_view name, std::string_view value);

/// Returns the numbers of an attribute. Throws Error(input) naming file and line if it is absent or holds something
/// else; `count`: their number, 0 for any number but none.
std::vector<double> numbers_of(const xml::Element& element, std::string_view attribute, std::size_t count,
                               const std::string& file);
/// Returns an attribute's text. Throws Error(input) if it is absent.
const std::string& required(const xml::Element& element, std::string_view attribute, const std::string& file);

/// Returns a comment line with the text; empty for an empty text.
std::string comment_text(std::string_view text);

/// Writes geoms, and the mesh assets of their hulls.
class MjcfShapes {
public:
    /// `first`: number of the first mesh, whose name is "foam_hull_FIRST". `own`: attributes of each mesh.
    explicit MjcfShapes(std::size_t first = 1, std::string own = "") : next_(first), own_(std::move(own)) {}

    /// Returns ` type=… size=… pos=… quat=…`, the attributes of the geom of an element of a kind that MJCF knows.
    std::string attributes(const Element& element);
    /// Returns the `<mesh …/>` of the hulls so far. Their corners stand in the file: there is no other file to lose.
    const std::vector<std::string>& meshes() const { return meshes_; }

private:
    std::size_t next_;
    std::string own_;
    std::vector<std::string> meshes_;
};

/// What a name of a mesh of foam begins with.
constexpr const char* hull_prefix = "foam_hull_";

struct MjcfGeom {
    const xml::Element* geom = nullptr;
    const xml::Element* body = nullptr; ///< or the <worldbody>
    /// The element that states each attribute: itself or the <geom> of a class.
    std::map<std::string, const xml::Element*, std::less<>> stated{};
    std::vector<const xml::Element*> frames{}; ///< the <frame> elements between the body and the geom
    std::string inherited{};                   ///< the class that holds without `class`
    bool replicated = false;                   ///< it stands in a <replicate>
    bool paired = false;                       ///< a <pair> names it

    /// Returns the text of an attribute; nullptr if it is stated nowhere.
    const std::string* text(std::string_view attribute) const;
    /// Whether it is a sphere: a geom without type is one, unless a mesh says otherwise.
    bool sphere() const;
    bool has_contact() const; ///< contype or conaffinity is not 0
    bool collides() const;    ///< it has contact, or a <pair> names it
    bool is_ground() const;   ///< a plane or a height field, which no elements cover
};

/// Returns the geoms in the order of the file, without those of bodies that <replicate> copies. Throws Error(input) for
/// a default class that does not exist.
std::vector<MjcfGeom> geoms_of(const xml::Element& root, const std::string& file);

/// Returns the bodies by the names of their links: "world" for each <worldbody>, "body_N" for one without a name, where
/// N is its number in MuJoCo. Those that <replicate> copies are left out.
std::multimap<std::string, const xml::Element*> bodies_of(const xml::Element& root);

/// Returns the MJCF with the files that it includes in place of their <include>, where they hold geoms, name them, or
/// have an effect on them: bodies, classes and <compiler>. Others stay included. Throws Error(input) for one that is not
/// found.
std::string with_included(const TextFile& file);

/// Puts the folder of the input, as seen from that of the output, before the paths of an MJCF: `from_output`.
void move_paths(xml::Editor& editor, const xml::Element& root, const std::string& from_output);

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
    /// Returns the element in the frame of the innermost <frame> around the geom.
    std::optional<Element> element_in_frame(const MjcfGeom& geom, std::string& why) const;
    Pose pose_in_frame(const MjcfGeom& geom) const;
    /// Returns the pose of that frame in the body's.
    Pose frame_of(const MjcfGeom& geom) const;
    std::optional<Element> between(const MjcfGeom& geom, Element element) const;
    std::optional<Element> hull_of_mesh(const std::string& name, std::string& why) const;

    std::filesystem::path file_;
    std::map<std::string, const xml::Element*> meshes_;
    bool degrees_ = true;
    std::string eulerseq_ = "xyz", mesh_folder_;
};

/// The geoms that have the place of a named one.
struct GeomsInPlace {
    std::vector<std::string> names{};
    bool with_others = false; ///< they replace other geoms of its body as well
};
using ReplacedGeoms = std::map<std::string, GeomsInPlace>; ///< by the name that goes

/// Returns the names of the geoms that a <pair> states.
std::set<std::string> names_in_pairs(const xml::Element& root);

/// Repeats each <pair> of a replaced geom for those in its place. Throws Error(input) if a sensor <contact> names one.
void put_pairs_of_replaced(xml::Editor& editor, const xml::Element& root, const ReplacedGeoms& replaced,
                           const std::string& file, Context& context);

struct MjcfReplacement {
    bool all_collision = false;                         ///< also other geoms with contact than spheres
    PairEdit pairs = PairEdit::keep;                    ///< what happens to the <exclude> elements
    std::optional<std::vector<IgnoredPair>> found = {}; ///< SphereModel::ignored_pairs
    std::vector<std::string> emptied = {};              ///< links whose geoms with contact go without elements
    std::filesystem::path folder = {};                  ///< of the file that is written; empty: paths stay
};

/// Returns the file with the spheres of the bodies called like the links replaced; every other byte stays. New geoms
/// take over the class and the settings of contact of the first one that they replace. A <pair> is repeated for each.
/// Geoms that give their body its mass, or that others than <pair> name, stay without contact. Throws Error(input) if the
/// file is not MJCF or lacks a body.
std::string with_spheres(const TextFile& into, const std::vector<LinkSpheres>& links, const MjcfReplacement& what,
                         Context& context);

/// Returns ` <exclude body1=… body2=…/>` of a pair, without the blank.
std::string exclude_text(const IgnoredPair& pair);

/// What moves the joints of a file that is written whole. The words in the parameter are those of the enumeration.
enum class Actuators { none, position, velocity, motor };
Actuators actuators_named(const std::string& word);

class MjcfWriter final : public Writer {
public:
    MjcfWriter(const Parameters& parameters, const StageMaker& maker);
    ~MjcfWriter() override;
    std::string write(const SphereModel& model, Context& context) const override;
    std::map<std::string, Elements> read(const std::string& bytes,
                                         const std::map<std::string, std::string>& beside) const override;
    std::map<std::string, std::string> files_beside(const SphereModel& model, Context& context) const override;

private:
    /// Returns the text of a robot that was read from no MJCF.
    std::string whole_text(const SphereModel& model, Context& context) const;

    KnownKinds known_;
    bool free_;
    double density_;          ///< kg/m³
    bool replaces_collision_; ///< in a file of the user
    PairEdit pairs_;          ///< in a file of the user
    bool visuals_;
    Actuators actuators_;
    std::unique_ptr<MeshLoader> meshes_; ///< null if no plugin has it
};

class MjcfReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override;
    SphereFile read(const std::string& text, const std::filesystem::path& file, Context& context) const override;
};

class SrdfWriter final : public Writer {
public:
    explicit SrdfWriter(const Parameters& parameters);
    std::string write(const SphereModel& model, Context& context) const override;
    std::map<std::string, Elements> read(const std::string& bytes,
                                         const std::map<std::string, std::string>&) const override;

private:
    PairEdit pairs_; ///< in a file of the user
};

class SrdfReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override;
    SphereFile read(const std::string& text, const std::filesystem::path& file, Context& context) const override;
};

} // namespace foam::xml_models
