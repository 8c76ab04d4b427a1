#include <foam/report/internal/report.hpp>

#include <foam/base/text.hpp>

#include <nlohmann/json.hpp>

#include <bit>
#include <limits>
#include <unordered_map>

namespace foam::inline report {
namespace {

using Json = nlohmann::ordered_json;

constexpr int finest_bits = 16;
constexpr int segments = 24; ///< around the circles of elements

template <class T> void append_little_endian(std::string& bytes, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
    }
}

void append_float(std::string& bytes, double value) {
    append_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

std::uint64_t packed(const std::array<std::uint16_t, 3>& corner) {
    return static_cast<std::uint64_t>(corner[0]) << 32 | static_cast<std::uint64_t>(corner[1]) << 16 | corner[2];
}

/// Returns the triangle with its least corner first, so that equal triangles compare equal.
Triangle rotated(const Triangle& t) {
    return t[0] < t[1] && t[0] < t[2] ? t : t[1] < t[2] ? Triangle{t[1], t[2], t[0]} : Triangle{t[2], t[0], t[1]};
}

/// Returns the largest number of triangles per mesh for which all meshes stay within `most`.
std::size_t fair_share(std::vector<std::size_t> counts, std::size_t most) {
    std::sort(counts.begin(), counts.end());
    std::size_t rest = most;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const std::size_t share = rest / (counts.size() - i);
        if (counts[i] > share) {
            return share;
        }
        rest -= counts[i];
    }
    return std::numeric_limits<std::size_t>::max();
}

/// Returns the mesh on the finest grid on which it has at most `most` triangles.
GridMesh reduced(const Mesh& mesh, std::size_t most) {
    if (mesh.triangles.size() <= most) {
        return on_grid(mesh, finest_bits);
    }
    // A surface passes through a few times n² of the n³ cells of a grid. A side of more than twice the one that gives
    // `most` cells of one face has no effect.
    const auto side = static_cast<unsigned>(std::sqrt(static_cast<double>(most)));
    int bits = std::min(finest_bits, static_cast<int>(std::bit_width(side)) + 1);
    GridMesh result = on_grid(mesh, bits);
    while (result.triangles.size() > most && bits > 1) {
        result = on_grid(mesh, --bits);
    }
    return result;
}

Json to_json(const GridMesh& mesh) {
    const bool wide = mesh.corners.size() > std::numeric_limits<std::uint16_t>::max();
    std::string corners, triangles;
    for (const auto& corner : mesh.corners) {
        for (const std::uint16_t coordinate : corner) {
            append_little_endian(corners, coordinate);
        }
    }
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            if (wide) {
                append_little_endian(triangles, corner);
            } else {
                append_little_endian(triangles, static_cast<std::uint16_t>(corner));
            }
        }
    }
    return {{"low", {mesh.low.x, mesh.low.y, mesh.low.z}},
            {"step", mesh.step},
            {"wide", wide},
            {"corners", base64(corners)},
            {"triangles", base64(triangles)}};
}

std::string to_floats(const std::vector<Sphere>& spheres) {
    std::string bytes;
    for (const Sphere& sphere : spheres) {
        for (const double value : {sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius}) {
            append_float(bytes, value);
        }
    }
    return base64(bytes);
}

/// The distinct meshes of all links.
class DistinctMeshes {
public:
    std::size_t index_of(const std::shared_ptr<const Mesh>& mesh) {
        const auto equal = [&](const std::shared_ptr<const Mesh>& other) { return other == mesh || *other == *mesh; };
        const auto found = std::find_if(meshes_.begin(), meshes_.end(), equal);
        if (found == meshes_.end()) {
            meshes_.push_back(mesh);
            return meshes_.size() - 1;
        }
        return static_cast<std::size_t>(found - meshes_.begin());
    }

    Json to_json(std::size_t max_triangles, double& drawn) const {
        std::vector<std::size_t> counts;
        for (const auto& mesh : meshes_) {
            counts.push_back(mesh->triangles.size());
        }
        const std::size_t share = fair_share(counts, max_triangles);
        std::size_t kept = 0, all = 0;
        Json json = Json::array();
        for (const auto& mesh : meshes_) {
            const GridMesh grid = reduced(*mesh, share);
            all += mesh->triangles.size();
            kept += mesh->triangles.size() > share ? grid.triangles.size() : mesh->triangles.size();
            json.push_back(report::to_json(grid));
        }
        drawn = all > 0 ? static_cast<double>(kept) / static_cast<double>(all) : 1;
        return json;
    }

private:
    std::vector<std::shared_ptr<const Mesh>> meshes_;
};

std::string without_tags(std::string json) {
    for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) {
        json.replace(at, 1, "\\u003c");
    }
    return json;
}

} // namespace

GridMesh on_grid(const Mesh& mesh, int bits) {
    Box box;
    for (const Vec3& vertex : mesh.vertices) {
        box.add(vertex);
    }
    const Vec3 size = box.size();
    const double most = static_cast<double>((1 << bits) - 1);
    GridMesh grid;
    grid.low = box.empty() ? Vec3{} : box.low;
    grid.step = std::max({size.x, size.y, size.z}) / most;
    std::unordered_map<std::uint64_t, std::uint32_t> index;
    index.reserve(mesh.vertices.size());
    const auto corner_of = [&](const Vec3& vertex) {
        std::array<std::uint16_t, 3> corner{};
        for (int axis = 0; axis < 3; ++axis) {
            const double cell = grid.step > 0 ? std::round((vertex[axis] - grid.low[axis]) / grid.step) : 0;
            corner[static_cast<std::size_t>(axis)] = static_cast<std::uint16_t>(std::clamp(cell, 0.0, most));
        }
        const auto [entry, fresh] = index.try_emplace(packed(corner), static_cast<std::uint32_t>(grid.corners.size()));
        if (fresh) {
            grid.corners.push_back(corner);
        }
        return entry->second;
    };
    for (const Triangle& triangle : mesh.triangles) {
        const Triangle t{corner_of(mesh.vertices[triangle[0]]), corner_of(mesh.vertices[triangle[1]]),
                         corner_of(mesh.vertices[triangle[2]])};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
            grid.triangles.push_back(rotated(t));
        }
    }
    std::sort(grid.triangles.begin(), grid.triangles.end());
    grid.triangles.erase(std::unique(grid.triangles.begin(), grid.triangles.end()), grid.triangles.end());
    return grid;
}

std::string scene_json(const std::vector<SceneLink>& links, std::size_t max_triangles) {
    DistinctMeshes meshes;
    Json list = Json::array();
    for (const SceneLink& link : links) {
        Json indices = Json::array(), levels = Json::array();
        for (const StageMesh& stage : link.meshes) {
            indices.push_back(meshes.index_of(stage.mesh));
        }
        for (const Elements& level : link.levels) {
            levels.push_back(to_floats(level.spheres()));
        }
        list.push_back(
            {{"name", shown(link.name)}, {"pose", rows_of(link.pose)}, {"meshes", indices}, {"levels", levels}});
        const bool spheres_alone = link.levels.empty() || link.levels.back().are_spheres();
        for (std::size_t l = 0; !spheres_alone && l < link.levels.size(); ++l) {
            Json elements = Json::array();
            for (const Element& element : link.levels[l].shaped()) {
                const auto mesh = std::make_shared<const Mesh>(enclosing_mesh(element, segments));
                elements.push_back({{"kind", to_string(element.kind)}, {"mesh", meshes.index_of(mesh)}});
            }
            list.back()["elements"].push_back(std::move(elements));
        }
    }
    double drawn = 1;
    Json json{{"links", std::move(list)}, {"meshes", meshes.to_json(max_triangles, drawn)}};
    json["drawn"] = drawn;
    return without_tags(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

} // namespace foam::report
