#include <foam/runtime/internal/input.hpp>

#include "input/inputs.hpp"
#include "process/process.hpp"

#include <foam/geometry/internal/triangles.hpp>

#include <fmt/format.h>

#include <map>
#include <tuple>

namespace foam::inline runtime {
namespace {

/// A mesh file at a scale.
struct LoadTask {
    MeshReference reference;
    std::vector<Target> targets;
    std::shared_ptr<const Mesh> mesh;
    InputFile file;
    StageReport report;
    std::optional<Error> error;
};

/// Runs the tasks on all cores. Keeps errors with their tasks, but lets cancellation pass.
template <class Task, class Body> void run_all(std::vector<Task>& tasks, Body&& body) {
    parallel_for(tasks.size(), [&](std::size_t i) {
        try {
            body(tasks[i]);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) {
                throw;
            }
            tasks[i].error.emplace(error);
        }
    });
}

/// Checks the contract of a stage: later stages rely on valid corner indices.
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

std::vector<LinkWork> links_to_do(const Workspace& workspace, const Robot& robot) {
    std::vector<LinkWork> links;
    for (const Link& link : robot.links) {
        if (link.collisions.empty()) {
            continue;
        }
        LinkWork work;
        work.link = &link;
        work.recipe = workspace.recipe.for_link(link.name);
        work.report.link = link.name;
        work.report.skipped = work.recipe.skip;
        if (!work.recipe.skip) {
            for (const GeometryElement& source : link.collisions) {
                CollisionElement element;
                element.source = &source;
                const auto* mesh = std::get_if<MeshReference>(&source.geometry);
                element.geometry = mesh ? mesh->uri : to_string(std::get<Element>(source.geometry).kind);
                work.elements.push_back(std::move(element));
            }
        }
        links.push_back(std::move(work));
    }
    return links;
}

std::vector<LoadTask> load_tasks(const std::vector<LinkWork>& links) {
    std::map<std::tuple<std::string, double, double, double>, std::size_t> known;
    std::vector<LoadTask> tasks;
    for (std::size_t l = 0; l < links.size(); ++l) {
        for (std::size_t e = 0; e < links[l].elements.size(); ++e) {
            const auto* reference = std::get_if<MeshReference>(&links[l].elements[e].source->geometry);
            if (!reference) {
                continue;
            }
            const Vec3& s = reference->scale;
            const auto [it, fresh] = known.try_emplace(
                {reference->path.empty() ? reference->uri : reference->path.string(), s.x, s.y, s.z}, tasks.size());
            if (fresh) {
                tasks.emplace_back().reference = *reference;
            }
            tasks[it->second].targets.push_back({l, e});
        }
    }
    return tasks;
}

InputFile input_file(const Workspace& workspace, const MeshReference& reference) {
    const DigestedFile digested = digest_of_mesh_file(workspace, reference.path);
    return {reference.uri, reference.path, digested.digest, digested.bytes};
}

void load(const Workspace& workspace, const std::vector<LinkWork>& links, LoadTask& task) {
    const std::filesystem::path& path = task.reference.path;
    const std::string& link = links[task.targets.front().link].link->name;
    if (path.empty()) { // the robot's loader requires the files of collision geometry only
        throw Error(ErrorCode::input, fmt::format("link '{}': the mesh '{}' is not found; remedy: correct the path, or "
                                                  "set FOAM_PACKAGE_PATH to the folder that holds the package",
                                                  link, task.reference.uri));
    }
    const RegisteredStage* loader = mesh_loader_of(workspace, path);
    if (!loader) {
        const std::string extension = path.extension().string();
        throw Error(ErrorCode::input,
                    fmt::format("link '{}': {}: no loader reads files that end in '.{}'; remedy: convert it to "
                                "STL, OBJ, PLY, DAE, OFF or GLB",
                                link, path.string(), extension.empty() ? "" : extension.substr(1)));
    }
    task.file = input_file(workspace, task.reference);
    task.report.input = task.reference.uri;
    task.mesh = run_stage(workspace, loader->info.name, link, path.string(), task.file.digest, task.report,
                          [&](Context& context) {
                              Mesh mesh = call_loader(workspace, loader->info.name, path, context);
                              check_triangles(mesh, "loader");
                              scale(mesh, task.reference.scale);
                              return std::make_shared<const Mesh>(std::move(mesh));
                          });
    for (const Vec3& vertex : task.mesh->vertices) {
        if (!is_finite(vertex)) {
            throw Error(ErrorCode::input,
                        fmt::format("link '{}': {}: a vertex is not finite after scaling", link, path.string()));
        }
    }
    task.report.output = digest_of_content(*task.mesh);
}

void filter(const Workspace& workspace, const std::vector<LinkWork>& links, FilterTask& task) {
    const auto [l, e] = task.targets.front();
    const std::string& link = links[l].link->name;
    const std::string& input = links[l].elements[e].geometry;
    std::shared_ptr<const Mesh> mesh = task.mesh;
    std::optional<geometry::ComparedMesh> before(*mesh);
    for (const StageCall& call : task.filters) {
        const Digest content = digest_of_content(*mesh);
        const Digest key = filter_key(workspace, call, *mesh, content);
        StageReport& report = task.reports.emplace_back();
        report.input = input;
        if (auto cached = workspace.cache.mesh(key)) {
            report.stage = call.stage;
            report.cached = true;
            report.metrics = cached->said.metrics;
            workspace.journal.repeat(cached->said, link, call.stage);
            workspace.journal.finished(link, report);
            mesh = std::make_shared<const Mesh>(std::move(cached->result));
        } else {
            StageLog said;
            mesh = run_stage(workspace, call.stage, link, input, content, report, [&](StageContext& context) {
                Mesh result = call_filter(workspace, call, *mesh, context);
                check_triangles(result, "filter");
                said = context.said();
                return std::make_shared<const Mesh>(std::move(result));
            });
            workspace.cache.put(key, *mesh, said);
        }
        report.output = digest_of_content(*mesh);
        task.results.push_back(mesh);
        geometry::ComparedMesh after(*mesh);
        if (!before->mesh().triangles.empty() && !mesh->triangles.empty()) {
            report.change =
                geometry::mesh_change(*before, after, derive_seed(workspace.recipe.seed, "change" + content));
            workspace.journal.finding({Severity::debug, link, call.stage, describe(*report.change)});
        }
        before.emplace(std::move(after));
    }
}

} // namespace

std::vector<FilterTask> filter_tasks(const Workspace& workspace, std::vector<LinkWork>& links) {
    std::map<Digest, std::size_t> known;
    std::vector<FilterTask> tasks;
    for (std::size_t l = 0; l < links.size(); ++l) {
        if (links[l].error) {
            continue; // no stage gets refused geometry
        }
        for (std::size_t e = 0; e < links[l].elements.size(); ++e) {
            CollisionElement& element = links[l].elements[e];
            if (!element.raw) {
                if (const Element* primitive = element.primitive()) {
                    Hasher hasher;
                    add_primitive(hasher, *primitive);
                    element.digest = hasher.finish();
                }
                continue;
            }
            Hasher hasher;
            hasher.add(*element.raw);
            for (const StageCall& filter : links[l].recipe.filters) {
                add_call(hasher, filter, workspace.registry);
            }
            element.digest = hasher.finish();
            for (const StageCall& filter : links[l].recipe.filters) {
                add_isolation(hasher, filter.isolation);
            }
            const auto [it, fresh] = known.try_emplace(hasher.finish(), tasks.size());
            if (fresh) {
                FilterTask& task = tasks.emplace_back();
                task.mesh = element.raw;
                task.filters = links[l].recipe.filters;
                task.digest = element.digest;
            }
            tasks[it->second].targets.push_back({l, e});
        }
    }
    return tasks;
}

Digest filter_key(const Workspace& workspace, const StageCall& filter, const Mesh& mesh, const Digest& content) {
    Hasher hasher;
    hasher.add("filter");
    add_call(hasher, filter, workspace.registry);
    hasher.add(workspace.recipe.seed).add(content);
    if (const geometry::OwnFrame frame = geometry::own_frame(mesh); !frame.is_given()) {
        hasher.add("frame").add(frame.origin).add(frame.scale()).add(frame.dust);
    }
    return hasher.finish();
}

std::vector<LinkWork> load_links(const Workspace& workspace, const Robot& robot, std::vector<InputFile>& files) {
    std::vector<LinkWork> links = links_to_do(workspace, robot);

    std::vector<LoadTask> loads = load_tasks(links);
    workspace.journal.expect(loads.size());
    run_all(loads, [&](LoadTask& task) { load(workspace, links, task); });
    for (const LoadTask& task : loads) {
        if (!task.file.digest.empty()) { // it could be read
            files.push_back(task.file);
        }
        for (const auto [l, e] : task.targets) {
            links[l].elements[e].raw = task.mesh;
            links[l].elements[e].read = task.report.output;
            links[l].report.stages.push_back(task.report);
            if (task.error && !links[l].error) {
                links[l].error.emplace(*task.error);
            }
        }
    }
    for (LinkWork& link : links) {
        if (link.error) {
            continue;
        }
        try {
            require_workable(robot, link);
        } catch (const Error& error) {
            link.error.emplace(error);
        }
    }
    return links;
}

void filter_links(const Workspace& workspace, std::vector<LinkWork>& links) {
    std::vector<FilterTask> chains = filter_tasks(workspace, links);
    for (const FilterTask& task : chains) {
        workspace.journal.expect(task.filters.size());
    }
    run_all(chains, [&](FilterTask& task) { filter(workspace, links, task); });
    for (const FilterTask& task : chains) {
        for (const auto [l, e] : task.targets) {
            links[l].elements[e].filtered = task.results;
            links[l].report.stages.insert(links[l].report.stages.end(), task.reports.begin(), task.reports.end());
            if (task.error && !links[l].error) {
                links[l].error.emplace(*task.error);
            }
        }
    }
}

std::vector<LinkWork> prepare_links(const Workspace& workspace, const Robot& robot, std::vector<InputFile>& files) {
    std::vector<LinkWork> links = load_links(workspace, robot, files);
    filter_links(workspace, links);
    return links;
}

std::vector<InputFile> mesh_files(const Workspace& workspace, const Robot& robot) {
    std::vector<InputFile> files;
    for (const LoadTask& task : load_tasks(links_to_do(workspace, robot))) {
        try {
            files.push_back(input_file(workspace, task.reference));
        } catch (const Error&) {
            continue; // not an input of a run either
        }
    }
    return files;
}

} // namespace foam::inline runtime
