// Temporary folders that go with their process, however it ends.
#pragma once

#include <filesystem>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Marks a folder as unfinished for its lifetime. A crash of the process removes it (remove_unfinished_runs()). Where the
/// process is killed, remove_abandoned_folders() of a later one does.
class UnfinishedFolder {
public:
    /// Precondition: the folder exists, and is the caller's own.
    explicit UnfinishedFolder(const std::filesystem::path& folder);
    ~UnfinishedFolder();
    UnfinishedFolder(const UnfinishedFolder&) = delete;
    UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

    /// Removes the mark, before the folder gets its final name.
    void finish();

private:
    std::filesystem::path mark_;
    int slot_ = -1, lock_ = -1;
};

/// The file that marks an unfinished folder.
inline constexpr const char* unfinished_mark = ".foam-unfinished";

/// Removes the unfinished folders directly below `parent` that killed processes of this user left behind. Those of
/// running processes are locked, and stay. Returns how many are removed.
std::size_t remove_abandoned_folders(const std::filesystem::path& parent);

} // namespace runtime
} // namespace foam
