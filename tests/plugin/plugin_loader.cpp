// Files that must not be loaded: each is refused with its reason before any of it runs, none of its stages is known
// afterwards, and the program goes on. Plugins that are bad from within: refused_plugins.
#include <foam/base/error.hpp>
#include <foam/sdk/registry.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace foam::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* no_header =
    "it is no shared library (it has no ELF header); remedy: build it with foam_add_plugin()";
const std::string good = std::string(FOAM_TEST_FIXTURES) + "/fixture_stages.so";

class PluginLoader : public testing::Test {
protected:
    void SetUp() override {
        const PluginRecord& record = registry_.load(good);
        ASSERT_TRUE(record.loaded()) << record.rejection;
        stages_ = registry_.stages().size();
        folder_ = fs::canonical(fs::temp_directory_path()) / ("foam_plugin_loader_" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override {
        EXPECT_EQ(registry_.stages().size(), stages_) << "a refused plugin left stages behind";
        fs::remove_all(folder_);
    }

    /// Why one of tests/plugin/bad is refused.
    std::string refusal(const std::string& name) {
        return registry_.load(std::string(FOAM_TEST_BAD_PLUGINS) + "/bad_" + name + ".so").rejection;
    }
    fs::path write(const std::string& name, const std::string& bytes) {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }
    static std::string bytes_of(const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    /// The good plugin with another fingerprint in its note.
    std::string with_note(const std::string& fingerprint) {
        const std::string own = FOAM_ABI_FINGERPRINT;
        EXPECT_EQ(fingerprint.size(), own.size());
        std::string bytes = bytes_of(good);
        const std::size_t note = bytes.find(std::string("foam\0\0\0\0", 8) + own);
        EXPECT_NE(note, std::string::npos);
        return bytes.replace(note + 8, own.size(), fingerprint);
    }

    Registry registry_;
    std::size_t stages_ = 0;
    fs::path folder_;
};

TEST_F(PluginLoader, RefusesWhatIsNoLibrary) {
    EXPECT_EQ(registry_.load(folder_ / "none.so").rejection, "there is no such file; remedy: check the path");
    EXPECT_EQ(registry_.load(folder_).rejection,
              "it is not a regular file; remedy: give the file of the plugin itself");
    EXPECT_EQ(registry_.load("").rejection, "there is no such file; remedy: check the path");
    EXPECT_EQ(registry_.load(write("empty.so", "")).rejection, no_header);
    EXPECT_EQ(registry_.load(write("text.so", std::string(1000, 'x'))).rejection, no_header);
    std::string other = bytes_of(good);
    other[18] = static_cast<char>(0xF3); // e_machine: RISC-V
    EXPECT_THAT(registry_.load(write("riscv.so", other)).rejection,
                testing::MatchesRegex("it is built for RISC-V, this foam for .+; remedy: build it for this machine"));
    other = bytes_of(good);
    other[16] = 1; // e_type: relocatable
    EXPECT_EQ(registry_.load(write("object.so", other)).rejection,
              "it is an ELF file, but no shared library; remedy: build it with foam_add_plugin()");
}

TEST_F(PluginLoader, RefusesAFileThatIsCutOff) {
    const std::string whole = bytes_of(good);
    for (const std::size_t length :
         {std::size_t{64}, std::size_t{200}, whole.size() / 4, whole.size() / 2, whole.size() - 1}) {
        const fs::path file =
            write(std::string("cut_").append(std::to_string(length)).append(".so"), whole.substr(0, length));
        EXPECT_EQ(registry_.load(file).rejection,
                  "its ELF structure is damaged (the file is cut off); remedy: build or copy it again")
            << length;
    }
    EXPECT_EQ(registry_.load(write("cut_63.so", whole.substr(0, 63))).rejection, no_header);
}

TEST_F(PluginLoader, RefusesOtherBuildsBeforeTheyRun) {
    const std::string own = FOAM_ABI_FINGERPRINT, epoch_text = std::to_string(FOAM_ABI_EPOCH);
    constexpr const char* remedy = "; remedy: rebuild the plugin against this foam, with the same compiler options";
    std::string epoch = own;
    epoch[epoch.find("foam-abi=") + 9] = '7';
    EXPECT_EQ(registry_.load(write("epoch.so", with_note(epoch))).rejection,
              "it was built for ABI epoch 7, this foam has ABI epoch " + epoch_text + remedy);
    std::string sanitizer = epoch;
    const std::string kind = FOAM_ABI_SANITIZER;
    sanitizer.replace(sanitizer.find("sanitizer=") + 10, kind.size(), kind.size(), 'x');
    EXPECT_EQ(registry_.load(write("sanitizer.so", with_note(sanitizer))).rejection,
              "it was built for ABI epoch 7 and sanitizer " + std::string(kind.size(), 'x') +
                  ", this foam has ABI epoch " + epoch_text + " and sanitizer " + kind + remedy);
    std::string other = own;
    other[0] = 'F';
    EXPECT_EQ(registry_.load(write("other.so", with_note(other))).rejection,
              "it was built for [" + other + "], this foam has [" + own + "]" + remedy);
}

TEST_F(PluginLoader, RefusesFilesThatEverybodyMayWrite) {
    const fs::path file = write("open.so", bytes_of(good));
    fs::permissions(file, fs::perms::others_write, fs::perm_options::add);
    EXPECT_EQ(registry_.load(file).rejection,
              "everybody may write to it, so anybody's code could run; remedy: chmod o-w " + file.string());
}

TEST_F(PluginLoader, RefusesFilesThatEverybodyMayReplace) {
    const fs::path folder = folder_ / "open";
    fs::create_directory(folder);
    write("open/plugin.so", bytes_of(good));
    fs::permissions(folder, fs::perms::others_write, fs::perm_options::add);
    EXPECT_EQ(registry_.load(folder / "plugin.so").rejection,
              "everybody may replace it in its folder, so anybody's code could run; remedy: chmod o-w " + folder.string());
    fs::permissions(folder, fs::perms::sticky_bit, fs::perm_options::add); // as /tmp: only the owner may replace it
    Registry other;
    EXPECT_EQ(other.load(folder / "plugin.so").rejection, "");
}

TEST_F(PluginLoader, TakesAllStagesOrNone) {
    EXPECT_EQ(refusal("taken"),
              "stage 'repair.fixture' exists already, from plugin fixture_stages; remedy: give it another "
              "name, or load only one of the two");
    EXPECT_EQ(registry_.find("repair.new"), nullptr);
    EXPECT_EQ(registry_.find("repair.fixture")->plugin, "fixture_stages");
}

TEST_F(PluginLoader, KeepsARecordOfEveryFileOnce) {
    const std::size_t before = registry_.plugins().size();
    EXPECT_EQ(refusal("no_stages"), refusal("no_stages"));
    registry_.load(good);
    registry_.load(fs::path(FOAM_TEST_FIXTURES) / "." / "fixture_stages.so");
    EXPECT_EQ(registry_.plugins().size(), before + 1);
    const PluginRecord& record = registry_.plugins().front();
    EXPECT_EQ(record.name, "fixture_stages");
    EXPECT_EQ(record.version, "1.0");
    EXPECT_EQ(record.license, "Apache-2.0");
    EXPECT_EQ(record.stages.size(), stages_);
}

TEST_F(PluginLoader, GoesOnAfterAFolderOfBadPlugins) {
    Registry registry;
    registry.load(good);
    registry.load_directory(FOAM_TEST_BAD_PLUGINS);
    const auto& records = registry.plugins();
    EXPECT_GE(records.size(), 20U);
    EXPECT_TRUE(std::is_sorted(records.begin() + 1, records.end(),
                               [](const PluginRecord& a, const PluginRecord& b) { return a.file < b.file; }));
    registry.load_directory(folder_ / "none");
    registry.load_directory(FOAM_TEST_FIXTURES);
    EXPECT_NE(registry.find("write.json"), nullptr);
}

TEST(StageObjects, AreOfTheKindThatThePluginPromised) {
    Registry registry;
    ASSERT_TRUE(registry.load(std::string(FOAM_TEST_FIXTURES) + "/fixture_wrong_kind.so").loaded());
    for (const char* stage : {"repair.loader", "repair.null"}) {
        try {
            registry.make<MeshFilter>(stage);
            FAIL() << "no error for " << stage;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::plugin);
            EXPECT_EQ(error.what(), std::string(stage) +
                                        ": plugin wrong_kind made no mesh filter for it; remedy: correct the plugin");
        }
    }
}

TEST(StageObjects, ThatCannotBeMadeSayWhy) {
    Registry registry;
    ASSERT_TRUE(registry.load(std::string(FOAM_TEST_FIXTURES) + "/fixture_wrong_kind.so").loaded());
    const auto message = [&](const char* stage) -> std::string {
        try {
            registry.make<MeshFilter>(stage);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::plugin);
            return error.what();
        }
        return "no error";
    };
    EXPECT_EQ(message("repair.throws"), "repair.throws: its constructor threw an exception: too long");
    EXPECT_EQ(message("repair.throws_int"),
              "repair.throws_int: its constructor threw an object that is not a std::exception");
}

TEST(StageObjects, AreMadeOfCheckedParameters) {
    Registry registry;
    ASSERT_TRUE(registry.load(good).loaded());
    EXPECT_NE(registry.make<MeshFilter>("repair.fixture", {{"leaves", std::int64_t{100}}}), nullptr);
    const auto message = [&](const std::string& stage,
                             const std::map<std::string, ParameterValue>& given) -> std::string {
        try {
            registry.make<MeshFilter>(stage, given);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return error.what();
        }
        return "no error";
    };
    EXPECT_EQ(message("repair.fixtrue", {}), "unknown stage 'repair.fixtrue'; did you mean 'repair.fixture'?");
    EXPECT_EQ(message("polish", {}), "unknown stage 'polish'; `foam stages` lists them");
    EXPECT_EQ(message("spherize.fixture", {}), "stage 'spherize.fixture' is a spherizer, a mesh filter is needed here");
    EXPECT_EQ(message("repair.fixture", {{"leaves", std::int64_t{7}}}),
              "repair.fixture: parameter 'leaves' expects an integer between 8 and 100000, got 7");
    EXPECT_EQ(message("repair.fixture", {{"leafs", std::int64_t{9}}}), "repair.fixture: unknown parameter 'leafs'");
    EXPECT_EQ(message("repair.fixture", {{"leaves", 9.0}}),
              "repair.fixture: parameter 'leaves' expects an integer between 8 and 100000, got 9");
}

} // namespace
} // namespace foam::test
