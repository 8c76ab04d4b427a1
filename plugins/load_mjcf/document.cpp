#include "document.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::mjcf {
namespace fs = std::filesystem;
std::vector<const Node*> Node::children_named(std::string_view child_name) const {
    std::vector<const Node*> found;
    for (const Node& child : children) {
        if (child.name() == child_name) {
            found.push_back(&child);
        }
    }
    return found;
}

std::string Node::place() const {
    return fmt::format("{}:{}", file->path.string(), element->line);
}

void Node::fail(const std::string& what) const {
    throw Error(ErrorCode::input, fmt::format("{}: {}", place(), shown(what)));
}

const std::string& Node::required(std::string_view key) const {
    const std::string* text = attribute(key);
    if (!text || text->empty()) {
        fail(fmt::format("<{0}> has no {1}; remedy: add {1}=\"…\"", name(), key));
    }
    return *text;
}

fs::path path_of(std::string reference) {
    std::replace(reference.begin(), reference.end(), '\\', '/');
    return reference;
}

std::string bytes_of(const fs::path& file, std::uintmax_t most, std::string_view if_too_large) {
    FileContents contents = read_regular_file(file, most, if_too_large);
    if (!contents.problem.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: {}", file.string(), contents.why_not()));
    }
    return std::move(contents.bytes);
}

std::string text_of(const fs::path& file) {
    constexpr std::uintmax_t most = 200'000'000;
    return bytes_of(file, most, "leave it out");
}

Document::Document(const std::string& text, const fs::path& file) {
    const File& main = add(text, file);
    root_ = {main.root.get(), &main};
    if (root_.name() != "mujoco") {
        root_.fail(fmt::format("the root element of an MJCF is <mujoco>, not <{}>", root_.name()));
    }
    included_.insert(file.lexically_normal());
    expand(root_);
}

const File& Document::add(const std::string& text, const fs::path& file) {
    auto parsed = std::make_unique<File>();
    parsed->path = file;
    parsed->root = xml::parse(text, file.string(), ErrorCode::input);
    files_.push_back(std::move(parsed));
    return *files_.back();
}

void Document::expand(Node& node) {
    CancellationCounter asking(256);
    for (const auto& child : node.element->children) {
        asking.check();
        Node next{child.get(), node.file};
        if (child->name == "include") {
            include(next, node.children);
        } else {
            expand(next);
            node.children.push_back(std::move(next));
        }
    }
}

std::vector<std::filesystem::path> Document::files() const {
    std::vector<std::filesystem::path> files;
    for (const auto& file : files_) {
        files.push_back(std::filesystem::absolute(file->path).lexically_normal());
    }
    return files;
}

/// Appends the elements of an included file. MuJoCo looks beside the main file first, then beside the file that
/// includes.
void Document::include(const Node& place, std::vector<Node>& into) {
    const fs::path name = path_of(place.required("file"));
    const fs::path first = folder() / name, second = place.file->path.parent_path() / name;
    std::error_code error;
    const fs::path file = fs::is_regular_file(first, error) ? first : second;
    if (!fs::is_regular_file(file, error)) {
        std::string tried = "\n  " + first.string();
        tried += second == first ? "" : "\n  " + second.string();
        throw Error(ErrorCode::input, fmt::format("{}: the file '{}' that is included is not found; tried:{}",
                                                  place.place(), shown(name.string()), tried));
    }
    if (!included_.insert(file.lexically_normal()).second) {
        place.fail(fmt::format("the file '{}' is included twice; remedy: keep one <include>", name.string()));
    }
    const File& added = add(text_of(file), file);
    Node root{added.root.get(), &added};
    expand(root);
    std::move(root.children.begin(), root.children.end(), std::back_inserter(into));
}

} // namespace foam::mjcf
