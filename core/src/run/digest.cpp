#include "digest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace foam {

struct Hasher::State {
    XXH3_state_t* xxh = XXH3_createState();
    State() { XXH3_128bits_reset(xxh); }
    ~State() { XXH3_freeState(xxh); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
};

namespace {
Digest hex(const XXH128_hash_t& hash) {
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}
} // namespace

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;

void Hasher::bytes(const void* data, std::size_t size) {
    XXH3_128bits_update(state_->xxh, data, size);
}

Hasher& Hasher::add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    bytes(text.data(), text.size());
    return *this;
}

Hasher& Hasher::add(std::uint64_t value) {
    bytes(&value, sizeof value);
    return *this;
}

Hasher& Hasher::add(double value) {
    value += 0.0; // -0 and 0 are one value
    bytes(&value, sizeof value);
    return *this;
}

Hasher& Hasher::add(const Vec3& v) {
    return add(v.x).add(v.y).add(v.z);
}

Hasher& Hasher::add(const Pose& pose) {
    for (const Vec3& row : pose.rotation) {
        add(row);
    }
    return add(pose.translation);
}

Hasher& Hasher::add(const Mesh& mesh) {
    add(static_cast<std::uint64_t>(mesh.vertices.size()));
    bytes(mesh.vertices.data(), mesh.vertices.size() * sizeof(Vec3));
    add(static_cast<std::uint64_t>(mesh.triangles.size()));
    bytes(mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
    return *this;
}

Hasher& Hasher::add(const Primitive& primitive) {
    return add(to_string(primitive.kind)).add(primitive.size).add(primitive.radius).add(primitive.length);
}

Hasher& Hasher::add(const SphereTree& tree) {
    add(static_cast<std::uint64_t>(tree.levels.size()));
    for (const SphereTree::Level& level : tree.levels) {
        add(static_cast<std::uint64_t>(level.spheres.size()));
        for (const Sphere& sphere : level.spheres) {
            add(sphere.center).add(sphere.radius);
        }
        add(static_cast<std::uint64_t>(level.parents.size()));
        bytes(level.parents.data(), level.parents.size() * sizeof(std::uint32_t));
    }
    return *this;
}

Hasher& Hasher::add(const Measures& m) {
    add(static_cast<std::uint64_t>(m.spheres)).add(static_cast<std::uint64_t>(m.certified));
    for (const double figure : {m.area, m.volume, m.covered, m.gap, m.excess, m.excess_error, m.missing,
                                m.missing_error, m.exposed_area, m.protrusion_max, m.protrusion_mean, m.excess_volume,
                                m.missing_volume, m.excess_volume_error, m.missing_volume_error, m.volume_error}) {
        add(figure);
    }
    return *this;
}

Hasher& Hasher::add(const Robot& robot) {
    add(robot.name).add(robot.root).add(static_cast<std::uint64_t>(robot.links.size()));
    for (const Link& link : robot.links) {
        add(link.name).add(static_cast<std::uint64_t>(link.collisions.size()));
        for (const GeometryElement& element : link.collisions) {
            add(element.origin).add(element.name);
            if (const auto* mesh = std::get_if<MeshReference>(&element.geometry)) {
                add("mesh").add(mesh->uri).add(mesh->scale);
            } else {
                add("primitive").add(std::get<Primitive>(element.geometry));
            }
        }
    }
    add(static_cast<std::uint64_t>(robot.joints.size()));
    for (const Joint& joint : robot.joints) {
        add(joint.name).add(static_cast<std::uint64_t>(joint.kind)).add(joint.parent).add(joint.child);
        add(joint.origin).add(joint.axis).add(joint.lower).add(joint.upper);
    }
    return *this;
}

Hasher& Hasher::add(const StageCall& call, const Registry& registry) {
    const RegisteredStage* stage = registry.find(call.stage);
    add(call.stage);
    if (!stage) {
        return *this;
    }
    add(stage->plugin_version).add(static_cast<std::uint64_t>(stage->info.revision));
    for (const std::string& used : stage->info.uses) {
        const RegisteredStage* other = registry.find(used);
        add(used).add(other ? other->plugin_version : "absent");
        add(static_cast<std::uint64_t>(other ? other->info.revision : 0));
    }
    const Parameters parameters(stage->info.parameters, call.given);
    for (const Parameter& declared : stage->info.parameters) {
        if (declared.affects_output) {
            add(declared.name).add(to_text(parameters.values().find(declared.name)->second));
        }
    }
    return *this;
}

Digest Hasher::finish() const {
    return hex(XXH3_128bits_digest(state_->xxh));
}

Digest digest_of(std::string_view bytes) {
    return hex(XXH3_128bits(bytes.data(), bytes.size()));
}

} // namespace foam
