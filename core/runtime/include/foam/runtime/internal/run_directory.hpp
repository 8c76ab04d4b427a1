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
    /// Makes the temporary folder beside `target`. Throws Error(output) if `target` exists and is neither empty nor a
    /// folder with the file `mark`: other programs' files are never replaced.
    explicit RunDirectory(std::filesystem::path target, const char* mark = "manifest.json");
    /// Removes the temporary folder if commit() was not called.
    ~RunDirectory();
    RunDirectory(const RunDirectory&) = delete;
    RunDirectory& operator=(const RunDirectory&) = delete;

    /// `file` is relative to the folder.
    void write(const std::filesystem::path& file, std::string_view bytes) const;
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
