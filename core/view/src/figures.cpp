// What is measured and proved of the spheres of a session.
#include "session_work.hpp"

#include <foam/base/parallel.hpp>
#include <foam/collision/self_collision.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/internal/proof.hpp>
#include <foam/view/session.hpp>

#include <limits>

namespace foam::inline view {
namespace {

/// Few samples: the figures of an edit are wanted at once. `foam evaluate` has the exact ones.
constexpr MeasureOptions quick{
    .seed = 0, .surface_points = 2'000, .volume_rays = 4'000, .volume_points = 20'000, .directions_per_sphere = 200};

constexpr std::size_t directions = 200; ///< of each sphere, for its protrusion

} // namespace

LinkVerdict verdict_of(const Solid& solid, const std::vector<Sphere>& spheres) {
    const Certificate certificate = geometry::prove_cover(solid, spheres).certificate;
    const Measures measures = measure(solid, spheres, quick);
    return {.holds = certificate.holds,
            .witness = certificate.witness,
            .gap = certificate.cavity ? certificate.growth : measures.gap,
            .excess = measures.excess,
            .protrusion = measures.protrusion_max,
            .missing = measures.missing};
}

LinkVerdicts verdicts_of(const ViewedRobot& robot, const Original& original,
                         const std::vector<std::vector<Sphere>>& spheres) {
    LinkVerdicts verdicts(spheres.size());
    parallel_for(original.links.size(), [&](std::size_t i) {
        const std::size_t l = link_index(*robot.robot, original.links[i].link);
        verdicts[l] = verdict_of(*original.links[i].solid, spheres.at(l));
    });
    return verdicts;
}

ModelFigures figures_of(const ViewedRobot& robot, const Original& original,
                        const std::vector<std::vector<Sphere>>& spheres) {
    ModelFigures figures;
    for (const std::vector<Sphere>& link : spheres) {
        figures.protrusions.emplace_back(link.size(), std::numeric_limits<double>::infinity());
    }
    for (const OriginalLink& link : original.links) {
        const std::size_t l = link_index(*robot.robot, link.link);
        figures.protrusions.at(l) = geometry::protrusions(*link.solid, spheres.at(l), directions);
    }
    return figures;
}

LinkPairs ignored_pairs_of(const ViewedRobot& robot, const Original* original,
                           const std::vector<std::vector<Sphere>>& spheres, const std::atomic<bool>* cancel) {
    LinkPairs pairs;
    if (!robot.kinematics) {
        return pairs;
    }
    CollisionModel model;
    model.robot = robot.robot;
    model.elements.assign(spheres.begin(), spheres.end());
    for (const std::vector<Sphere>& link : spheres) {
        model.sources.push_back(link.empty() ? CollisionModel::Source::none : CollisionModel::Source::given);
    }
    model.solids.resize(robot.robot->links.size());
    for (const OriginalLink& link : original ? original->links : std::vector<OriginalLink>{}) {
        const std::size_t l = link_index(*robot.robot, link.link);
        model.solids.at(l) = link.solid;
        if (!spheres.at(l).empty() && certify(*link.solid, spheres.at(l)).holds) {
            model.sources.at(l) = CollisionModel::Source::cover;
        }
    }
    SelfCollisionOptions options;
    options.samples = 10'000;  // pairs are shown, not written: a rate of 3 in 10 000 is fine enough
    options.proof_boxes = 500; // for the same reason few boxes
    options.cancel = cancel;
    for (const LinkPair& pair : self_collision_matrix(*robot.kinematics, model, options).pairs) {
        if (pair.reason != PairReason::none) {
            pairs.emplace_back(pair.first, pair.second);
        }
    }
    return pairs;
}

} // namespace foam::inline view
