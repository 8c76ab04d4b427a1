// Whole files, of whatever kind and size.
#include "support/temporary_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/internal/files.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace foam::test {
namespace {

namespace fs = std::filesystem;

class ReadRegularFile : public ::testing::Test {
protected:
    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.path() / name, std::ios::binary) << text;
        return folder_.path() / name;
    }
    static std::string why_not(const fs::path& file, std::uintmax_t most = 100) {
        return read_regular_file(file, most, "take another").why_not();
    }

    TemporaryFolder folder_;
};

TEST_F(ReadRegularFile, GivesTheBytes) {
    const std::string bytes("a\0b\r\n", 5);
    const FileContents contents = read_regular_file(write("file", bytes), 5, "");
    EXPECT_EQ(contents.bytes, bytes);
    EXPECT_EQ(contents.problem, "");
    EXPECT_EQ(read_regular_file(write("empty", ""), 0, "").problem, "");
    fs::create_symlink("file", folder_.path() / "link");
    EXPECT_EQ(read_regular_file(folder_.path() / "link", 5, "").bytes, bytes);
}

TEST_F(ReadRegularFile, GivesPiecesOfLargeFiles) {
    std::string bytes;
    for (std::size_t i = 0; i < 700'000; ++i) {
        bytes.push_back(static_cast<char>(i * i >> 3));
    }
    const fs::path file = write("large", bytes);
    std::string pieces;
    std::size_t count = 0, longest = 0;
    const auto take = [&](std::string_view piece) {
        pieces += piece;
        longest = std::max(longest, piece.size());
        ++count;
    };
    const FileContents contents = read_regular_file(file, bytes.size(), "", take);
    EXPECT_EQ(contents.problem, "");
    EXPECT_EQ(contents.bytes, "");
    EXPECT_EQ(pieces, bytes);
    EXPECT_GT(count, 1u);
    EXPECT_LE(longest, std::size_t{1} << 18);
    EXPECT_EQ(read_regular_file(file, bytes.size() - 1, "take another", take).why_not(),
              "it has 700000 bytes, more than 699999; remedy: take another");
    const DigestedFile digested = digest_of_file(file);
    EXPECT_EQ(digested.digest, digest_of(bytes));
    EXPECT_EQ(digested.bytes, bytes.size());
    EXPECT_EQ(digest_of_file(write("empty", "")).digest, digest_of(""));
    EXPECT_THROW(digest_of_file(folder_.path() / "none"), Error);
}

TEST_F(ReadRegularFile, RefusesWhatIsNoRegularFile) {
    EXPECT_EQ(why_not(folder_.path() / "none"), "there is no such file; remedy: check the path");
    EXPECT_EQ(why_not(write("file", "x") / "below"), "there is no such file; remedy: check the path");
    EXPECT_EQ(why_not(folder_.path()), "it is a folder, not a regular file; remedy: give the path of a file");
    EXPECT_EQ(why_not("/dev/zero"), "it is a device, not a regular file; remedy: give the path of a file");
    const fs::path pipe = folder_.path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0); // opened to be read it would wait for a writer
    EXPECT_EQ(why_not(pipe), "it is a pipe, not a regular file; remedy: give the path of a file");
    const fs::path secret = write("secret", "x");
    fs::permissions(secret, fs::perms::none);
    if (geteuid() != 0) {
        EXPECT_EQ(why_not(secret), "it cannot be read (Permission denied); remedy: check its permissions");
    }
}

TEST_F(ReadRegularFile, AsksTheSizeBeforeItReads) {
    const fs::path file = write("file", "123456");
    EXPECT_EQ(why_not(file, 6), "");
    EXPECT_EQ(why_not(file, 5), "it has 6 bytes, more than 5; remedy: take another");
    fs::resize_file(file, std::uintmax_t{1} << 40); // sparse
    EXPECT_EQ(why_not(file, std::uintmax_t{1} << 39),
              "it has 1099511627776 bytes, more than 549755813888; remedy: take another");
}

TEST_F(ReadRegularFile, NoticesAChangingSize) {
    // A regular file of size 0 that holds bytes all the same.
    EXPECT_EQ(why_not("/proc/self/stat", 100'000), "it changed while it was read; remedy: wait until it is written");
}

} // namespace
} // namespace foam::test
