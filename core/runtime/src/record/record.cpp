#include "record/record.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace foam::inline runtime {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* no_value = "nothing";

[[noreturn]] void damaged(const std::string& source, const std::string& what) {
    throw Error(ErrorCode::usage, fmt::format("{}: the manifest is damaged: {}; remedy: restore it from where it was "
                                              "published, or run its recipe again",
                                              source, what));
}

/// Returns nlohmann's message without its "[json.exception.…] ".
std::string message_of(const std::exception& error) {
    const std::string text = error.what();
    const std::size_t end = text.find("] ");
    return end == text.npos ? text : text.substr(end + 2);
}

/// Reads the value of a key of the manifest by `body(value)`.
template <class Body> void section(const Json& manifest, const char* key, const std::string& source, Body&& body) {
    try {
        body(manifest.at(key));
    } catch (const Json::exception& error) {
        damaged(source, fmt::format("in '{}': {}", key, message_of(error)));
    }
}

std::string text(const Json& object, const char* key) {
    return object.at(key).get<std::string>();
}

void read_link(const Json& link, Record& record) {
    const std::string name = text(link, "link");
    for (const Json& stage : link.at("stages")) {
        record.stages.push_back({name, text(stage, "stage"), text(stage, "input"), text(stage, "output")});
    }
    if (link.contains("skipped") || link.contains("error")) {
        record.stages.push_back({name, "link", "", link.contains("skipped") ? "excluded by the recipe" : "failed"});
    }
}

/// Reads the files of the run directory. Returns their checkpoints at the time of writing.
std::vector<Checkpoint> read_files(const Json& list, Record& record) {
    std::vector<Checkpoint> made;
    for (const Json& file : list) {
        record.files.push_back({text(file, "file"), text(file, "digest"), file.at("bytes").get<std::size_t>()});
        made.push_back({"", file.contains("stage") ? text(file, "stage") : "debug mesh", text(file, "file"),
                        text(file, file.contains("portable_digest") ? "portable_digest" : "digest")});
    }
    return made;
}

/// Lists every value with its path.
void flatten(const Json& json, const std::string& path, std::vector<std::pair<std::string, std::string>>& values) {
    if (json.is_object() && !json.empty()) {
        for (const auto& [key, value] : json.items()) {
            flatten(value, path.empty() ? key : path + "." + key, values);
        }
    } else if (json.is_array() && !json.empty()) {
        for (std::size_t i = 0; i < json.size(); ++i) {
            flatten(json[i], fmt::format("{}[{}]", path, i), values);
        }
    } else {
        values.emplace_back(path, json.is_structured() ? no_value : json.dump());
    }
}

std::vector<Checkpoint> settings_by_path(const Json& settings) {
    std::vector<std::pair<std::string, std::string>> values;
    flatten(settings, "", values);
    std::vector<Checkpoint> checkpoints;
    for (auto& [path, value] : values) {
        checkpoints.push_back({"", "setting", path, std::move(value)});
    }
    return checkpoints;
}

/// Reads the places of inputs. A published manifest may lack 'execution', or the names of folders.
std::vector<InputPlace> read_places(const Json& manifest) {
    std::vector<InputPlace> places;
    try {
        const Json& execution = manifest.at("execution");
        places.push_back({text(execution.at("input"), "taken"), text(execution.at("input"), "file")});
        const Json &meshes = manifest.at("mesh_files"), &files = execution.at("mesh_files");
        for (std::size_t i = 0; i < meshes.size() && i < files.size(); ++i) {
            places.push_back({text(meshes[i], "file"), files[i].get<std::string>()});
        }
    } catch (const Json::exception&) {
        return places;
    }
    return places;
}

} // namespace

Record parse_record(const std::string& bytes, const std::string& source) {
    Json manifest;
    try {
        manifest = Json::parse(bytes);
    } catch (const Json::exception& error) {
        damaged(source, bytes.empty() ? "it is empty" : message_of(error));
    }
    if (!manifest.is_object() || !manifest.contains("foam_manifest")) {
        damaged(source, "it has no 'foam_manifest': it is not the manifest of a run");
    }
    if (manifest["foam_manifest"] != 1) {
        damaged(source, fmt::format("it has format {}, this foam reads format 1", manifest["foam_manifest"].dump()));
    }
    Record record;
    record.source = source;
    section(manifest, "foam_version", source, [&](const Json& v) { record.foam_version = v.get<std::string>(); });
    if (manifest.contains("cut")) {
        section(manifest, "cut", source, [&](const Json& cut) { record.cut = cut.get<std::string>(); });
    }
    section(manifest, "libraries", source, [&](const Json& v) { v.get_to(record.libraries); });
    section(manifest, "plugins", source, [&](const Json& list) {
        for (const Json& plugin : list) {
            const Json& build = plugin.at("build");
            record.plugins.push_back({text(plugin, "plugin"), text(plugin, "version"),
                                      build.is_null() ? std::string() : build.get<std::string>()});
        }
    });
    section(manifest, "settings", source, [&](const Json& settings) {
        text(settings, "name");
        record.settings = settings;
    });
    section(manifest, "input", source, [&](const Json& input) {
        record.inputs.push_back({"", "input file", text(input, "file"), text(input, "digest")});
        record.stages.push_back({"", text(input, "stage"), text(input, "file"), text(input, "output")});
    });
    if (manifest.contains("further_files")) {
        section(manifest, "further_files", source, [&](const Json& files) {
            for (const Json& file : files) {
                record.inputs.push_back({"", "further file", text(file, "file"), text(file, "digest")});
            }
        });
    }
    section(manifest, "mesh_files", source, [&](const Json& meshes) {
        for (const Json& mesh : meshes) {
            record.inputs.push_back({"", "mesh file", text(mesh, "file"), text(mesh, "digest")});
        }
    });
    record.places = read_places(manifest);
    section(manifest, "links", source, [&](const Json& links) {
        for (const Json& link : links) {
            read_link(link, record);
        }
    });
    section(manifest, "outputs", source, [&](const Json& list) { record.outputs = read_files(list, record); });
    section(manifest, "debug_meshes", source,
            [&](const Json& list) { record.debug_meshes = read_files(list, record); });
    return record;
}

Record read_record(const std::filesystem::path& manifest) {
    std::error_code error;
    if (!std::filesystem::exists(manifest, error)) {
        throw Error(
            ErrorCode::usage,
            fmt::format("{}: there is no such file; a run directory has one: name a folder that `foam run` made",
                        manifest.string()));
    }
    try {
        return parse_record(read_file(manifest, most_model_bytes), manifest.string());
    } catch (const Error& failure) {
        if (failure.code() == ErrorCode::usage) {
            throw;
        }
        throw Error(ErrorCode::usage, failure.what()); // it cannot be read
    }
}

void require_whole(const Record& record) {
    if (!record.cut.empty()) {
        throw Error(ErrorCode::usage, fmt::format("{}: the search of this run ended early ({}), so another run may "
                                                  "give other spheres; remedy: run its recipe without a limit",
                                                  record.source, record.cut));
    }
}

std::vector<Difference> compare(const std::vector<Checkpoint>& expected, const std::vector<Checkpoint>& found) {
    using Key = std::tuple<std::string, std::string, std::string>;
    // A mesh may occur several times in a link: the n-th is compared with the n-th.
    std::map<Key, std::vector<const Checkpoint*>> rest;
    for (auto at = found.rbegin(); at != found.rend(); ++at) {
        rest[{at->link, at->stage, at->input}].push_back(&*at);
    }
    std::set<const Checkpoint*> met;
    std::vector<Difference> differences;
    for (const Checkpoint& e : expected) {
        auto& same = rest[{e.link, e.stage, e.input}];
        const Checkpoint* f = same.empty() ? nullptr : same.back();
        if (f) {
            same.pop_back();
            met.insert(f);
        }
        if (!f || f->digest != e.digest) {
            differences.push_back({e.link, e.stage, e.input, e.digest, f ? f->digest : no_value});
        }
    }
    for (const Checkpoint& f : found) {
        if (!met.contains(&f)) {
            differences.push_back({f.link, f.stage, f.input, no_value, f.digest});
        }
    }
    return differences;
}

std::vector<Difference> compare_settings(const Json& expected, const Json& found) {
    return compare(settings_by_path(expected), settings_by_path(found));
}

std::vector<std::string> other_versions(const Record& expected, const Record& found) {
    std::vector<std::string> list;
    const auto add = [&](const std::string& what, const std::string& then, const std::string& now) {
        if (then != now) {
            list.push_back(fmt::format("{}: the manifest has {}, this is {}", what, then, now));
        }
    };
    add("foam", expected.foam_version, found.foam_version);
    for (const PluginVersion& then : expected.plugins) {
        const auto now = std::find_if(found.plugins.begin(), found.plugins.end(),
                                      [&](const PluginVersion& p) { return p.name == then.name; });
        if (now == found.plugins.end()) {
            list.push_back(fmt::format("plugin {}: the manifest has {}, it is not used here", then.name, then.version));
        } else if (then.version != now->version) {
            add("plugin " + then.name, then.version, now->version);
        } else if (then.build != now->build) {
            list.push_back(fmt::format("plugin {} {}: another build of it (the manifest has {}, this is {})", then.name,
                                       then.version, then.build, now->build));
        }
    }
    for (const auto& [library, version] : expected.libraries) {
        const auto now = found.libraries.find(library);
        add("library " + library, version, now == found.libraries.end() ? "nothing of it" : now->second);
    }
    return list;
}

} // namespace foam::runtime
