#include <foam/runtime/plan.hpp>

#include "allocate/budget.hpp"
#include "allocate/exploration.hpp"
#include "finish/finish.hpp"
#include "input/inputs.hpp"

#include <foam/runtime/internal/input.hpp>

#include <algorithm>
#include <set>

namespace foam::inline runtime {
namespace {

PlannedStage planned(const StageCall& call, const Registry& registry) {
    PlannedStage stage;
    stage.stage = call.stage;
    stage.given = call.given;
    if (const RegisteredStage* known = registry.find(call.stage)) {
        stage.plugin = known->plugin;
        stage.plugin_version = known->plugin_version;
    }
    return stage;
}

/// Returns how many filters of the chain, from the first, have results in the cache.
std::size_t cached_filters(const Workspace& workspace, const FilterTask& task) {
    std::shared_ptr<const Mesh> mesh = task.mesh;
    for (std::size_t i = 0; i < task.filters.size(); ++i) {
        auto cached = workspace.cache.mesh(filter_key(workspace, task.filters[i], *mesh, digest_of_content(*mesh)));
        if (!cached) {
            return i;
        }
        mesh = std::make_shared<const Mesh>(std::move(cached->result));
    }
    return task.filters.size();
}

class Planner {
public:
    Planner(const Workspace& workspace, const Robot& robot) : workspace_(workspace) {
        work_ = load_links(workspace_, robot, files_);
        chains_ = filter_tasks(workspace_, work_);
        for (const LinkWork& link : work_) {
            add(link);
        }
        count_filters();
        count_trees();
    }

    std::vector<PlannedLink> links;
    const std::vector<InputFile>& files() const { return files_; }

private:
    void add(const LinkWork& work) {
        PlannedLink& link = links.emplace_back();
        link.link = work.link->name;
        link.skipped = work.recipe.skip;
        link.error = work.error ? work.error->what() : "";
        for (const LinkOverride& change : workspace_.recipe.links) {
            if (change.glob == link.link || glob_matches(change.glob, link.link)) {
                link.overrides.push_back(change);
            }
        }
        for (const CollisionElement& element : work.elements) {
            link.geometry.push_back(element.geometry);
        }
        if (link.skipped || work.error) {
            return;
        }
        for (const StageCall* call : work.recipe.stages()) {
            link.stages.push_back(planned(*call, workspace_.registry));
        }
    }

    void count_filters() {
        std::vector<std::size_t> found(chains_.size());
        parallel_for(chains_.size(), [&](std::size_t c) { found[c] = cached_filters(workspace_, chains_[c]); });
        for (std::size_t c = 0; c < chains_.size(); ++c) {
            for (const Target& target : chains_[c].targets) {
                std::vector<PlannedStage>& stages = links[target.link].stages;
                for (std::size_t i = 0; i < work_[target.link].recipe.filters.size(); ++i) {
                    stages[i].needed += 1;
                    stages[i].cached += i < found[c] ? 1 : 0;
                }
            }
        }
    }

    void count_trees() {
        std::vector<Group> groups = make_groups(workspace_, work_);
        take_covered_groups(workspace_, work_, groups); // these need no search
        const std::vector<ShapeWork> shapes = distinct_shapes(workspace_, work_, groups);
        for (const Group& group : groups) {
            const ShapeWork& shape = shapes[group.shape];
            std::vector<PlannedStage>& stages = links[group.link].stages;
            const std::size_t first = work_[group.link].recipe.filters.size(); // the spherizer; refiners follow
            for (const std::size_t count : first_counts(workspace_.recipe, shape, groups.size())) {
                const bool cached = workspace_.cache.tree(tree_key(workspace_, shape, count)).has_value();
                for (std::size_t i = first; i < stages.size(); ++i) {
                    stages[i].needed += 1;
                    stages[i].cached += cached ? 1 : 0;
                }
            }
        }
    }

    const Workspace& workspace_;
    std::vector<InputFile> files_;
    std::vector<LinkWork> work_;
    std::vector<FilterTask> chains_;
};

} // namespace

Plan plan(const Recipe& recipe, const Registry& registry, const RunOptions& options) {
    Journal journal(nullptr);
    const Cache cache(cache_folder(options));
    const Workspace workspace{recipe, registry, options, journal, cache};
    const Input input = load_input(workspace);

    std::vector<Diagnostic> unknown = unknown_names(recipe, *input.robot);
    require_names(unknown);
    Plan result;
    result.warnings = std::move(unknown);
    result.input = input.chosen;
    result.input_file = {input.file, input.digest};
    const auto& candidates = recipe.urdf.empty() ? recipe.mesh : recipe.urdf;
    result.not_found.assign(candidates.begin(), std::find(candidates.begin(), candidates.end(), input.chosen));
    for (const StageCall* call : recipe.stages()) {
        result.stages.push_back(planned(*call, registry));
    }
    Planner planner(workspace, *input.robot);
    result.links = std::move(planner.links);
    const Reading reading = reading_of(workspace);
    for (const InputFile& mesh : planner.files()) {
        result.meshes.push_back({mesh.file, mesh.digest, mesh_loader_of(registry, reading, mesh.file)->info.name});
    }
    for (const OutputCall& output : recipe.outputs) {
        result.outputs.push_back({planned(output.writer, registry), output.file});
    }
    if (recipe.snapshots || recipe.debug_snapshots) {
        result.renderer = planned(recipe.renderer, registry);
    }
    return result;
}

std::vector<Diagnostic> unknown_names(const Recipe& recipe, const Registry& registry) {
    if (recipe.links.empty() && recipe.self_collision_pose.empty() && recipe.pose.empty()) {
        return {};
    }
    const auto& candidates = recipe.urdf.empty() ? recipe.mesh : recipe.urdf;
    if (candidates.empty() || !input_resolves(recipe)) {
        return {};
    }
    const RunOptions options;
    Journal journal(nullptr);
    const Cache cache({});
    const Workspace workspace{recipe, registry, options, journal, cache};
    return unknown_names(recipe, *load_input(workspace).robot);
}

void add_unknown_names(RecipeResult& read, const Registry& registry) {
    std::set<std::string> reported;
    for (const Recipe& recipe : read.recipes) {
        for (Diagnostic& finding : unknown_names(recipe, registry)) {
            if (reported.insert(finding.text()).second) {
                read.diagnostics.push_back(std::move(finding));
            }
        }
    }
}

} // namespace foam::runtime
