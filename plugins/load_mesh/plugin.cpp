// load.mesh: from a mesh file to a Mesh.
//
// Each format has its own reader. Readers calculate in double precision, so that a part far from its origin keeps its
// shape. They trust no count or index of the file, and name the place of an error.
//
// A mesh has every triangle of the file, also degenerate ones, in the order of the file. Vertices with identical
// coordinates become one. Normals and texture coordinates are left out; colours are for pictures only (MeshColours).
#include <foam/sdk/plugin.hpp>

#include "builder.hpp"
#include "readers.hpp"

#include <foam/base/file.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>

namespace foam::load_mesh {
namespace {

class Loader final : public MeshLoader, public MeshColours {
public:
    explicit Loader(const Parameters& parameters);
    Mesh load(const std::filesystem::path& file, Context& context) const override;
    std::vector<std::uint32_t> colours(const std::filesystem::path& file, Context& context) const override;

private:
    Source source_of(const std::filesystem::path& file) const;

    Limits limits_;
};

std::size_t count_without_area(const Mesh& mesh) {
    std::size_t count = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3& p = mesh.vertices[a];
        count += cross(mesh.vertices[b] - p, mesh.vertices[c] - p) == Vec3{} ? 1 : 0;
    }
    return count;
}

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

} // namespace
} // namespace foam::load_mesh

FOAM_PLUGIN("load_mesh", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::load_mesh::Loader>(
        {.name = "load.mesh",
         .summary = "Reads triangle meshes in double precision: STL, OBJ, PLY, OFF, COLLADA and glTF 2.0.",
         .parameters = {Parameter::integer("max_triangles", 20'000'000)
                            .unit("1")
                            .bounds(1, 1'000'000'000)
                            .doc("A file with more triangles is refused.")
                            .source("about 2 GB of memory in the stages that follow"),
                        Parameter::integer("max_bytes", std::int64_t{1} << 30)
                            .unit("B")
                            .bounds(1, 1e12)
                            .doc("A larger file is refused before it is read.")
                            .source("a binary STL of 20 million triangles is 1 GB")},
         .extensions = {"stl", "obj", "dae", "ply", "off", "gltf", "glb"},
         .extensions_with_unit = {"dae", "gltf", "glb"}});
}
