#include "loader.hpp"

#include "obj_colours.hpp"
#include "readers.hpp"

#include <foam/base/file.hpp>

#include <fmt/format.h>

namespace foam::load_mesh {
namespace {

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
    : limits_{static_cast<std::size_t>(parameters.integer("max_triangles")),
              static_cast<std::uintmax_t>(parameters.integer("max_bytes"))} {}

Source Loader::source_of(const std::filesystem::path& file) const {
    Source source{file, {}};
    FileContents contents = read_regular_file(file, limits_.max_bytes, too_large_remedy);
    if (!contents.problem.empty()) {
        throw source.error(contents.why_not());
    }
    source.bytes = std::move(contents.bytes);
    if (source.bytes.empty()) {
        throw source.error("the file is empty");
    }
    return source;
}

std::vector<std::uint32_t> Loader::colours(const std::filesystem::path& file, Context& context) const {
    const std::string ending = extension_of(file);
    if (ending != "dae" && ending != "obj" && ending != "gltf" && ending != "glb") {
        return {}; // the formats without colours, and those of which they are not read
    }
    const Source source = source_of(file);
    MeshBuilder builder(source, limits_, context);
    if (ending == "obj") {
        builder.name_colours(obj_colours(source));
    }
    read_any(source, builder, context);
    std::vector<std::uint32_t> colours = builder.colours();
    if (!colours.empty()) {
        colours.resize(builder.mesh().triangles.size());
    }
    return colours;
}

Mesh Loader::load(const std::filesystem::path& file, Context& context) const {
    const Source source = source_of(file);
    MeshBuilder builder(source, limits_, context);
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

} // namespace foam::load_mesh
