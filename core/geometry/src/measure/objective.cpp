#include <foam/geometry/objective.hpp>

#include <algorithm>

namespace foam::inline geometry {

std::optional<Objective> objective_named(std::string_view name) {
    static constexpr std::pair<std::string_view, Objective> objectives[] = {
        {"excess", Objective::excess}, {"protrusion", Objective::protrusion}, {"radius", Objective::radius}};
    const auto it = std::find_if(std::begin(objectives), std::end(objectives),
                                 [&](const auto& objective) { return objective.first == name; });
    return it == std::end(objectives) ? std::nullopt : std::optional(it->second);
}

} // namespace foam::geometry
