// A tree of values that becomes YAML: what is known of the robot, how it is written.
#pragma once

#include <foam/sdk/context.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/sdk/writing.hpp>
#include <foam/yaml/value.hpp>
#include <foam/yaml/write.hpp>

#include <string>
#include <string_view>

namespace foam::tree {

// Links with lists of spheres in a tree of values. The formats differ in the place of these lists and in the form of a
// sphere.

/// Returns the tree of a YAML or JSON text. Throws Error(input) with the place.
yaml::Value parse(const std::string& text, const std::filesystem::path& file);

/// Fills a SphereFile from values of the tree. All functions throw Error(input) with the place of the value.
class Tree {
public:
    explicit Tree(SphereFile& file) : result(file) {}

    [[noreturn]] void fail(const yaml::Value& at, const std::string& why) const;
    /// Returns the value of a key of a map.
    const yaml::Value& at(const yaml::Value& map, std::string_view key) const;
    /// Returns `value`, which must be a list. `what`: "a list of centers".
    const yaml::Value& list(const yaml::Value& value, std::string_view what) const;
    template <class Body> void for_each(const yaml::Value& map, Body&& body) const {
        require_map(map);
        for (std::size_t i = 0; i < map.keys.size(); ++i) {
            body(map.keys[i].text, map.items[i]);
        }
    }
    /// Adds a list of spheres: `[x, y, z, r]`, `{center, radius}` or `{origin, radius}`.
    void add(const std::string& link, const yaml::Value& spheres);
    /// Adds elements of write.json: `{kind, position, …}`.
    void add_elements(const std::string& link, const yaml::Value& elements);
    /// Adds `{centers: [[x, y, z]], radii: [r]}`.
    void add_columns(const std::string& link, const yaml::Value& value);
    /// Reads a distance that the program which uses the file adds to all radii, or to those of each link. Call it after the
    /// spheres are added.
    void read_buffer(const yaml::Value& holder, std::string_view key);
    /// Adds a note about a distance that the program adds to radii only between links. Call it after the spheres are added.
    void note_self_buffer(const yaml::Value& holder, std::string_view key);

    SphereFile& result;

private:
    void require_map(const yaml::Value& value) const;
    double number(const yaml::Value& value) const;
    double buffer_of(const yaml::Value& buffer, const std::string& link) const;
    void append_numbers(const yaml::Value& value, std::vector<double>& numbers) const;
    Vec3 point(const yaml::Value& value) const;
    Sphere sphere(const yaml::Value& value) const;
};

/// Reads the JSON of write.json.
void read_foam_json(const yaml::Value& root, Tree& tree);
/// Reads XRDF 1.0 (`collision`) and 2.0 (`world_collision`),
/// https://nvidia-isaac-ros.github.io/concepts/manipulation/xrdf.html
void read_xrdf(const yaml::Value& root, Tree& tree);
/// Reads a robot file of cuRobo, whose spheres are in `kinematics`.
void read_curobo(const yaml::Value& root, Tree& tree);
/// Reads `collision_spheres` of bubblify and cuRobo's sphere files: a map of lists; plainmp: a map of maps; Lula: a
/// list of maps.
void read_collision_spheres(const yaml::Value& root, Tree& tree);
/// Reads `{centers, radii}` for a single body (MorphIt), or by link (ballpark, pyroki).
void read_columns(const yaml::Value& root, Tree& tree);
/// Reads `spheres: {link: […]}`.
void read_spheres_by_link(const yaml::Value& root, Tree& tree);
/// Reads the output of CoMMALab/foam (Coumar et al. 2025): a list by depth for a mesh, a database for a robot.
void read_commalab(const yaml::Value& root, Tree& tree);

/// Returns {link: [{center: [x, y, z], radius: r}, …]}.
yaml::Value spheres_of_links(const std::vector<LinkSpheres>& links);
/// Returns {link: [other, …]} with each pair once, under its first link.
yaml::Value ignored_links(const std::vector<IgnoredPair>& pairs);
/// Returns the names of joints.
yaml::Value names_of(const PlannedJoints::Positions& joints);
/// Returns the positions of joints.
yaml::Value positions_of(const PlannedJoints::Positions& joints);
/// Returns {joint: position}.
yaml::Value map_of(const PlannedJoints::Positions& joints);
/// Returns a list with the same number for each joint.
yaml::Value repeated(double value, std::size_t count);

/// Returns the robot's URDF as a program finds it: its absolute path; without a folder the name of the file. For a robot
/// of no file the URDF is expected beside the file that is written. Logs a URDF that is not there.
std::string urdf_path(const SphereModel& model, Context& context);

/// Throws Error(output) for a link with spheres that is not below the base link: a program would not find it.
void require_below_base(const SphereModel& model, const std::vector<LinkSpheres>& links, const std::string& writer);

/// Writes a tree of values, as a whole file or into a file of the user, and reads it back by the reader of the format.
class TreeWriter : public Writer {
public:
    using Reading = void (*)(const yaml::Value&, Tree&);

    TreeWriter(std::string name, Reading reading) : name_(std::move(name)), reading_(reading) {}

    std::string write(const SphereModel& model, Context& context) const override;
    std::map<std::string, Elements> read(const std::string& bytes, const std::map<std::string, std::string>&) const override;

protected:
    /// Returns the whole file.
    virtual yaml::Value document(const SphereModel& model, const std::vector<LinkSpheres>& links,
                                 Context& context) const = 0;
    /// Replaces the spheres of a file of the user.
    virtual void edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
                      Context& context) const;
    /// Returns the text of a whole file.
    virtual std::string text_of(const yaml::Value& document, const SphereModel& model) const;
    const std::string& name() const { return name_; }

private:
    std::string name_;
    Reading reading_;
};

/// Edits the map of pairs {link: [link, …]} at a path of keys in a file of the user.
void edit_ignored_links(yaml::Splice& file, const std::vector<std::string_view>& path, const SphereModel& model,
                        PairEdit edit, Context& context);

/// Throws Error(output): the file of the user has no such key.
[[noreturn]] void fail_without_key(const SphereModel& model, const std::string& key, const std::string& remedy);

} // namespace foam::tree
