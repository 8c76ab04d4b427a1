// Elements of an approximation: how many there are of each kind, their words, and what their checks cost.
#pragma once

#include <foam/geometry/sphere.hpp>
#include <foam/sdk/stage.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// The number of elements of each kind, by Element::Kind.
using KindCounts = std::array<std::size_t, element_kinds>;
KindCounts kinds_of(const Elements& elements);
KindCounts sum_of(const KindCounts& a, const KindCounts& b);

/// Returns the noun of a kind for a number: "capsule", "boxes", "swept boxes".
std::string noun_of(Element::Kind kind, std::size_t count);
/// Returns "3 capsules, 1 box"; "0 spheres" for none.
std::string counts_text(const KindCounts& counts);
/// Returns "spheres", "capsules and boxes".
std::string words_of(const std::vector<Element::Kind>& kinds);
/// Returns the words of all kinds: "sphere", "capsule", …
std::vector<std::string> kind_words();
/// Returns the kinds that the words name, in the order of Element::Kind, each once. Throws Error(usage) for another
/// word. `where`: what the words stand in, for the message: "--with".
std::vector<Element::Kind> kinds_named(const std::vector<std::string>& words, std::string_view where);
/// Returns whether these are spheres alone.
bool spheres_alone(const std::vector<Element::Kind>& kinds);
bool spheres_alone(const KindCounts& counts);
/// Returns whether all of `kinds` are in `known`.
bool knows_all(const std::vector<Element::Kind>& known, const std::vector<Element::Kind>& kinds);

/// Returns the number of elements of each kind that there are, of a class such as nlohmann's: {"capsule": 3}.
template <class Json> Json json_of_kinds(const KindCounts& counts) {
    Json json = Json::object();
    for (std::size_t kind = 0; kind < counts.size(); ++kind) {
        if (counts[kind] > 0) {
            json[to_string(static_cast<Element::Kind>(kind))] = counts[kind];
        }
    }
    return json;
}

/// Throws Error(output) if the files of the writer do not hold the kinds of elements of the model.
void require_held(const StageInfo& writer, const SphereModel& model);

/// Returns what a check of the element costs.
double price_of(const Element& element, const ElementCost& cost);
double price_of(const Elements& elements, const ElementCost& cost);
/// Returns the least price of an element of these kinds: a hull has at least four vertices.
double least_price(const std::vector<Element::Kind>& kinds, const ElementCost& cost);

} // namespace sdk
} // namespace foam
