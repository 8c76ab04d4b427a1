#include "meshes.hpp"

#include <foam/base/file.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element.hpp>
#include <foam/sdk/context.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam::mjcf {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

/// Returns the number in single precision, by way of memory: g++ 12 leaves conversions out where it vectorises them.
double in_single_precision(double value) {
    const volatile float rounded = static_cast<float>(value);
    return rounded;
}

/// Returns the mesh with vertices in single precision, as MuJoCo keeps them.
Mesh in_single_precision(Mesh mesh) {
    for (Vec3& v : mesh.vertices) {
        v = {in_single_precision(v.x), in_single_precision(v.y), in_single_precision(v.z)};
    }
    return mesh;
}

} // namespace

MeshAsset::MeshAsset(const Model& model, const Node& node) : node_(node), attributes_(model.classes.of(node, "")) {
    scale_ = attributes_.vector("scale").value_or(scale_);
    if (scale_.x == 0 || scale_.y == 0 || scale_.z == 0) {
        attributes_.fail("scale", "it flattens the mesh to nothing: no factor may be 0");
    }
    const std::vector<double> turn = attributes_.numbers("refquat", 4, 4);
    if (!turn.empty()) {
        reference_ = from_quaternion({}, {turn[0], turn[1], turn[2], turn[3]});
    }
    reference_.translation = attributes_.vector("refpos").value_or(Vec3{});
    for (const char* generated : {"builtin", "plugin"}) {
        if (node.attribute(generated) || !node.children_named(generated).empty()) {
            node.fail(fmt::format("a mesh that MuJoCo generates ({}) is not read; remedy: a file of it", generated));
        }
    }
    if (attributes_.text("file")) {
        resolve(model);
    } else if (!attributes_.text("vertex")) {
        node.fail("<mesh> has neither file nor vertex; remedy: add file=\"…\"");
    }
}

void MeshAsset::resolve(const Model& model) {
    uri_ = attributes_.word("file");
    const fs::path stated = path_of(uri_), name = model.settings.strippath ? stated.filename() : stated;
    const fs::path folder = path_of(model.settings.meshdir), beside = node_.file->path.parent_path();
    for (const fs::path& file : {model.document.folder() / folder / name, beside / name, beside / folder / name}) {
        std::error_code error;
        if (fs::is_regular_file(file, error)) {
            path_ = file.lexically_normal();
            return;
        }
        if (std::find(tried_.begin(), tried_.end(), file) == tried_.end()) {
            tried_.push_back(file);
        }
    }
}

bool MeshAsset::is_plain() const {
    return !uri_.empty() && reference_ == Pose{} && lower_case(path_.extension().string()) != ".msh";
}

MeshReference MeshAsset::reference(std::shared_ptr<const Mesh> mesh) const {
    const bool in_place = reference_ == Pose{};
    return {.uri = in_place ? uri_ : "",
            .path = path_,
            .scale = in_place ? scale_ : Vec3{1, 1, 1},
            .mesh = std::move(mesh)};
}

void MeshAsset::fail_missing(const Node& geom) const {
    std::string text = fmt::format("{}: the mesh '{}', which the geom in {} names, is not found; tried:", node_.place(),
                                   shown(uri_), geom.place());
    for (const fs::path& file : tried_) {
        text += "\n  " + file.string();
    }
    throw Error(ErrorCode::input, text + "\nremedy: correct the path, or meshdir of <compiler>");
}

Mesh MeshAsset::of_text() const {
    Mesh mesh;
    const std::vector<double> corners = attributes_.numbers("vertex", 12, any_number);
    if (corners.size() % 3 != 0) {
        attributes_.fail("vertex", "the count of its numbers is no multiple of 3");
    }
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        mesh.vertices.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    const std::vector<double> faces = attributes_.numbers("face", 3, any_number);
    for (std::size_t i = 0; i + 2 < faces.size(); i += 3) {
        Triangle& triangle = mesh.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const double corner = faces[i + k];
            if (!(corner >= 0 && corner < static_cast<double>(mesh.vertices.size()))) {
                attributes_.fail(
                    "face", fmt::format("{} is no index of {} vertices", number_text(corner), mesh.vertices.size()));
            }
            triangle[k] = static_cast<std::uint32_t>(corner);
        }
    }
    return mesh;
}

Mesh MeshAsset::read_raw(const MeshLoader* loader) const {
    if (uri_.empty()) {
        return of_text();
    }
    if (lower_case(path_.extension().string()) == ".msh") {
        return read_msh(path_);
    }
    if (!loader) {
        throw Error(ErrorCode::plugin, fmt::format("{}: no plugin has load.mesh, which reads it", path_.string()));
    }
    QuietContext context;
    return loader->load(path_, context);
}

void MeshAsset::read(const MeshLoader* loader) {
    try {
        Mesh mesh = in_single_precision(read_raw(loader));
        if (mesh.triangles.empty()) { // vertices alone: MuJoCo takes the faces of their hull
            mesh = convex_hull(mesh.vertices)->surface;
        }
        if (reference_ != Pose{}) {
            mesh = transformed(transformed(mesh, reference_.inverse()), {}, scale_);
        }
        mesh_ = std::make_shared<const Mesh>(std::move(mesh));
        if (hull_wanted) {
            hull_ = std::make_shared<const Mesh>(convex_hull(mesh_->vertices)->surface);
        }
    } catch (const Error& error) {
        error_.emplace(error.code() == ErrorCode::geometry ? ErrorCode::input : error.code(),
                       fmt::format("{}: mesh '{}': {}", node_.place(), shown(uri_), error.what()));
    }
}

void MeshAsset::require_read() const {
    if (error_) {
        throw Error(*error_);
    }
}

Mesh MeshAsset::mesh() const {
    require_read();
    return reference_ == Pose{} ? transformed(*mesh_, {}, scale_) : *mesh_;
}

MeshReference MeshAsset::surface() const {
    if (is_plain()) {
        return reference(nullptr);
    }
    require_read();
    return reference(mesh_);
}

MeshReference MeshAsset::hull() const {
    require_read();
    return reference(hull_);
}

MeshAsset& Meshes::named(const Model& model, const std::string& name, const Attributes& geom) {
    const auto found = model.meshes.find(name);
    if (found == model.meshes.end()) {
        std::vector<std::string> names;
        for (const auto& [known, unused] : model.meshes) {
            names.push_back(known);
        }
        const std::string near = nearest_word(name, names);
        geom.fail("mesh", near.empty() ? "there is no such mesh; remedy: <asset><mesh name=\"…\" file=\"…\"/></asset>"
                                       : fmt::format("there is no such mesh; did you mean '{}'?", near));
    }
    std::unique_ptr<MeshAsset>& asset = assets_[found->second];
    if (!asset) {
        asset = std::make_unique<MeshAsset>(model, *found->second);
    }
    return *asset;
}

std::vector<MeshAsset*> Meshes::wanted() const {
    std::vector<MeshAsset*> wanted;
    for (const auto& [node, asset] : assets_) {
        if ((asset->wanted || asset->hull_wanted) && asset->found()) {
            wanted.push_back(asset.get());
        }
    }
    return wanted;
}

std::vector<fs::path> Meshes::files() const {
    std::vector<fs::path> files;
    for (const MeshAsset* asset : wanted()) {
        if (!asset->path().empty()) {
            files.push_back(fs::absolute(asset->path()).lexically_normal());
        }
    }
    return files;
}

void Meshes::read(const MeshLoader* loader) {
    const std::vector<MeshAsset*> wanted = this->wanted();
    parallel_for(wanted.size(), [&](std::size_t i) { wanted[i]->read(loader); });
}

} // namespace foam::mjcf
