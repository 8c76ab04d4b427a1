#include "support/temporary_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/runtime/internal/debug.hpp>
#include <foam/runtime/internal/run_directory.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(RunDirectory, AppearsWholeOnCommit) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "a" / "run";
    {
        RunDirectory run(target);
        run.write("manifest.json", "{}");
        run.write("links/base/0.ply", "ply");
        EXPECT_FALSE(fs::exists(target));
        run.commit();
    }
    EXPECT_EQ(read_file(target / "links/base/0.ply"), "ply");
    EXPECT_EQ(entries(folder.path() / "a"), 1u) << "a temporary folder was left behind";
}

TEST(RunDirectory, WithoutCommitLeavesWhatWasThere) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "run";
    {
        RunDirectory run(target);
        run.write("manifest.json", "first");
        run.commit();
    }
    {
        RunDirectory run(target);
        run.write("manifest.json", "second");
    }
    EXPECT_EQ(read_file(target / "manifest.json"), "first");
    EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(RunDirectory, ReplacesAnEarlierRunWhole) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "run";
    for (const char* content : {"first", "second"}) {
        RunDirectory run(target);
        run.write("manifest.json", content);
        run.write(std::string(content) + ".urdf", "");
        run.commit();
    }
    EXPECT_EQ(read_file(target / "manifest.json"), "second");
    EXPECT_FALSE(fs::exists(target / "first.urdf"));
    EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(RunDirectory, AnyLinkNameMakesAFolderName) {
    EXPECT_EQ(folder_name("panda_link0"), "panda_link0");
    EXPECT_EQ(folder_name("a/b"), "a%2Fb");
    EXPECT_EQ(folder_name(".."), "_..");
    const std::string longest(200, 'x'), longer(201, 'x'), other = longer + "y";
    EXPECT_EQ(folder_name(longest), longest);
    EXPECT_EQ(folder_name(longer).size(), 200u);
    EXPECT_NE(folder_name(longer), folder_name(other));
    EXPECT_LE(folder_name(std::string(300, '/')).size(), 200u);
}

TEST(RunDirectory, NeverReplacesWhatIsNotARun) {
    const TemporaryFolder folder;
    write_file(folder.path() / "home" / "thesis.tex", "years of work");
    EXPECT_THROW(RunDirectory(folder.path() / "home"), Error);
    write_file(folder.path() / "file", "x");
    EXPECT_THROW(RunDirectory(folder.path() / "file"), Error);
    EXPECT_EQ(read_file(folder.path() / "home" / "thesis.tex"), "years of work");
    EXPECT_EQ(entries(folder.path()), 2u);
}

TEST(RunDirectory, ThatCannotBeMadeHasARemedy) {
    const TemporaryFolder folder;
    write_file(folder.path() / "file", "x");
    const fs::path target = folder.path() / "file" / "run";
    try {
        RunDirectory run(target);
        ADD_FAILURE() << "it was made";
    } catch (const Error& error) {
        EXPECT_EQ(error.what(), target.string() + ": the run directory cannot be made: Not a directory; remedy: choose "
                                                  "another folder with --run-dir");
    }
}

} // namespace
} // namespace foam
