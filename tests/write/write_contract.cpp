// What every writer promises, asked of all that are built.
#include "models.hpp"
#include "support/read_spheres.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

/// Calls test(name, writer) for every writer with default parameters and for every value of its choices.
template <class Test> void for_each_writer(const Test& test) {
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    int count = 0;
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind != StageKind::writer) {
            continue;
        }
        SCOPED_TRACE(name);
        ++count;
        test(name, *registry.make<Writer>(name, needed_parameters(name, {"only"})));
        for (const Parameter& parameter : stage.info.parameters) {
            for (const std::string& choice : parameter.choices) {
                if (parameter.name == "engine") {
                    continue; // engines_test has those
                }
                SCOPED_TRACE(parameter.name + ": " + choice);
                test(name + " " + choice, *registry.make<Writer>(name, {{parameter.name, choice}}));
            }
        }
    }
    EXPECT_GE(count, 4);
}

/// A model that every format can hold: one link with spheres, one group, a joint that moves.
SphereModel plain_model() {
    SphereTree tree = flat_tree(awkward_spheres());
    return model_of(turning("only"), {group_of("only", {"a.stl"}, tree)});
}

TEST(WriterContract, GivesTheSameSpheresBack) {
    QuietContext context;
    for_each_writer([&](const std::string&, const Writer& writer) {
        const SphereModel model = plain_model();
        EXPECT_EQ(read_spheres(writer, writer.write(model, context)), spheres_of(model));
    });
}

TEST(WriterContract, GivesAwkwardModelsBackOrRefusesThem) {
    QuietContext context;
    int read_back = 0;
    for_each_writer([&](const std::string&, const Writer& writer) {
        const SphereModel model = awkward_model();
        std::string bytes;
        try {
            bytes = writer.write(model, context);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::output);
            return;
        }
        EXPECT_EQ(read_spheres(writer, bytes), spheres_of(model));
        ++read_back;
    });
    EXPECT_GE(read_back, 6);
}

TEST(WriterContract, TakesARobotOfNoFile) {
    QuietContext context;
    for_each_writer([&](const std::string&, const Writer& writer) {
        SphereModel model = plain_model();
        auto robot = std::make_shared<Robot>(*model.robot);
        robot->file.clear();
        robot->source.clear();
        model.robot = robot;
        for (const char* folder : {"", "/somewhere"}) {
            model.folder = folder;
            EXPECT_EQ(read_spheres(writer, writer.write(model, context)), spheres_of(model));
        }
    });
}

TEST(WriterContract, RobotFilesNeedMoreThanTheNamesOfLinks) {
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    auto names = std::make_shared<Robot>();
    names->name = "names";
    names->root = "only";
    names->links = {{.name = "only", .collisions = {}, .visuals = {}}};
    const SphereModel model = model_of(names, {group_of("only", {}, flat_tree({{{0, 0, 0}, 1}}))});
    for (const char* name : {"write.curobo", "write.xrdf", "write.lula", "write.plainmp"}) {
        EXPECT_EQ(refusal(*registry.make<Writer>(name), model),
                  std::string(name) + " needs the robot, not only its spheres; remedy: give its URDF");
    }
    for (const char* name : {"write.urdf", "write.vamp"}) {
        EXPECT_THAT(refusal(*registry.make<Writer>(name), model), testing::HasSubstr("no URDF text")) << name;
    }
}

TEST(WriterContract, EqualModelsGiveEqualBytes) {
    QuietContext one(1), two(2);
    for_each_writer([&](const std::string&, const Writer& writer) {
        EXPECT_EQ(writer.write(plain_model(), one), writer.write(plain_model(), two));
    });
}

TEST(WriterContract, CompanionsAreWrittenWithEqualBytes) {
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    int count = 0;
    for (const auto& [name, stage] : registry.stages()) {
        for (const std::string& ending :
             stage.kind == StageKind::writer ? stage.info.companions : std::vector<std::string>{}) {
            SCOPED_TRACE(name + " ." + ending);
            QuietContext one(1), two(2);
            const auto writer = registry.make<Writer>(name);
            const std::string bytes = writer->companion(ending, plain_model(), one);
            EXPECT_NE(bytes, "");
            EXPECT_EQ(writer->companion(ending, plain_model(), two), bytes);
            ++count;
        }
    }
    EXPECT_GE(count, 2);
}

TEST(WriterContract, RefusesSpheresThatNoReaderTakes) {
    for (const Sphere& bad :
         {Sphere{{0, 0, 0}, 0}, Sphere{{0, 0, 0}, -1}, Sphere{{NAN, 0, 0}, 1}, Sphere{{0, 0, 0}, INFINITY}}) {
        for_each_writer([&](const std::string&, const Writer& writer) {
            SphereModel model = plain_model();
            model.groups[0].tree.levels.back().elements.spheres()[2] = bad;
            EXPECT_THAT(refusal(writer, model), testing::HasSubstr("sphere 2 of link 'only'"));
        });
    }
}

TEST(WriterContract, RefusesLinksWithoutSpheres) {
    for_each_writer([&](const std::string&, const Writer& writer) {
        SphereModel model = plain_model();
        model.groups[0].tree.levels.clear();
        EXPECT_THAT(refusal(writer, model), testing::HasSubstr("link 'only' has no spheres"));
    });
}

TEST(WriterContract, ReadingGarbageIsAnError) {
    QuietContext context;
    for_each_writer([&](const std::string&, const Writer& writer) {
        const std::string good = writer.write(plain_model(), context);
        for (const std::string& bad :
             {std::string(), std::string("\0\1\2", 3), std::string("hello\n"), good.substr(0, good.size() / 2)}) {
            try {
                EXPECT_NE(read_spheres(writer, bad), spheres_of(plain_model()));
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::output);
            }
        }
    });
}

} // namespace
} // namespace foam::test
