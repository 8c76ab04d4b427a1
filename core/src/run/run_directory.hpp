// The folder of a run: filled under a temporary name, then put in place in one step. An interrupted run leaves what was
// there before.
#pragma once

#include "unfinished.hpp"

#include <filesystem>
#include <optional>
#include <string_view>

namespace foam {

class RunDirectory {
public:
    /// Makes the temporary folder beside `target`. Throws Error(output) if `target` exists and is neither empty nor a
    /// folder that holds the file `mark`: foreign files are never replaced.
    explicit RunDirectory(std::filesystem::path target, const char* mark = "manifest.json");
    /// Removes the temporary folder, if commit() was not called.
    ~RunDirectory();
    RunDirectory(const RunDirectory&) = delete;
    RunDirectory& operator=(const RunDirectory&) = delete;

    /// `file` is relative to the folder.
    void write(const std::filesystem::path& file, std::string_view bytes) const;
    void commit();
    /// Where it will lie, absolute.
    const std::filesystem::path& target() const { return target_; }

private:
    std::filesystem::path target_, temporary_;
    std::optional<UnfinishedFolder> unfinished_; ///< removed by a crash, too
    bool committed_ = false;
};

} // namespace foam
