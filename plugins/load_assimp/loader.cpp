#include "loader.hpp"

#include "readers.hpp"

#include <fmt/format.h>

#include <fstream>

namespace foam::load_assimp {
namespace {

namespace fs = std::filesystem;

Source read_file(const fs::path& file, std::uintmax_t max_bytes) {
    Source source{file, {}};
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) {
        throw source.error("there is no such file");
    }
    if (!fs::is_regular_file(status)) {
        throw source.error("it is not a regular file");
    }
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) {
        throw source.error(error.message());
    }
    if (size > max_bytes) {
        throw source.error(
            fmt::format("it has {} bytes, more than {}; remedy: simplify the mesh, or raise max_bytes of load.assimp",
                        size, max_bytes));
    }
    if (size == 0) {
        throw source.error("the file is empty");
    }
    source.bytes.resize(size);
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(source.bytes.data(), static_cast<std::streamsize>(size))) {
        throw source.error("it cannot be read; remedy: check its permissions");
    }
    return source;
}

void read_any(const Source& source, MeshBuilder& builder, Context& context) {
    const std::string ending = lower(source.file.extension().string());
    if (ending == ".stl") {
        read_stl(source, builder, context);
    } else if (ending == ".obj") {
        read_obj(source, builder, context);
    } else if (ending == ".off") {
        read_off(source, builder, context);
    } else if (ending == ".ply") {
        read_ply(source, builder, context);
    } else if (ending == ".dae") {
        check_collada(source);
        read_scene(source, builder, context);
    } else if (ending == ".gltf" || ending == ".glb") {
        check_gltf(source, builder);
        read_scene(source, builder, context);
    } else {
        throw source.error(
            fmt::format("meshes of type '{}' are not read; remedy: use stl, obj, dae, ply, off, gltf or glb", ending));
    }
}

std::size_t count_without_area(const Mesh& mesh) {
    std::size_t count = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3& p = mesh.vertices[a];
        count += cross(mesh.vertices[b] - p, mesh.vertices[c] - p) == Vec3{} ? 1 : 0;
    }
    return count;
}

} // namespace

Loader::Loader(const Parameters& parameters)
    : max_triangles_(static_cast<std::size_t>(parameters.integer("max_triangles"))),
      max_bytes_(static_cast<std::uintmax_t>(parameters.integer("max_bytes"))) {}

Mesh Loader::load(const fs::path& file, Context& context) const {
    const Source source = read_file(file, max_bytes_);
    MeshBuilder builder(source, max_triangles_, context);
    try {
        read_any(source, builder, context);
    } catch (const std::bad_alloc&) {
        throw source.error("there is not enough memory for it");
    }
    const std::size_t points = builder.mesh().vertices.size();
    Mesh mesh = builder.take();
    if (mesh.triangles.empty()) {
        throw source.error(
            points == 0
                ? "there are no triangles in it"
                : fmt::format("there are no triangles in it, only {} points; remedy: export a surface", points));
    }
    const std::size_t degenerate = count_without_area(mesh);
    if (degenerate > 0) {
        context.log(Severity::info, fmt::format("{}: {} of {} triangles have no area; they are kept", file.string(),
                                                degenerate, mesh.triangles.size()));
    }
    context.metric("triangles", static_cast<double>(mesh.triangles.size()), "1");
    context.metric("vertices", static_cast<double>(mesh.vertices.size()), "1");
    return mesh;
}

} // namespace foam::load_assimp
