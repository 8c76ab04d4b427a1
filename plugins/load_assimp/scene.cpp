// COLLADA and glTF through assimp. Its post-processing is not used: faces and node transforms are taken as they are
// read.
#include "readers.hpp"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <locale.h>

namespace foam::load_assimp {
namespace {

/// The C locale for this thread alone while it lives: pugixml in assimp reads attributes with strtod, which under de_DE
/// reads meter="0.01" as 0.
class CLocale {
public:
    CLocale() : locale_(newlocale(LC_ALL_MASK, "C", nullptr)), before_(uselocale(locale_)) {}
    ~CLocale() {
        uselocale(before_);
        freelocale(locale_);
    }
    CLocale(const CLocale&) = delete;
    CLocale& operator=(const CLocale&) = delete;

private:
    locale_t locale_, before_;
};

/// An affine map in double precision: the products of deep node trees keep their digits.
struct Affine {
    std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 shift;

    Vec3 turn(const Vec3& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
    Vec3 operator*(const Vec3& p) const { return turn(p) + shift; }
    Affine operator*(const Affine& other) const {
        Affine result;
        for (int column = 0; column < 3; ++column) {
            const Vec3 image = turn({other.rows[0][column], other.rows[1][column], other.rows[2][column]});
            for (int row = 0; row < 3; ++row) {
                result.rows[static_cast<std::size_t>(row)][column] = image[row];
            }
        }
        result.shift = *this * other.shift;
        return result;
    }
    bool mirrors() const { return dot(rows[0], cross(rows[1], rows[2])) < 0; }
};

Affine affine(const aiMatrix4x4& m) {
    return {{Vec3{m.a1, m.a2, m.a3}, Vec3{m.b1, m.b2, m.b3}, Vec3{m.c1, m.c2, m.c3}}, {m.a4, m.b4, m.c4}};
}

class SceneReader {
public:
    SceneReader(const Source& source, const aiScene& scene, MeshBuilder& builder)
        : source_(source), scene_(scene), builder_(builder) {}

    void read(Context& context) {
        std::vector<std::pair<const aiNode*, Affine>> open{{scene_.mRootNode, Affine{}}};
        while (!open.empty()) {
            const auto [node, above] = open.back();
            open.pop_back();
            const Affine pose = above * affine(node->mTransformation);
            for (unsigned i = 0; i < node->mNumMeshes; ++i) {
                mesh(*scene_.mMeshes[node->mMeshes[i]], pose, *node, context);
            }
            for (unsigned i = node->mNumChildren; i-- > 0;) { // the first child is taken next
                open.emplace_back(node->mChildren[i], pose);
            }
        }
        if (skinned_) {
            context.log(Severity::info,
                        fmt::format("{}: it has skinned parts, which are taken as they are without their bones",
                                    source_.file.string()));
        }
    }

private:
    void mesh(const aiMesh& part, const Affine& pose, const aiNode& node, Context& context) {
        context.check_cancelled();
        skinned_ = skinned_ || part.HasBones();
        std::vector<std::uint32_t> vertices;
        vertices.reserve(part.mNumVertices);
        for (unsigned i = 0; i < part.mNumVertices; ++i) {
            const Vec3 raw{part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z}, p = pose * raw;
            if (!is_finite(p)) {
                throw source_.error(
                    fmt::format("vertex {} of mesh '{}' in node '{}' is not finite: {}; remedy: export the mesh again "
                                "without it",
                                i, part.mName.C_Str(), node.mName.C_Str(), text_of(is_finite(raw) ? p : raw)));
            }
            vertices.push_back(builder_.vertex(p));
        }
        std::vector<std::uint32_t> polygon;
        for (unsigned f = 0; f < part.mNumFaces; ++f) {
            const aiFace& face = part.mFaces[f];
            if (face.mNumIndices < 3) {
                continue; // a line or a point
            }
            polygon.clear();
            for (unsigned k = 0; k < face.mNumIndices; ++k) {
                const unsigned corner = face.mIndices[pose.mirrors() ? face.mNumIndices - 1 - k : k];
                if (corner >= part.mNumVertices) {
                    throw source_.error(fmt::format(
                        "face {} of mesh '{}' refers to vertex {}, but there are {}; remedy: export the mesh "
                        "again",
                        f, part.mName.C_Str(), corner, part.mNumVertices));
                }
                polygon.push_back(vertices[corner]);
            }
            builder_.polygon(polygon);
        }
    }

    const Source& source_;
    const aiScene& scene_;
    MeshBuilder& builder_;
    bool skinned_ = false;
};

} // namespace

void read_scene(const Source& source, MeshBuilder& builder, Context& context) {
    Assimp::Importer importer;
    // RViz and the planners of ROS take COLLADA coordinates as they are: the up-axis is not applied, the unit is.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    const aiScene* scene = nullptr;
    {
        const CLocale locale;
        scene = importer.ReadFile(source.file.string(), 0);
    }
    if (!scene || !scene->mRootNode) {
        throw source.error(fmt::format("assimp cannot read it: {}", importer.GetErrorString()));
    }
    SceneReader(source, *scene, builder).read(context);
}

} // namespace foam::load_assimp
