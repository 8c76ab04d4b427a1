// load.mjcf: MuJoCo's MJCF (https://mujoco.readthedocs.io/en/stable/XMLreference.html), as MuJoCo 4.0 compiles it.
#include "bodies.hpp"
#include "geoms.hpp"
#include "model.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/plugin.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <set>

namespace foam::mjcf {
namespace {

class MjcfLoader final : public RobotLoader {
public:
    MjcfLoader(const Parameters& parameters, const StageMaker& maker)
        : hulls_(parameters.text("semantics") == "mujoco"), meshes_(maker.make<MeshLoader>("load.mesh")) {}

    bool recognises(std::string_view text) const override { return xml::root_name(text) == "mujoco"; }

    Robot load(const std::string& text, const std::filesystem::path& file, const ResourceResolver&,
               Context& context) const override {
        const Model model(text, file);
        Tree tree = tree_of(model);
        Shapes shapes(hulls_);
        for (Geom& geom : tree.geoms) {
            shapes.prepare(geom);
        }
        shapes.read(meshes_.get());
        add_geometry(tree, shapes, context);
        tree.robot.file = file;
        tree.robot.source = text; // for write.mjcf, which edits it
        tree.robot.further_files = further_files(model, shapes, tree.robot);
        return std::move(tree.robot);
    }

private:
    /// Returns files of models, and of meshes that primitives are fitted to: no link names these.
    static std::vector<std::filesystem::path> further_files(const Model& model, const Shapes& shapes,
                                                            const Robot& robot) {
        std::set<std::filesystem::path> files = model.files();
        for (const std::filesystem::path& mesh : shapes.files()) {
            files.insert(mesh);
        }
        files.erase(std::filesystem::absolute(robot.file).lexically_normal());
        for (const std::filesystem::path& named : files_beside(robot)) {
            files.erase(std::filesystem::absolute(named).lexically_normal());
        }
        return {files.begin(), files.end()};
    }

    static void add_geometry(Tree& tree, const Shapes& shapes, Context& context) {
        std::size_t ground = 0;
        CancellationCounter asking(64);
        for (const Geom& geom : tree.geoms) {
            asking.check();
            Link& link = tree.robot.links[geom.link];
            ground += geom.is_ground() && geom.collides() ? 1 : 0;
            if (geom.collides() && !geom.is_ground()) {
                link.collisions.push_back(shapes.collision(geom));
            }
            if (geom.is_seen()) {
                if (auto visual = shapes.visual(geom, context)) {
                    link.visuals.push_back(std::move(*visual));
                }
            }
        }
        if (ground > 0) {
            context.log(Severity::info, fmt::format("{} with contact: no elements cover a plane or a height field",
                                                    counted(ground, "plane or height field")));
        }
    }

    bool hulls_;
    std::unique_ptr<MeshLoader> meshes_; ///< null if no plugin has it
};

} // namespace
} // namespace foam::mjcf

FOAM_PLUGIN("load_mjcf", "1.0", "Apache-2.0") {
    enrol.add<foam::mjcf::MjcfLoader>(
        {.name = "load.mjcf",
         .summary = "Reads a robot from MuJoCo's MJCF.",
         .reference = "https://mujoco.readthedocs.io/en/stable/XMLreference.html",
         .parameters = {foam::Parameter::choice("semantics", {"mujoco", "raw"}, "mujoco")
                            .doc("mujoco: a mesh collides as its convex hull; raw: as it is.")
                            .source("MuJoCo collides with the convex hulls of meshes.")},
         .extensions = {"mjcf", "xml"},
         .uses = {"load.mesh"}});
}
