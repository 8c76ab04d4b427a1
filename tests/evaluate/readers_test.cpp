// Which reader takes which file, asked of all that are built.
#include "write/models.hpp"

#include <foam/base/error.hpp>
#include <foam/judge/evaluate.hpp>

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace foam::test {
namespace {

using ::testing::SizeIs;

std::vector<std::string> readers_for(const Registry& registry, const std::string& text) {
    std::vector<std::string> names;
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind == StageKind::model_reader && registry.make<ModelReader>(name)->recognises(text)) {
            names.push_back(name);
        }
    }
    return names;
}

class Readers : public ::testing::Test {
protected:
    Readers() { registry.load_directory(FOAM_TEST_PLUGINS); }
    Registry registry;
};

TEST_F(Readers, OneReadsWhatEachWriterWrites) {
    QuietContext context;
    const SphereModel model = model_of(
        turning("only"),
        {group_of("only", {"a.stl"}, flat_tree({{{0.1, -0.2, 1.0 / 3}, 0.05}, {{1e-17, 1234.5, -0.0}, 0.1 + 0.7}}))});
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind != StageKind::writer) {
            continue;
        }
        SCOPED_TRACE(name);
        const std::string text = registry.make<Writer>(name, needed_parameters(name, {"only"}))->write(model, context);
        ASSERT_THAT(readers_for(registry, text), SizeIs(1));
        const SphereFile read = parse_sphere_file(text, "model", registry);
        ASSERT_THAT(read.links, SizeIs(1));
        EXPECT_EQ(read.links[0].link, "only");
        EXPECT_EQ(read.links[0].elements.spheres(), spheres_of(model).at("only"));
    }
}

TEST_F(Readers, OneRecognisesEachSampleOfTheOthers) {
    const std::filesystem::path plugins = FOAM_TEST_SOURCE "/plugins";
    int samples = 0;
    for (const char* folder : {"yaml_models/samples", "read_rows/samples", "write_gltf/samples", "write_scene/samples",
                               "write_sdf/samples", "write_usd/samples"}) {
        for (const auto& entry : std::filesystem::directory_iterator(plugins / folder)) {
            SCOPED_TRACE(entry.path().string());
            std::ifstream stream(entry.path());
            const std::string text{std::istreambuf_iterator<char>(stream), {}};
            EXPECT_THAT(readers_for(registry, text), SizeIs(1));
            ++samples;
        }
    }
    EXPECT_GE(samples, 8);
}

TEST_F(Readers, AFileThatSeveralRecogniseNeedsAChoice) {
    Registry two;
    two.load_directory(FOAM_TEST_PLUGINS);
    const PluginRecord& record = two.load(FOAM_TEST_GREEDY);
    ASSERT_TRUE(record.loaded()) << record.rejection;
    try {
        parse_sphere_file("l 0 0 0 1\n", "rows.txt", two);
        ADD_FAILURE() << "two readers recognise it";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "rows.txt: several readers recognise this file: read.greedy, read.rows; remedy: choose one by "
                     "--reader");
    }
    EXPECT_THAT(parse_sphere_file("l 0 0 0 1\n", "rows.txt", two, "read.rows").links, SizeIs(1));
}

} // namespace
} // namespace foam::test
