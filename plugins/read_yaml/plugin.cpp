// read.*: sphere models in YAML and JSON.
#include "formats.hpp"
#include "outline.hpp"

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

FOAM_PLUGIN("read_yaml", "1.0", "Apache-2.0") {
    using namespace foam::tree;
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
