// What the proofs of single links say of the robot.
#include <foam/geometry/measure.hpp>
#include <foam/judge/evaluate.hpp>

#include <algorithm>

namespace foam::inline judge {
namespace {

/// Returns the verdict without volumes. `proved`: of each link of the original.
ProvedLinks verdict_on(const Original& original, const MatchedModel& model, const std::vector<bool>& proved,
                       Guarantee guarantee) {
    ProvedLinks links;
    links.guarantee = guarantee;
    links.geometry = original.geometry;
    links.visual_only = visual_only_links(*original.robot);
    links.collision_only = original.collision_only;
    if (!std::all_of(model.elements.begin(), model.elements.end(), std::mem_fn(&Elements::are_spheres))) {
        links.elements = "elements";
    }
    std::size_t next = 0; // of those that are judged, in the robot's order
    for (const Link& link : original.robot->links) {
        if (link.collisions.empty()) {
            continue;
        }
        ++links.with_geometry;
        if (next == original.links.size() || original.links[next].link != link.name) {
            links.left_out.push_back({link.name, "excluded by --keep or --skip"});
        } else if (proved[next++]) {
            ++links.proved;
            const std::string why = why_surface_alone(*original.links[next - 1].solid);
            if (guarantee == Guarantee::outer && !why.empty()) {
                links.as_surface.push_back({link.name, why});
            }
        } else {
            links.left_out.push_back({link.name, model.elements[next - 1].empty() ? no_elements : proof_fails});
        }
    }
    return links;
}

/// Returns the share of the volume of the proved links that lies outside their elements.
double missing_in(const Original& original, const MatchedModel& model, const std::vector<bool>& proved,
                  Guarantee guarantee) {
    double missing = 0, volume = 0;
    for (std::size_t i = 0; i < original.links.size(); ++i) {
        if (proved[i] && !model.elements[i].empty()) {
            const bool by_proof = guarantee == Guarantee::outer && original.links[i].solid->covers() == Covers::solid;
            missing += by_proof ? 0 : missing_volume(*original.links[i].solid, model.elements[i]);
            volume += original.links[i].solid->volume();
        }
    }
    return missing_share(missing, volume);
}

} // namespace

ProvedLinks proved_links(const Original& original, const MatchedModel& model, const std::vector<LinkProof>& proofs,
                         Guarantee guarantee) {
    std::vector<bool> proved;
    for (const LinkProof& proof : proofs) {
        proved.push_back(proof.holds);
    }
    ProvedLinks links = verdict_on(original, model, proved, guarantee);
    links.missing = links.proved > 0 ? missing_in(original, model, proved, guarantee) : 0;
    return links;
}

ProvedLinks proved_links(const Original& original, const MatchedModel& model, const Evaluation& evaluation) {
    std::vector<bool> proved;
    std::vector<Measures> measured;
    for (const Figures& figures : evaluation.links) {
        proved.push_back(figures.measures.certified);
        if (proved.back()) {
            measured.push_back(figures.measures);
        }
    }
    ProvedLinks links = verdict_on(original, model, proved, Guarantee::outer);
    links.missing = total(measured).missing;
    return links;
}

} // namespace foam::inline judge
