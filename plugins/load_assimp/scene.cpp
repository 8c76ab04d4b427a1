#include "scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace foam::load_assimp {
namespace {

/// Largest depth of nested nodes; real scenes have some tens.
constexpr std::size_t deepest = 1000;

constexpr const char* damaged = "; remedy: the file is damaged, export it again";

std::span<const aiFace> faces_of(const aiMesh& mesh) {
    return {mesh.mFaces, mesh.mFaces ? mesh.mNumFaces : 0};
}

void expect_triangles(std::size_t count, std::size_t most) {
    if (count > most) {
        throw BadScene(fmt::format(
            "more than {} triangles; remedy: simplify the mesh, or raise max_triangles of load.assimp", most));
    }
}

/// Returns the number of triangles that the faces of a mesh give.
std::size_t checked_triangles(const aiMesh& mesh) {
    std::size_t count = 0;
    for (const aiFace& face : faces_of(mesh)) {
        if (face.mNumIndices == 0) { // left behind by readers where a file is truncated
            throw BadScene(fmt::format("a face has no corners{}", damaged));
        }
        for (unsigned i = 0; i < face.mNumIndices; ++i) {
            if (!face.mIndices || !mesh.mVertices || face.mIndices[i] >= mesh.mNumVertices) {
                throw BadScene(fmt::format("a face refers to vertex {} of {}{}", face.mIndices ? face.mIndices[i] : 0,
                                           mesh.mVertices ? mesh.mNumVertices : 0, damaged));
            }
        }
        count += face.mNumIndices > 2 ? face.mNumIndices - 2 : 0;
    }
    return count;
}

/// What is left out of a mesh.
struct LeftOut {
    std::size_t lines_and_points = 0, without_area = 0;
    bool deformed = false; ///< bones, morph targets
};

class Collector {
public:
    Collector(const aiScene& scene, std::size_t max_triangles, Context& context)
        : scene_(scene), max_triangles_(max_triangles), context_(context) {}

    void add_node(const aiNode& node, const Affine& place) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const unsigned index = node.mMeshes ? node.mMeshes[i] : scene_.mNumMeshes;
            if (index >= scene_.mNumMeshes || !scene_.mMeshes[index]) {
                throw BadScene(fmt::format("a node refers to mesh {} of {}{}", index, scene_.mNumMeshes, damaged));
            }
            add_mesh(*scene_.mMeshes[index], place);
        }
    }

    Mesh mesh;
    LeftOut left_out;

private:
    void add_mesh(const aiMesh& part, const Affine& place) {
        expect_triangles(mesh.triangles.size() + checked_triangles(part), max_triangles_);
        context_.check_cancelled();
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        if (part.mNumVertices > 0xFFFFFFF0u - first) {
            throw BadScene("more than 2^32 vertices; remedy: simplify the mesh");
        }
        mesh.vertices.reserve(mesh.vertices.size() + part.mNumVertices);
        for (unsigned i = 0; part.mVertices && i < part.mNumVertices; ++i) {
            const aiVector3D& v = part.mVertices[i];
            mesh.vertices.push_back(place({v.x, v.y, v.z}));
        }
        for (const aiFace& face : faces_of(part)) {
            add_face(face, first, place.mirrors());
        }
        left_out.deformed = left_out.deformed || part.mNumBones > 0 || part.mNumAnimMeshes > 0;
    }

    void add_face(const aiFace& face, std::uint32_t first, bool mirrored) {
        if (face.mNumIndices < 3) {
            ++left_out.lines_and_points;
            return;
        }
        if (face.mNumIndices > 3) {
            throw BadScene(fmt::format("assimp cannot cut a polygon of {} corners into triangles; remedy: export "
                                       "triangles",
                                       face.mNumIndices));
        }
        Triangle triangle{first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]};
        if (mirrored) {
            std::swap(triangle[1], triangle[2]);
        }
        for (const std::uint32_t corner : triangle) {
            if (!is_finite(mesh.vertices[corner])) {
                throw BadScene(fmt::format("a vertex is not finite: ({}, {}, {}); remedy: export the mesh again "
                                           "without it",
                                           mesh.vertices[corner].x, mesh.vertices[corner].y, mesh.vertices[corner].z));
            }
        }
        mesh.triangles.push_back(triangle);
    }

    const aiScene& scene_;
    std::size_t max_triangles_;
    Context& context_;
};

/// Calls `visit(node, place)` for every node. Without recursion, because the file determines the depth of nodes.
template <class Visit> void walk(const aiNode& root, const Affine& frame, Visit&& visit) {
    struct Entry {
        const aiNode* node;
        Affine place;
        std::size_t depth;
    };
    std::vector<Entry> open{{&root, frame * Affine::from(root.mTransformation), 1}};
    while (!open.empty()) {
        const Entry entry = open.back();
        open.pop_back();
        if (entry.depth > deepest) {
            throw BadScene(fmt::format("nodes lie more than {} deep in nodes; remedy: flatten the scene", deepest));
        }
        visit(*entry.node, entry.place);
        for (unsigned i = entry.node->mChildren ? entry.node->mNumChildren : 0; i > 0; --i) { // the first comes first
            if (const aiNode* child = entry.node->mChildren[i - 1]) {
                open.push_back({child, entry.place * Affine::from(child->mTransformation), entry.depth + 1});
            }
        }
    }
}

void tell(const LeftOut& left_out, Context& context) {
    if (left_out.lines_and_points > 0) {
        context.log(Severity::info, fmt::format("{} lines and points are left out", left_out.lines_and_points));
    }
    if (left_out.without_area > 0) {
        context.log(Severity::info, fmt::format("{} triangles with equal corners are left out", left_out.without_area));
    }
    if (left_out.deformed) {
        context.log(Severity::info, "bones and morph targets are left out: the mesh is as it was modelled");
    }
}

} // namespace

bool check_faces(const aiScene& scene, std::size_t max_triangles) {
    std::size_t count = 0;
    bool polygons = false;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        if (scene.mMeshes && scene.mMeshes[i]) {
            count += checked_triangles(*scene.mMeshes[i]);
            expect_triangles(count, max_triangles);
            const auto faces = faces_of(*scene.mMeshes[i]);
            polygons = polygons ||
                       std::any_of(faces.begin(), faces.end(), [](const aiFace& face) { return face.mNumIndices > 3; });
        }
    }
    return polygons;
}

Mesh mesh_of(const aiScene& scene, const Affine& frame, std::size_t max_triangles, Context& context) {
    Collector collector(scene, max_triangles, context);
    if (scene.mRootNode) {
        walk(*scene.mRootNode, frame,
             [&](const aiNode& node, const Affine& place) { collector.add_node(node, place); });
    }
    Mesh mesh = welded(collector.mesh);
    collector.left_out.without_area = collector.mesh.triangles.size() - mesh.triangles.size();
    tell(collector.left_out, context);
    if (mesh.triangles.empty()) {
        throw BadScene(collector.left_out.lines_and_points > 0
                           ? "there are no triangles in it, only lines and points; remedy: export a surface"
                           : "there are no triangles in it; remedy: export a surface");
    }
    return mesh;
}

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
