#include "help.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::cli {
namespace {

std::vector<std::string> command_names(const DescribedProgram& program) {
    std::vector<std::string> names;
    for (const DescribedCommand& command : program.commands) {
        names.push_back(command.name);
    }
    return names;
}

/// Calls `use` with each option of the command that has a name, and with those of the program.
template <class Use> void for_each_option(const DescribedProgram& program, const DescribedCommand& command, Use use) {
    for (const DescribedCommand* level : {&command, &program.program}) {
        for (const DescribedOption& option : level->options) {
            if (!option.positional) {
                use(option);
            }
        }
    }
}

/// Returns the words that the arguments of a command may be; empty: files, or any.
std::vector<std::string> argument_words(const DescribedCommand& command) {
    std::vector<std::string> words;
    for (const DescribedOption& option : command.options) {
        if (option.positional) {
            words.insert(words.end(), option.choices.begin(), option.choices.end());
        }
    }
    return words;
}

/// Returns the text with a backslash before each of the characters.
std::string escaped(const std::string& text, const std::string& characters) {
    std::string result;
    for (const char c : text) {
        if (characters.find(c) != characters.npos) {
            result += '\\';
        }
        result += c;
    }
    return result;
}

/// Returns the text between single quotes, for a shell.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return result + "'";
}

/// Returns the first sentence, for lists.
std::string brief(const std::string& text) {
    return text.substr(0, std::min(text.find("; "), text.find(": ")));
}

std::string bash_script(const DescribedProgram& program) {
    std::string words, values, arguments;
    for (const DescribedCommand& command : program.commands) {
        std::vector<std::string> names{"--help"};
        for_each_option(program, command, [&](const DescribedOption& option) {
            names.insert(names.end(), option.names.begin(), option.names.end());
            for (const std::string& name : option.names) {
                if (!option.choices.empty()) {
                    values += fmt::format("        {}:{}) words=\"{}\" ;;\n", command.name, name,
                                          fmt::join(option.choices, " "));
                } else if (!option.value.empty()) {
                    values += fmt::format("        {}:{}) return ;;\n", command.name, name);
                }
            }
        });
        constexpr const char* line = "            {}) words=\"{}\" ;;\n";
        words += fmt::format(line, command.name, fmt::join(names, " "));
        if (const auto of_arguments = argument_words(command); !of_arguments.empty()) {
            arguments += fmt::format(line, command.name, fmt::join(of_arguments, " "));
        }
    }
    const std::string commands = fmt::format("{}", fmt::join(command_names(program), " "));
    return fmt::format(R"(# Completion of {0} in bash, made by: {0} completion bash
_{0}() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} command='' word words=''
    COMPREPLY=()
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case " {1} " in *" $word "*) command=$word && break ;; esac
    done
    case $command:$previous in
{2}    esac
    if [[ -z $words && $current == -* ]]; then
        case $command in
{3}            *) words="--help --version --plugin --plugin-dir" ;;
        esac
    elif [[ -z $words ]]; then
        case $command in
{4}            '') words="{1}" ;;
        esac
    fi
    [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -F _{0} {0}
)",
                       program.program.name, commands, values, words, arguments);
}

std::string zsh_script(const DescribedProgram& program) {
    std::string commands, arguments;
    for (const DescribedCommand& command : program.commands) {
        commands += fmt::format("        {}\n", quoted(command.name + ":" + escaped(command.summary, ":")));
        arguments += fmt::format("            ({})\n                _arguments", command.name);
        for_each_option(program, command, [&](const DescribedOption& option) {
            const std::string value = option.value.empty() ? ""
                                      : option.choices.empty()
                                          ? fmt::format(":{}:_files", escaped(option.value, ":"))
                                          : fmt::format(":value:({})", fmt::join(option.choices, " "));
            for (const std::string& name : option.names) {
                arguments +=
                    fmt::format(" \\\n                    {}",
                                quoted(fmt::format("*{}[{}]{}", name, escaped(brief(option.text), "[]:"), value)));
            }
        });
        const auto of_arguments = argument_words(command);
        arguments +=
            fmt::format(" \\\n                    '*:{}' ;;\n",
                        of_arguments.empty() ? "file:_files" : fmt::format("value:({})", fmt::join(of_arguments, " ")));
    }
    return fmt::format(R"(#compdef {0}
# Completion of {0} in zsh, made by: {0} completion zsh
_{0}() {{
    local context state line
    local -a commands
    commands=(
{1}    )
    _arguments -C '1:command:->command' '*::argument:->argument'
    case $state in
        (command) _describe command commands ;;
        (argument)
            case $line[1] in
{2}            esac ;;
    esac
}}
_{0} "$@"
)",
                       program.program.name, commands, arguments);
}

std::string fish_script(const DescribedProgram& program) {
    const std::string& name = program.program.name;
    std::string script = fmt::format("# Completion of {0} in fish, made by: {0} completion fish\n", name);
    for (const DescribedCommand& command : program.commands) {
        script += fmt::format("complete -c {} -n __fish_use_subcommand -f -a {} -d {}\n", name, command.name,
                              quoted(command.summary));
        if (const auto words = argument_words(command); !words.empty()) {
            script += fmt::format("complete -c {} -n '__fish_seen_subcommand_from {}' -f -a '{}'\n", name, command.name,
                                  fmt::join(words, " "));
        }
        for_each_option(program, command, [&](const DescribedOption& option) {
            script += fmt::format("complete -c {} -n '__fish_seen_subcommand_from {}'", name, command.name);
            for (const std::string& word : option.names) {
                script += word.starts_with("--") ? " -l " + word.substr(2) : " -s " + word.substr(1);
            }
            if (!option.choices.empty()) {
                script += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
            } else if (!option.value.empty()) {
                script += " -r";
            }
            script += fmt::format(" -d {}\n", quoted(brief(option.text)));
        });
    }
    return script;
}

} // namespace

const std::vector<std::string>& completion_shells() {
    static const std::vector<std::string> shells{"bash", "zsh", "fish"};
    return shells;
}

std::string completion_script(const DescribedProgram& program, const std::string& shell) {
    if (shell == "bash") {
        return bash_script(program);
    }
    if (shell == "zsh") {
        return zsh_script(program);
    }
    if (shell == "fish") {
        return fish_script(program);
    }
    throw Error(ErrorCode::usage, fmt::format("there is no completion for '{}'; remedy: one of {}", shell,
                                              fmt::join(completion_shells(), ", ")));
}

} // namespace foam::cli
