// The files of an MJCF: those that it includes, and the paths that it states.
#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace foam::xml_models {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_included_bytes = 200'000'000;

/// MuJoCo takes both kinds of slashes.
fs::path path_stated(std::string reference) {
    std::ranges::replace(reference, '\\', '/');
    return reference;
}

/// Returns the path with slashes; with one at its end if it is a folder's.
std::string after_folder(const std::string& folder, const std::string& stated) {
    const fs::path path = path_stated(stated);
    return path.is_absolute() ? stated : (fs::path(folder) / path).lexically_normal().generic_string();
}

class IncludedFiles {
public:
    explicit IncludedFiles(const fs::path& main) : folder_(main.parent_path()) {}

    /// Returns the text with the files in place of their <include>. `file`: of the text. `needed`: set to whether the
    /// text holds what names geoms or has an effect on them.
    std::string merged(const std::string& text, const fs::path& file, bool& needed) {
        const auto root = xml::parse(text, file.string(), ErrorCode::input);
        xml::Editor editor(text);
        merge(*root, file, editor, needed);
        return editor.result();
    }

private:
    void merge(const xml::Element& element, const fs::path& file, xml::Editor& editor, bool& needed) {
        static constexpr std::array with_effect{"geom",   "body",     "frame",     "replicate", "default",
                                                "attach", "compiler", "worldbody", "composite"};
        needed |= std::ranges::find(with_effect, element.name) != with_effect.end() || names_geom(element);
        for (const auto& child : element.children) {
            if (child->name == "include") {
                needed |= include(*child, file, editor);
            } else {
                merge(*child, file, editor, needed);
            }
        }
    }

    static bool names_geom(const xml::Element& element) {
        return std::ranges::any_of(element.attributes, [](const auto& attribute) {
            const auto& [key, value] = attribute;
            return key == "geom" || key == "geom1" || key == "geom2" ||
                   ((key == "objtype" || key == "reftype") && value == "geom");
        });
    }

    /// Puts an included file into the text. Returns false for one that may stay where it is.
    bool include(const xml::Element& element, const fs::path& file, xml::Editor& editor) {
        const std::string& name = required(element, "file", file.string());
        fs::path included = folder_ / path_stated(name);
        std::error_code error;
        const bool beside = !fs::is_regular_file(included, error); // the file that includes it
        if (beside) {
            included = file.parent_path() / path_stated(name);
        }
        if (!fs::is_regular_file(included, error) || !seen_.insert(included.lexically_normal()).second) {
            throw Error(ErrorCode::input,
                        fmt::format("{}:{}: the file '{}' that is included is not found, or included twice; remedy: "
                                    "correct <include>",
                                    file.string(), element.line, shown(name)));
        }
        bool needed = false;
        const std::string text =
            merged(read_regular_file(included, most_included_bytes, "leave it out").bytes, included, needed);
        if (needed) {
            const auto root = xml::parse(text, included.string(), ErrorCode::input);
            editor.replace(element.span, root->self_closing()
                                             ? ""
                                             : text.substr(root->start_tag.end, root->end_tag - root->start_tag.end));
        } else if (const fs::path own = included.lexically_relative(folder_);
                   !own.empty() && own != path_stated(name)) {
            editor.set_attribute(element, "file", own.generic_string());
        }
        return needed;
    }

    fs::path folder_;
    std::set<fs::path> seen_;
};

/// What an MJCF says of the folders of its files.
struct FoldersOfFiles {
    const char* attribute; ///< of <compiler>
    std::set<std::string> elements;
};

/// Returns whether the element names a file: `file`, or one of the six of a texture around a cube.
bool names_file(const xml::Element& element) {
    constexpr std::array words{"file", "fileright", "fileleft", "fileup", "filedown", "filefront", "fileback"};
    return std::ranges::any_of(words, [&](const char* word) { return element.attribute(word) != nullptr; });
}

/// Returns whether an element below has a file.
bool has_files(const xml::Element& element, const std::set<std::string>& elements) {
    return (elements.contains(element.name) && names_file(element)) || element.name == "include" ||
           std::ranges::any_of(element.children, [&](const auto& child) { return has_files(*child, elements); });
}

/// Moves the files of <include> and <model>, whose paths lead from the folder of the MJCF.
void move_models(xml::Editor& editor, const xml::Element& element, const std::string& folder) {
    const std::string* file = element.attribute("file");
    if (file && (element.name == "include" || element.name == "model")) {
        editor.set_attribute(element, "file", attribute_escaped(after_folder(folder, *file)));
    }
    for (const auto& child : element.children) {
        move_models(editor, *child, folder);
    }
}

} // namespace

std::string with_included(const TextFile& file) {
    bool needed = false;
    return IncludedFiles(file.file).merged(file.text, file.file, needed);
}

void move_paths(xml::Editor& editor, const xml::Element& root, const std::string& from_output) {
    move_models(editor, root, from_output);
    const auto compilers = root.children_named("compiler");
    bool has_asset_folder = false;
    std::string added;
    for (const xml::Element* compiler : compilers) {
        if (const std::string* stated = compiler->attribute("assetdir")) {
            has_asset_folder = true;
            editor.set_attribute(*compiler, "assetdir", attribute_escaped(after_folder(from_output, *stated)));
        }
    }
    for (const FoldersOfFiles& kind : {FoldersOfFiles{"meshdir", {"mesh", "hfield", "skin", "flexcomp"}},
                                       FoldersOfFiles{"texturedir", {"texture"}}}) {
        bool stated = has_asset_folder;
        for (const xml::Element* compiler : compilers) {
            if (const std::string* folder = compiler->attribute(kind.attribute)) {
                stated = true;
                editor.set_attribute(*compiler, kind.attribute, attribute_escaped(after_folder(from_output, *folder)));
            }
        }
        if (!stated && has_files(root, kind.elements)) {
            added += attribute_text(kind.attribute, from_output);
        }
    }
    if (!added.empty()) {
        editor.append_child(root, "<compiler" + added + "/>");
    }
}

} // namespace foam::xml_models
