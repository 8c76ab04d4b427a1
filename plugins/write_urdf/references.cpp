#include "references.hpp"

#include <foam/sdk/resource.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam {
namespace {

namespace fs = std::filesystem;

bool is_relative(const std::string& path) {
    return !path.empty() && path.front() != '/' && path.find("://") == path.npos;
}

void collect(std::string_view text, const xml::Element& element, std::vector<RelativeReference>& found) {
    const std::string* path = element.attribute("filename");
    if (path && is_relative(*path) && (element.name == "mesh" || element.name == "texture")) {
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

} // namespace

std::vector<RelativeReference> relative_references(std::string_view text, const xml::Element& robot,
                                                   const std::set<std::string>& replaced) {
    std::vector<RelativeReference> found;
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

std::string reference_from(const fs::path& folder, const std::string& path, const fs::path& base) {
    const fs::path target = ResourceResolver().resolve(path, base).path;
    if (target.empty() || folder.empty()) {
        return target.string();
    }
    std::error_code error;
    const fs::path from = fs::weakly_canonical(folder);
    if (from == fs::weakly_canonical(base) || fs::equivalent(from / path, target, error)) {
        return path;
    }
    return physical(target).lexically_relative(from).string();
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
