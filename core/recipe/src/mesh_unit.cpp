#include <foam/recipe/mesh_unit.hpp>

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/geometry/length.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline recipe {
double MeshUnit::factor() const {
    const std::optional<double> metres = metres_in(unit.value_or("m"));
    if (!metres) {
        throw Error(ErrorCode::usage,
                    fmt::format("unknown unit '{}'; there are: {}", *unit, fmt::join(length_units(), ", ")));
    }
    if (!(scale > 0) || !std::isfinite(scale)) {
        throw Error(ErrorCode::usage, fmt::format("a scale is a number above 0, got {}", scale));
    }
    return *metres * scale;
}

std::string why_refused(const MeshUnit& unit, const std::filesystem::path& file, InputKind kind,
                        const Registry& registry, std::string_view preferred) {
    if (!unit.given()) {
        return "";
    }
    if (kind == InputKind::robot) {
        return fmt::format("{} is no mesh: a robot is in metres, and the scale of a mesh of it stands in the URDF, "
                           "<mesh scale=\"0.001 0.001 0.001\"/>; remedy: give no unit and no scale",
                           file.string());
    }
    const std::string ending = extension_of(file);
    const RegisteredStage* loader = registry.find_for_extension(StageKind::mesh_loader, ending, preferred);
    const std::vector<std::string> own = loader ? loader->info.extensions_with_unit : std::vector<std::string>();
    if (unit.unit && std::find(own.begin(), own.end(), ending) != own.end()) {
        return fmt::format(
            "{} says its unit itself, as every {} does; remedy: give no unit, or a scale if that is wrong",
            file.string(), ending);
    }
    return "";
}

} // namespace foam::recipe
