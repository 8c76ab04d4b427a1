#include "readers.hpp"

#include <foam/base/text.hpp>
#include <fmt/format.h>

#include <map>

namespace foam::load_mesh {

void read_any(const Source& source, MeshBuilder& builder, Context& context) {
    using Reader = void (*)(const Source&, MeshBuilder&, Context&);
    static const std::map<std::string_view, Reader> readers{
        {".stl", read_stl},     {".obj", read_obj},   {".off", read_off}, {".ply", read_ply},
        {".dae", read_collada}, {".gltf", read_gltf}, {".glb", read_gltf}};
    const std::string ending = lower_case(source.file.extension().string());
    const auto reader = readers.find(ending);
    if (reader == readers.end()) {
        throw source.error(
            fmt::format("meshes of type '{}' are not read; remedy: use stl, obj, dae, ply, off, gltf or glb", ending));
    }
    reader->second(source, builder, context);
}

} // namespace foam::load_mesh
