#include <foam/runtime/internal/output.hpp>

#include <fmt/format.h>

#include <atomic>
#include <cctype>
#include <cstring>

namespace foam::inline runtime {
namespace {

constexpr std::size_t longest_folder_name = 200; // file systems take 255 bytes

} // namespace

Mesh link_mesh(const LinkWork& link, std::size_t stage) {
    Mesh mesh;
    for (const CollisionElement& element : link.elements) {
        if (const Element* primitive = element.primitive()) {
            append(mesh, transformed(enclosing_mesh(*primitive), element.source->origin));
        } else {
            const std::size_t last = std::min(stage, element.filtered.size());
            append(mesh, transformed(last == 0 ? *element.raw : *element.filtered[last - 1], element.source->origin));
        }
    }
    return mesh;
}

std::string folder_name(const std::string& link) {
    std::string name;
    for (const char c : link) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                           c == '_' || c == '.';
        name += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    if (name.size() > longest_folder_name) { // "%_" occurs in no other name
        const std::string digest = digest_of(link).substr(0, 16);
        return name.substr(0, longest_folder_name - 2 - digest.size()) + "%_" + digest;
    }
    return name.empty() || name.find_first_not_of('.') == std::string::npos ? "_" + name : name;
}

std::string to_ply(const Mesh& mesh) {
    std::string bytes =
        fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
                    "property double z\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                    mesh.vertices.size(), mesh.triangles.size());
    bytes.append(reinterpret_cast<const char*>(mesh.vertices.data()), mesh.vertices.size() * sizeof(Vec3));
    for (const Triangle& triangle : mesh.triangles) {
        bytes += '\3';
        bytes.append(reinterpret_cast<const char*>(triangle.data()), sizeof triangle);
    }
    return bytes;
}

std::string why_dropped(const Workspace& workspace) {
    return workspace.cut() == Cut::stop
               ? "the run was stopped"
               : fmt::format("the time limit of {} s is over", workspace.time_limit().value_or(0));
}

std::vector<OutputFile> write_debug_meshes(const Workspace& workspace, const FinishedModel& finished,
                                           const RunDirectory& directory) {
    if (!workspace.recipe.debug_meshes) {
        return {};
    }
    std::vector<std::vector<OutputFile>> files(finished.links.size());
    std::atomic<bool> dropped = false;
    parallel_for(finished.links.size(), [&](std::size_t l) {
        if (workspace.ended()) {
            dropped = true;
            return;
        }
        const LinkWork& link = *finished.links[l].work;
        const std::filesystem::path folder = std::filesystem::path("links") / folder_name(link.link->name);
        const auto write = [&](std::size_t number, const std::string& stage, const Mesh& mesh) {
            const std::filesystem::path file = folder / fmt::format("{:02}-{}.ply", number, stage);
            const std::string bytes = to_ply(mesh);
            directory.write(file, bytes);
            files[l].push_back({"", file.string(), digest_of(bytes), bytes.size()});
        };
        write(0, "original", link_mesh(link, 0));
        const auto& filters = link.recipe.filters;
        for (std::size_t f = 0; f < filters.size(); ++f) {
            write(f + 1, filters[f].stage, link_mesh(link, f + 1));
        }
        Mesh spheres;
        for (const Element& element : finished.links[l].elements.shaped()) {
            append(spheres, enclosing_mesh(element));
        }
        for (const Sphere& sphere : finished.links[l].elements.spheres()) {
            append(spheres, enclosing_mesh(element_of(sphere)));
        }
        write(filters.size() + 1, link.recipe.spherizer.stage, spheres);
    });
    if (dropped) {
        workspace.journal.finding({Severity::warning, "", "",
                                   fmt::format("{}: debug meshes are missing", why_dropped(workspace))});
    }
    std::vector<OutputFile> all;
    for (const auto& list : files) {
        all.insert(all.end(), list.begin(), list.end());
    }
    return all;
}

} // namespace foam::runtime
