// The unit of a mesh file's numbers where the file does not state it.
#pragma once

#include <foam/sdk/registry.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {

/// Unit and scale of a single mesh; a robot's meshes have their scale in the URDF.
struct MeshUnit {
    std::optional<std::string> unit; ///< one of length_units(); absent: the file's own, or m
    double scale = 1;                ///< in addition to the unit

    bool given() const { return unit.has_value() || scale != 1; }
    /// Returns the factor for the mesh's numbers as its loader returns them. Throws Error(usage) for an unknown unit
    /// and for a scale that is not above 0.
    double factor() const;
};

enum class InputKind { robot, mesh };
/// Returns why `file` cannot be read with this unit, with the remedy; empty if it can. A robot is in metres, and some
/// mesh formats state their unit. `preferred`: the loader with precedence where several read the file's ending.
std::string why_refused(const MeshUnit& unit, const std::filesystem::path& file, InputKind kind,
                        const Registry& registry, std::string_view preferred = {});

} // namespace recipe
} // namespace foam
