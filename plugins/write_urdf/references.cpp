#include "sphere_urdf.hpp"

#include <foam/base/file.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/resource.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace foam {
namespace {

namespace fs = std::filesystem;

bool is_relative(const std::string& path) {
    return !path.empty() && path.front() != '/' && path.find("://") == path.npos;
}

void collect(std::string_view text, const xml::Element& element, std::vector<Reference>& found) {
    const std::string* path = element.attribute("filename");
    if (path && !path->empty() && (element.name == "mesh" || element.name == "texture")) {
        found.push_back({*path, element.attribute_span("filename", text)});
    }
    for (const auto& child : element.children) { // at most as deep as xml::parse() allows
        collect(text, *child, found);
    }
}

/// Returns the path without symbolic links except for the file itself, so that ".." is unambiguous.
fs::path physical(const fs::path& file) {
    return fs::weakly_canonical(file.parent_path()) / file.filename();
}

/// Returns the code point at `at`, and moves `at` behind it.
std::uint32_t next_code_point(std::string_view text, std::size_t& at) {
    const auto byte = static_cast<unsigned char>(text[at++]);
    const int more = byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : byte >= 0xC0 ? 1 : 0;
    std::uint32_t point = more == 0 ? byte : byte & (0x3FU >> more);
    for (int i = 0; i < more && at < text.size(); ++i) {
        point = point << 6 | (static_cast<unsigned char>(text[at++]) & 0x3FU);
    }
    return point;
}

bool is_utf8(std::string_view text) {
    const std::string_view declaration = text.substr(0, std::min(text.find("?>"), text.size()));
    const std::size_t at = declaration.find("encoding=");
    std::string name(at == declaration.npos ? "" : declaration.substr(at + 10, 5));
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
    return name.empty() || name == "UTF-8";
}

/// Returns the file that a reference leads to; empty if there is none.
fs::path target_of(const std::string& path, const Robot& robot) {
    for (const Link& link : robot.links) {
        for (const auto* elements : {&link.visuals, &link.collisions}) {
            for (const GeometryElement& element : *elements) {
                const auto* mesh = std::get_if<MeshReference>(&element.geometry);
                if (mesh && mesh->uri == path && !mesh->path.empty()) {
                    return mesh->path; // found with the package path of the loader
                }
            }
        }
    }
    return ResourceResolver().resolve(path, robot.file.parent_path()).path;
}

/// Returns the path from `folder`, which need not exist yet; `path` itself if it is right already.
std::string path_from(const fs::path& folder, const std::string& path, const fs::path& target, const fs::path& base) {
    std::error_code error;
    const fs::path from = fs::weakly_canonical(folder);
    if (from == fs::weakly_canonical(base) || fs::equivalent(from / path, target, error)) {
        return path;
    }
    return path_seen_from(folder, target);
}

/// Returns the <name> of a package.xml (REP 149); empty if there is no such file or no name in it.
std::string name_of_package(const fs::path& folder) {
    constexpr std::uintmax_t most = 1'000'000;
    const fs::path file = folder / "package.xml";
    const std::string text = read_regular_file(file, most, "").bytes;
    if (text.empty()) {
        return {};
    }
    const auto package = xml::parse(text, file.string(), ErrorCode::output);
    const xml::Element* name = package->child("name");
    const auto found =
        name ? words(std::string_view(text).substr(name->start_tag.end, name->end_tag - name->start_tag.end))
             : std::vector<std::string_view>{};
    return found.empty() ? "" : std::string(found.front());
}

/// Returns package://NAME/REST for a file below a package; empty for another file.
std::string package_uri(const fs::path& target) {
    const fs::path file = physical(fs::absolute(target));
    for (fs::path folder = file.parent_path(); folder != folder.parent_path(); folder = folder.parent_path()) {
        if (const std::string name = name_of_package(folder); !name.empty()) {
            return "package://" + name + "/" + file.lexically_relative(folder).generic_string();
        }
    }
    return {};
}

/// References with one finding in common: their number and the first.
class Counted {
public:
    void add(const std::string& path) { first_ = count_++ == 0 ? path : first_; }
    /// Adds a message if there are any: `which`, paths of meshes, `what` becomes of them.
    void say(MovedReferences& result, Severity severity, const std::string& which, const std::string& what) const {
        if (count_ > 0) {
            result.messages.emplace_back(
                severity, fmt::format("{} {} of meshes {} (the first: '{}')", count_, which, what, first_));
        }
    }

private:
    std::size_t count_ = 0;
    std::string first_;
};

/// Returns where relative paths lead from, in words.
std::string folder_in_words(const Robot& robot) {
    return robot.file.empty() ? "the current folder" : "the folder of " + robot.file.string();
}

MovedReferences kept(const std::vector<Reference>& references, bool on_purpose, const SphereModel& model) {
    return {.moved = {},
            .messages = {{on_purpose ? Severity::info : Severity::warning,
                          fmt::format("relative paths of meshes are kept as they are (the first: '{}'); they lead to "
                                      "their files from {}",
                                      references.front().path, folder_in_words(*model.robot))}}};
}

} // namespace

std::vector<Reference> references_of(std::string_view text, const xml::Element& robot,
                                     const std::set<std::string>& replaced) {
    std::vector<Reference> found;
    for (const auto& element : robot.children) {
        const std::string* name = element->name == "link" ? element->attribute("name") : nullptr;
        if (!name || !replaced.contains(*name)) {
            collect(text, *element, found);
            continue;
        }
        for (const auto& child : element->children) {
            if (child->name != "collision") {
                collect(text, *child, found);
            }
        }
    }
    return found;
}

MovedReferences moved_references(const std::vector<Reference>& all, const std::string& mesh_paths,
                                 const SphereModel& model) {
    const bool absolute = mesh_paths == "absolute", package = mesh_paths == "package";
    std::vector<Reference> references;
    std::copy_if(all.begin(), all.end(), std::back_inserter(references),
                 [&](const Reference& reference) { return absolute || is_relative(reference.path); });
    if (references.empty()) {
        return {};
    }
    if (mesh_paths == "keep" || (model.folder.empty() && !absolute && !package)) {
        return kept(references, mesh_paths == "keep", model);
    }
    MovedReferences result;
    Counted rewritten, lost, outside;
    for (const Reference& reference : references) {
        const fs::path target = target_of(reference.path, *model.robot);
        const std::string path = target.empty() ? ""
                                 : absolute     ? fs::absolute(target).string()
                                 : package
                                     ? package_uri(target)
                                     : path_from(model.folder, reference.path, target, model.robot->file.parent_path());
        if (path.empty()) {
            (target.empty() ? lost : outside).add(reference.path);
        } else if (path != reference.path) {
            rewritten.add(reference.path);
            result.moved.push_back({path, reference.span});
        }
    }
    const std::string which = absolute ? "paths" : "relative paths";
    rewritten.say(result, Severity::info, which, "are rewritten so that they lead to their files");
    lost.say(result, Severity::warning, which,
             fmt::format("lead to no file from {} and are kept as they are", folder_in_words(*model.robot)));
    outside.say(result, Severity::warning, which,
                "lead to files in no package, a folder with a package.xml, and are kept as they are");
    return result;
}

std::string uri_of_beside(const std::string& name, const std::string& mesh_paths, const SphereModel& model,
                          Context& context) {
    if (model.folder.empty() || (mesh_paths != "absolute" && mesh_paths != "package")) {
        return name;
    }
    if (mesh_paths == "absolute") {
        return (fs::absolute(model.folder) / name).string();
    }
    const std::string uri = package_uri(model.folder / name);
    if (uri.empty()) {
        context.log(Severity::warning,
                    fmt::format("the mesh '{}' lies in no package, a folder with a package.xml, and its path stays "
                                "relative",
                                name));
    }
    return uri.empty() ? name : uri;
}

std::string attribute_text(std::string_view value, std::string_view text) {
    const bool utf8 = is_utf8(text);
    std::string result;
    for (std::size_t at = 0; at < value.size();) {
        const std::size_t begin = at;
        const std::uint32_t point = next_code_point(value, at);
        if (point < 0x20 || (point >= 0x80 && !utf8) || std::string_view("&<>\"'").find(value[begin]) != value.npos) {
            result += fmt::format("&#{};", point);
        } else {
            result += value.substr(begin, at - begin);
        }
    }
    return result;
}

} // namespace foam
