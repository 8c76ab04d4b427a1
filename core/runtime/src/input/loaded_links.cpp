// The meshes of a robot's links: each file at each scale is loaded once.
#include "input/inputs.hpp"
#include "input/tasks.hpp"
#include "process/process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace foam::inline runtime {
namespace {

/// What makes references one mesh: the file, or what stands in its place, and the scale.
using MeshKey = std::tuple<std::string, const Mesh*, double, double, double>;

MeshKey key_of(const MeshReference& reference) {
    const Vec3& s = reference.scale;
    return {reference.path.empty() ? reference.uri : reference.path.string(), reference.mesh.get(), s.x, s.y, s.z};
}

struct LoadTask : LoadedMesh {
    std::vector<Target> targets;
    std::optional<Error> error;
};

/// Scales a mesh in place: it may be large.
void scale(Mesh& mesh, const Vec3& by) {
    for (Vec3& v : mesh.vertices) {
        v = {v.x * by.x + 0.0, v.y * by.y + 0.0, v.z * by.z + 0.0}; // -0 becomes 0
    }
    if (by.x * by.y * by.z < 0) {
        for (Triangle& t : mesh.triangles) {
            std::swap(t[1], t[2]);
        }
    }
}

std::vector<LoadedLink> links_with_geometry(const Robot& robot, const std::function<bool(const Link&)>& wanted) {
    std::vector<LoadedLink> links;
    for (const Link& link : robot.links) {
        if (link.collisions.empty()) {
            continue;
        }
        LoadedLink& loaded = links.emplace_back();
        loaded.link = &link;
        if (wanted(link)) {
            for (const GeometryElement& source : link.collisions) {
                CollisionElement& element = loaded.elements.emplace_back();
                element.source = &source;
                const auto* mesh = std::get_if<MeshReference>(&source.geometry);
                element.geometry = mesh ? mesh->uri : to_string(std::get<Element>(source.geometry).kind);
            }
        }
    }
    return links;
}

std::vector<LoadTask> load_tasks(const std::vector<LoadedLink>& links) {
    std::map<MeshKey, std::size_t> known;
    std::vector<LoadTask> tasks;
    for (std::size_t l = 0; l < links.size(); ++l) {
        for (std::size_t e = 0; e < links[l].elements.size(); ++e) {
            const auto* reference = std::get_if<MeshReference>(&links[l].elements[e].source->geometry);
            if (!reference) {
                continue;
            }
            const auto [it, fresh] = known.try_emplace(key_of(*reference), tasks.size());
            if (fresh) {
                tasks.emplace_back().reference = *reference;
            }
            tasks[it->second].targets.push_back({l, e});
        }
    }
    return tasks;
}

/// Reads the file of a mesh, and scales it.
void read_mesh(const Calls& calls, const Reading& reading, const std::string& link, LoadTask& task) {
    const std::filesystem::path& path = path_of(task.reference);
    const RegisteredStage* loader = mesh_loader_of(calls.registry, reading, path);
    if (!loader) {
        const std::string extension = path.extension().string();
        throw Error(ErrorCode::input,
                    fmt::format("link '{}': {}: no loader reads files that end in '.{}'; remedy: convert it to "
                                "STL, OBJ, PLY, DAE, OFF or GLB",
                                link, path.string(), extension.empty() ? "" : extension.substr(1)));
    }
    task.file = mesh_file_of(calls.registry, reading, task.reference);
    task.report.input = task.reference.uri;
    task.mesh = run_stage(calls, loader->info.name, link, path.string(), task.file.digest, task.report,
                          [&](StageContext& context) {
                              Mesh mesh = call_loader(calls, reading.call(loader->info.name), path, context);
                              check_triangles(mesh, "loader");
                              scale(mesh, task.reference.scale);
                              task.log = context.kept_log();
                              return std::make_shared<const Mesh>(std::move(mesh));
                          });
}

/// Takes the mesh that the robot holds itself.
void take_own(const Calls& calls, const Reading& reading, LoadTask& task) {
    if (!task.reference.path.empty()) {
        task.file = mesh_file_of(calls.registry, reading, task.reference);
    }
    Mesh mesh = *task.reference.mesh;
    scale(mesh, task.reference.scale);
    task.mesh = std::make_shared<const Mesh>(std::move(mesh));
}

void load(const Calls& calls, const Reading& reading, const std::string& link, LoadTask& task) {
    if (task.reference.mesh) {
        take_own(calls, reading, task);
    } else {
        read_mesh(calls, reading, link, task);
    }
    for (const Vec3& vertex : task.mesh->vertices) {
        if (!is_finite(vertex)) {
            throw Error(ErrorCode::input, fmt::format("link '{}': {}: a vertex is not finite after scaling", link,
                                                      task.reference.path.string()));
        }
    }
    task.report.output = digest_of_content(*task.mesh);
}

/// Takes a mesh that was read before; the log of its loader is repeated.
void take(const Calls& calls, const std::string& link, LoadTask& task, const LoadedMesh& known) {
    const MeshReference reference = task.reference;
    static_cast<LoadedMesh&>(task) = known;
    task.reference = reference;
    task.file.reference = task.report.input = reference.uri;
    task.report.seconds = 0;
    if (!task.reference.mesh) {
        calls.journal.repeat(task.log, link, task.report.stage);
        calls.journal.finished(link, task.report);
    }
}

/// Hands the results of the tasks to the links.
LoadedLinks finished(std::vector<LoadedLink> links, std::vector<LoadTask> tasks) {
    LoadedLinks loaded;
    for (LoadTask& task : tasks) {
        if (!task.file.digest.empty()) { // it could be read
            loaded.files.push_back(task.file);
        }
        for (const auto [l, e] : task.targets) {
            links[l].elements[e].raw = task.mesh;
            links[l].elements[e].read = task.report.output;
            if (!task.reference.mesh) {
                links[l].loaders.push_back(task.report);
            }
            if (task.error && !links[l].error) {
                links[l].error.emplace(*task.error);
            }
        }
        if (!task.error) {
            loaded.meshes.push_back(std::move(task));
        }
    }
    loaded.links = std::move(links);
    return loaded;
}

} // namespace

void check_triangles(const Mesh& mesh, const char* kind) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t corner : mesh.triangles[t]) {
            if (corner >= mesh.vertices.size()) {
                throw Error(ErrorCode::plugin,
                            fmt::format("the {} broke its contract: triangle {} has corner {} of {} vertices", kind, t,
                                        corner, mesh.vertices.size()));
            }
        }
    }
}

std::vector<MeshReference> mesh_references(const Robot& robot, const std::function<bool(const Link&)>& wanted) {
    std::vector<MeshReference> references;
    for (const LoadTask& task : load_tasks(links_with_geometry(robot, wanted))) {
        references.push_back(task.reference);
    }
    return references;
}

LoadedLinks load_links(const Calls& calls, const Reading& reading, const Robot& robot,
                       const std::function<bool(const Link&)>& wanted, const std::vector<LoadedMesh>& known) {
    std::vector<LoadedLink> links = links_with_geometry(robot, wanted);
    std::vector<LoadTask> tasks = load_tasks(links);
    std::map<MeshKey, const LoadedMesh*> before;
    for (const LoadedMesh& mesh : known) {
        before.emplace(key_of(mesh.reference), &mesh);
    }
    calls.journal.expect(static_cast<std::size_t>(
        std::count_if(tasks.begin(), tasks.end(), [](const LoadTask& task) { return !task.reference.mesh; })));
    run_all(tasks, [&](LoadTask& task) {
        const std::string& link = links[task.targets.front().link].link->name;
        if (const auto found = before.find(key_of(task.reference)); found != before.end()) {
            take(calls, link, task, *found->second);
        } else {
            load(calls, reading, link, task);
        }
    });
    LoadedLinks loaded = finished(std::move(links), std::move(tasks));
    for (LoadedLink& link : loaded.links) {
        if (link.error) {
            continue;
        }
        try {
            require_workable(robot, link);
        } catch (const Error& error) {
            link.error.emplace(error);
        }
    }
    return loaded;
}

} // namespace foam::inline runtime
