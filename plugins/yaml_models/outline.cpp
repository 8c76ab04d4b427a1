#include "writers.hpp"

#include <algorithm>

namespace foam::tree {
namespace {

/// Returns the text without quotes and blanks around it.
std::string bare(std::string_view text) {
    const std::string_view blanks = " \t\r\n";
    const std::size_t first = std::min(text.find_first_not_of(blanks), text.size());
    text.remove_prefix(first);
    text.remove_suffix(text.size() - (text.empty() ? 0 : text.find_last_not_of(blanks) + 1));
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front()) {
        text.remove_prefix(1);
        text.remove_suffix(1);
    }
    return std::string(text);
}

/// Returns the position after the quoted text that begins at `at`.
std::size_t after_quote(std::string_view text, std::size_t at) {
    const char quote = text[at];
    for (++at; at < text.size() && text[at] != quote; ++at) {
        at += quote == '"' && text[at] == '\\' ? 1 : 0;
    }
    return at + 1;
}

/// Returns the keys of a map in braces (JSON), which begins with '{'.
Outline outline_of_flow(std::string_view text) {
    Outline outline{.list = text.front() == '[', .keys = {}};
    int depth = 0;
    std::size_t key = 0; // where the next key begins
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            i = after_quote(text, i);
            continue;
        }
        depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
        if (depth == 1 && (c == '{' || c == ',')) {
            key = i + 1;
        } else if (depth == 1 && c == ':' && key > 0) {
            outline.keys.push_back(bare(text.substr(key, i - key)));
            key = 0;
        }
        ++i;
    }
    return outline;
}

/// Returns the key of a line "key: value"; empty if there is none.
std::string key_of(std::string_view line) {
    const bool quoted = line.front() == '"' || line.front() == '\'';
    std::size_t colon = line.find(':', quoted ? std::min(after_quote(line, 0), line.size()) : 0);
    while (colon != line.npos && colon + 1 < line.size() && line[colon + 1] != ' ' && line[colon + 1] != '\t' &&
           line[colon + 1] != '\r') {
        colon = line.find(':', colon + 1); // a colon within a word
    }
    return colon == line.npos ? "" : bare(line.substr(0, colon));
}

/// Returns the keys of the lines without indentation (YAML).
Outline outline_of_block(std::string_view text) {
    Outline outline;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        outline.list = outline.list || (outline.keys.empty() && line.starts_with("- "));
        if (line.empty() || line.find_first_of(" \t#-%") == 0) {
            continue;
        }
        if (std::string key = key_of(line); !key.empty()) {
            outline.keys.push_back(std::move(key));
        }
    }
    return outline;
}

} // namespace

bool Outline::has(std::string_view key) const {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

Outline outline_of(std::string_view text) {
    return text.starts_with('{') || text.starts_with('[') ? outline_of_flow(text) : outline_of_block(text);
}

Format format_of(std::string_view text) {
    const auto has_word = [&](std::string_view word) { return text.find(word) != text.npos; };
    const Outline outline = outline_of(text);
    if (outline.list) {
        return has_word("spheres") ? Format::commalab : Format::none;
    }
    if (outline.has("foam_spheres")) {
        return Format::foam_json;
    }
    if (outline.has("format") && has_word("xrdf")) {
        return Format::xrdf;
    }
    if ((outline.has("robot_cfg") || outline.has("kinematics")) && has_word("collision_spheres")) {
        return Format::curobo;
    }
    if (outline.has("collision_spheres")) {
        return Format::collision_spheres;
    }
    if (outline.has("spheres")) {
        return Format::spheres_by_link;
    }
    if (!outline.keys.empty() && has_word("centers") && has_word("radii")) {
        return Format::columns;
    }
    const bool database = !outline.keys.empty() && outline.keys.front().find("::") != std::string::npos;
    return database && has_word("spheres") ? Format::commalab : Format::none;
}

} // namespace foam::tree
