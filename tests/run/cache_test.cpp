#include "run/cache.hpp"
#include "run/digest.hpp"
#include "run/files.hpp"
#include "support/temporary_folder.hpp"

#include <foam/error.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

const Digest key = digest_of("a key");

SphereTree some_tree() {
    return flat_tree({{{0.1, 0.2, 0.3}, 0.4}, {{1, 2, 3}, 0.5}});
}

TEST(Cache, GivesBackWhatWasPut) {
    const TemporaryFolder folder;
    const Cache cache(folder.path());
    EXPECT_FALSE(cache.tree(key));
    cache.put(key, some_tree());
    EXPECT_EQ(cache.tree(key), some_tree());

    const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const Digest other = digest_of("another key");
    cache.put(other, mesh);
    EXPECT_EQ(cache.mesh(other), mesh);
}

TEST(Cache, ADamagedEntryIsNoEntry) {
    const TemporaryFolder folder;
    const Cache cache(folder.path());
    cache.put(key, some_tree());
    const auto file = folder.path() / key.substr(0, 2) / key.substr(2);
    std::string bytes = read_file(file);
    for (const std::size_t at : {bytes.size() - 1, bytes.size() / 2, std::size_t{3}}) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        write_file(file, damaged);
        EXPECT_FALSE(cache.tree(key)) << at;
    }
    write_file(file, bytes.substr(0, bytes.size() - 8));
    EXPECT_FALSE(cache.tree(key));
    write_file(file, "");
    EXPECT_FALSE(cache.tree(key));
    write_file(file, bytes);
    EXPECT_TRUE(cache.tree(key));
}

TEST(Cache, CanBeOffOrUnwritable) {
    const Cache off{std::filesystem::path()};
    off.put(key, some_tree());
    EXPECT_FALSE(off.tree(key));

    const TemporaryFolder folder;
    write_file(folder.path() / "file", "not a folder");
    const Cache unwritable(folder.path() / "file");
    unwritable.put(key, some_tree());
    EXPECT_FALSE(unwritable.tree(key));
}

TEST(Hasher, TellsSequencesApart) {
    EXPECT_NE(Hasher().add("ab").add("c").finish(), Hasher().add("a").add("bc").finish());
    EXPECT_NE(Hasher().add(1.0).finish(), Hasher().add(2.0).finish());
    EXPECT_EQ(Hasher().add(0.0).finish(), Hasher().add(-0.0).finish());
    EXPECT_EQ(digest_of("x").size(), 32u);
}

TEST(Files, AnErrorNamesTheFileAndTheReason) {
    const TemporaryFolder folder;
    const auto message = [](const std::filesystem::path& file) {
        try {
            read_file(file);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::input);
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(message(folder.path() / "none"),
              (folder.path() / "none").string() + ": cannot be read: No such file or directory");
    EXPECT_EQ(message(folder.path()), folder.path().string() + ": this is a folder, a file is needed");
}

} // namespace
} // namespace foam
