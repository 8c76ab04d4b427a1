#include "link_shapes.hpp"
#include "pairs.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/random.hpp>
#include <foam/base/text.hpp>
#include <foam/collision/consequences.hpp>
#include <foam/collision/reference_pose.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace foam::inline collision {
namespace {

/// Poses of one robot, and which links touch in them.
class Poses {
public:
    Poses(const Kinematics& kinematics, const LinkSolids& solids)
        : kinematics_(kinematics), shapes_(solids), placed_(kinematics, shapes_),
          pairs_(pairs_apart(kinematics, shapes_)) {}

    /// Returns the pairs that touch, but not in every configuration.
    LinkPairs touching(const std::vector<double>& configuration) {
        check_cancelled();
        LinkPairs found;
        placed_.place(configuration);
        std::copy_if(pairs_.begin(), pairs_.end(), std::back_inserter(found),
                     [&](const auto& pair) { return placed_.touching(pair.first, pair.second); });
        if (!found.empty()) {
            const LinkPairs& always = always_touching(found);
            std::erase_if(found,
                          [&](const auto& pair) { return std::binary_search(always.begin(), always.end(), pair); });
        }
        return found;
    }
    /// Returns whether no pair touches that can be apart. Ends at the first that does.
    bool free(const std::vector<double>& configuration) {
        if (!always_) {
            return touching(configuration).empty();
        }
        check_cancelled();
        placed_.place(configuration);
        return std::none_of(pairs_.begin(), pairs_.end(), [&](const auto& pair) {
            return placed_.touching(pair.first, pair.second) &&
                   !std::binary_search(always_->begin(), always_->end(), pair);
        });
    }

private:
    /// Returns the pairs that touch in every configuration, of all pairs: those that touch in one are asked about once.
    const LinkPairs& always_touching(const LinkPairs& found) {
        constexpr std::size_t tried = 256;
        if (!always_) {
            always_ = touching_in_all(kinematics_, shapes_, found, random_configurations(kinematics_, tried, 0));
        }
        return *always_;
    }

    const Kinematics& kinematics_;
    const LinkShapes shapes_;
    PlacedShapes placed_;
    LinkPairs pairs_;
    /// Pairs that touch in every configuration. They touch in the first that was asked about, so they are found there.
    std::optional<LinkPairs> always_;
};

/// Moves joints of a free configuration back to `zero`, one after the other, as long as it stays free.
std::vector<double> with_few_moved(Poses& poses, std::vector<double> configuration, const std::vector<double>& zero) {
    for (std::size_t i = 0; i < configuration.size(); ++i) {
        const double before = configuration[i];
        configuration[i] = zero[i];
        if (!poses.free(configuration)) {
            configuration[i] = before;
        }
    }
    return configuration;
}

std::vector<double> middle_of(const Kinematics& kinematics) {
    std::vector<double> middle;
    for (const Freedom& freedom : kinematics.freedoms()) {
        middle.push_back((freedom.lower + freedom.upper) / 2);
    }
    return middle;
}

/// Returns a configuration between the limits at the joints that move one link of the pair against the other, else `at`.
std::vector<double> redrawn(const Kinematics& kinematics, const std::pair<std::size_t, std::size_t>& pair,
                            std::vector<double> at, const std::vector<bool>& held, Random& random) {
    const std::vector<double> drawn = kinematics.random_configuration(random);
    const auto chain = joint_chain::chain_between(kinematics, pair.first, pair.second);
    for (const std::size_t f : self_collision::freedoms_of(chain)) {
        at[f] = held[f] ? at[f] : drawn[f];
    }
    return at;
}

/// Returns a free configuration, or nothing: again and again one touching pair is drawn apart, and the draw is kept unless
/// more pairs touch then. Robots with many limbs are hardly ever free if all joints are drawn at once.
std::optional<std::vector<double>> freed_pair_by_pair(Poses& poses, const Kinematics& kinematics,
                                                      std::vector<double> configuration, const std::vector<bool>& held,
                                                      Random& random) {
    constexpr int tries = 512;
    LinkPairs touching = poses.touching(configuration);
    for (int i = 0; i < tries && !touching.empty(); ++i) {
        std::vector<double> other =
            redrawn(kinematics, touching[random.below(touching.size())], configuration, held, random);
        LinkPairs left = poses.touching(other);
        if (left.size() <= touching.size()) {
            configuration = std::move(other);
            touching = std::move(left);
        }
    }
    return touching.empty() ? std::optional(std::move(configuration)) : std::nullopt;
}

/// Returns a free configuration with few joints away from zero; nothing if none is found. The middle of the ranges comes
/// first: it is far from contacts near the limits.
std::optional<std::vector<double>> found_free(Poses& poses, const Kinematics& kinematics,
                                              const std::vector<double>& zero, const std::vector<bool>& held,
                                              std::uint64_t seed) {
    constexpr int tries = 256;
    Random random(derive_seed(seed, "reference pose"));
    for (int i = 0; i < tries; ++i) {
        std::vector<double> configuration = i == 0 ? middle_of(kinematics) : kinematics.random_configuration(random);
        for (std::size_t f = 0; f < zero.size(); ++f) {
            configuration[f] = held[f] ? zero[f] : configuration[f];
        }
        if (poses.free(configuration)) {
            return with_few_moved(poses, std::move(configuration), zero);
        }
    }
    auto freed = freed_pair_by_pair(poses, kinematics, zero, held, random);
    return freed ? std::optional(with_few_moved(poses, std::move(*freed), zero)) : std::nullopt;
}

std::vector<bool> freedoms_held(const Kinematics& kinematics, const JointValues& values) {
    std::vector<bool> held;
    for (const Freedom& freedom : kinematics.freedoms()) {
        held.push_back(values.contains(freedom.joint));
    }
    return held;
}

/// Returns the values of joints that move and mimic no other.
JointValues of_freedoms(const Kinematics& kinematics, const JointValues& values) {
    JointValues result;
    for (const Freedom& freedom : kinematics.freedoms()) {
        if (const auto value = values.find(freedom.joint); value != values.end()) {
            result.insert(*value);
        }
    }
    return result;
}

/// Returns the first freedom whose value is beyond its limits; null: there is none.
const Freedom* first_beyond_limits(const Kinematics& kinematics, const JointValues& values) {
    for (const Freedom& freedom : kinematics.freedoms()) {
        const auto value = values.find(freedom.joint);
        if (value != values.end() && !(value->second >= freedom.lower && value->second <= freedom.upper)) {
            return &freedom;
        }
    }
    return nullptr;
}

void require_within_limits(const Kinematics& kinematics, const JointValues& values) {
    if (const Freedom* freedom = first_beyond_limits(kinematics, values)) {
        throw Error(ErrorCode::usage,
                    fmt::format("joint '{}' at {} is beyond its limits, {:.6g} to {:.6g}", shown(freedom->joint),
                                values.at(freedom->joint), freedom->lower, freedom->upper));
    }
}

/// Returns the first state that is free; else the first that is free with other joints moved, for a state of an arm leaves
/// the joints of its hand open.
std::optional<ReferenceConfiguration> named_configuration(Poses& poses, const Kinematics& kinematics,
                                                          const ReferencePoseOptions& options) {
    for (const bool move_others : {false, true}) {
        for (const GroupState& named : options.named) {
            JointValues own = of_freedoms(kinematics, named.values);
            if (own.empty() || first_beyond_limits(kinematics, own)) {
                continue;
            }
            JointValues values = options.held;
            values.merge(own);
            const std::vector<double> start = kinematics.configuration(values);
            const auto free =
                move_others         ? found_free(poses, kinematics, start, freedoms_held(kinematics, values), options.seed)
                : poses.free(start) ? std::optional(start)
                                    : std::nullopt;
            if (free) {
                return ReferenceConfiguration{*free, ReferenceConfiguration::Source::named, named.name, {}};
            }
        }
    }
    return std::nullopt;
}

} // namespace

ReferenceConfiguration reference_configuration(const Kinematics& kinematics, const LinkSolids& solids,
                                               const ReferencePoseOptions& options) {
    using Source = ReferenceConfiguration::Source;
    Poses poses(kinematics, solids);
    if (!options.given.empty()) {
        require_within_limits(kinematics, options.given);
        const std::vector<double> configuration = kinematics.configuration(options.given);
        return {configuration, Source::given, "", poses.touching(configuration)};
    }
    if (auto named = named_configuration(poses, kinematics, options)) {
        return std::move(*named);
    }
    const std::vector<double> zero = kinematics.configuration(options.held);
    const LinkPairs touching = poses.touching(zero);
    if (touching.empty()) {
        return {zero, Source::zero, "", {}};
    }
    const auto found =
        found_free(poses, kinematics, zero, freedoms_held(kinematics, options.held), options.seed);
    return found ? ReferenceConfiguration{*found, Source::found, "", {}}
                 : ReferenceConfiguration{zero, Source::worst, "", touching};
}

JointValues moved_joints(const Kinematics& kinematics, const std::vector<double>& configuration) {
    const std::vector<double> zero = kinematics.configuration();
    JointValues moved;
    for (std::size_t i = 0; i < zero.size(); ++i) {
        if (configuration[i] != zero[i]) {
            moved[kinematics.freedoms()[i].joint] = configuration[i];
        }
    }
    return moved;
}

std::string sentence_about(const Kinematics& kinematics, const ReferenceConfiguration& reference) {
    using Source = ReferenceConfiguration::Source;
    std::vector<std::string> joints, pairs;
    for (const auto& [joint, value] : moved_joints(kinematics, reference.configuration)) {
        joints.push_back(fmt::format("{} {:.4g}", shown(joint), value));
    }
    constexpr std::size_t most_named = 5;
    for (const auto& [a, b] : reference.touching) {
        if (pairs.size() == most_named) {
            pairs.push_back(fmt::format("{} more pairs", reference.touching.size() - most_named));
            break;
        }
        pairs.push_back(fmt::format("{} and {}", shown(kinematics.robot().links[a].name),
                                    shown(kinematics.robot().links[b].name)));
    }
    const std::string where = joints.empty() ? "all joints at zero" : fmt::format("{}", fmt::join(joints, ", "));
    const std::string what = reference.source == Source::given   ? "as given"
                             : reference.source == Source::named ? fmt::format("'{}'", shown(reference.name))
                             : reference.source == Source::found
                                 ? "found, for links touch with all joints at zero"
                             : reference.source == Source::worst
                                 ? "none without contact was found; moved into the limits"
                                 : "moved into the limits";
    return fmt::format("reference pose ({}): {}{}", what, where,
                       pairs.empty() ? ""
                                     : fmt::format("; the geometry of these links touches in it: {}",
                                                   fmt::join(pairs, ", ")));
}

} // namespace foam::inline collision
