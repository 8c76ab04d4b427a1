// write.urdf on the robots of others, and its reader on sphere robots of others.
#include "models.hpp"
#include "support/read_spheres.hpp"

#include <expat.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace foam::test {
namespace {

namespace fs = std::filesystem;

fs::path shared() {
    const char* folder = std::getenv("FOAM_SHARED");
    return folder ? folder : FOAM_TEST_SHARED;
}

std::string contents(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<fs::path> files_below(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
        if (entry.path().extension() == extension) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// The text without the <collision> elements of links, and without the white space before each.
std::string without_collisions(const std::string& text) {
    struct State {
        const std::string& text;
        XML_Parser parser;
        std::vector<std::string> open{};
        std::size_t copied = 0;
        std::string result{};
    } state{text, XML_ParserCreate(nullptr)};
    XML_SetUserData(state.parser, &state);
    XML_SetElementHandler(
        state.parser,
        [](void* data, const XML_Char* name, const XML_Char**) {
            State& s = *static_cast<State*>(data);
            s.open.emplace_back(name);
            if (s.open == std::vector<std::string>{"robot", "link", "collision"}) {
                const auto begin = static_cast<std::size_t>(XML_GetCurrentByteIndex(s.parser));
                s.result += s.text.substr(s.copied, begin - s.copied);
                s.result.erase(s.result.find_last_not_of(" \t\r\n") + 1);
            }
        },
        [](void* data, const XML_Char*) {
            State& s = *static_cast<State*>(data);
            if (s.open == std::vector<std::string>{"robot", "link", "collision"}) {
                s.copied =
                    static_cast<std::size_t>(XML_GetCurrentByteIndex(s.parser) + XML_GetCurrentByteCount(s.parser));
            }
            s.open.pop_back();
        });
    EXPECT_EQ(XML_Parse(state.parser, text.data(), static_cast<int>(text.size()), 1), XML_STATUS_OK);
    XML_ParserFree(state.parser);
    return state.result + text.substr(state.copied);
}

TEST(WriteUrdfRobots, NothingButCollisionElementsChanges) {
    const std::vector<fs::path> files = files_below(shared() / "robots", ".urdf");
    if (files.empty()) {
        GTEST_SKIP() << "no robots in " << shared();
    }
    Registry registry;
    registry.load(FOAM_TEST_PLUGINS "/load_urdf.so");
    registry.load(FOAM_TEST_PLUGINS "/write_urdf.so");
    const auto loader = registry.make<RobotLoader>("load.urdf");
    const auto urdf = registry.make<Writer>("write.urdf");
    QuietContext context;
    for (const fs::path& file : files) {
        SCOPED_TRACE(file);
        const auto robot =
            std::make_shared<const Robot>(loader->load(contents(file), file, ResourceResolver{}, context));
        SphereModel model = model_of(robot, {});
        for (const Link& link : robot->links) {
            if (!link.collisions.empty()) {
                model.groups.push_back(group_of(link.name, {}, flat_tree(awkward_spheres())));
            }
        }
        const std::string written = urdf->write(model, context);
        EXPECT_EQ(without_collisions(written), without_collisions(robot->source));
        EXPECT_EQ(read_spheres(*urdf, written), spheres_of(model));
        const Robot again = loader->load(written, file, ResourceResolver{}, context);
        EXPECT_EQ(again.links.size(), robot->links.size());
        EXPECT_EQ(again.joints.size(), robot->joints.size());
        // A model of spheres can be written over by another one.
        model.robot = std::make_shared<const Robot>(again);
        EXPECT_EQ(urdf->write(model, context), written);
    }
}

TEST(WriteUrdfRobots, ReadsPublishedSphereModels) {
    const auto urdf = writer("write_urdf", "write.urdf");
    int compared = 0;
    for (const fs::path& file : files_below(shared() / "reference_spheres", ".urdf")) {
        SCOPED_TRACE(file);
        const fs::path expected_file = fs::path(file).replace_extension(".spheres.json");
        if (!fs::exists(expected_file) || file.string().find("morphit") != std::string::npos) {
            continue; // MorphIt's spheres are links of their own
        }
        const auto expected = nlohmann::json::parse(contents(expected_file)).at("spheres");
        const auto spheres = read_spheres(*urdf, contents(file));
        for (const auto& [link, list] : expected.items()) {
            std::vector<Sphere> there;
            for (const Sphere& s : spheres.contains(link) ? spheres.at(link) : std::vector<Sphere>{}) {
                if (s.radius > 0) {
                    there.push_back(s);
                }
            }
            ASSERT_EQ(there.size(), list.size()) << link;
            for (std::size_t i = 0; i < there.size(); ++i) {
                EXPECT_NEAR(there[i].radius, list[i][3].get<double>(), 1e-6);
                EXPECT_NEAR(there[i].center.x, list[i][0].get<double>(), 1e-6);
                EXPECT_NEAR(there[i].center.y, list[i][1].get<double>(), 1e-6);
                EXPECT_NEAR(there[i].center.z, list[i][2].get<double>(), 1e-6);
            }
        }
        ++compared;
    }
    if (!fs::exists(shared() / "reference_spheres")) {
        GTEST_SKIP() << "no reference_spheres in " << shared();
    }
    EXPECT_GE(compared, 10);
}

} // namespace
} // namespace foam::test
