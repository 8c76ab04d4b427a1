#include <foam/recipe/internal/keys.hpp>

#include <foam/base/text.hpp>
#include <foam/geometry/length.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

namespace foam::inline recipe::reading {
namespace {

template <class T> struct ValueOf { using type = T; };
template <class T> struct ValueOf<std::optional<T>> { using type = T; };

template <class V> V converted(const ParameterValue& value) {
    if constexpr (std::is_same_v<V, bool> || std::is_same_v<V, double> || std::is_same_v<V, std::string>) {
        return std::get<V>(value);
    } else {
        return static_cast<V>(std::get<std::int64_t>(value));
    }
}

template <class V> ParameterValue as_value(const V& value) {
    if constexpr (std::is_integral_v<V> && !std::is_same_v<V, bool>) {
        return static_cast<std::int64_t>(value);
    } else {
        return value;
    }
}

/// Returns a key whose value the member holds; an optional member without a value: the key is absent.
template <class T, class M> KeyOf<T> held(Parameter declared, M T::*member) {
    using V = typename ValueOf<M>::type;
    return {std::move(declared),
            [member](T& holder, const ParameterValue& value) { holder.*member = converted<V>(value); },
            [member](const T& holder) -> std::optional<ParameterValue> {
                if constexpr (std::is_same_v<M, V>) {
                    return as_value(holder.*member);
                } else {
                    return holder.*member ? std::optional(as_value(*(holder.*member))) : std::nullopt;
                }
            }};
}

/// Returns the same for a key that is no setting of the result.
template <class T, class M> KeyOf<T> without_effect(Parameter declared, M T::*member) {
    KeyOf<T> key = held(std::move(declared), member);
    key.affects_result = false;
    return key;
}

/// Returns a key whose choices are the values of an enumeration, in their order.
template <class T, class E> KeyOf<T> choice(Parameter declared, E T::*member) {
    const std::vector<std::string> choices = declared.choices;
    return {std::move(declared),
            [member, choices](T& holder, const ParameterValue& value) {
                const auto at = std::find(choices.begin(), choices.end(), std::get<std::string>(value));
                holder.*member = static_cast<E>(at - choices.begin());
            },
            [member, choices](const T& holder) -> std::optional<ParameterValue> {
                return choices.at(static_cast<std::size_t>(holder.*member));
            }};
}

template <class V, class M>
LinkKey of_link(Parameter declared, std::optional<V> LinkOverride::*given, M Recipe::LinkRecipe::*merged) {
    return {held(std::move(declared), given), [given, merged](const LinkOverride& link, Recipe::LinkRecipe& result) {
                if (link.*given) {
                    result.*merged = *(link.*given);
                }
            }};
}

/// Returns a key whose choices are the values of an enumeration, in their order; it may be absent.
template <class T, class E> KeyOf<T> choice(Parameter declared, std::optional<E> T::*member) {
    const std::vector<std::string> choices = declared.choices;
    return {std::move(declared),
            [member, choices](T& holder, const ParameterValue& value) {
                const auto at = std::find(choices.begin(), choices.end(), std::get<std::string>(value));
                holder.*member = static_cast<E>(at - choices.begin());
            },
            [member, choices](const T& holder) -> std::optional<ParameterValue> {
                return holder.*member
                           ? std::optional<ParameterValue>(choices.at(static_cast<std::size_t>(*(holder.*member))))
                           : std::nullopt;
            }};
}

Parameter inside_of_hollow(const char* of) {
    return Parameter::choice("hollow", {"keep", "fill"}, "keep")
        .doc(fmt::format(
            "fill: the inside of hollow geometry of {} counts as geometry in figures and in the allocation; "
            "the proof is of the geometry as it is. Absent: keep.",
            of));
}

Parameter held_by_covers(const char* of) {
    return Parameter::choice("covers", {"solid", "surface"}, "solid")
        .doc(fmt::format("What the elements of {} hold, and what is proved: solid: all of it, with its inside, but of open "
                         "meshes the surface; surface: the surface alone. Absent: solid.",
                         of));
}

Parameter padding(const char* of) {
    return Parameter::number("pad", 0).at_least(0).unit("m").doc(
        fmt::format("Length that is added to all radii of {}, after the proof; absent: 0.", of));
}

/// Returns `links: {…: {spheres: N}}`, which sets both limits of the count.
LinkKey number_of_spheres() {
    return {held(Parameter::integer("spheres", 1)
                     .at_least(1)
                     .unit("1")
                     .doc("Number of spheres of each of these links: min_spheres and max_spheres."),
                 &LinkOverride::spheres),
            [](const LinkOverride& link, Recipe::LinkRecipe& result) {
                if (link.spheres) {
                    result.min_spheres = *link.spheres;
                    result.max_spheres = link.spheres;
                }
            }};
}

/// Returns `links: {…: {collision: none}}`.
LinkKey collision_in_output() {
    return {{Parameter::choice("collision", {"spheres", "none"}, "spheres")
                 .doc("none: these links get no spheres, and the output has no collision geometry for them."),
             [](LinkOverride& link, const ParameterValue& value) {
                 link.no_collision = std::get<std::string>(value) == "none";
             },
             [](const LinkOverride& link) -> std::optional<ParameterValue> {
                 return link.no_collision
                            ? std::optional<ParameterValue>(std::string(*link.no_collision ? "none" : "spheres"))
                            : std::nullopt;
             }},
            [](const LinkOverride& link, Recipe::LinkRecipe& result) {
                result.no_collision = link.no_collision.value_or(result.no_collision);
            }};
}

} // namespace

const std::vector<KeyOf<Recipe>>& top_level_keys() {
    static const std::vector<KeyOf<Recipe>> keys{
        held(Parameter::text("name", "")
                 .doc("Name of the run's folder; absent: the recipe's file name without its ending."),
             &Recipe::name),
        held(Parameter::integer("seed", 0).at_least(0).doc("Seed of all random choices."), &Recipe::seed),
        KeyOf<Recipe>{
            Parameter::choice("unit", length_units(), "m")
                .doc("Unit of a single mesh, for formats without a unit; absent: m."),
            [](Recipe& recipe, const ParameterValue& value) { recipe.mesh_unit.unit = std::get<std::string>(value); },
            [](const Recipe& recipe) -> std::optional<ParameterValue> { return recipe.mesh_unit.unit; }},
        KeyOf<Recipe>{
            Parameter::number("scale", 1)
                .bounds(1e-12, 1e12)
                .unit("1")
                .doc("Scale factor of a single mesh, in addition to its unit; absent: 1."),
            [](Recipe& recipe, const ParameterValue& value) { recipe.mesh_unit.scale = std::get<double>(value); },
            [](const Recipe& recipe) -> std::optional<ParameterValue> {
                return recipe.mesh_unit.scale == 1 ? std::optional<ParameterValue>() : recipe.mesh_unit.scale;
            }},
        KeyOf<Recipe>{Parameter::choice("per", {"link", "collision"}, "link")
                          .doc("Spherize each link as one solid, or every collision element on its own."),
                      [](Recipe& recipe, const ParameterValue& value) {
                          recipe.per_link = std::get<std::string>(value) == "link";
                      },
                      [](const Recipe& recipe) -> std::optional<ParameterValue> {
                          return std::string(recipe.per_link ? "link" : "collision");
                      }},
        choice(Parameter::choice("guarantee", {"outer", "inner", "fitted"}, "outer")
                   .doc("outer: the spheres are proved to cover the geometry; inner: the spheres are proved to lie "
                        "inside the "
                        "geometry; fitted: neither is proved."),
               &Recipe::guarantee),
        choice(Parameter::choice("cover", words_of_covered_geometry(), "collision")
                   .doc("The geometry of a robot that the spheres cover; absent: collision."),
               &Recipe::cover),
        held(padding("the robot"), &Recipe::pad),
        choice(inside_of_hollow("the robot"), &Recipe::hollow),
        choice(held_by_covers("the robot"), &Recipe::covers),
        KeyOf<Recipe>{
            Parameter::choice("numbers", {"float64", "float32"}, "float64")
                .doc("The numbers on which the guarantee is proved: float64: as written; float32: also as a program "
                     "holds them that reads single precision. Absent: float32 if such a program reads an output."),
            [](Recipe& recipe, const ParameterValue& value) {
                recipe.numbers = std::get<std::string>(value) == "float32" ? Numbers::float32 : Numbers::float64;
            },
            [](const Recipe& recipe) -> std::optional<ParameterValue> {
                return recipe.numbers ? std::optional<ParameterValue>(
                                            std::string(*recipe.numbers == Numbers::float32 ? "float32" : "float64"))
                                      : std::nullopt;
            }},
        choice(Parameter::choice("on_error", {"stop", "skip", "fallback"}, "stop")
                   .doc("When a link fails: stop the run, skip the link, or replace it by one enclosing sphere."),
               &Recipe::on_error),
        held(Parameter::boolean("strict", false)
                 .doc("A glob in 'links' that matches no link is an error, not a warning."),
             &Recipe::strict),
    };
    return keys;
}

/// Returns a key of the number of elements, by the word for spheres or for elements of any kind.
static KeyOf<Recipe> number_in_budget(const char* word, const char* doc, bool elements) {
    return {Parameter::integer(word, 1).at_least(1).unit("1").doc(doc),
            [elements](Recipe& recipe, const ParameterValue& value) {
                recipe.budget_spheres = converted<std::size_t>(value);
                recipe.budget_in_elements = elements;
            },
            [elements](const Recipe& recipe) -> std::optional<ParameterValue> {
                return recipe.budget_spheres && recipe.budget_in_elements == elements
                           ? std::optional(as_value(*recipe.budget_spheres))
                           : std::nullopt;
            }};
}

/// Returns the key of one price; a price that is the default is absent.
static KeyOf<Recipe> price(const std::string& word, const std::string& of, double& (*held_in)(ElementCost&)) {
    ElementCost usual;
    const double otherwise = held_in(usual);
    return {Parameter::number(word, otherwise)
                .bounds(0, 1e6)
                .unit("1")
                .doc(fmt::format("Cost of {}; absent: {}.", of, otherwise)),
            [held_in](Recipe& recipe, const ParameterValue& value) {
                held_in(recipe.costs) = std::get<double>(value);
            },
            [held_in, otherwise](const Recipe& recipe) -> std::optional<ParameterValue> {
                ElementCost costs = recipe.costs;
                return held_in(costs) == otherwise ? std::nullopt : std::optional<ParameterValue>(held_in(costs));
            }};
}

const std::vector<KeyOf<Recipe>>& cost_keys() {
    using Kind = Element::Kind;
    const auto of_kind = []<Kind kind>() {
        return price(to_string(kind), "a check of " + with_article(noun_of(kind, 1)),
                     [](ElementCost& cost) -> double& { return cost.of_kind[static_cast<std::size_t>(kind)]; });
    };
    static const std::vector<KeyOf<Recipe>> keys = [&]<std::size_t... kind>(std::index_sequence<kind...>) {
        return std::vector<KeyOf<Recipe>>{of_kind.template operator()<static_cast<Kind>(kind)>()...,
                                          price("hull_vertex", "each vertex of a hull, in addition",
                                                [](ElementCost& cost) -> double& { return cost.of_hull_vertex; })};
    }(std::make_index_sequence<element_kinds>());
    return keys;
}

const std::vector<KeyOf<Recipe>>& budget_keys() {
    static const std::vector<KeyOf<Recipe>> keys{
        number_in_budget("spheres", "Maximum number of spheres of the whole robot.", false),
        number_in_budget("elements", "Maximum number of elements of any kind of the whole robot.", true),
        held(Parameter::number("cost", 1).bounds(0.01, 1e6).unit("1").doc(
                 "Maximum cost of checking all elements of the whole robot, by `costs`; prices of links are "
                 "rounded up to hundredths."),
             &Recipe::budget_cost),
        held(Parameter::number("excess", 0.5)
                 .bounds(1e-6, 1e6)
                 .unit("1")
                 .doc("Excess of the whole robot: volume of the spheres outside the geometry / volume of the geometry. "
                      "The "
                      "fewest spheres that reach it, as far as their number allows."),
             &Recipe::budget_excess),
        held(
            Parameter::number("max_protrusion", 0)
                .at_least(0)
                .unit("m")
                .doc(
                    "Largest distance by which spheres may extend beyond the geometry, as far as the number of spheres "
                    "allows."),
            &Recipe::budget_max_protrusion),
        choice(
            Parameter::choice("share", words_of_share(), "volume")
                .doc("Quantity of each link whose sum over the links is made least. volume: its excess volume; even: "
                     "that volume / the volume of its geometry, so that small links get more spheres; protrusion: "
                     "that volume / the area of its geometry. Absent: volume."),
            &Recipe::budget_share),
        choice(Parameter::choice("for", {"geometry", "poses"}, "geometry")
                   .doc("What the allocation serves. geometry: `share` alone; poses: links whose elements touch in 500 "
                        "random poses, though their geometry does not, get more of the budget where that gives fewer "
                        "such contacts. Absent: geometry."),
               &Recipe::budget_for),
        without_effect(Parameter::number("time_limit", 10)
                           .at_least(0.001)
                           .unit("s")
                           .doc("Time from the start until the best elements so far are written; another run may give "
                                "others. Absent: no limit."),
                       &Recipe::budget_time_limit),
    };
    return keys;
}

const std::vector<KeyOf<Recipe>>& debug_keys() {
    static const std::vector<KeyOf<Recipe>> keys{
        held(Parameter::boolean("meshes", false).doc("Write every link's mesh after each stage."),
             &Recipe::debug_meshes),
        held(Parameter::boolean("snapshots", false).doc("Write pictures of every link: its spheres, and the link after each stage."),
             &Recipe::debug_snapshots),
    };
    return keys;
}

const std::vector<LinkKey>& link_keys() {
    static const std::vector<LinkKey> keys{
        of_link(Parameter::boolean("skip", false).doc("Make no spheres for these links."), &LinkOverride::skip,
                &Recipe::LinkRecipe::skip),
        collision_in_output(),
        number_of_spheres(),
        of_link(Parameter::integer("min_spheres", 1)
                    .at_least(1)
                    .unit("1")
                    .doc("Minimum number of spheres of each of these links."),
                &LinkOverride::min_spheres, &Recipe::LinkRecipe::min_spheres),
        of_link(Parameter::integer("max_spheres", 1)
                    .at_least(1)
                    .unit("1")
                    .doc("Maximum number of spheres of each of these links."),
                &LinkOverride::max_spheres, &Recipe::LinkRecipe::max_spheres),
        of_link(Parameter::number("weight", 1)
                    .bounds(0, 1e6)
                    .unit("1")
                    .doc("Factor of the excess volume of these links in the allocation of spheres."),
                &LinkOverride::weight, &Recipe::LinkRecipe::weight),
        of_link(Parameter::number("max_protrusion", 0)
                    .at_least(0)
                    .unit("m")
                    .doc("As in 'budget', for each of these links."),
                &LinkOverride::max_protrusion, &Recipe::LinkRecipe::max_protrusion),
        of_link(padding("these links, instead of the robot's"), &LinkOverride::pad, &Recipe::LinkRecipe::pad),
        {choice(inside_of_hollow("these links, instead of the robot's"), &LinkOverride::hollow),
         [](const LinkOverride& link, Recipe::LinkRecipe& result) {
             result.hollow = link.hollow.value_or(result.hollow);
         }},
        {choice(held_by_covers("these links, instead of the robot's"), &LinkOverride::covers),
         [](const LinkOverride& link, Recipe::LinkRecipe& result) {
             result.covers = link.covers.value_or(result.covers);
         }},
    };
    return keys;
}

} // namespace foam::inline recipe::reading
