#include "poses_text.hpp"

#include "table.hpp"

#include <algorithm>
#include <vector>

namespace foam::cli {
namespace {

constexpr std::size_t most_rows = 10;

std::string share(std::size_t count, std::size_t of) {
    return fmt::format("{:>9}  {:>6.2f} %", count,
                       of > 0 ? 100 * static_cast<double>(count) / static_cast<double>(of) : 0.0);
}

std::string more(std::size_t rows, const char* noun) {
    return rows > most_rows ? fmt::format("{} more {} (--json lists them)\n", rows - most_rows, noun) : "";
}

std::string pairs_text(const Robot& robot, const Consequences& found) {
    std::vector<PairConsequence> pairs;
    std::copy_if(found.pairs.begin(), found.pairs.end(), std::back_inserter(pairs),
                 [](const PairConsequence& pair) { return pair.missed > 0 || pair.false_contacts > 0; });
    std::stable_sort(pairs.begin(), pairs.end(), [](const PairConsequence& a, const PairConsequence& b) {
        return std::pair(a.missed, a.false_contacts) > std::pair(b.missed, b.false_contacts);
    });
    if (pairs.empty()) {
        return {};
    }
    const auto first = [&](const PairConsequence& pair) { return robot.links[pair.first].name; };
    const auto second = [&](const PairConsequence& pair) { return robot.links[pair.second].name; };
    const std::size_t width = std::max(column_width("link", pairs, first), column_width("link", pairs, second));
    std::string text = fmt::format("\n{:<{}}  {:<{}}  {:>8}  {:>8}  {:>8}\n", "link", width, "link", width, "contacts",
                                   "missed", "false");
    for (std::size_t i = 0; i < std::min(most_rows, pairs.size()); ++i) {
        const PairConsequence& pair = pairs[i];
        text +=
            fmt::format("{}  {}  {:>8}  {:>8}  {:>8}\n", padded(first(pair), width),
                        padded(second(pair), width), pair.contacts, pair.missed, pair.false_contacts);
    }
    return text + more(pairs.size(), "pairs");
}

std::string elements_text(const Robot& robot, const Consequences& found) {
    if (found.elements.empty()) {
        return {};
    }
    const auto name = [&](const ElementConsequence& element) { return robot.links[element.link].name; };
    const std::size_t width = column_width("link", found.elements, name);
    std::string text = fmt::format("\n{:<{}}  {:>8}  {:>8}\n", "link", width, "element", "false");
    for (std::size_t i = 0; i < std::min(most_rows, found.elements.size()); ++i) {
        const ElementConsequence& element = found.elements[i];
        text += fmt::format("{}  {:>8}  {:>8}\n", padded(name(element), width), element.element,
                            element.false_contacts);
    }
    return text + more(found.elements.size(), "elements");
}

} // namespace

std::string poses_text(const Robot& robot, const Consequences& found) {
    std::string text = fmt::format("{}, {} of links\n", counted(found.poses, "pose"), counted(found.pairs.size(), "pair"));
    text += fmt::format("in contact       {}  the geometry of a pair touches\n", share(found.in_contact, found.poses));
    text += fmt::format("refused          {}  the model of a pair touches\n", share(found.refused, found.poses));
    text += fmt::format("falsely refused  {}  the model touches, no geometry does\n",
                        share(found.falsely_refused, found.poses));
    text += fmt::format("missed           {}  geometry touches, no model does\n", share(found.missed, found.poses));
    return text + pairs_text(robot, found) + elements_text(robot, found);
}

} // namespace foam::cli
