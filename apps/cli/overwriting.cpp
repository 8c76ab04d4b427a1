#include "overwriting.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::cli {
namespace fs = std::filesystem;

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
