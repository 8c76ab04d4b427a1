#include "support/environment_variable.hpp"
#include "support/temporary_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/runtime/process.hpp>
#include <foam/runtime/scratch_folder.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foam {
namespace {

namespace fs = std::filesystem;
using ::testing::StartsWith;

/// "" if it can be made.
template <class... Folder> std::string refusal(const Folder&... folder) {
    try {
        const ScratchFolder scratch(folder...);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::output);
        return error.what();
    }
    return "";
}

TEST(ScratchFolder, IsRemovedWithAllThatIsInIt) {
    const TemporaryFolder folder;
    fs::path path;
    {
        const ScratchFolder scratch(folder.path());
        path = scratch.path();
        EXPECT_EQ(path.parent_path(), folder.path());
        EXPECT_THAT(path.filename().string(), StartsWith(".foam-"));
        fs::create_directory(path / "run");
        write_file(path / "run" / "manifest.json", "{}");
    }
    EXPECT_FALSE(fs::exists(path));
}

TEST(ScratchFolder, IsWhereTheSystemKeepsTemporaryFiles) {
    const TemporaryFolder folder;
    const EnvironmentVariable temporary("TMPDIR", folder.path().c_str());
    const ScratchFolder first, second;
    EXPECT_EQ(first.path().parent_path(), folder.path());
    EXPECT_NE(first.path(), second.path());
}

TEST(ScratchFolder, ACrashRemovesIt) {
    const ScratchFolder scratch;
    write_file(scratch.path() / "file", "");
    remove_unfinished_runs();
    EXPECT_FALSE(fs::exists(scratch.path()));
}

TEST(ScratchFolder, SaysWhereItCannotBeMade) {
    const TemporaryFolder folder;
    const fs::path none = folder.path() / "none";
    EXPECT_EQ(refusal(none),
              "cannot write to the folder " + none.string() + " (No such file or directory); remedy: name another one");
    const EnvironmentVariable temporary("TMPDIR", none.c_str());
    EXPECT_EQ(refusal(), "there is no folder for temporary files (No such file or directory); remedy: set TMPDIR");
}

} // namespace
} // namespace foam
