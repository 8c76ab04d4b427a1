#include "frame.hpp"

#include <algorithm>
#include <array>

namespace foam::load_assimp {
namespace {

/// Formats in metres. COLLADA and IFC: assimp scales to metres; FBX: see below; glTF is in metres.
constexpr std::array<std::string_view, 7> in_metres{"dae", "zae", "gltf", "glb", "fbx", "ifc", "ifczip"};

/// Formats with z up that assimp turns to y up at the root.
constexpr std::array<std::string_view, 7> turned{"3ds", "prj", "ase", "ask", "dxf", "ifc", "ifczip"};

template <class Endings> bool has(const Endings& endings, std::string_view ending) {
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// Maps (x, z, -y) back to (x, y, z).
constexpr Affine turned_back{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}};

/// Returns the UnitScaleFactor of an FBX file, cm; 1 if it has none.
double centimetres(const aiScene& scene) {
    float factor = 1;
    if (scene.mMetaData) {
        scene.mMetaData->Get("UnitScaleFactor", factor);
    }
    return factor;
}

} // namespace

Affine frame_of(const aiScene& scene, std::string_view ending) {
    const Affine frame = has(turned, ending) ? turned_back : Affine{};
    constexpr double centimetre = 0.01;
    return ending == "fbx" ? Affine::scale(centimetre * centimetres(scene)) * frame : frame;
}

std::string_view unit_note(std::string_view ending) {
    return ending == "3mf" || ending == "amf"
               ? "the unit that the file states is not read; its numbers are taken for metres unless the recipe says "
                 "'unit: mm' or another"
               : "";
}

std::span<const std::string_view> endings_with_unit() {
    return in_metres;
}

} // namespace foam::load_assimp
