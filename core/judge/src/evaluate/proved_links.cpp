// What the proofs of single links say of the robot.
#include <foam/judge/evaluate.hpp>

namespace foam::inline judge {

ProvedLinks proved_links(const Original& original, const std::vector<bool>& proved, Guarantee guarantee) {
    ProvedLinks links;
    links.guarantee = guarantee;
    links.geometry = original.geometry;
    links.visual_only = visual_only_links(*original.robot);
    links.collision_only = original.collision_only;
    std::size_t next = 0; // of those that are judged, in the robot's order
    for (const Link& link : original.robot->links) {
        if (link.collisions.empty()) {
            continue;
        }
        ++links.with_geometry;
        if (next == original.links.size() || original.links[next].link != link.name) {
            links.left_out.push_back({link.name, "excluded by --link"});
        } else if (proved[next++]) {
            ++links.proved;
        } else {
            links.left_out.push_back({link.name, proof_fails});
        }
    }
    return links;
}

std::vector<bool> certified_links(const Evaluation& evaluation) {
    std::vector<bool> certified;
    for (const Figures& figures : evaluation.links) {
        certified.push_back(figures.measures.certified);
    }
    return certified;
}

} // namespace foam::inline judge
