#include "quick_choices.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/parameter.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace foam::inline recipe {
namespace {

/// What the recipe says of the links that match a glob.
struct Entry {
    std::string glob;
    std::optional<bool> skip{};
    std::optional<double> weight{};

    std::string text() const {
        std::vector<std::string> parts;
        if (skip) {
            parts.push_back(fmt::format("skip: {}", *skip));
        }
        if (weight) {
            parts.push_back("weight: " + to_text(*weight));
        }
        return fmt::format("  {}: {{{}}}\n", json_string(glob), fmt::join(parts, ", "));
    }
};

bool contains(const std::vector<std::string>& globs, const std::string& glob) {
    return std::find(globs.begin(), globs.end(), glob) != globs.end();
}

/// Returns the entries, of which a later one has precedence. A glob occurs once.
std::vector<Entry> entries_of(const RobotChoices& choices) {
    std::vector<Entry> entries;
    const auto add = [&](Entry entry) {
        std::erase_if(entries, [&](const Entry& known) { return known.glob == entry.glob; });
        entries.push_back(std::move(entry));
    };
    if (!choices.keep.empty() && !contains(choices.keep, "*")) {
        add({"**", true}); // "*" may have a weight
    }
    for (const std::string& glob : choices.keep) {
        add({glob, false});
    }
    for (const auto& [glob, weight] : choices.weights) {
        add({glob, contains(choices.keep, glob) ? std::optional(false) : std::nullopt, weight});
    }
    for (const std::string& glob : choices.skip) {
        add({glob, true});
    }
    return entries;
}

} // namespace

std::string json_string(const std::string& text) {
    try {
        return nlohmann::json(text).dump();
    } catch (const nlohmann::json::type_error&) {
        throw Error(ErrorCode::usage, fmt::format("{}: its name is not UTF-8, as recipes are; remedy: another name "
                                                  "for the file or its folder",
                                                  shown(text)));
    }
}

std::string robot_keys(const RobotChoices& choices) {
    std::string text;
    if (!choices.tool_frames.empty()) {
        std::vector<std::string> frames;
        std::transform(choices.tool_frames.begin(), choices.tool_frames.end(), std::back_inserter(frames), &json_string);
        text += fmt::format("  tool_frames: [{}]\n", fmt::join(frames, ", "));
    }
    std::vector<std::string> locks;
    for (const auto& [joint, position] : choices.locks) {
        locks.push_back(fmt::format("{}: {}", json_string(joint), to_text(position)));
    }
    return text + (locks.empty() ? "" : fmt::format("  lock_joints: {{{}}}\n", fmt::join(locks, ", ")));
}

std::string links_key(const RobotChoices& choices) {
    std::string text;
    for (const Entry& entry : entries_of(choices)) {
        text += entry.text();
    }
    return text.empty() ? "" : "links:\n" + text;
}

void refuse_choices_of_mesh(const RobotChoices& choices, const std::string& file) {
    const char* option = !choices.keep.empty()          ? "--keep"
                         : !choices.skip.empty()        ? "--skip"
                         : !choices.weights.empty()     ? "--weight"
                         : !choices.locks.empty()       ? "--lock"
                         : !choices.tool_frames.empty() ? "--tool-frame"
                                                        : nullptr;
    if (option) {
        throw Error(ErrorCode::usage,
                    fmt::format("{} is a mesh, which has no links and no joints to choose from; remedy: without {}",
                                shown(file), option));
    }
}

} // namespace foam::inline recipe
