#include "support/temporary_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/runtime/cache.hpp>
#include <foam/runtime/internal/cache.hpp>

#include <gtest/gtest.h>

#include <chrono>

namespace foam {
namespace {

const Digest key = digest_of("a key");

SphereTree some_tree() {
    return flat_tree({{{0.1, 0.2, 0.3}, 0.4}, {{1, 2, 3}, 0.5}});
}

StageLog some_log() {
    return {"a call", {{Severity::warning, "", "", "mind the gap"}}, {{"moves", 3, "1"}}};
}

TEST(Cache, GivesBackWhatWasPut) {
    const TemporaryFolder folder;
    const Cache cache(folder.path());
    EXPECT_FALSE(cache.tree(key));
    cache.put(key, some_tree(), some_log());
    const auto entry = cache.tree(key);
    ASSERT_TRUE(entry);
    EXPECT_EQ(entry->result, some_tree());
    EXPECT_EQ(entry->log.call, "a call");
    ASSERT_EQ(entry->log.findings.size(), 1u);
    EXPECT_EQ(entry->log.findings[0].severity, Severity::warning);
    EXPECT_EQ(entry->log.findings[0].message, "mind the gap");
    ASSERT_EQ(entry->log.metrics.size(), 1u);
    EXPECT_EQ(entry->log.metrics[0].name, "moves");
    EXPECT_EQ(entry->log.metrics[0].value, 3);
    EXPECT_EQ(entry->log.metrics[0].unit, "1");

    const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const Digest other = digest_of("another key");
    cache.put(other, mesh, {});
    EXPECT_EQ(cache.mesh(other).value().result, mesh);
}

TEST(Cache, ADamagedEntryIsNoEntry) {
    const TemporaryFolder folder;
    const Cache cache(folder.path());
    cache.put(key, some_tree(), some_log());
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
    off.put(key, some_tree(), some_log());
    EXPECT_FALSE(off.tree(key));

    const TemporaryFolder folder;
    write_file(folder.path() / "file", "not a folder");
    const Cache unwritable(folder.path() / "file");
    unwritable.put(key, some_tree(), some_log());
    EXPECT_FALSE(unwritable.tree(key));
}

/// Sets when an entry was used last: seconds before now.
void used(const std::filesystem::path& folder, const Digest& of, int seconds_ago) {
    std::filesystem::last_write_time(folder / of.substr(0, 2) / of.substr(2),
                                     std::filesystem::file_time_type::clock::now() - std::chrono::seconds(seconds_ago));
}

TEST(Cache, IsTrimmedByTheTimeOfUse) {
    const TemporaryFolder folder;
    const Cache cache(folder.path());
    const Digest keys[] = {digest_of("a"), digest_of("b"), digest_of("c")};
    for (const Digest& of : keys) {
        cache.put(of, some_tree(), some_log());
    }
    used(folder.path(), keys[0], 3000);
    used(folder.path(), keys[1], 2000);
    used(folder.path(), keys[2], 1000);
    write_file(folder.path() / "notes.txt", "not an entry");
    const CacheContents all = cache_contents(folder.path());
    EXPECT_EQ(all.entries, 3u);
    const std::uintmax_t one = all.bytes / 3;
    EXPECT_EQ(trim_cache(folder.path(), all.bytes).entries, 0u);

    EXPECT_TRUE(cache.tree(keys[0])) << "it is now the last that was used";
    const CacheContents deleted = trim_cache(folder.path(), all.bytes - 1);
    EXPECT_EQ(deleted.entries, 1u);
    EXPECT_EQ(deleted.bytes, one);
    EXPECT_FALSE(cache.tree(keys[1]));
    EXPECT_TRUE(cache.tree(keys[0]) && cache.tree(keys[2]));

    EXPECT_EQ(trim_cache(folder.path(), 0).entries, 2u);
    EXPECT_EQ(cache_contents(folder.path()).entries, 0u);
    EXPECT_EQ(read_file(folder.path() / "notes.txt"), "not an entry");
    EXPECT_EQ(trim_cache(folder.path() / "none", 0).entries, 0u);
}

TEST(Cache, KeepsWithinALimitWhenItGrew) {
    const TemporaryFolder folder;
    Cache(folder.path()).put(key, some_tree(), some_log());
    Cache cache(folder.path());
    cache.keep_within(1);
    EXPECT_TRUE(cache.tree(key)) << "nothing was put";
    cache.put(digest_of("another key"), some_tree(), some_log());
    cache.keep_within(0);
    EXPECT_EQ(cache_contents(folder.path()).entries, 2u) << "0 is no limit";
    cache.keep_within(1);
    EXPECT_EQ(cache_contents(folder.path()).entries, 0u);
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
              (folder.path() / "none").string() + ": there is no such file; remedy: check the path");
    EXPECT_EQ(message(folder.path()),
              folder.path().string() + ": it is a folder, not a regular file; remedy: give the path of a file");
}

} // namespace
} // namespace foam
