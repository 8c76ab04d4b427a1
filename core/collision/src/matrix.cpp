// The self-collision matrix: neighbours first, then proofs, then samples for the remaining pairs.
#include "proof.hpp"
#include "sampling.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/collision/self_collision.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline collision {

using namespace self_collision;

namespace {

void require_sensible(const Kinematics& kinematics, const CollisionModel& model, const SelfCollisionOptions& options) {
    if (!(options.confidence > 0 && options.confidence < 1)) {
        throw Error(ErrorCode::usage,
                    fmt::format("the confidence must lie between 0 and 1, got {}", options.confidence));
    }
    if (model.spheres.size() != kinematics.robot().links.size()) {
        throw Error(ErrorCode::usage, fmt::format("spheres are given for {} links, the robot has {}",
                                                  model.spheres.size(), kinematics.robot().links.size()));
    }
}

std::vector<LinkPair> pairs_of(const Groups& groups) {
    std::vector<LinkPair> pairs;
    for (std::size_t a = 0; a < groups.size(); ++a) {
        for (std::size_t b = a + 1; b < groups.size(); ++b) {
            if (groups[a] && groups[b]) {
                pairs.push_back({.first = a, .second = b});
            }
        }
    }
    return pairs;
}

std::vector<bool> have_geometry(const Groups& groups) {
    std::vector<bool> have(groups.size());
    std::transform(groups.begin(), groups.end(), have.begin(), [](const auto& group) { return group.has_value(); });
    return have;
}

void judge_by_proof(LinkPair& pair, const Kinematics& kinematics, const Groups& groups,
                    const SelfCollisionOptions& options) {
    if (adjacent(kinematics, have_geometry(groups), pair.first, pair.second)) {
        pair.reason = PairReason::adjacent;
        return;
    }
    const Chain chain = chain_between(kinematics, pair.first, pair.second);
    pair.unbounded = chain.unbounded;
    if (pair.unbounded) {
        return;
    }
    const Verdict verdict = touching_verdict(kinematics, chain, *groups[pair.first], *groups[pair.second],
                                             options.proof_boxes, options.cancel);
    if (verdict == Verdict::never || verdict == Verdict::always) {
        pair.reason = verdict == Verdict::never ? PairReason::never : PairReason::always;
        pair.proved = true;
    }
}

PairReason reason_by_samples(const LinkPair& pair, bool touching_in_reference) {
    if (pair.samples > 0 && pair.touching == pair.samples) {
        return PairReason::always;
    }
    if (touching_in_reference) {
        return PairReason::default_pose;
    }
    return pair.samples > 0 && pair.touching == 0 ? PairReason::never : PairReason::none;
}

void judge_by_samples(SelfCollisionMatrix& matrix, const Kinematics& kinematics, const Groups& groups,
                      const SelfCollisionOptions& options) {
    std::vector<LinkPair*> open;
    std::vector<LinkPair> copies;
    for (LinkPair& pair : matrix.pairs) {
        if (pair.reason == PairReason::none && !pair.unbounded) {
            open.push_back(&pair);
            copies.push_back(pair);
        }
    }
    const std::vector<std::size_t> touching =
        count_touching(kinematics, groups, copies, options.samples, options.seed, options.cancel);
    PlacedLinks reference(kinematics, groups);
    reference.place(matrix.reference);
    for (std::size_t i = 0; i < open.size(); ++i) {
        open[i]->samples = options.samples;
        open[i]->touching = touching[i];
        open[i]->reason = reason_by_samples(*open[i], reference.touching(open[i]->first, open[i]->second));
    }
}

} // namespace

const char* to_string(PairReason reason) {
    switch (reason) {
    case PairReason::none:
        return "";
    case PairReason::adjacent:
        return "Adjacent";
    case PairReason::always:
        return "Always";
    case PairReason::default_pose:
        return "Default";
    case PairReason::never:
        return "Never";
    }
    return "";
}

double SelfCollisionMatrix::rate_bound() const {
    return -std::expm1(std::log1p(-confidence) / static_cast<double>(samples));
}

double SelfCollisionMatrix::joint_rate_bound() const {
    const auto sampled = std::count_if(pairs.begin(), pairs.end(), [](const LinkPair& pair) {
        return !pair.proved && (pair.reason == PairReason::never || pair.reason == PairReason::always);
    });
    const double each = (1 - confidence) / static_cast<double>(std::max<std::ptrdiff_t>(sampled, 1));
    return -std::expm1(std::log(each) / static_cast<double>(samples));
}

std::size_t SelfCollisionMatrix::count(PairReason reason) const {
    return static_cast<std::size_t>(
        std::count_if(pairs.begin(), pairs.end(), [&](const LinkPair& pair) { return pair.reason == reason; }));
}

SelfCollisionMatrix self_collision_matrix(const Kinematics& kinematics, const CollisionModel& model,
                                          const SelfCollisionOptions& options) {
    require_sensible(kinematics, model, options);
    const Groups groups = groups_of(model);
    SelfCollisionMatrix matrix{pairs_of(groups), kinematics.configuration(options.reference), options.samples,
                               options.confidence};
    parallel_for(matrix.pairs.size(),
                 [&](std::size_t i) { judge_by_proof(matrix.pairs[i], kinematics, groups, options); });
    judge_by_samples(matrix, kinematics, groups, options);
    if (options.cancel && options.cancel->load()) {
        throw Error(ErrorCode::cancelled, "the self-collision matrix was not finished");
    }
    return matrix;
}

} // namespace foam::collision
