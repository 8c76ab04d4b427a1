#include "help.hpp"

#include "messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace foam::cli {
namespace {

/// Returns the text with the characters that roff would read as commands escaped.
std::string roff(const std::string& text) {
    std::string result;
    bool begins = true;
    for (const char c : text) {
        if (begins && (c == '.' || c == '\'')) {
            result += "\\&";
        }
        result += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
        begins = c == '\n';
    }
    return result;
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::string title(const std::string& page, const std::string& version) {
    return fmt::format(".TH {} 1 \"\" \"foam {}\" \"User Commands\"\n", roff(upper(page)), roff(version));
}

/// Returns the options as a list of paragraphs; those that are positional, or the others.
std::string option_list(const DescribedCommand& command, bool positional) {
    std::string text;
    for (const DescribedOption& option : command.options) {
        if (option.positional != positional) {
            continue;
        }
        std::string names;
        for (const std::string& name : option.names) {
            names += (names.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
        }
        text += fmt::format(".TP\n{}{}\n{}\n", names,
                            option.value.empty() || positional ? "" : fmt::format(" \\fI{}\\fR", roff(option.value)),
                            roff(option.text));
    }
    return text;
}

/// Returns the end of a help text: examples, and what follows them, as it stands.
std::string footer(const DescribedCommand& command) {
    return fmt::format(".SH NOTES\n.nf\n{}\n.fi\n", roff(command.footer));
}

std::string page_of_program(const DescribedProgram& program, const std::string& version) {
    const DescribedCommand& whole = program.program;
    std::string text =
        title(whole.name, version) +
        fmt::format(".SH NAME\n{0} \\- {1}\n.SH SYNOPSIS\n.B {0}\n[\\fIOPTIONS\\fR] \\fICOMMAND\\fR ...\n"
                    ".SH OPTIONS\n",
                    whole.name, roff(whole.summary)) +
        option_list(whole, false) + ".SH COMMANDS\n";
    for (const DescribedCommand& command : program.commands) {
        text += fmt::format(".TP\n\\fB{}\\fR\n{}; see \\fB{}\\-{}\\fR(1)\n", roff(command.name), roff(command.summary),
                            whole.name, roff(command.name));
    }
    return text + footer(whole);
}

std::string page_of_command(const DescribedProgram& program, const DescribedCommand& command,
                            const std::string& version) {
    const std::string page = program.program.name + "-" + command.name;
    std::string positionals;
    for (const DescribedOption& option : command.options) {
        positionals += option.positional ? fmt::format(" \\fI{}\\fR", roff(upper(option.names.front()))) : "";
    }
    std::string text = title(page, version) +
                       fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B {} {}\n[\\fIOPTIONS\\fR]{}\n", roff(page),
                                   roff(command.summary), program.program.name, roff(command.name), positionals);
    if (const std::string list = option_list(command, true); !list.empty()) {
        text += ".SH ARGUMENTS\n" + list;
    }
    if (const std::string list = option_list(command, false); !list.empty()) {
        text += ".SH OPTIONS\n" + list;
    }
    return text + footer(command) + fmt::format(".SH SEE ALSO\n\\fB{}\\fR(1)\n", program.program.name);
}

} // namespace

std::string manual_page(const DescribedProgram& program, const std::string& command, const std::string& version) {
    if (command.empty()) {
        return page_of_program(program, version);
    }
    std::vector<std::string> names;
    for (const DescribedCommand& known : program.commands) {
        if (known.name == command) {
            return page_of_command(program, known, version);
        }
        names.push_back(known.name);
    }
    throw Error(ErrorCode::usage, unknown_command(shown(command), names));
}

} // namespace foam::cli
