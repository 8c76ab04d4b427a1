#include "support/temporary_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/runtime/internal/output.hpp>

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

TEST(RunDirectory, HoldsNothingButFilesOfTheRunBefore) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "run";
    const auto run = [&] {
        RunDirectory directory(target);
        directory.write("manifest.json", "{}");
        directory.write("links/a/0.ply", "ply");
        directory.commit();
    };
    run();
    run();
    const auto refused = [&] {
        try {
            run();
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    write_file(target / "links/a/notes.txt", "mine");
    EXPECT_EQ(refused(), target.string() + ": links/a/notes.txt in it was not written by the run that foam would replace; "
                                           "nothing was written; remedy: move it elsewhere, or choose another folder "
                                           "with --run-dir");
    write_file(target / "recipe.yaml", "foam: 1");
    EXPECT_NE(refused().find("links/a/notes.txt and 1 more file in it were not written"), std::string::npos);
    EXPECT_EQ(read_file(target / "links/a/notes.txt"), "mine");
    fs::remove(target / "recipe.yaml");
    fs::remove(target / "links/a/notes.txt");
    fs::create_symlink("manifest.json", target / "link");
    EXPECT_NE(refused(), "");
    EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(RunDirectory, AFolderWithAnyManifestIsNotARun) {
    const TemporaryFolder folder;
    write_file(folder.path() / "web/manifest.json", R"({"name": "my web app"})");
    EXPECT_THROW(RunDirectory(folder.path() / "web"), Error);
    write_file(folder.path() / "list/.foam-run", "files of a run of foam, format 1\n../../home\n");
    write_file(folder.path() / "home", "precious");
    {
        RunDirectory run(folder.path() / "list");
        run.commit();
    }
    EXPECT_EQ(read_file(folder.path() / "home"), "precious");
}

TEST(RunDirectory, WhatComesWhileTheRunIsGoingStays) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "run";
    {
        RunDirectory run(target);
        run.write("manifest.json", "{}");
        run.commit();
    }
    {
        RunDirectory run(target);
        run.write("manifest.json", "new");
        write_file(target / "late.txt", "mine");
        EXPECT_THROW(run.commit(), Error);
    }
    EXPECT_EQ(read_file(target / "late.txt"), "mine");
    EXPECT_EQ(read_file(target / "manifest.json"), "{}");
}

TEST(RunDirectory, RemovesWhatKilledRunsLeft) {
    const TemporaryFolder folder;
    const fs::path dead = folder.path() / ".run.partial-1", others = folder.path() / ".other.partial-2";
    write_file(dead / unfinished_mark, "");
    write_file(dead / "links/a.ply", "half");
    write_file(others / "thesis.tex", "without the mark it is not foam's");
    const fs::path living = folder.path() / ".living.partial-3";
    fs::create_directory(living);
    const UnfinishedFolder mark(living);
    {
        RunDirectory run(folder.path() / "run");
        run.commit();
    }
    EXPECT_FALSE(fs::exists(dead));
    EXPECT_TRUE(fs::exists(others / "thesis.tex"));
    EXPECT_TRUE(fs::exists(living));
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
