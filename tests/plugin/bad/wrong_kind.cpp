// Says that it filters meshes, and makes a loader.
#include "stage.hpp"

namespace {

class Loader final : public foam::MeshLoader {
public:
    foam::Mesh load(const std::filesystem::path&, foam::Context&) const override { return {}; }
};

} // namespace

FOAM_PLUGIN("wrong_kind", "1.0", "Apache-2.0") {
    enrol.add_stage(foam::StageKind::mesh_filter, info("repair.loader"),
                    [](const foam::Parameters&) { return std::make_unique<Loader>(); });
    enrol.add_stage(foam::StageKind::mesh_filter, info("repair.null"),
                    [](const foam::Parameters&) { return std::unique_ptr<foam::Stage>(); });
}
