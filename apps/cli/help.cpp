#include "help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace foam::cli {
namespace {

constexpr std::size_t terminal_width = 80, name_width = 28;
constexpr std::size_t most_words = 8; ///< beside a name; more of them are listed in the description

/// Returns the number of code points of a UTF-8 text.
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

/// Returns a line with the name and the description, and as many further lines as the description needs.
std::string entry(const std::string& name, const std::string& description) {
    std::string text = "  " + name;
    std::size_t column = width_of(text);
    if (column >= name_width) { // no room beside the name
        text += '\n';
        column = 0;
    }
    text += std::string(name_width - column, ' ');
    column = name_width;
    std::istringstream words(description);
    for (std::string word; words >> word;) {
        const bool first = column == name_width;
        if (!first && column + 1 + width_of(word) > terminal_width) {
            text += '\n' + std::string(name_width, ' ');
            column = name_width;
        } else if (!first) {
            text += ' ';
            ++column;
        }
        text += word;
        column += width_of(word);
    }
    return text + '\n';
}

} // namespace

std::vector<std::string> words_of(const CLI::Option& option) {
    std::vector<std::string> words;
    std::istringstream stream(option.get_type_name());
    for (std::string word; std::getline(stream, word, '|');) {
        words.push_back(word);
    }
    return words.size() > 1 ? words : std::vector<std::string>();
}

std::string HelpFormatter::make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const {
    std::string text = CLI::Formatter::make_help(command, std::move(name), mode);
    for (std::size_t at; (at = text.find("\n\n\n")) != text.npos;) {
        text.erase(at, 1);
    }
    return text;
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
    return entry(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
    return entry(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option));
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
    std::string text = option->get_type_size() == 0             ? ""
                       : words_of(*option).size() <= most_words ? " " + option->get_type_name()
                                                                : " WORD";
    if (option->get_expected_max() == CLI::detail::expected_max_vector_size) {
        text += " ...";
    }
    return option->get_required() ? text + " REQUIRED" : text;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
    std::string text = option->get_description();
    if (const std::vector<std::string> words = words_of(*option); words.size() > most_words) {
        text += fmt::format("; one of {}", fmt::join(words, ", "));
    }
    for (const CLI::Option* other : option->get_excludes()) {
        text += "; not together with " + other->get_name();
    }
    const std::string value = option->get_default_str();
    return value.empty() ? text : text + "; default: " + value;
}

namespace {

DescribedOption described_option(const CLI::Option& option) {
    DescribedOption result;
    result.positional = !option.nonpositional();
    for (const std::string& name : option.get_snames()) {
        result.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        result.names.push_back("--" + name);
    }
    if (result.positional) {
        result.names.assign(1, option.get_name(true));
    }
    if (option.get_type_size() != 0) {
        result.value = option.get_type_name();
        result.choices = words_of(option);
    }
    result.text = HelpFormatter().make_option_desc(&option);
    return result;
}

DescribedCommand described_command(const CLI::App& app) {
    DescribedCommand result{app.get_name(), app.get_description(), app.get_footer(), {}};
    for (const CLI::Option* option : app.get_options()) {
        if (option != app.get_help_ptr() && !option->get_group().empty()) {
            result.options.push_back(described_option(*option));
        }
    }
    return result;
}

} // namespace

DescribedProgram described(const CLI::App& app) {
    DescribedProgram result{described_command(app), {}};
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
        result.commands.push_back(described_command(*command));
    }
    std::vector<std::string> names; // a COMMAND is one of these, all of which are known only here
    for (const DescribedCommand& command : result.commands) {
        names.push_back(command.name);
    }
    for (DescribedCommand& command : result.commands) {
        for (DescribedOption& option : command.options) {
            if (option.value == "COMMAND") {
                option.choices = names;
            }
        }
    }
    return result;
}

} // namespace foam::cli
