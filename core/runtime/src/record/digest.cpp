#include <foam/runtime/internal/digest.hpp>

namespace foam::inline runtime {

void add_to(Hasher& hasher, const Robot& robot) {
    hasher.add(robot.name).add(robot.root).add(static_cast<std::uint64_t>(robot.links.size()));
    for (const Link& link : robot.links) {
        hasher.add(link.name).add(static_cast<std::uint64_t>(link.collisions.size()));
        for (const GeometryElement& element : link.collisions) {
            hasher.add(element.origin).add(element.name);
            if (const auto* mesh = std::get_if<MeshReference>(&element.geometry)) {
                hasher.add("mesh").add(mesh->uri).add(mesh->scale);
            } else {
                hasher.add("primitive").add(std::get<Primitive>(element.geometry));
            }
        }
    }
    hasher.add(static_cast<std::uint64_t>(robot.joints.size()));
    for (const Joint& joint : robot.joints) {
        hasher.add(joint.name).add(static_cast<std::uint64_t>(joint.kind)).add(joint.parent).add(joint.child);
        hasher.add(joint.origin).add(joint.axis).add(joint.lower).add(joint.upper);
    }
}

void add_call(Hasher& hasher, const StageCall& call, const Registry& registry) {
    const RegisteredStage* stage = registry.find(call.stage);
    hasher.add(call.stage);
    if (!stage) {
        return;
    }
    hasher.add(build_of_libraries()).add(stage->build).add(static_cast<std::uint64_t>(stage->info.revision));
    for (const std::string& used : stage->info.uses) {
        const RegisteredStage* other = registry.find(used);
        hasher.add(used).add(other ? other->build : "absent");
        hasher.add(static_cast<std::uint64_t>(other ? other->info.revision : 0));
    }
    const Parameters parameters(stage->info.parameters, call.given);
    for (const Parameter& declared : stage->info.parameters) {
        if (declared.affects_output) {
            hasher.add(declared.name).add(to_text(parameters.values().find(declared.name)->second));
        }
    }
}

} // namespace foam::runtime
