#include "part.hpp"

#include "readers.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace foam::load_mesh {
namespace {

Vec3 placed(const Part& part, std::size_t i, const Affine& pose) {
    const Vec3 &raw = part.points[i], p = pose * raw;
    if (!is_finite(raw)) {
        throw part.error(i, fmt::format("is not finite: {}; remedy: export the mesh again without it", text_of(raw)));
    }
    if (!is_finite(p)) {
        throw part.error(i, fmt::format("is not finite where its node puts it: {}; remedy: export the mesh again with "
                                        "a smaller scale",
                                        text_of(p)));
    }
    return p;
}

} // namespace

Part compacted(Part part) {
    constexpr std::uint32_t unused = 0xFFFFFFFFu;
    std::vector<std::uint32_t> renumbered(part.points.size(), unused), original;
    std::vector<Vec3> points;
    for (std::uint32_t& corner : part.corners) {
        std::uint32_t& number = renumbered[corner];
        if (number == unused) {
            number = static_cast<std::uint32_t>(points.size());
            points.push_back(part.points[corner]);
            original.push_back(corner);
        }
        corner = number;
    }
    part.points = std::move(points);
    part.error = [original = std::move(original), error = std::move(part.error)](
                     std::size_t i, const std::string& what) { return error(original[i], what); };
    return part;
}

void place(const Part& part, const Affine& pose, MeshBuilder& builder, std::span<const std::uint32_t> colours) {
    constexpr std::uint32_t unused = 0xFFFFFFFFu;
    std::vector<std::uint32_t> vertices(part.points.size(), unused), polygon;
    const bool mirrors = pose.mirrors();
    auto corner = part.corners.begin();
    CancellationCounter asking(4096);
    for (std::size_t p = 0; p < part.sizes.size(); ++p) {
        const std::uint32_t size = part.sizes[p], material = p < part.materials.size() ? part.materials[p] : 0;
        asking.check();
        builder.paint(material < colours.size() ? colours[material] : 0);
        polygon.clear();
        for (const auto end = corner + size; corner != end; ++corner) {
            std::uint32_t& vertex = vertices[*corner];
            vertex = vertex == unused ? builder.vertex(placed(part, *corner, pose)) : vertex;
            polygon.push_back(vertex);
        }
        if (mirrors) {
            std::reverse(polygon.begin(), polygon.end());
        }
        builder.polygon(polygon);
    }
}

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
