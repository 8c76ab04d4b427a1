#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

namespace foam::inline sdk {

static_assert(static_cast<std::size_t>(Element::Kind::sphere) == 0);

KindCounts kinds_of(const Elements& elements) {
    KindCounts counts{};
    counts[static_cast<std::size_t>(Element::Kind::sphere)] = elements.spheres().size();
    for (const Element& element : elements.shaped()) {
        ++counts[static_cast<std::size_t>(element.kind)];
    }
    return counts;
}

KindCounts sum_of(const KindCounts& a, const KindCounts& b) {
    KindCounts sum = a;
    for (std::size_t kind = 0; kind < sum.size(); ++kind) {
        sum[kind] += b[kind];
    }
    return sum;
}

std::string noun_of(Element::Kind kind, std::size_t count) {
    std::string noun = to_string(kind);
    std::replace(noun.begin(), noun.end(), '_', ' ');
    return count == 1 ? noun : noun + (noun.ends_with('x') ? "es" : "s");
}

std::string counts_text(const KindCounts& counts) {
    std::vector<std::string> parts;
    for (std::size_t kind = 0; kind < counts.size(); ++kind) {
        if (counts[kind] > 0) {
            parts.push_back(
                fmt::format("{} {}", counts[kind], noun_of(static_cast<Element::Kind>(kind), counts[kind])));
        }
    }
    return parts.empty() ? "0 spheres" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string words_of(const std::vector<Element::Kind>& kinds) {
    std::string words;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        words += i == 0 ? "" : i + 1 == kinds.size() ? " and " : ", ";
        words += noun_of(kinds[i], 2);
    }
    return words;
}

std::vector<std::string> kind_words() {
    std::vector<std::string> words;
    for (const Element::Kind kind : every_kind()) {
        words.emplace_back(to_string(kind));
    }
    return words;
}

std::vector<Element::Kind> kinds_named(const std::vector<std::string>& words, std::string_view where) {
    std::set<Element::Kind> kinds;
    for (const std::string& word : words) {
        const std::optional<Element::Kind> kind = element_kind_named(word);
        if (!kind) {
            throw Error(
                ErrorCode::usage,
                fmt::format("{}: there is no kind '{}'; there are: {}", where, shown(word), fmt::join(kind_words(), ", ")));
        }
        kinds.insert(*kind);
    }
    return {kinds.begin(), kinds.end()};
}

bool spheres_alone(const std::vector<Element::Kind>& kinds) {
    return std::all_of(kinds.begin(), kinds.end(), [](Element::Kind kind) { return kind == Element::Kind::sphere; });
}

bool spheres_alone(const KindCounts& counts) {
    return std::all_of(counts.begin() + 1, counts.end(), [](std::size_t count) { return count == 0; });
}

bool knows_all(const std::vector<Element::Kind>& known, const std::vector<Element::Kind>& kinds) {
    return std::all_of(kinds.begin(), kinds.end(),
                       [&](Element::Kind kind) { return std::find(known.begin(), known.end(), kind) != known.end(); });
}

void require_held(const StageInfo& writer, const SphereModel& model) {
    if (writer.consumer.elements_optional) {
        return;
    }
    for (const SphereGroup& group : model.groups) {
        for (const Approximation::Level& level : group.tree.levels) {
            for (const Element& element : level.elements.shaped()) {
                if (!knows_all(writer.kinds, {element.kind})) {
                    throw Error(ErrorCode::output,
                                fmt::format("link '{}' has {}, files of {} hold {}; remedy: another output, such as "
                                            "write.json, or a stage that makes these alone",
                                            shown(group.link), counts_text(kinds_of(level.elements)), writer.name,
                                            words_of(writer.kinds)));
                }
            }
        }
    }
}

double price_of(const Element& element, const ElementCost& cost) {
    const double vertices = element.hull ? static_cast<double>(element.hull->surface.vertices.size()) : 0;
    return cost.of_kind[static_cast<std::size_t>(element.kind)] + vertices * cost.of_hull_vertex;
}

double price_of(const Elements& elements, const ElementCost& cost) {
    double sum =
        static_cast<double>(elements.spheres().size()) * cost.of_kind[static_cast<std::size_t>(Element::Kind::sphere)];
    for (const Element& element : elements.shaped()) {
        sum += price_of(element, cost);
    }
    return sum;
}

double least_price(const std::vector<Element::Kind>& kinds, const ElementCost& cost) {
    constexpr double fewest_vertices = 4;
    double least = std::numeric_limits<double>::infinity();
    for (const Element::Kind kind : kinds) {
        const double vertices = kind == Element::Kind::hull ? fewest_vertices * cost.of_hull_vertex : 0;
        least = std::min(least, cost.of_kind[static_cast<std::size_t>(kind)] + vertices);
    }
    return least;
}

} // namespace foam::inline sdk
