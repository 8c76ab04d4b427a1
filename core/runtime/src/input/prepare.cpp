#include <foam/runtime/internal/input.hpp>

#include "input/tasks.hpp"
#include "process/process.hpp"

#include <foam/geometry/internal/triangles.hpp>

#include <map>

namespace foam::inline runtime {
namespace {

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
            report.metrics = cached->log.metrics;
            workspace.journal.repeat(cached->log, link, call.stage);
            workspace.journal.finished(link, report);
            mesh = std::make_shared<const Mesh>(std::move(cached->result));
        } else {
            StageLog log;
            mesh = run_stage(workspace, call.stage, link, input, content, report, [&](StageContext& context) {
                Mesh result = call_filter(workspace, call, *mesh, context);
                check_triangles(result, "filter");
                log = context.kept_log();
                return std::make_shared<const Mesh>(std::move(result));
            });
            workspace.cache.put(key, *mesh, log);
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
    const auto wanted = [&](const Link& link) { return !workspace.recipe.for_link(link.name).skip; };
    const auto& given = workspace.options.input;
    LoadedLinks loaded =
        load_links(workspace, reading_of(workspace), robot, wanted, given ? given->meshes : std::vector<LoadedMesh>{});
    files.insert(files.end(), loaded.files.begin(), loaded.files.end());
    std::vector<LinkWork> links;
    for (LoadedLink& link : loaded.links) {
        LinkWork& work = links.emplace_back(LinkWork{std::move(link), {}, {}});
        work.recipe = workspace.recipe.for_link(work.link->name);
        work.covers = work.recipe.covers;
        work.report.link = work.link->name;
        work.report.skipped = work.recipe.skip;
        work.report.stages = work.loaders;
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
    const Reading reading = reading_of(workspace);
    std::vector<InputFile> files;
    for (const MeshReference& reference :
         mesh_references(robot, [&](const Link& link) { return !workspace.recipe.for_link(link.name).skip; })) {
        try {
            files.push_back(mesh_file_of(workspace.registry, reading, reference));
        } catch (const Error&) {
            continue; // not an input of a run either
        }
    }
    return files;
}

} // namespace foam::inline runtime
