// glTF 2.0: the meshes that the nodes of the scene show, in metres; the up-axis (y) is not turned, as with COLLADA.
#include "gltf.hpp"
#include "part.hpp"
#include "readers.hpp"

#include <fmt/format.h>

#include <map>
#include <numeric>
#include <set>

namespace foam::load_mesh {
namespace {

using nlohmann::json;

json parsed(const Source& source, std::string_view text) {
    const auto start = static_cast<std::size_t>(text.empty() ? 0 : text.data() - source.bytes.data());
    try {
        json root = json::parse(with_valid_utf8(text));
        if (root.is_object()) {
            return root;
        }
    } catch (const json::parse_error& error) {
        throw source.error_at(
            source.line_of(start + std::min(error.byte, text.size())),
            fmt::format("it holds no glTF: its text is no JSON object, it goes wrong at byte {}; remedy: "
                        "export or copy it again",
                        start + error.byte));
    } catch (const json::out_of_range&) {
        throw source.error("it holds no glTF: a number of its JSON is too large; remedy: export it again");
    }
    throw source.error("it holds no glTF: its text is no JSON object; remedy: export or copy it again");
}

Affine rotation(const JsonPlace& place) {
    const std::vector<double> q = place.numbers(4);
    const auto turned = Affine::rotation(q[0], q[1], q[2], q[3]);
    if (!turned) {
        throw place.error("is no rotation");
    }
    return *turned;
}

Vec3 vector(const JsonPlace& place) {
    const std::vector<double> v = place.numbers(3);
    return {v[0], v[1], v[2]};
}

/// Returns the map from the node's frame to its parent's: its matrix, column by column, or translation · rotation ·
/// scale.
Affine transform_of(const JsonPlace& node) {
    if (const auto matrix = node.find("matrix")) {
        const std::vector<double> m = matrix->numbers(16);
        return {{Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}, Vec3{m[2], m[6], m[10]}}, {m[12], m[13], m[14]}};
    }
    const auto t = node.find("translation"), r = node.find("rotation"), s = node.find("scale");
    return (t ? Affine::translation(vector(*t)) : Affine{}) * (r ? rotation(*r) : Affine{}) *
           (s ? Affine::scaling(vector(*s)) : Affine{});
}

class GltfReader {
public:
    GltfReader(const Source& source, const JsonPlace& root, std::string_view binary, MeshBuilder& builder,
               Context& context)
        : source_(source), root_(root), accessors_(source, root, binary, builder.limits().max_bytes,
                                                   3 * std::uint64_t{builder.limits().max_triangles}),
          builder_(builder), context_(context) {}

    void read() {
        const auto asset = root_.find("asset");
        const auto version = asset ? asset->find("version") : asset;
        if (!version || !version->text().starts_with("2")) {
            throw source_.error("it does not say that it is glTF 2 (asset.version); remedy: export glTF 2.0");
        }
        check_extensions(source_, root_, context_);
        std::vector<JsonPlace> roots = root_nodes();
        if (roots.empty()) {
            all_meshes();
        } else {
            nodes(roots);
        }
        if (deformed_) {
            context_.log(Severity::info, fmt::format("{}: it has skinned or morphed parts, which are taken as they are "
                                                     "without their bones and targets",
                                                     source_.file.string()));
        }
    }

private:
    struct Visit {
        JsonPlace node;
        Affine pose;
        std::size_t parent; ///< index in visited_, or none
    };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    /// Returns the root nodes of the default scene, or of the first; without scenes the nodes that have no parent.
    std::vector<JsonPlace> root_nodes() const {
        std::vector<JsonPlace> roots;
        const auto scenes = root_.find("scenes"), chosen = root_.find("scene"), all = root_.find("nodes");
        if (scenes && scenes->size() > 0) {
            const JsonPlace scene = chosen ? chosen->target(root_, "scenes") : (*scenes)[0];
            const auto list = scene.find("nodes");
            for (std::size_t i = 0; list && i < list->size(); ++i) {
                roots.push_back((*list)[i].target(root_, "nodes"));
            }
            return roots;
        }
        std::set<std::uint64_t> children;
        for (std::size_t i = 0; all && i < all->size(); ++i) {
            const auto list = (*all)[i].find("children");
            for (std::size_t k = 0; list && k < list->size(); ++k) {
                children.insert((*list)[k].natural());
            }
        }
        for (std::size_t i = 0; all && i < all->size(); ++i) {
            if (!children.contains(i)) {
                roots.push_back((*all)[i]);
            }
        }
        return roots;
    }

    void all_meshes() {
        const auto meshes = root_.find("meshes");
        for (std::size_t i = 0; meshes && i < meshes->size(); ++i) {
            mesh((*meshes)[i], {Affine{}});
        }
    }

    /// Visits the nodes. By the specification they are a set of strict trees: each is reached once.
    void nodes(const std::vector<JsonPlace>& roots) {
        std::vector<Visit> open;
        for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
            open.push_back({*root, Affine{}, none});
        }
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            const std::size_t self = enter(visit);
            const Affine pose = visit.pose * transform_of(visit.node);
            if (const auto index = visit.node.find("mesh")) {
                mesh(index->target(root_, "meshes"), instances(visit.node, pose, accessors_));
                deformed_ = deformed_ || visit.node.find("skin");
            }
            const auto children = visit.node.find("children");
            for (std::size_t k = children ? children->size() : 0; k-- > 0;) { // the first child is next
                open.push_back({(*children)[k].target(root_, "nodes"), pose, self});
            }
        }
    }

    std::size_t enter(const Visit& visit) {
        if (!reached_.insert(visit.node.path()).second) {
            for (std::size_t above = visit.parent; above != none; above = visited_[above].second) {
                if (visited_[above].first == visit.node) {
                    throw visit.node.error("is its own ancestor");
                }
            }
            throw visit.node.error("has two parents");
        }
        visited_.emplace_back(visit.node, visit.parent);
        return visited_.size() - 1;
    }

    void mesh(const JsonPlace& item, const std::vector<Affine>& poses) {
        const auto primitives = item.find("primitives");
        for (std::size_t i = 0; primitives && i < primitives->size(); ++i) {
            const JsonPlace primitive = (*primitives)[i];
            const std::uint64_t mode = primitive.natural("mode", triangles);
            if (mode > triangle_fan) {
                throw primitive.error(fmt::format("has the unknown mode {}", mode));
            }
            if (mode < triangles) {
                continue; // points and lines
            }
            auto known = parts_.find(primitive.path());
            if (known == parts_.end()) {
                known = parts_.emplace(primitive.path(), compacted(part(primitive, mode))).first;
            }
            const std::array<std::uint32_t, 1> colour{colour_of(primitive)};
            for (const Affine& pose : known->second.sizes.empty() ? std::vector<Affine>{} : poses) {
                context_.check_cancelled();
                place(known->second, pose, builder_, colour);
            }
            deformed_ = deformed_ || primitive.find("targets");
        }
    }

    /// Returns the base colour of a primitive's material; 0 if it has none, or a texture.
    std::uint32_t colour_of(const JsonPlace& primitive) const try {
        const auto index = primitive.find("material");
        const auto surface = index ? index->target(root_, "materials").find("pbrMetallicRoughness") : std::nullopt;
        const auto factor =
            surface && !surface->find("baseColorTexture") ? surface->find("baseColorFactor") : std::nullopt;
        if (!factor) {
            return 0;
        }
        const std::vector<double> shares = factor->numbers(4);
        return colour_number({shares[0], shares[1], shares[2], shares[3]});
    } catch (const Error&) {
        return 0; // a material that is not there: the mesh is read without it
    }

    Part part(const JsonPlace& primitive, std::uint64_t mode) {
        const JsonPlace position = primitive.at("attributes").at("POSITION");
        const auto extensions = primitive.find("extensions");
        if (extensions && extensions->find("KHR_draco_mesh_compression") &&
            !position.target(root_, "accessors").find("bufferView")) {
            throw primitive.error("is compressed (KHR_draco_mesh_compression), which is not read");
        }
        Part part;
        part.points = accessors_.points(position);
        part.error = [&source = source_, path = position.path()](std::size_t i, const std::string& what) {
            return source.error(fmt::format("{}: vertex {} (counted from 0) {}", path, i, what));
        };
        std::vector<std::uint32_t> indices;
        if (const auto place = primitive.find("indices")) {
            indices = accessors_.indices(*place);
            for (const std::uint32_t index : indices) {
                if (index >= part.points.size()) {
                    throw place->error(fmt::format("refers to vertex {}, but there are {}", index, part.points.size()));
                }
            }
        } else {
            indices.resize(part.points.size());
            std::iota(indices.begin(), indices.end(), 0u);
        }
        add_triangles(mode, indices, part);
        return part;
    }

    /// Adds triangles as in section 3.7.2.1 of the specification, which also fixes the order of the corners.
    static void add_triangles(std::uint64_t mode, const std::vector<std::uint32_t>& v, Part& part) {
        for (std::size_t i = 2; i < v.size(); i += mode == triangles ? 3 : 1) {
            const std::size_t odd = i % 2;
            const Triangle triangle = mode == triangles        ? Triangle{v[i - 2], v[i - 1], v[i]}
                                      : mode == triangle_strip ? Triangle{v[i - 2 + odd], v[i - 1 - odd], v[i]}
                                                               : Triangle{v[0], v[i - 1], v[i]};
            part.corners.insert(part.corners.end(), triangle.begin(), triangle.end());
        }
        part.sizes.assign(part.corners.size() / 3, 3);
    }

    static constexpr std::uint64_t triangles = 4, triangle_strip = 5, triangle_fan = 6;

    const Source& source_;
    JsonPlace root_;
    GltfAccessors accessors_;
    MeshBuilder& builder_;
    Context& context_;
    std::map<std::string, Part> parts_; ///< read once, by the path of the primitive
    std::set<std::string> reached_;     ///< paths of nodes
    std::vector<std::pair<JsonPlace, std::size_t>> visited_;
    bool deformed_ = false;
};

} // namespace

void read_gltf(const Source& source, MeshBuilder& builder, Context& context) {
    const GltfContainer container = open_gltf(source);
    const json root = parsed(source, container.text);
    GltfReader(source, JsonPlace(source, root), container.binary, builder, context).read();
}

} // namespace foam::load_mesh
