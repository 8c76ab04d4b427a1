#include "promises.hpp"
#include "targets.hpp"

#include <foam/geometry/vector.hpp>

#include <load_mesh/readers.hpp>

namespace foam::fuzz {
namespace {

/// Small, so that what is slow or large only because it was asked for is no finding.
constexpr load_mesh::Limits limits{
    .max_triangles = 20'000, .max_bytes = std::uintmax_t{1} << 20, .polygon_work = 2'000'000};

void check(const Mesh& mesh) {
    promise(mesh.triangles.size() <= limits.max_triangles, "more triangles than allowed");
    for (const Vec3& vertex : mesh.vertices) {
        promise(is_finite(vertex), "a vertex that is not finite");
    }
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            promise(corner < mesh.vertices.size(), "a corner that is no vertex");
        }
    }
}

void read_as(const char* name, std::string_view bytes) {
    QuietContext context;
    const load_mesh::Source source{name, std::string(bytes)};
    load_mesh::MeshBuilder builder(source, limits, context);
    try {
        load_mesh::read_any(source, builder, context);
        check(builder.take());
    } catch (const Error& error) {
        check_refusal(error, name);
    }
}

} // namespace

void read_stl(std::string_view bytes) {
    read_as("fuzz.stl", bytes);
}
void read_obj(std::string_view bytes) {
    read_as("fuzz.obj", bytes);
}
void read_off(std::string_view bytes) {
    read_as("fuzz.off", bytes);
}
void read_ply(std::string_view bytes) {
    read_as("fuzz.ply", bytes);
}
void read_dae(std::string_view bytes) {
    read_as("fuzz.dae", bytes);
}
void read_gltf(std::string_view bytes) {
    read_as("fuzz.gltf", bytes);
}

} // namespace foam::fuzz
