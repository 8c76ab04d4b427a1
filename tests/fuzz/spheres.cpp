#include "promises.hpp"
#include "targets.hpp"

#include <foam/judge/evaluate.hpp>

#include <cmath>

namespace foam::fuzz {
namespace {

const Registry& readers() {
    static Registry registry;
    static const bool loaded = [] {
        for (const char* plugin : {"load_urdf", "read_rows", "yaml_models", "write_csv", "write_gltf", "write_ply",
                                   "write_scene", "write_sdf", "write_usd"}) {
            const PluginRecord& record = registry.load(std::string(FOAM_FUZZ_PLUGINS "/") + plugin + ".so");
            promise(record.loaded(), record.rejection);
        }
        return true;
    }();
    promise(loaded, "no plugins");
    return registry;
}

} // namespace

void read_spheres(std::string_view bytes) {
    const std::string file = "/nowhere/fuzz.spheres";
    try {
        const SphereFile model = parse_sphere_file(std::string(bytes), file, readers());
        promise(!model.format.empty(), "a format without a name");
        for (const LinkSpheres& link : model.links) {
            for (const Sphere& sphere : link.elements.spheres()) {
                promise(is_finite(sphere.center), "a centre that is not finite");
                promise(std::isfinite(sphere.radius) && sphere.radius > 0, "a radius that is none");
            }
        }
    } catch (const Error& error) {
        check_refusal(error, file);
    }
}

} // namespace foam::fuzz
