#include <foam/runtime/internal/output.hpp>

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/runtime/scratch_folder.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <set>
#include <string>
#include <system_error>
#include <vector>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

/// The list of the files that a run wrote, one a line, after this first line.
constexpr const char* list_name = ".foam-run";
constexpr const char* list_title = "files of a run of foam, format 1";

/// Returns everything below the folder that is no folder, relative to it, sorted; symbolic links are not followed.
std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (!fs::is_directory(entry.symlink_status())) {
            files.push_back(entry.path().lexically_relative(folder).string());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Returns the files that the run in the folder wrote; nothing if no run did. Lines that lead out of the folder are left
/// out.
std::set<std::string> files_of_run(const fs::path& folder) {
    std::set<std::string> files;
    constexpr std::uintmax_t most_bytes = 1'000'000'000;
    const FileContents list = read_regular_file(folder / list_name, most_bytes, "");
    if (!list.problem.empty() || !list.bytes.starts_with(list_title)) {
        return files;
    }
    files.insert(list_name);
    for (std::size_t begin = list.bytes.find('\n'); begin != std::string::npos;) {
        const std::size_t end = list.bytes.find('\n', begin + 1);
        if (end != std::string::npos) {
            const std::string file = list.bytes.substr(begin + 1, end - begin - 1);
            if (is_within_folder(file)) {
                files.insert(file);
            }
        }
        begin = end;
    }
    return files;
}

/// Throws unless there is nothing at the place, an empty folder, or one in which an earlier run wrote every file.
void require_replaceable(const fs::path& target) {
    std::error_code error;
    const auto status = fs::symlink_status(target, error);
    if (!fs::exists(status) || (fs::is_directory(status) && fs::is_empty(target, error))) {
        return;
    }
    const std::set<std::string> ours = fs::is_directory(status) ? files_of_run(target) : std::set<std::string>{};
    if (ours.empty()) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: exists, but is not the folder of a run (no {} in it), so foam does not replace "
                                "it; remedy: choose another folder with --run-dir, or remove it",
                                target.string(), list_name));
    }
    std::vector<std::string> others = files_below(target);
    std::erase_if(others, [&](const std::string& file) { return ours.contains(file); });
    if (!others.empty()) {
        const std::string more =
            others.size() == 1 ? ""
                               : fmt::format(" and {} more file{}", others.size() - 1, others.size() == 2 ? "" : "s");
        throw Error(ErrorCode::output,
                    fmt::format("{}: {}{} in it {} not written by the run that foam would replace; nothing was "
                                "written; remedy: move {} elsewhere, or choose another folder with --run-dir",
                                target.string(), shown(others.front()), more, others.size() == 1 ? "was" : "were",
                                others.size() == 1 ? "it" : "them"));
    }
}

/// Removes the files that the run in `old` wrote, and the folders that are then empty. What else is there moves to the same
/// place in `now`, unless a file has that place.
void remove_run(const fs::path& old, const fs::path& now) {
    std::error_code error;
    for (const std::string& file : files_of_run(old)) {
        if (file != list_name) {
            fs::remove(old / file, error);
        }
    }
    fs::remove(old / list_name, error);
    for (const std::string& file : files_below(old)) {
        fs::create_directories((now / file).parent_path(), error);
        if (renameat2(AT_FDCWD, (old / file).c_str(), AT_FDCWD, (now / file).c_str(), RENAME_NOREPLACE) != 0) {
            return; // it stays where it is
        }
    }
    fs::remove_all(old, error);
}

} // namespace

RunDirectory::RunDirectory(fs::path target) : target_(fs::absolute(target).lexically_normal()) {
    if (target_.filename().empty()) {
        target_ = target_.parent_path();
    }
    require_replaceable(target_);
    remove_abandoned_folders(target_.parent_path());
    temporary_ = target_.parent_path() / fmt::format(".{}.partial-{}", target_.filename().string(), getpid());
    std::error_code error;
    fs::remove_all(temporary_, error);
    fs::create_directories(temporary_, error);
    if (error) {
        throw Error(
            ErrorCode::output,
            fmt::format("{}: the run directory cannot be made: {}; remedy: choose another folder with --run-dir",
                        target_.string(), error.message()));
    }
    unfinished_.emplace(temporary_);
}

RunDirectory::~RunDirectory() {
    if (!committed_) {
        std::error_code ignored;
        fs::remove_all(temporary_, ignored);
    }
}

void RunDirectory::write(const fs::path& file, std::string_view bytes) const {
    write_file(temporary_ / file, bytes);
}

void RunDirectory::commit() {
    unfinished_->finish();
    std::string list = list_title;
    for (const std::string& file : files_below(temporary_)) {
        list += '\n' + file;
    }
    write(list_name, list + '\n');
    require_replaceable(target_); // what came meanwhile stays as well
    std::error_code error;
    fs::path old;
    if (fs::exists(target_)) {
        // An existing run is exchanged with the new one in one step, so that the name always has a complete run.
        old = temporary_;
        if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) != 0) {
            old = temporary_.string() + "-old"; // the file system does not support the exchange
            fs::rename(target_, old, error);
            fs::rename(temporary_, target_, error);
        }
    } else {
        fs::rename(temporary_, target_, error);
    }
    if (error) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot be put in place: {}", target_.string(), error.message()));
    }
    committed_ = true;
    unfinished_.reset();
    if (!old.empty()) {
        remove_run(old, target_);
    }
}

namespace {

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

} // namespace foam::inline runtime
