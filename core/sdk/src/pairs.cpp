#include <foam/sdk/writing.hpp>

#include <foam/base/text.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/elements.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

namespace foam::inline sdk {
namespace {

using LinkNames = std::set<std::pair<std::string, std::string>>;

std::pair<std::string, std::string> in_order(const IgnoredPair& pair) {
    return std::minmax(pair.first, pair.second);
}

LinkNames links_of(const std::vector<IgnoredPair>& pairs) {
    LinkNames links;
    for (const IgnoredPair& pair : pairs) {
        links.insert(in_order(pair));
    }
    return links;
}

/// Warns of the pairs that `replace` removes. All that may be a decision of the user are named: those without a reason,
/// or with that of the user.
void warn_of_removed(const StatedPairs& stated, const LinkNames& kept, Context& context) {
    constexpr std::size_t most = 20; ///< of other reasons
    std::vector<std::string> names;
    LinkNames seen;
    std::size_t others = 0;
    for (const IgnoredPair& pair : stated.ignored) {
        if (kept.contains(in_order(pair)) || !seen.insert(in_order(pair)).second) {
            continue;
        }
        const bool user = pair.reason.empty() || pair.reason == "User";
        if (user || ++others <= most) {
            names.push_back(fmt::format("{} with {}{}", shown(pair.first), shown(pair.second),
                                        pair.reason.empty() ? "" : fmt::format(" ({})", shown(pair.reason))));
        }
    }
    if (!names.empty()) {
        context.log(
            Severity::warning,
            fmt::format("{}: these pairs are checked from now on, as 'pairs: replace' removes them: {}{}; remedy: "
                        "'pairs: merge' keeps them",
                        stated.file, fmt::join(names, ", "),
                        others > most ? fmt::format(", and {} more", others - most) : ""));
    }
}

} // namespace

Parameter pairs_parameter() {
    return Parameter::choice("pairs", {"keep", "merge", "replace"}, "keep")
        .doc("With 'into': what happens to the pairs of links that the file lists as needing no check. keep: the list "
             "stays as it is; merge: pairs that foam finds are added; replace: foam's list. A whole file has foam's.");
}

PairEdit pair_edit(const Parameters& parameters) {
    const std::string& word = parameters.text("pairs");
    return word == "merge" ? PairEdit::merge : word == "replace" ? PairEdit::replace : PairEdit::keep;
}

std::optional<std::vector<IgnoredPair>> pairs_into(PairEdit edit, const StatedPairs& stated,
                                                   const std::optional<std::vector<IgnoredPair>>& found,
                                                   Context& context) {
    const LinkNames theirs = links_of(stated.ignored);
    if (edit == PairEdit::keep || !found) {
        if (edit != PairEdit::keep) {
            context.log(Severity::warning,
                        fmt::format("{}: the pairs of links that need no check are not known: its own "
                                    "{} stay; remedy: give the robot's URDF",
                                    stated.file, theirs.size()));
        } else if (theirs.empty()) {
            context.log(Severity::warning,
                        fmt::format("{}: it lists no pairs of links that need no check, and gets none; "
                                    "remedy: 'pairs: merge' adds them",
                                    stated.file));
        } else {
            context.log(Severity::info, fmt::format("{}: pairs: {} kept", stated.file, theirs.size()));
        }
        return {};
    }
    std::vector<IgnoredPair> result;
    LinkNames kept = edit == PairEdit::merge ? theirs : LinkNames{};
    std::size_t added = 0;
    for (const IgnoredPair& pair : *found) {
        if (stated.decided && stated.decided(pair)) {
            continue;
        }
        const bool known = theirs.contains(in_order(pair));
        if (known) {
            kept.insert(in_order(pair));
        } else {
            ++added;
        }
        if (edit == PairEdit::replace || !known) {
            result.push_back(pair);
        }
    }
    context.log(Severity::info, fmt::format("{}: pairs: {} kept, {} added, {} removed", stated.file, kept.size(), added,
                                            theirs.size() - kept.size()));
    warn_of_removed(stated, kept, context);
    return result;
}

void warn_without_pairs(const SphereModel& model, Context& context) {
    if (!model.ignored_pairs && elements_by_link(model).size() > 1) {
        context.log(Severity::warning, "the pairs of links that need no check are not known: none is written");
    }
}

} // namespace foam::inline sdk
