// load.sdf: robots in SDF (http://sdformat.org), as libsdformat reads them.
#include "model.hpp"

#include <foam/sdk/plugin.hpp>
#include <foam/xml/document.hpp>

namespace foam::load_sdf {
namespace {

class SdfLoader final : public RobotLoader {
public:
    SdfLoader(const Parameters&, const StageMaker& maker) : meshes_(maker.make<MeshLoader>("load.mesh")) {}

    bool recognises(std::string_view text) const override { return xml::root_name(text) == "sdf"; }

    Robot load(const std::string& text, const std::filesystem::path& file, const ResourceResolver& resources,
               Context& context) const override {
        return robot_of(text, file, resources, meshes_.get(), context);
    }

private:
    std::unique_ptr<MeshLoader> meshes_; ///< null if no plugin has it
};

} // namespace
} // namespace foam::load_sdf

FOAM_PLUGIN("load_sdf", "1.0", "Apache-2.0") {
    enrol.add<foam::load_sdf::SdfLoader>({.name = "load.sdf",
                                          .summary = "Reads a robot from an SDF file, by libsdformat.",
                                          .reference = "http://sdformat.org/spec",
                                          .extensions = {"sdf", "world"},
                                          .uses = {"load.mesh"}});
}
