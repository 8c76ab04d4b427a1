#include "promises.hpp"
#include "targets.hpp"

#include <foam/sdk/registry.hpp>

namespace foam::fuzz {
namespace {

const RobotLoader& loader() {
    static Registry registry;
    static const auto loader = [] {
        const PluginRecord& record = registry.load(FOAM_FUZZ_PLUGINS "/load_urdf.so");
        promise(record.loaded(), record.rejection);
        return registry.make<RobotLoader>("load.urdf");
    }();
    return *loader;
}

void check(const GeometryElement& element) {
    for (const Vec3& row : element.origin.rotation) {
        promise(is_finite(row), "a rotation that is not finite");
    }
    promise(is_finite(element.origin.translation), "a position that is not finite");
}

} // namespace

void read_urdf(std::string_view bytes) {
    const std::string file = "/nowhere/fuzz.urdf";
    QuietContext context;
    try {
        const Robot robot = loader().load(std::string(bytes), file, ResourceResolver(), context);
        promise(!robot.links.empty(), "a robot without links");
        for (const Link& link : robot.links) {
            for (const GeometryElement& element : link.collisions) {
                check(element);
            }
        }
    } catch (const Error& error) {
        check_refusal(error, file);
    }
}

} // namespace foam::fuzz
