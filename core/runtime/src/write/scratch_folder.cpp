#include <foam/runtime/scratch_folder.hpp>

#include <foam/base/error.hpp>
#include <foam/runtime/internal/unfinished.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace foam::inline runtime {
namespace {

namespace fs = std::filesystem;

fs::path folder_for_temporary_files() {
    std::error_code error;
    fs::path folder = fs::temp_directory_path(error);
    if (error) {
        throw Error(ErrorCode::output,
                    fmt::format("there is no folder for temporary files ({}); remedy: set TMPDIR", error.message()));
    }
    return folder;
}

fs::path made(const fs::path& folder, const char* name, const char* remedy) {
    remove_abandoned_folders(folder);
    std::string pattern = (folder / name).string();
    if (!mkdtemp(pattern.data())) {
        throw Error(ErrorCode::output, fmt::format("cannot write to the folder {} ({}); remedy: {}", folder.string(),
                                                   std::generic_category().message(errno), remedy));
    }
    return pattern;
}

} // namespace

ScratchFolder::ScratchFolder()
    : path_(made(folder_for_temporary_files(), "foam-XXXXXX", "set TMPDIR")),
      unfinished_(std::make_unique<UnfinishedFolder>(path_)) {}

ScratchFolder::ScratchFolder(const fs::path& folder)
    : path_(made(fs::absolute(folder), ".foam-XXXXXX", "name another one")),
      unfinished_(std::make_unique<UnfinishedFolder>(path_)) {}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

} // namespace foam::runtime
