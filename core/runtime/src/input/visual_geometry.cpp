// What is reported of links whose visual geometry says more than their collision geometry.
#include "input/inputs.hpp"
#include "input/tasks.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/length.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

/// Adds the vertices of a mesh in the link's frame.
void add_mesh(Box& box, const Mesh& mesh, const Pose& pose) {
    for (const Vec3& vertex : mesh.vertices) {
        box.add(pose * vertex);
    }
}

Box collision_box(const LinkWork& link) {
    Box box;
    for (const CollisionElement& element : link.elements) {
        if (const Element* primitive = element.primitive()) {
            box.add(bounds(moved(*primitive, element.source->origin)));
        } else if (element.raw) {
            add_mesh(box, *element.raw, element.source->origin);
        }
    }
    return box;
}

/// Loads visual meshes whose files are small; without a word.
class VisualMeshes {
public:
    explicit VisualMeshes(const Workspace& workspace) : workspace_(workspace) {}

    /// Returns the mesh, scaled; null for a large file, or one that cannot be read.
    const Mesh* find(const MeshReference& reference) {
        const Vec3& s = reference.scale;
        const auto [known, fresh] = meshes_.try_emplace({reference.path.string(), s.x, s.y, s.z});
        if (fresh) {
            known->second = loaded(reference);
        }
        return known->second ? &*known->second : nullptr;
    }

private:
    std::optional<Mesh> loaded(const MeshReference& reference) {
        constexpr std::uintmax_t small = 1'000'000, all = 16'000'000; // bytes
        std::error_code error;
        const std::uintmax_t size = fs::file_size(reference.path, error);
        const RegisteredStage* loader = mesh_loader_of(workspace_.registry, reading_of(workspace_), reference.path);
        if (error || !loader || size > small || bytes_ + size > all) {
            return std::nullopt;
        }
        bytes_ += size;
        try {
            QuietContext quiet;
            const StageCall call = workspace_.recipe.loader_call(loader->info.name);
            const auto stage = workspace_.registry.make<MeshLoader>(call.stage, call.given);
            return transformed(stage->load(reference.path, quiet), {}, reference.scale);
        } catch (const Error&) { // whoever looks at visual geometry hears of it
            return std::nullopt;
        }
    }

    const Workspace& workspace_;
    std::uintmax_t bytes_ = 0;
    std::map<std::tuple<std::string, double, double, double>, std::optional<Mesh>> meshes_;
};

/// Returns the box of what is known of a link's visual geometry.
Box visual_box(const Link& link, VisualMeshes& meshes) {
    Box box;
    for (const GeometryElement& visual : link.visuals) {
        if (const auto* reference = std::get_if<MeshReference>(&visual.geometry)) {
            if (const Mesh* mesh = reference->path.empty() ? nullptr : meshes.find(*reference)) {
                add_mesh(box, *mesh, visual.origin);
            }
        } else {
            box.add(bounds(moved(std::get<Element>(visual.geometry), visual.origin)));
        }
    }
    return box;
}

/// Returns how far a box extends beyond another one.
double beyond(const Box& box, const Box& other) {
    const Vec3 low = other.low - box.low, high = box.high - other.high;
    return std::max({low.x, low.y, low.z, high.x, high.y, high.z, 0.0});
}

void note_links_without_collision(const Workspace& workspace, const Robot& robot) {
    std::vector<std::string> names;
    for (const Link& link : robot.links) {
        if (link.collisions.empty() && !link.visuals.empty()) {
            names.push_back(shown(link.name));
        }
    }
    if (!names.empty()) {
        workspace.journal.finding(
            {Severity::info, "", "",
             fmt::format("{} visual geometry alone, and no element covers it: {}; to cover it: --geometry "
                         "collision-or-visual, or cover: collision-or-visual in the recipe",
                         names.size() == 1 ? "1 link has" : fmt::format("{} links have", names.size()),
                         fmt::join(names, ", "))});
    }
}

} // namespace

void refuse_without_geometry(const fs::path& file, const Robot& robot, CoveredGeometry geometry, const char* to) {
    const bool visual =
        std::any_of(robot.links.begin(), robot.links.end(), [](const Link& link) { return !link.visuals.empty(); });
    throw Error(ErrorCode::input,
                fmt::format("{}: no link has {}: there is nothing {}{}", file.string(), to_string(geometry), to,
                            visual && geometry == CoveredGeometry::collision
                                ? "; remedy: --geometry visual, or cover: visual in the recipe"
                                : ""));
}

void tell_visual_geometry(const Workspace& workspace, const Robot& robot, const std::vector<LinkWork>& links) {
    constexpr double visible = 0.001, share = 0.01; // m; of the longest edge
    if (workspace.recipe.cover.value_or(CoveredGeometry::collision) != CoveredGeometry::collision ||
        !workspace.recipe.mesh.empty()) {
        return;
    }
    note_links_without_collision(workspace, robot);
    VisualMeshes meshes(workspace);
    std::vector<std::string> names;
    double largest = 0;
    for (const LinkWork& link : links) {
        const Box inner = collision_box(link), outer = visual_box(*link.link, meshes);
        if (link.error || link.elements.empty() || inner.empty() || outer.empty()) {
            continue;
        }
        const Vec3 size = outer.size();
        const double gap = beyond(outer, inner);
        if (gap > visible && gap > share * std::max({size.x, size.y, size.z})) {
            largest = std::max(largest, gap);
            names.push_back(fmt::format("{} ({})", shown(link.link->name), length_text(gap)));
        }
    }
    if (!names.empty()) {
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format(
                 "the visual geometry extends beyond the collision geometry, which is what elements cover: {}; to "
                 "cover both: --geometry both, or cover: both in the recipe",
                 first_names(names))});
    }
}

} // namespace foam::inline runtime
