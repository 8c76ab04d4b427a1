#include "input/inputs.hpp"
#include "write/report.hpp"

#include <foam/collision/self_collision.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/runtime/internal/output.hpp>
#include <foam/runtime/version.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

bool any_lists_pairs(const Workspace& workspace) {
    return std::any_of(workspace.recipe.outputs.begin(), workspace.recipe.outputs.end(), [&](const OutputCall& output) {
        return lists_pairs(workspace.registry.find(output.writer.stage)->info, output.writer.given,
                           !output.into.empty());
    });
}

/// Returns the elements of each link; a link without them keeps its geometry, and takes part in no pair.
CollisionModel collision_model(const Workspace& workspace, const FinishedModel& finished) {
    const bool outer = workspace.recipe.guarantee == Guarantee::outer;
    CollisionModel model;
    model.robot = finished.model.robot;
    model.elements.resize(model.robot->links.size());
    model.sources.resize(model.robot->links.size());
    model.solids.resize(model.robot->links.size());
    for (const FinishedLink& link : finished.links) {
        const auto at = static_cast<std::size_t>(link.work->link - model.robot->links.data());
        model.elements[at] = link.elements;
        model.sources[at] = outer && link.work->report.measures.certified ? CollisionModel::Source::cover
                                                                          : CollisionModel::Source::given;
        model.solids[at] = link.solid;
    }
    return model;
}

/// Returns the pairs of neighbours, which need no check: what is known of pairs without a search.
std::vector<IgnoredPair> pairs_of_neighbours(const FinishedModel& finished, CollisionModel model) {
    SelfCollisionOptions options;
    options.samples = 1;
    options.proof_boxes = 0;
    model.solids.clear();
    SelfCollisionMatrix matrix = self_collision_matrix(Kinematics(finished.model.robot), model, options);
    std::erase_if(matrix.pairs, [](const LinkPair& pair) { return pair.reason != PairReason::adjacent; });
    return ignored_pairs(*finished.model.robot, matrix);
}

/// Returns the self-collision matrix; nothing if there is no time to find it.
std::optional<SelfCollisionMatrix> matrix_in_time(const Workspace& workspace, const FinishedModel& finished,
                                                  const CollisionModel& model) {
    SelfCollisionOptions options;
    options.seed = workspace.recipe.seed;
    try {
        const StopScope scope(workspace.in(Phase::completing).request());
        return self_collision_matrix(Kinematics(finished.model.robot), model, options);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled || workspace.ended()) {
            throw;
        }
    }
    workspace.journal.finding({Severity::warning, "", "",
                               fmt::format("{}: the pairs of links that never touch were not looked for; all but "
                                           "neighbours are checked",
                                           why_dropped(workspace))});
    return {};
}

/// Returns the pairs that need no check. Warns of pairs that are in contact in every pose because of their elements
/// alone.
std::vector<IgnoredPair> pairs_of(const Workspace& workspace, const FinishedModel& finished) {
    const CollisionModel model = collision_model(workspace, finished);
    const std::optional<SelfCollisionMatrix> matrix = matrix_in_time(workspace, finished, model);
    if (!matrix) {
        return pairs_of_neighbours(finished, model);
    }
    for (const LinkPair& pair : matrix->pairs) {
        if (pair.touches_by_elements_alone) {
            workspace.journal.finding(
                {Severity::warning, model.robot->links[pair.first].name, "", sentence_about(pair, *model.robot)});
        }
    }
    return ignored_pairs(*finished.model.robot, *matrix);
}

std::string provenance(const Input& input, const FinishedModel& finished, const ProvedLinks& proved) {
    KindCounts kinds{};
    for (const FinishedLink& link : finished.links) {
        kinds = sum_of(kinds, kinds_of(link.elements));
    }
    return fmt::format("foam {}; {} ({}); {}; {}", version(), input.file.filename().string(), input.digest,
                       counts_text(kinds), statement_of(proved));
}

} // namespace

void complete_model(const Workspace& workspace, const Input& input,
                    const std::optional<ReferenceConfiguration>& reference, const ProvedLinks& proved,
                    FinishedModel& finished) {
    finished.model.facts = facts_for_outputs(workspace, *finished.model.robot).facts;
    if (reference && finished.model.facts.default_pose.empty()) {
        finished.model.facts.default_pose = moved_joints(Kinematics(finished.model.robot), reference->configuration);
    }
    for (const Link& link : finished.model.robot->links) {
        if (workspace.recipe.for_link(link.name).no_collision) {
            finished.model.without_collision.push_back(link.name);
        }
    }
    finished.model.verdict = proved;
    finished.model.provenance = provenance(input, finished, proved);
    for (const FinishedLink& link : finished.links) {
        finished.model.geometry[link.work->link->name] = link.solid;
    }
    if (any_lists_pairs(workspace) && finished.model.robot->links.size() > 1) {
        finished.model.ignored_pairs = pairs_of(workspace, finished);
    }
}

} // namespace foam::inline runtime
