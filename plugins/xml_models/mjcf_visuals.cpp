// What MuJoCo reads: doc/XMLreference.rst (asset/mesh), tried with MuJoCo 4.0.
#include "mjcf_visuals.hpp"

#include "mjcf_joints.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/elements.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

namespace foam::xml_models {
namespace {

namespace fs = std::filesystem;

/// Returns whether MuJoCo reads an STL file: a binary one of some facets, but not of very many.
bool is_stl_of_mujoco(const fs::path& file) {
    constexpr std::uintmax_t most_facets = 200'000, head = 84, of_facet = 50;
    std::array<char, head> bytes{};
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream.read(bytes.data(), head)) {
        return false;
    }
    std::array<unsigned char, 4> count{};
    std::memcpy(count.data(), bytes.data() + 80, count.size());
    const std::uintmax_t facets = count[0] | count[1] << 8U | count[2] << 16U | std::uintmax_t{count[3]} << 24U;
    return facets >= 2 && facets <= most_facets && size == head + of_facet * facets;
}

/// Returns whether MuJoCo reads the file as it is.
bool is_file_of_mujoco(const fs::path& file) {
    const std::string ending = lower_case(file.extension().string());
    std::error_code error;
    return (ending == ".obj" && fs::is_regular_file(file, error)) || (ending == ".stl" && is_stl_of_mujoco(file));
}

/// Returns the name with letters, digits, '.', '_' and '-' alone.
std::string file_word(std::string_view name) {
    std::string word(name);
    std::replace_if(
        word.begin(), word.end(),
        [](char c) {
            const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
            return !letter && c != '.' && c != '_' && c != '-';
        },
        '_');
    return word.empty() ? "mesh" : word;
}

/// Returns the name, with a number behind it if it is taken. Names differ by more than case.
std::string free_name(const std::string& name, std::set<std::string>& taken) {
    std::string result = name;
    for (int number = 2; !taken.insert(lower_case(result)).second; ++number) {
        result = fmt::format("{}_{}", name, number);
    }
    return result;
}

/// Returns the colour; nothing for the colour that MuJoCo gives.
std::string colour_text(const GeometryElement& visual) {
    if (!visual.material || !visual.material->rgba) {
        return "";
    }
    std::array<double, 4> rgba = *visual.material->rgba;
    for (double& share : rgba) {
        share = std::clamp(share, 0.0, 1.0);
    }
    return attribute_text("rgba", numbers_text(rgba));
}

std::string mesh_attributes(const std::string& asset, const Pose& pose) {
    return attribute_text("type", "mesh") + attribute_text("mesh", asset) +
           (pose.translation == Vec3{} ? "" : attribute_text("pos", vector_text(pose.translation))) +
           (pose.rotation == Pose{}.rotation ? "" : attribute_text("quat", numbers_text(quaternion(pose))));
}

} // namespace

MjcfVisuals::MjcfVisuals(const SphereModel& model, bool shown, const MeshLoader* meshes, Context& context)
    : model_(model), meshes_(meshes), context_(context) {
    const std::set<std::string> below = shown ? links_below(*model.robot, base_link(model)) : std::set<std::string>{};
    for (const Link& link : model.robot->links) {
        if (!below.contains(link.name)) {
            continue;
        }
        for (const GeometryElement& visual : link.visuals) {
            check_cancelled();
            std::string why;
            if (const auto attributes = geom(visual, why)) {
                geoms_[link.name].push_back(*attributes + colour_text(visual));
            } else {
                left_out_[why].push_back(foam::shown(link.name));
            }
        }
    }
}

std::vector<std::string> MjcfVisuals::of(const std::string& link) const {
    const auto found = geoms_.find(link);
    return found == geoms_.end() ? std::vector<std::string>{} : found->second;
}

std::optional<std::string> MjcfVisuals::geom(const GeometryElement& visual, std::string& why) {
    using Kind = Element::Kind;
    if (const auto* primitive = std::get_if<Element>(&visual.geometry)) {
        if (primitive->kind != Kind::hull && primitive->kind != Kind::swept_box) {
            return shapes_.attributes(moved(*primitive, visual.origin));
        }
        MeshReference surface{.uri = to_string(primitive->kind), .path = {}};
        surface.mesh = std::make_shared<const Mesh>(enclosing_mesh(*primitive));
        const auto name = asset(surface, why);
        return name ? std::optional(mesh_attributes(*name, visual.origin)) : std::nullopt;
    }
    const auto name = asset(std::get<MeshReference>(visual.geometry), why);
    return name ? std::optional(mesh_attributes(*name, visual.origin)) : std::nullopt;
}

std::optional<std::string> MjcfVisuals::asset(const MeshReference& reference, std::string& why) {
    const std::string key = fmt::format("{}\n{}\n{}", reference.path.string(), fmt::ptr(reference.mesh.get()),
                                        vector_text(reference.scale));
    if (const auto known = names_.find(key); known != names_.end()) {
        return known->second;
    }
    const auto file = file_of(reference, why);
    if (!file) {
        return {};
    }
    const std::string stem = file_word(fs::path(*file).stem().string());
    const std::string name = free_name((stem.starts_with(hull_prefix) ? "visual_" : "") + stem, taken_);
    const bool scaled = reference.scale != Vec3{1, 1, 1};
    assets_.push_back("<mesh class=\"visual\"" + attribute_text("name", name) + attribute_text("file", *file) +
                      (scaled ? attribute_text("scale", vector_text(reference.scale)) : "") + "/>");
    names_[key] = name;
    kept_.push_back(reference.mesh);
    return name;
}

std::optional<std::string> MjcfVisuals::file_of(const MeshReference& reference, std::string& why) {
    constexpr std::size_t least_corners = 4;
    if (model_.folder.empty()) {
        why = "meshes are files beside the MJCF, whose place is not known; remedy: -o FILE";
        return {};
    }
    if (!reference.mesh && reference.path.empty()) {
        why = "their meshes are not found; remedy: --package NAME=FOLDER";
        return {};
    }
    if (!reference.mesh && is_file_of_mujoco(reference.path)) {
        return path_seen_from(model_.folder, reference.path);
    }
    const std::string key = fmt::format("{}\n{}", reference.path.string(), fmt::ptr(reference.mesh.get()));
    if (const auto known = sources_.find(key); known != sources_.end()) {
        return known->second;
    }
    if (!reference.mesh && !meshes_) {
        why = "MuJoCo reads STL and OBJ, and no plugin has load.mesh for their meshes; remedy: convert them";
        return {};
    }
    try {
        const Mesh mesh = reference.mesh ? *reference.mesh : meshes_->load(reference.path, context_);
        if (welded(mesh).vertices.size() < least_corners) {
            why = "MuJoCo refuses meshes of less than four corners; remedy: another mesh";
            return {};
        }
        const fs::path source = reference.path.empty() ? fs::path(reference.uri) : reference.path;
        return sources_[key] = file_beside(source.stem().string(), mesh);
    } catch (const Error& error) {
        why = fmt::format("{}; remedy: convert the mesh to STL or OBJ", error.what());
        return {};
    }
}

std::string MjcfVisuals::file_beside(const std::string& stem, const Mesh& mesh) {
    const std::string folder = file_word(fs::path(model_.file).stem().string()) + "_visuals/";
    const std::string name = free_name(folder + file_word(stem), taken_) + ".obj";
    files_[name] = obj_text(mesh);
    return name;
}

void MjcfVisuals::report(Context& context) const {
    for (const auto& [why, links] : left_out_) {
        context.log(Severity::warning,
                    fmt::format("visual geometry is left out of {}: {}", fmt::join(links, ", "), why));
    }
    if (!files_.empty()) {
        context.log(Severity::info,
                    fmt::format("{} that MuJoCo does not read {} written as OBJ, without textures, into {}",
                                counted(files_.size(), "visual mesh"), files_.size() == 1 ? "is" : "are",
                                fs::path(files_.begin()->first).parent_path().string()));
    }
}

} // namespace foam::xml_models
