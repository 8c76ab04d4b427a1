#include "recipe_file.hpp"

#include "suggestion.hpp"

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

} // namespace foam::cli
