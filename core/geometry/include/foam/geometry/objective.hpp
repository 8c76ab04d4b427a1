// What covering elements are to minimise.
#pragma once

#include <optional>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// The objective of a search for covering elements; over increasing counts it never becomes worse.
enum class Objective {
    excess,          ///< least excess volume
    protrusion,      ///< least maximum protrusion: the same loss of clearance everywhere
    radius,          ///< smallest largest radius: equal spheres at best (the k-centre problem); for spheres alone
    mean_protrusion, ///< least area-weighted mean protrusion
};

/// Returns the objective with the name above; nothing for any other word.
std::optional<Objective> objective_named(std::string_view name);

} // namespace geometry
} // namespace foam
