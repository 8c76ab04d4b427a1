// What a mesh file does not say of itself: the unit of its numbers.
#pragma once

#include <foam/host/registry.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace foam {

/// How large a single mesh is read; a robot's meshes have their scale in the URDF.
struct MeshUnit {
    std::optional<std::string> unit; ///< one of length_units(); absent: the file's own, or m
    double scale = 1;                ///< besides the unit

    bool given() const { return unit.has_value() || scale != 1; }
    /// What the numbers of the mesh, as its loader gives them, are multiplied by. Throws Error(usage) for a word that
    /// is no unit and a scale that is not above 0.
    double factor() const;
};

enum class InputKind { robot, mesh };
/// Why `file` cannot be read so, with the remedy; empty if it can: a robot is in metres, and some formats of meshes say
/// their unit themselves. `preferred`: the loader that goes first where several read the file's ending.
std::string why_refused(const MeshUnit& unit, const std::filesystem::path& file, InputKind kind,
                        const Registry& registry, std::string_view preferred = {});

} // namespace foam
