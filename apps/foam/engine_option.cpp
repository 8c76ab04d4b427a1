#include "engine_option.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/quick_recipe.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace foam::cli {
namespace {

/// Returns the writers of the engine that plugins offer.
std::vector<const StageInfo*> writers_of(const Engine& engine, const Registry& registry) {
    std::vector<const StageInfo*> writers;
    for (const std::string_view name : engine.writers) {
        if (const RegisteredStage* stage = registry.find(std::string(name))) {
            writers.push_back(&stage->info);
        }
    }
    return writers;
}

/// Returns the kinds as --with has them.
std::string with_words(const std::vector<Element::Kind>& kinds) {
    std::vector<std::string> words;
    for (const Element::Kind kind : kinds) {
        words.emplace_back(to_string(kind));
    }
    return fmt::format("{}", fmt::join(words, ","));
}

std::string word_of(const StageInfo& writer) {
    return writer.name.substr(writer.name.find('.') + 1);
}

} // namespace

void add_engine(CLI::App& command, std::string& engine) {
    std::vector<std::string_view> names;
    for (const Engine& known : engines()) {
        names.push_back(known.name);
    }
    command
        .add_option("--for", engine,
                    fmt::format("The program that collides with the result: {}. Format, words and sizes are as it "
                                "needs them, so that what it makes of the file holds the elements; default: none in "
                                "particular",
                                fmt::join(names, ", ")))
        ->type_name("ENGINE");
}

std::string format_for(const Engine& engine, const std::string& format, const std::string& output,
                       const Registry& registry) {
    const std::vector<const StageInfo*> writers = writers_of(engine, registry);
    const std::string ending = extension_of(output);
    std::vector<std::string> words;
    for (const StageInfo* writer : writers) {
        words.push_back(word_of(*writer));
        const auto& endings = writer->extensions;
        if (format.empty() ? ending.empty() || std::find(endings.begin(), endings.end(), ending) != endings.end()
                           : format == words.back()) {
            return words.back();
        }
    }
    throw Error(ErrorCode::usage,
                words.empty() ? fmt::format("--for {}: no plugin offers {}; `foam plugins --why` says which were not "
                                            "loaded",
                                            engine.name, engine.writers.front())
                              : fmt::format("--for {}: {} reads no {}; remedy: --format {}", engine.name, engine.title,
                                            shown(format.empty() ? "." + ending : format), fmt::join(words, ", or ")));
}

bool asks_for_engine(const StageInfo& writer, const Engine& engine) {
    return std::any_of(writer.parameters.begin(), writer.parameters.end(), [&](const Parameter& parameter) {
        return parameter.name == "engine" && why_invalid(parameter, std::string(engine.name)).empty();
    });
}

void require_kinds(const Engine& engine, const std::vector<Element::Kind>& kinds) {
    for (const Element::Kind kind : kinds) {
        if (!knows_all(engine.kinds, {kind})) {
            throw Error(ErrorCode::usage,
                        fmt::format("--for {0}: foam writes no {1} for {2}; remedy: --with {3}; `foam formats --for "
                                    "{0}` says more",
                                    engine.name, noun_of(kind, 2), engine.title, with_words(engine.kinds)));
        }
    }
}

std::string text_about(const Engine& engine) {
    std::string text = fmt::format("For {}.\n", engine.title);
    if (engine.kinds != every_kind()) {
        text += fmt::format("  foam writes {} for it.\n", words_of(engine.kinds));
    }
    if (engine.loss.empty() && engine.advice.empty()) {
        text += "  It takes the shapes as the file states them.\n";
    }
    for (const std::string_view part : {engine.loss, engine.advice}) {
        text += part.empty() ? "" : "  " + std::string(part) + "\n";
    }
    if (engine.stated) {
        text += "  Convert from the model, not from this file: its shapes would grow again. Links that keep their "
                "geometry keep it as it is.\n";
    }
    return text;
}

std::string text_about_written(const std::map<std::string, ParameterValue>& given, const std::string& asked) {
    if (const auto set = given.find("engine"); set != given.end()) {
        const std::string& word = std::get<std::string>(set->second);
        return word == "any" ? "" : text_about(engine_named(word));
    }
    return asked.empty() ? "" : text_about(engine_named(asked));
}

} // namespace foam::cli
