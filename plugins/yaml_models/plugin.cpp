// Sphere models in YAML and JSON: read.* and write.*.
#include "tree_writer.hpp"
#include "writers.hpp"

#include <foam/sdk/plugin.hpp>

namespace foam::tree {
namespace {

template <Format format, void (*read_tree)(const yaml::Value&, Tree&)> class TreeReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return format_of(text) == format; }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        SphereFile result;
        result.file = file;
        Tree tree(result);
        read_tree(parse(text, file), tree);
        return result;
    }
};

} // namespace
} // namespace foam::tree

namespace foam::tree {

static void add_readers(foam::Enrolment& enrol) {
    enrol.add<TreeReader<Format::foam_json, read_foam_json>>(
        {.name = "read.foam_json",
         .summary = "Reads the JSON of write.json with layout: links.",
         .reference = "schemas/spheres.schema.json",
         .extensions = {"json"}});
    enrol.add<TreeReader<Format::xrdf, read_xrdf>>(
        {.name = "read.xrdf",
         .summary = "Reads the spheres of an XRDF file, 1.0 or 2.0 (Isaac, cuMotion).",
         .reference = "https://nvidia-isaac-ros.github.io/concepts/manipulation/xrdf.html",
         .extensions = {"xrdf", "yaml"}});
    enrol.add<TreeReader<Format::curobo, read_curobo>>(
        {.name = "read.curobo",
         .summary = "Reads the spheres of a robot file of cuRobo: collision_spheres within kinematics.",
         .reference = "https://curobo.org/tutorials/1_robot_configuration.html",
         .extensions = {"yml", "yaml"}});
    enrol.add<TreeReader<Format::collision_spheres, read_collision_spheres>>(
        {.name = "read.collision_spheres",
         .summary = "Reads a file with the key collision_spheres: a sphere file of cuRobo, bubblify, plainmp or Lula.",
         .reference = "https://curobo.org/tutorials/1_robot_configuration.html",
         .extensions = {"yml", "yaml"}});
    enrol.add<TreeReader<Format::columns, read_columns>>(
        {.name = "read.centers_radii",
         .summary = "Reads lists of centers and radii, of one body (MorphIt) or by link (ballpark, pyroki).",
         .reference = "https://github.com/chungmin99/ballpark",
         .extensions = {"json"}});
    enrol.add<TreeReader<Format::spheres_by_link, read_spheres_by_link>>(
        {.name = "read.spheres_by_link",
         .summary = "Reads a map of links below the key spheres, each with a list of spheres.",
         .reference = "",
         .extensions = {"json", "yaml"}});
    enrol.add<TreeReader<Format::commalab, read_commalab>>(
        {.name = "read.commalab",
         .summary = "Reads the JSON of CoMMALab/foam: the levels of one mesh, or the database of a robot.",
         .reference = "Coumar et al. 2025, https://github.com/CoMMALab/foam",
         .extensions = {"json"}});
}

/// Formats of NVIDIA's planners.
static void add_writers_of_nvidia(foam::Enrolment& enrol) {
    using foam::Parameter;
    enrol.add<CuroboWriter>(
        {.name = "write.curobo",
         .summary = "Writes a robot file of cuRobo with spheres, pairs, locked joints and rest pose.",
         .reference = "https://curobo.org/tutorials/1_robot_configuration.html",
         .parameters =
             {Parameter::choice("version", {"0.8", "0.7"}, "0.8")
                  .doc("0.7 has ee_link and retract_config in place of tool_frames and "
                       "default_joint_position, and no format_version."),
              foam::pairs_parameter(),
              Parameter::number("buffer", 0)
                  .bounds(-1, 10)
                  .unit("m")
                  .doc("collision_sphere_buffer: what cuRobo adds to all radii. The proof is of the radii with it."),
              Parameter::text("urdf_path", "").doc("urdf_path of the file; empty: the absolute path of the URDF."),
              Parameter::text("asset_root_path", "")
                  .doc("asset_root_path of the file; empty: the folder of the URDF.")},
         .extensions = {"yml", "yaml"},
         .consumer = {.name = "cuRobo 0.7.8 and 0.8 (a35a708ecf)",
                      .float32 = true,
                      .pairs = true,
                      .rest_pose = true,
                      .edits = true,
                      .tool_frames = true}});
    enrol.add<XrdfWriter>(
        {.name = "write.xrdf",
         .summary = "Writes an XRDF file: spheres, pairs, joints and limits.",
         .reference = "https://nvidia-isaac-ros.github.io/concepts/manipulation/xrdf.html",
         .parameters = {Parameter::choice("version", {"1.0", "2.0"}, "1.0")
                            .doc("2.0: world_collision in place of collision, for Isaac Sim 6. cuRobo reads 1.0 only."),
                        foam::pairs_parameter()},
         .extensions = {"xrdf"},
         .consumer = {.name = "cuMotion, Isaac Sim 6.0.1 (045ca8b596), cuRobo 0.8",
                      .float32 = true,
                      .pairs = true,
                      .rest_pose = true,
                      .edits = true,
                      .tool_frames = true}});
    enrol.add<LulaWriter>(
        {.name = "write.lula",
         .summary = "Writes a robot description of Lula (Isaac Sim 5): joints, spheres; it has no pairs.",
         .reference =
             "https://docs.isaacsim.omniverse.nvidia.com/5.0.0/manipulators/manipulators_robot_description_editor.html",
         .extensions = {"yaml"},
         .consumer = {.name = "Lula (Isaac Sim 5)", .float32 = true, .rest_pose = true, .edits = true}});
}

static void add_other_writers(foam::Enrolment& enrol) {
    enrol.add<BubblifyWriter>(
        {.name = "write.bubblify",
         .summary = "Writes collision_spheres by link, as bubblify and cuRobo's sphere files have it.",
         .reference = "https://github.com/bheijden/bubblify",
         .extensions = {"yml", "yaml"},
         .consumer = {.name = "bubblify (35b44a1690)", .edits = true}});
    enrol.add<PlainmpWriter>(
        {.name = "write.plainmp",
         .summary = "Writes a robot of plainmp: joints, spheres, and the pairs that are checked.",
         .reference = "https://github.com/HiroIshida/plainmp",
         .parameters = {foam::pairs_parameter()},
         .extensions = {"yaml"},
         .consumer = {.name = "plainmp (4a2fbd1a97)", .pairs = true, .rest_pose = true, .edits = true}});
    enrol.add<PyrokiWriter>({.name = "write.pyroki",
                             .summary = "Writes centers and radii by link, as pyroki and ballpark read them.",
                             .reference = "https://github.com/chungmin99/pyroki",
                             .extensions = {"json"},
                             .consumer = {.name = "pyroki (205451a32a), ballpark (0069623c52)", .float32 = true}});
    enrol.add<MorphitWriter>({.name = "write.morphit",
                              .summary = "Writes centers and radii of one body, as MorphIt does.",
                              .reference = "https://github.com/HIRO-group/MorphIt-1",
                              .extensions = {"json"},
                              .consumer = {.name = "MorphIt (46cf8b0fb5)"}});
}

} // namespace foam::tree

FOAM_PLUGIN("yaml_models", "1.0", "Apache-2.0") {
    foam::tree::add_readers(enrol);
    foam::tree::add_writers_of_nvidia(enrol);
    foam::tree::add_other_writers(enrol);
}
