#include "process/process.hpp"

#include <foam/runtime/cache.hpp>
#include <foam/runtime/internal/output.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace foam::inline runtime {
namespace {

namespace fs = std::filesystem;

/// Opens the file and locks it. Returns the descriptor, which holds the lock; -1: that cannot be, or another process
/// holds it.
int locked(const fs::path& file, int flags) {
    const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | flags, 0600);
    if (descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        close(descriptor);
        return -1;
    }
    return descriptor;
}

bool is_of_this_user(const fs::path& folder) {
    struct stat status {};
    return lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == geteuid();
}

/// Returns whether the name is one that foam gives to unfinished folders.
bool is_temporary_name(const std::string& name) {
    return name.starts_with(".foam-") || name.starts_with("foam-") ||
           (name.starts_with(".") && name.find(".partial-") != name.npos);
}

} // namespace

UnfinishedFolder::UnfinishedFolder(const fs::path& folder)
    : mark_(folder / unfinished_mark), slot_(keep_for_crash(folder)) {
    // The mark gets its name once it is locked, so that nobody takes the folder for an abandoned one.
    const fs::path unnamed = mark_.string() + "-new";
    lock_ = locked(unnamed, O_CREAT);
    std::error_code ignored; // where files cannot be locked, the folder has no mark, and stays after a kill
    if (lock_ >= 0) {
        fs::rename(unnamed, mark_, ignored);
    } else {
        fs::remove(unnamed, ignored);
    }
}

UnfinishedFolder::~UnfinishedFolder() {
    forget_for_crash(slot_);
    if (lock_ >= 0) {
        close(lock_);
    }
}

void UnfinishedFolder::finish() {
    std::error_code ignored;
    fs::remove(mark_, ignored);
}

std::size_t remove_abandoned_folders(const fs::path& parent) {
    std::size_t removed = 0;
    std::error_code error;
    std::vector<fs::path> candidates;
    for (fs::directory_iterator it(parent, error), end; !error && it != end; it.increment(error)) {
        if (is_temporary_name(it->path().filename().string()) && is_of_this_user(it->path())) {
            candidates.push_back(it->path());
        }
    }
    for (const fs::path& folder : candidates) {
        if (const int lock = locked(folder / unfinished_mark, 0); lock >= 0) {
            fs::remove_all(folder, error);
            removed += error ? 0 : 1;
            close(lock);
        }
    }
    return removed;
}

std::size_t remove_leftovers(const std::vector<fs::path>& folders) {
    std::error_code none; // where there is no such folder, there is nothing to remove
    std::size_t removed = remove_abandoned_folders(fs::temp_directory_path(none));
    for (const fs::path& folder : folders) {
        removed += remove_abandoned_folders(folder);
    }
    return removed;
}

} // namespace foam::inline runtime
