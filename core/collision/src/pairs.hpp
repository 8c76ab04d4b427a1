// What tells of a pair of links whether it can touch: proofs, approaches, samples.
#pragma once

#include "link_shapes.hpp"

#include <foam/base/parallel.hpp>
#include <foam/base/random.hpp>
#include <foam/collision/self_collision.hpp>
#include <foam/robot/internal/chain.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace foam::inline collision::self_collision {

using namespace joint_chain;

/// Returns the freedoms that move the chain, sorted. Precondition: its joints move.
std::vector<std::size_t> freedoms_of(const Chain& chain);

enum class Verdict {
    never,   ///< proved
    always,  ///< proved
    some,    ///< observed both touching and apart
    unknown, ///< not decided within the allowed number of boxes
};

/// Decides by branch and bound over boxes of the values of the joints between the links. In the middle of a box it
/// computes the distance between the links' spheres. Within the box no centre moves farther than a bound from the
/// joints' half ranges and the centre's distances from their axes (displacement bound as in Schwarzer, Saha, Latombe:
/// Adaptive dynamic collision checking for single and multiple articulated robots, IEEE T-RO 2005). If the distance
/// exceeds the displacements of both, the links are apart in the whole box. If an overlap is deeper than that, they
/// touch in the whole box. Any other box is halved. The search ends early where the share of the joint positions that is
/// decided after some hundred boxes shows that a proof would take more than `boxes`.
Verdict touching_verdict(const Kinematics& kinematics, const Chain& chain, const BallGroup& first,
                         const BallGroup& second, std::size_t boxes, const std::atomic<bool>* cancel);

/// Returns whether a configuration was found in which the elements of the two links touch. From the nearest of some random
/// configurations, the search moves one joint at a time as long as the links come nearer, by smaller and smaller steps
/// (Hooke, Jeeves: "Direct search" solution of numerical and statistical problems, JACM 8, 1961). It finds contacts in
/// far smaller parts of the joints' ranges than random samples do; that it finds none is no proof. Precondition: the
/// chain is bounded.
bool touch_somewhere(const Kinematics& kinematics, const joint_chain::Chain& chain, const BallGroup& first,
                     const BallGroup& second, std::uint64_t seed);

/// One entry per link of the robot; empty: it has no elements.
using Groups = std::vector<std::optional<BallGroup>>;
Groups groups_of(const CollisionModel& model);

/// The spheres of all links in one configuration. A link's spheres are transformed at their first use.
class PlacedLinks {
public:
    PlacedLinks(const Kinematics& kinematics, const Groups& groups);
    void place(std::span<const double> configuration);
    bool touching(std::size_t first, std::size_t second);

private:
    const std::vector<Sphere>& spheres(std::size_t link);

    const Kinematics& kinematics_;
    const Groups& groups_;
    std::vector<Pose> poses_;
    std::vector<Sphere> bounds_;
    std::vector<std::vector<Sphere>> spheres_; ///< empty: not transformed yet
    std::vector<Sphere> near_;
};

/// Random configurations in blocks, each with its own stream of random numbers, so that the counts do not depend on the
/// number of threads.
class Samples {
public:
    static constexpr std::size_t block_size = 1024;

    Samples(const Kinematics& kinematics, std::size_t count, std::uint64_t seed, const std::atomic<bool>* cancel)
        : kinematics_(kinematics), count_(count), seed_(seed), cancel_(cancel) {}

    std::size_t blocks() const { return (count_ + block_size - 1) / block_size; }
    /// Returns the number of configurations in the blocks before `block`.
    std::size_t before(std::size_t block) const { return std::min(block * block_size, count_); }
    /// Returns for each pair in how many configurations of the blocks [first, last) it touches. `placed()`: returns an
    /// object with place(configuration) and touching(link, link); there is one a block. O(pairs · configurations).
    template <class Placed>
    std::vector<std::size_t> touching(const LinkPairs& pairs, std::size_t first, std::size_t last,
                                      const Placed& placed) const {
        std::vector<std::vector<std::size_t>> of_block(last - first, std::vector<std::size_t>(pairs.size(), 0));
        parallel_for(last - first, [&](std::size_t i) {
            Random random(derive_seed(seed_, fmt::format("configurations {}", first + i)));
            auto links = placed();
            for (std::size_t k = before(first + i); k < before(first + i + 1) && !cancelled(); ++k) {
                links.place(kinematics_.random_configuration(random));
                for (std::size_t p = 0; p < pairs.size(); ++p) {
                    of_block[i][p] += links.touching(pairs[p].first, pairs[p].second) ? 1 : 0;
                }
            }
        });
        std::vector<std::size_t> counts(pairs.size(), 0);
        for (const std::vector<std::size_t>& block : of_block) {
            for (std::size_t p = 0; p < pairs.size(); ++p) {
                counts[p] += block[p];
            }
        }
        return counts;
    }

private:
    bool cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }

    const Kinematics& kinematics_;
    std::size_t count_;
    std::uint64_t seed_;
    const std::atomic<bool>* cancel_;
};

} // namespace foam::inline collision::self_collision
