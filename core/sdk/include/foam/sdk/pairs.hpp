// Pairs of links that need no check, in a file of the user.
#pragma once

#include <foam/robot/robot.hpp>
#include <foam/sdk/parameter.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

class Context;
struct SphereModel;

/// What a writer does with the pairs in a file of the user (SphereModel::into).
enum class PairEdit {
    keep,    ///< they stay as they are
    merge,   ///< they stay, and those that foam finds beyond them are added
    replace, ///< those that foam finds take their place
};
/// The parameter "pairs" of writers for it.
Parameter pairs_parameter();
PairEdit pair_edit(const Parameters& parameters);

/// What a file of the user says of pairs.
struct StatedPairs {
    std::string file;
    std::vector<IgnoredPair> ignored{}; ///< they need no check
    /// Whether the file has a word of its own on a pair that is not in `ignored`, such as <enable_collisions>; this
    /// word stays.
    std::function<bool(const IgnoredPair&)> decided{};
};

/// Returns the pairs that a writer puts into the file: with merge beside those that are there, with replace in their
/// place; nothing: the file keeps its pairs. Logs how many are kept, added and removed, and the names of what is
/// removed. `found`: SphereModel::ignored_pairs.
std::optional<std::vector<IgnoredPair>> pairs_into(PairEdit edit, const StatedPairs& stated,
                                                   const std::optional<std::vector<IgnoredPair>>& found,
                                                   Context& context);

/// Warns where the pairs that need no check are not known; a model of one link has none.
void warn_without_pairs(const SphereModel& model, Context& context);

} // namespace sdk
} // namespace foam
