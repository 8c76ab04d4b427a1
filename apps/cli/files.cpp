#include "files.hpp"
#include "messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/sdk.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>
#include <vector>

namespace foam::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
        if (entry.path().extension() == ".yaml") {
            names.push_back(entry.path().stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace

fs::path recipe_file(const std::string& name) {
    const fs::path given(name);
    std::error_code none;
    // A folder may be what an earlier run wrote.
    if (name.empty() || given.has_parent_path() || given.has_extension() ||
        (fs::exists(given, none) && !fs::is_directory(given, none))) {
        return given;
    }
    const fs::path folder = installation_prefix() / "share/foam/configs";
    const std::vector<std::string> names = names_in(folder);
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: there is no such file, and no recipe of this name comes with foam; remedy: check "
                                "the path, or name one of {}{}",
                                shown(name), fmt::join(names, ", "), did_you_mean(name, names)));
    }
    return folder / (name + ".yaml");
}

void add_run_directory(CLI::App& command, std::string& directory, const std::string& description) {
    CLI::Option* option = command.add_option("--run-dir", directory, description)->type_name("DIR");
    command
        .add_option_function<std::string>("--out",
                                          [option, &directory](const std::string& given) {
                                              if (option->count() > 0) {
                                                  throw Error(ErrorCode::usage,
                                                              "--out is the old spelling of --run-dir; remedy: one of "
                                                              "the two");
                                              }
                                              directory = given;
                                          })
        ->group("");
}

void refuse_output_file(CLI::App& command) {
    command
        .add_option_function<std::string>(
            "-o,--output",
            [&command](const std::string& given) {
                throw Error(ErrorCode::usage,
                            fmt::format("-o names an output file, and foam {} writes a folder; remedy: --run-dir {}",
                                        command.get_name(), given.empty() ? "DIR" : given));
            })
        ->expected(0, 1)
        ->group("");
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code error; // what does not exist is no file
    return !a.empty() && !b.empty() && fs::equivalent(a, b, error) && !error;
}

void add_force(CLI::App& command, bool& force) {
    command.add_flag("--force", force, "Write even if this replaces an input file");
}

void refuse_overwriting(const fs::path& target, const std::vector<fs::path>& inputs, bool force) {
    for (const fs::path& input : inputs) {
        if (!force && is_same_file(target, input)) {
            throw Error(ErrorCode::usage,
                        fmt::format("{}: the output would replace the input {}; nothing was written; remedy: another "
                                    "name, or --force",
                                    target.string(), input.string()));
        }
    }
}

void refuse_replacing(const fs::path& folder, const std::vector<fs::path>& inputs, bool force) {
    std::error_code error;
    const fs::path whole = fs::canonical(folder, error);
    if (force || error) {
        return; // a folder that does not exist holds nothing
    }
    for (const fs::path& input : inputs) {
        const fs::path file = fs::canonical(input, error);
        if (!error && std::mismatch(whole.begin(), whole.end(), file.begin(), file.end()).first == whole.end()) {
            throw Error(ErrorCode::usage,
                        fmt::format("{}: the run would replace this folder, in which the input {} lies; nothing was "
                                    "written; remedy: another folder, or --force",
                                    folder.string(), input.string()));
        }
    }
}

} // namespace foam::cli
