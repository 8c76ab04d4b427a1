#include "execute.hpp"
#include "robot_options.hpp"

#include "cli/files.hpp"
#include "cli/program.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::cli {
namespace {

/// Returns a value of the type that the parameter declares; nothing if the text is none.
std::optional<ParameterValue> value_of(const std::string& text, const Parameter& parameter) {
    const std::optional<double> number = parse_number(text);
    switch (parameter.type) {
    case Parameter::Type::boolean:
        return text == "true" || text == "false" ? std::optional<ParameterValue>(text == "true") : std::nullopt;
    case Parameter::Type::integer:
        return number && *number == std::floor(*number) && std::abs(*number) < 1e15
                   ? std::optional<ParameterValue>(static_cast<std::int64_t>(*number))
                   : std::nullopt;
    case Parameter::Type::number:
        return parameter.unit_text == "m" ? length_of(text, "--set " + parameter.name)
               : number                   ? std::optional<ParameterValue>(*number)
                                          : std::nullopt;
    case Parameter::Type::text:
    case Parameter::Type::choice:
        break;
    }
    return text;
}

/// Returns the parameter of a name, or of its path in a recipe, outputs.write.urdf.level, as `foam spherize` has it.
const Parameter& parameter_of(std::string name, const StageInfo& writer) {
    if (const std::string path = "outputs." + writer.name + "."; name.starts_with(path)) {
        name.erase(0, path.size());
    }
    std::vector<std::string> known;
    for (const Parameter& parameter : writer.parameters) {
        if (parameter.name == name) {
            return parameter;
        }
        known.push_back(parameter.name);
    }
    const std::string near = nearest_word(name, known);
    throw Error(ErrorCode::usage,
                fmt::format("--set: {} has no parameter '{}'{}; there {}", writer.name, shown(name),
                            near.empty() ? "" : fmt::format("; did you mean '{}'?", near),
                            known.empty() ? "is none" : fmt::format("are: {}", fmt::join(known, ", "))));
}

} // namespace

std::vector<std::string> file_names(const std::vector<WrittenFile>& files) {
    std::vector<std::string> names;
    for (const WrittenFile& file : files) {
        names.push_back(file.file.string());
    }
    return names;
}

std::string names_text(const std::vector<WrittenFile>& files) {
    constexpr std::size_t few = 4;
    const std::vector<std::string> names = file_names(files);
    if (names.size() <= few) {
        return fmt::format("{}", fmt::join(names, ", "));
    }
    const std::filesystem::path folder = files.back().file.parent_path();
    return fmt::format("{}, and {} files{}", names.front(), names.size() - 1,
                       folder == files.front().file.parent_path() ? " beside it" : " in " + folder.string());
}

/// Returns the bytes of a file that is replaced; "" if there is none.
static std::string bytes_before(const std::filesystem::path& file) {
    constexpr std::uintmax_t most_bytes = 1'000'000'000;
    return std::filesystem::is_regular_file(file) ? read_regular_file(file, most_bytes, "").bytes : "";
}

void refuse_replacing(const std::vector<WrittenFile>& files, const std::vector<std::filesystem::path>& inputs,
                      bool force) {
    std::vector<std::string> before;
    for (const WrittenFile& file : files) {
        refuse_overwriting(file.file, inputs, force);
        before.push_back(bytes_before(file.file));
    }
    const auto names = [&](std::size_t a, std::size_t b) {
        return a != b && before[a].find(files[b].file.filename().string()) != std::string::npos;
    };
    for (std::size_t i = 1; i < files.size() && !force; ++i) {
        bool ours = before[i].empty() || before[i] == files[i].bytes;
        for (std::size_t k = 0; k < files.size() && !ours; ++k) {
            ours = names(i, k) || names(k, i);
        }
        if (!ours) {
            throw Error(ErrorCode::usage,
                        fmt::format("{}: the output would replace this file, which does not belong to an earlier {}; "
                                    "nothing was written; remedy: another name, or --force",
                                    files[i].file.string(), files.front().file.filename().string()));
        }
    }
}

void make_folder_of(const WrittenFile& file) {
    if (file.beside) {
        std::error_code error; // writing the file reports it
        std::filesystem::create_directories(file.file.parent_path(), error);
    }
}

std::map<std::string, ParameterValue> parameters_of(const std::vector<std::string>& texts, const StageInfo& writer) {
    std::map<std::string, ParameterValue> values;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == text.npos) {
            throw Error(ErrorCode::usage, fmt::format("--set expects KEY=VALUE, got '{}'", text));
        }
        const Parameter& parameter = parameter_of(text.substr(0, equals), writer);
        const auto value = value_of(text.substr(equals + 1), parameter);
        const std::string why =
            value ? why_invalid(parameter, *value)
                  : fmt::format("expects {}, got \"{}\"", expectation(parameter), shown(text.substr(equals + 1)));
        if (!why.empty()) {
            throw Error(ErrorCode::usage, fmt::format("--set: '{}' of {} {}", parameter.name, writer.name, why));
        }
        values[parameter.name] = *value;
    }
    return values;
}

void question_setting(const std::string& text, const StageInfo& writer, double size) {
    const std::size_t equals = text.find('=');
    const Parameter& parameter = parameter_of(text.substr(0, equals), writer);
    if (parameter.type == Parameter::Type::number && parameter.unit_text == "m") {
        question_length("--set " + parameter.name, text.substr(equals + 1), size, "the robot");
    }
}

} // namespace foam::cli
