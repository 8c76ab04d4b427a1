// The self-collision matrix: neighbours first, then samples and proofs of the elements, then the original geometry.
#include "link_shapes.hpp"
#include "pairs.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/collision/self_collision.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace foam::inline collision {

using namespace self_collision;

namespace {

void require_sensible(const Kinematics& kinematics, const CollisionModel& model, const SelfCollisionOptions& options) {
    if (!(options.confidence > 0 && options.confidence < 1)) {
        throw Error(ErrorCode::usage,
                    fmt::format("the confidence must lie between 0 and 1, got {}", options.confidence));
    }
    if (model.elements.size() != kinematics.robot().links.size()) {
        throw Error(ErrorCode::usage, fmt::format("spheres are given for {} links, the robot has {}",
                                                  model.elements.size(), kinematics.robot().links.size()));
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

/// Fills in the reasons of the pairs, in steps from cheap to dear: neighbours, samples of the elements, proofs, samples
/// of the original geometry.
class Judgement {
public:
    Judgement(SelfCollisionMatrix& matrix, const Kinematics& kinematics, const CollisionModel& model,
              const SelfCollisionOptions& options)
        : matrix_(matrix), kinematics_(kinematics), model_(model), options_(options), groups_(groups_of(model)),
          shapes_(model.solids), samples_(kinematics, options.samples, options.seed, options.cancel) {}

    void run() {
        find_adjacent();
        const std::size_t first_blocks = std::min<std::size_t>(samples_.blocks(), 2);
        sample_elements(0, first_blocks);
        progress(0.1);
        prove();
        progress(0.4);
        for (std::size_t block = first_blocks; block < samples_.blocks(); block += blocks_at_once) {
            sample_elements(block, std::min(block + blocks_at_once, samples_.blocks()));
            progress(0.4 + 0.5 * static_cast<double>(block) / static_cast<double>(samples_.blocks()));
        }
        judge_by_samples();
        look_at_geometry();
        judge_by_pose();
        progress(1);
    }

private:
    static constexpr std::size_t blocks_at_once = 8;
    /// Contacts and free configurations after which a rate is known well enough, to about a tenth.
    static constexpr std::size_t enough = 100;
    /// Configurations in which original geometry is tested: it takes a hundred times as long as elements.
    static constexpr std::size_t most_of_geometry = 10 * Samples::block_size;

    using Source = CollisionModel::Source;

    bool stopped() const { return options_.cancel && options_.cancel->load(std::memory_order_relaxed); }
    void progress(double share) const {
        if (options_.progress) {
            options_.progress(share);
        }
    }

    void find_adjacent() {
        const std::vector<bool> have = have_geometry(groups_);
        for (LinkPair& pair : matrix_.pairs) {
            const Chain chain = chain_between(kinematics_, pair.first, pair.second);
            pair.unbounded = chain.unbounded;
            rigid_.push_back(chain.steps.empty()); // across a floating joint it is not asked for
            if (adjacent(kinematics_, have, pair.first, pair.second)) {
                pair.reason = PairReason::adjacent;
            }
        }
    }

    /// Returns whether no more is to be found out about the pair.
    bool settled(const LinkPair& pair) const {
        return pair.reason != PairReason::none || pair.unbounded ||
               (pair.touching >= enough && pair.samples - pair.touching >= enough);
    }

    /// Counts contacts of the elements in blocks [first, last).
    void sample_elements(std::size_t first, std::size_t last) {
        std::vector<LinkPair*> open;
        LinkPairs pairs;
        for (std::size_t i = 0; i < matrix_.pairs.size(); ++i) {
            LinkPair& pair = matrix_.pairs[i];
            if (!settled(pair) && !rigid_[i] && !always_.contains(&pair)) {
                open.push_back(&pair);
                pairs.emplace_back(pair.first, pair.second);
            }
        }
        if (pairs.empty() || first == last) {
            return;
        }
        const auto touching =
            samples_.touching(pairs, first, last, [&] { return PlacedLinks(kinematics_, groups_); });
        for (std::size_t k = 0; k < open.size(); ++k) {
            open[k]->samples += samples_.before(last) - samples_.before(first);
            open[k]->touching += touching[k];
        }
    }

    /// Proves what can be proved of the pairs that touched in all samples or in none.
    void prove() {
        std::vector<Verdict> verdicts(matrix_.pairs.size(), Verdict::unknown);
        parallel_for(matrix_.pairs.size(), [&](std::size_t i) {
            const LinkPair& pair = matrix_.pairs[i];
            const bool some = pair.touching > 0 && pair.touching < pair.samples;
            if (pair.reason == PairReason::none && !pair.unbounded && !some && !stopped()) {
                verdicts[i] = touching_verdict(kinematics_, chain_between(kinematics_, pair.first, pair.second),
                                               *groups_[pair.first], *groups_[pair.second], options_.proof_boxes,
                                               options_.cancel);
            }
        });
        for (std::size_t i = 0; i < verdicts.size(); ++i) {
            LinkPair& pair = matrix_.pairs[i];
            if (verdicts[i] == Verdict::never) {
                pair = {.first = pair.first, .second = pair.second, .reason = PairReason::never, .proved = true};
            } else if (verdicts[i] == Verdict::always) {
                always_.insert(&pair);
                proved_always_.insert(&pair);
            }
        }
    }

    /// Decides the pairs whose elements touched in no sample, and finds those that touched in all.
    void judge_by_samples() {
        std::vector<LinkPair*> apart;
        for (LinkPair& pair : matrix_.pairs) {
            if (pair.samples > 0) { // what is decided has none
                if (pair.touching == 0) {
                    apart.push_back(&pair);
                } else if (pair.touching == pair.samples) {
                    always_.insert(&pair);
                }
            }
        }
        parallel_for(apart.size(), [&](std::size_t i) {
            LinkPair& pair = *apart[i];
            const Chain chain = chain_between(kinematics_, pair.first, pair.second);
            const std::uint64_t seed =
                derive_seed(options_.seed, fmt::format("approach {} {}", pair.first, pair.second));
            pair.found_touching = !stopped() && touch_somewhere(kinematics_, chain, *groups_[pair.first],
                                                                *groups_[pair.second], seed);
            pair.reason = pair.found_touching ? PairReason::none : PairReason::never;
        });
    }

    /// Returns whether the elements of the link contain its original geometry, so that what holds for them where they are
    /// apart holds for it.
    bool contains_geometry(std::size_t link) const {
        return model_.sources[link] == Source::cover || is_geometry(link) || !shapes_.has(link);
    }
    bool is_geometry(std::size_t link) const { return model_.sources[link] == Source::geometry; }

    /// Tests the original geometry: of pairs whose elements always touch, and of pairs whose elements never touch though
    /// they may leave geometry out.
    void look_at_geometry() {
        std::vector<LinkPair*> of_always, of_never;
        for (std::size_t i = 0; i < matrix_.pairs.size(); ++i) {
            LinkPair& pair = matrix_.pairs[i];
            if (always_.contains(&pair)) {
                judge_always(pair, rigid_[i], of_always);
            } else if (pair.reason == PairReason::never &&
                       !(contains_geometry(pair.first) && contains_geometry(pair.second))) {
                of_never.push_back(&pair);
            }
        }
        count_geometry(of_always, [](const LinkPair& pair) {
            return pair.geometry_touching > 0 && pair.geometry_touching < pair.geometry_samples;
        });
        for (LinkPair* pair : of_always) {
            decide_by_geometry(*pair);
        }
        count_geometry(of_never, [](const LinkPair& pair) { return pair.geometry_touching > 0; });
        for (LinkPair* pair : of_never) { // a proof was of elements that may leave geometry out
            pair->proved = false;
            pair->reason = pair->geometry_samples == 0 || pair->geometry_touching > 0 ? PairReason::none : pair->reason;
        }
    }

    /// Returns configurations that random ones hardly meet: the reference pose, all joints at zero, and the limits of the
    /// joints between the links.
    std::vector<std::vector<double>> special_configurations(const LinkPair& pair) const {
        constexpr std::size_t most_joints = 6; // 64 corners
        std::vector<std::vector<double>> special{matrix_.reference, kinematics_.configuration()};
        std::vector<std::size_t> freedoms = freedoms_of(chain_between(kinematics_, pair.first, pair.second));
        freedoms.resize(std::min(freedoms.size(), most_joints));
        for (std::size_t corner = 0; corner < std::size_t{1} << freedoms.size(); ++corner) {
            std::vector<double>& configuration = special.emplace_back(matrix_.reference);
            for (std::size_t k = 0; k < freedoms.size(); ++k) {
                const Freedom& freedom = kinematics_.freedoms()[freedoms[k]];
                configuration[freedoms[k]] = corner >> k & 1 ? freedom.upper : freedom.lower;
            }
        }
        return special;
    }
    /// Returns in how many of the configurations the pair touches.
    template <class Placed>
    static std::size_t count_touching(const LinkPair& pair, const std::vector<std::vector<double>>& configurations,
                                      Placed placed) {
        return static_cast<std::size_t>(
            std::count_if(configurations.begin(), configurations.end(), [&](const std::vector<double>& configuration) {
                placed.place(configuration);
                return placed.touching(pair.first, pair.second);
            }));
    }

    /// Decides a pair whose elements always touch, or adds it to those whose geometry is sampled.
    void judge_always(LinkPair& pair, bool rigid, std::vector<LinkPair*>& sampled) const {
        const std::vector<std::vector<double>> special = special_configurations(pair);
        if (is_geometry(pair.first) && is_geometry(pair.second)) {
            const bool proved = proved_always_.contains(&pair);
            if (!proved && count_touching(pair, special, PlacedLinks(kinematics_, groups_)) < special.size()) {
                return;
            }
            pair = {.first = pair.first, .second = pair.second, .reason = PairReason::always, .proved = proved,
                    .samples = proved ? 0 : pair.samples, .touching = proved ? 0 : pair.touching};
        } else if (rigid) { // there is one configuration of the two
            PlacedShapes placed(kinematics_, shapes_);
            placed.place(kinematics_.configuration());
            pair.geometry_samples = shapes_.has(pair.first) && shapes_.has(pair.second) ? 1 : 0;
            pair.geometry_touching = placed.touching(pair.first, pair.second) ? 1 : 0;
            decide_by_geometry(pair);
        } else if (shapes_.has(pair.first) && shapes_.has(pair.second)) {
            const std::size_t touching = count_touching(pair, special, PlacedShapes(kinematics_, shapes_));
            if (touching < special.size() && touching > 0) {
                pair.geometry_samples = special.size();
                pair.geometry_touching = touching;
                pair.touches_by_elements_alone = true;
            } else {
                sampled.push_back(&pair);
            }
        }
    }

    /// Decides a pair whose elements always touch by the configurations in which its geometry was tested.
    static void decide_by_geometry(LinkPair& pair) {
        const std::size_t tested = pair.geometry_samples, touching = pair.geometry_touching;
        pair.reason = tested == 0          ? PairReason::none
                      : touching == tested ? PairReason::always
                      : touching == 0      ? PairReason::never
                                           : PairReason::none;
        pair.touches_by_elements_alone = touching > 0 && touching < tested;
    }

    /// Counts the contacts of the original geometry of pairs, each until `decided`.
    template <class Decided> void count_geometry(std::vector<LinkPair*> open, const Decided& decided) const {
        const Samples samples(kinematics_, std::min(options_.samples, most_of_geometry), options_.seed,
                              options_.cancel);
        for (std::size_t block = 0; block < samples.blocks() && !open.empty(); ++block) {
            LinkPairs pairs;
            for (const LinkPair* pair : open) {
                pairs.emplace_back(pair->first, pair->second);
            }
            const auto touching = samples.touching(pairs, block, block + 1,
                                                   [&] { return PlacedShapes(kinematics_, shapes_); });
            for (std::size_t k = 0; k < open.size(); ++k) {
                open[k]->geometry_samples += samples.before(block + 1) - samples.before(block);
                open[k]->geometry_touching += touching[k];
            }
            std::erase_if(open, [&](const LinkPair* pair) { return decided(*pair); });
        }
    }

    void judge_by_pose() {
        if (!options_.by_pose) {
            return;
        }
        PlacedShapes placed(kinematics_, shapes_);
        placed.place(matrix_.reference);
        for (LinkPair& pair : matrix_.pairs) {
            if (pair.reason == PairReason::none && !pair.unbounded && placed.touching(pair.first, pair.second)) {
                pair.reason = PairReason::default_pose;
            }
        }
    }

    SelfCollisionMatrix& matrix_;
    const Kinematics& kinematics_;
    const CollisionModel& model_;
    const SelfCollisionOptions& options_;
    const Groups groups_;
    const LinkShapes shapes_;
    const Samples samples_;
    std::vector<bool> rigid_;          ///< of each pair: no joint moves one against the other, but for planar and floating ones
    std::set<const LinkPair*> always_; ///< pairs whose elements touch in every configuration, proved or sampled
    std::set<const LinkPair*> proved_always_;
};

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

double SelfCollisionMatrix::rate_bound(std::size_t tested) const {
    return -std::expm1(std::log1p(-confidence) / static_cast<double>(tested));
}

/// Returns how many pairs never touched in samples, and the least number of samples that one of them has.
static std::pair<std::size_t, std::size_t> never_by_samples(const SelfCollisionMatrix& matrix) {
    std::size_t pairs = 0, least = matrix.samples;
    for (const LinkPair& pair : matrix.pairs) {
        if (!pair.proved && pair.reason == PairReason::never) {
            ++pairs;
            least = pair.geometry_samples > 0 ? std::min(least, pair.geometry_samples) : least;
        }
    }
    return {pairs, least};
}

double SelfCollisionMatrix::rate_bound() const {
    return rate_bound(never_by_samples(*this).second);
}

double SelfCollisionMatrix::joint_rate_bound() const {
    const auto [pairs, least] = never_by_samples(*this);
    const double each = (1 - confidence) / static_cast<double>(std::max<std::size_t>(pairs, 1));
    return -std::expm1(std::log(each) / static_cast<double>(least));
}

std::size_t SelfCollisionMatrix::count(PairReason reason) const {
    return static_cast<std::size_t>(
        std::count_if(pairs.begin(), pairs.end(), [&](const LinkPair& pair) { return pair.reason == reason; }));
}

SelfCollisionMatrix self_collision_matrix(const Kinematics& kinematics, const CollisionModel& model,
                                          const SelfCollisionOptions& options) {
    require_sensible(kinematics, model, options);
    SelfCollisionMatrix matrix{pairs_of(groups_of(model)), kinematics.configuration(options.reference), options.samples,
                               options.confidence};
    Judgement(matrix, kinematics, model, options).run();
    if (options.cancel && options.cancel->load()) {
        throw Error(ErrorCode::cancelled, "the self-collision matrix was not finished");
    }
    return matrix;
}

} // namespace foam::collision
