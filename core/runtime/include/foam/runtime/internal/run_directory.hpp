// The folder of a run: filled under a temporary name, then put in place in one step. An interrupted run keeps the
// previous one.
#pragma once

#include <foam/runtime/internal/unfinished.hpp>

#include <filesystem>
#include <optional>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

class RunDirectory {
public:
    /// Makes the temporary folder beside `target`, and removes those that killed runs left there. Throws Error(output)
    /// naming the file if `target` holds anything that the run before did not write: each run leaves the list `.foam-run`
    /// of its files.
    explicit RunDirectory(std::filesystem::path target);
    /// Removes the temporary folder if commit() was not called.
    ~RunDirectory();
    RunDirectory(const RunDirectory&) = delete;
    RunDirectory& operator=(const RunDirectory&) = delete;

    /// `file` is relative to the folder.
    void write(const std::filesystem::path& file, std::string_view bytes) const;
    /// Puts the folder in place of that of an earlier run. Throws Error(output) if a file of others came there meanwhile.
    void commit();
    /// Returns the final absolute path.
    const std::filesystem::path& target() const { return target_; }

private:
    std::filesystem::path target_, temporary_;
    std::optional<UnfinishedFolder> unfinished_; ///< removed after a crash, too
    bool committed_ = false;
};

} // namespace runtime
} // namespace foam
