// Sessions: edits, the way back, searches, proofs, and what is saved.
#include "arm.hpp"

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using Kind = Edit::Kind;

class SessionTest : public ArmTest {
protected:
    /// Begins a session with these files.
    Session& begin(std::vector<std::string> names, CoveredGeometry geometry = CoveredGeometry::collision) {
        SubjectOptions options = with(std::move(names));
        options.geometry = geometry;
        std::filesystem::create_directories(folder.path() / "saved");
        session.emplace(subject(options), options, registry, folder.path() / "saved");
        return *session;
    }
    Change apply(Edit edit) { return session->apply(edit, session->version()); }
    const std::vector<Sphere> spheres(std::size_t link, std::size_t model = 0) {
        return session->state(model).at(link)->spheres;
    }
    std::string refused(const Edit& edit) {
        const std::size_t before = session->version();
        const std::string message = refusal([&] { apply(edit); });
        EXPECT_EQ(session->version(), before);
        return message;
    }

    std::optional<Session> session;
    static constexpr std::size_t base = 0, upper = 1, left = 2;
};

TEST_F(SessionTest, EditsSpheresAndTakesThemBack) {
    begin({"arm.urdf", "arm.csv"});
    const Sphere other{{0.01, 0, 0.1}, 0.05};
    const Change moved = apply({.kind = Kind::move, .link = upper, .index = 0, .sphere = other});
    EXPECT_EQ(moved.links, std::vector<std::size_t>{upper});
    EXPECT_EQ(spheres(upper), std::vector<Sphere>{other});
    apply({.kind = Kind::add, .link = upper, .sphere = {{0, 0, 0.3}, 0.07}});
    EXPECT_EQ(spheres(upper).size(), 2u);
    EXPECT_TRUE(session->state(0)[upper]->pinned[1]);
    apply({.kind = Kind::remove, .link = upper, .index = 0});
    EXPECT_EQ(spheres(upper), (std::vector<Sphere>{{{0, 0, 0.3}, 0.07}}));
    apply({.kind = Kind::pin, .link = upper, .index = 0, .pinned = false});
    EXPECT_FALSE(session->state(0)[upper]->pinned[0]);
    for (int i = 0; i < 4; ++i) {
        session->undo(session->version());
    }
    EXPECT_FALSE(session->can_undo());
    EXPECT_EQ(spheres(upper), (std::vector<Sphere>{{{0, 0, 0.2}, 0.20801}}));
    session->redo(session->version());
    EXPECT_EQ(spheres(upper), std::vector<Sphere>{other});
    apply({.kind = Kind::move, .link = base, .index = 0, .sphere = other});
    EXPECT_FALSE(session->can_redo()); // what was undone is forgotten
}

TEST_F(SessionTest, RefusesWhatIsWrongAndChangesNothing) {
    begin({"arm.urdf", "arm.csv"});
    EXPECT_THAT(refused({.kind = Kind::move, .link = upper, .index = 1, .sphere = {{}, 1}}), HasSubstr("no sphere 1"));
    EXPECT_THAT(refused({.kind = Kind::remove, .link = 9}), HasSubstr("no link 9"));
    EXPECT_THAT(refused({.kind = Kind::add, .model = 3, .sphere = {{}, 1}}), HasSubstr("no model 3"));
    for (const double radius : {0.0, -1.0, 2e6, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THAT(refused({.kind = Kind::add, .link = upper, .sphere = {{}, radius}}), HasSubstr("radius above 0"));
    }
    EXPECT_THAT(refused({.kind = Kind::count, .spheres = 0}), HasSubstr("1 to"));
    EXPECT_THAT(refusal([&] { session->apply({.kind = Kind::again, .link = upper}, 7); }), HasSubstr("another window"));
    EXPECT_THAT(refusal([&] { session->undo(0); }), HasSubstr("nothing to undo"));
}

TEST_F(SessionTest, ProvesAfterEachEdit) {
    begin({"arm.urdf", "arm.csv"});
    EXPECT_TRUE(session->verdict(0, upper)->holds);
    apply({.kind = Kind::move, .link = upper, .index = 0, .sphere = {{0, 0, 0.2}, 0.1}});
    const LinkVerdict open = *session->verdict(0, upper);
    EXPECT_FALSE(open.holds);
    EXPECT_NEAR(open.gap, std::hypot(0.2, 0.04, 0.04) - 0.1, 1e-3); // to a corner of the box
    EXPECT_GT(distance(open.witness, {0, 0, 0.2}), 0.1);
    apply({.kind = Kind::close, .link = upper});
    EXPECT_TRUE(session->verdict(0, upper)->holds);
    EXPECT_EQ(spheres(upper)[0].center, (Vec3{0, 0, 0.2}));
}

TEST_F(SessionTest, SearchesALinkAroundPinnedSpheres) {
    begin({"arm.urdf", "arm.csv"});
    apply({.kind = Kind::more, .link = upper});
    EXPECT_EQ(spheres(upper).size(), 2u);
    EXPECT_EQ(session->state(0)[upper]->weight, 2);
    const Sphere kept{{0, 0, 0.05}, 0.0901};
    apply({.kind = Kind::move, .link = upper, .index = 0, .sphere = kept});
    apply({.kind = Kind::pin, .link = upper, .index = 0, .pinned = true});
    for (int i = 0; i < 3; ++i) {
        apply({.kind = Kind::more, .link = upper});
    }
    EXPECT_EQ(spheres(upper).front(), kept);
    EXPECT_TRUE(session->state(0)[upper]->pinned.front());
    EXPECT_LE(spheres(upper).size(), 5u);
    EXPECT_TRUE(session->verdict(0, upper)->holds);
    const std::vector<Sphere> before = spheres(upper);
    apply({.kind = Kind::again, .link = upper});
    EXPECT_EQ(spheres(upper), before); // the same search gives the same
    apply({.kind = Kind::fewer, .link = upper});
    EXPECT_LT(spheres(upper).size(), before.size());
    EXPECT_EQ(session->state(0)[upper]->weight, 8);
}

TEST_F(SessionTest, SaysWhenPinnedSpheresLeaveNoRoom) {
    begin({"arm.urdf", "arm.csv"});
    apply({.kind = Kind::move, .link = upper, .index = 0, .sphere = {{0, 0, 0}, 0.1}});
    apply({.kind = Kind::pin, .link = upper, .index = 0, .pinned = true});
    EXPECT_THAT(refused({.kind = Kind::again, .link = upper}), HasSubstr("remedy: more spheres, or pin fewer"));
}

TEST_F(SessionTest, SearchesTheWholeRobotAsSpherizeDoes) {
    begin({"arm.urdf"});
    EXPECT_EQ(session->counts(0).front(), 4u);
    apply({.kind = Kind::count, .spheres = 8});
    const Recipe recipe =
        recipe_of("robot: {urdf: arm.urdf}\nstages:\n  - spherize.cover: {effort: fast}\n  - refine.fit\n"
                  "  - refine.clip\n  - refine.row\n  - refine.split\nbudget: {spheres: 8}\n"
                  "outputs: [{write.urdf: {file: a.urdf}}]\n");
    run(recipe, registry, options());
    const auto expected = spheres_in("out/a.urdf");
    EXPECT_EQ(spheres(upper), expected.at("upper"));
    EXPECT_EQ(spheres(left), expected.at("left"));
    session->undo(session->version());
    EXPECT_TRUE(spheres(upper).empty());
}

TEST_F(SessionTest, FilesAreReadOnce) {
    write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    std::string text = arm_urdf;
    const std::string box = "<collision><geometry><box size=\"0.2 0.2 0.1\"/>";
    write("meshed.urdf",
          text.replace(text.find(box), box.size(), "<collision><geometry><mesh filename=\"part.obj\"/>"));
    begin({"meshed.urdf"});
    apply({.kind = Kind::count, .spheres = 12});
    const ModelState wanted = session->state(0);
    ASSERT_FALSE(wanted[base]->spheres.empty());
    begin({"meshed.urdf"});
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
        if (const auto ending = entry.path().extension(); ending == ".urdf" || ending == ".obj") {
            std::ofstream(entry.path()) << "no longer what it was";
        }
    }
    apply({.kind = Kind::count, .spheres = 12});
    for (std::size_t l = 0; l < wanted.size(); ++l) {
        EXPECT_EQ(spheres(l), wanted[l]->spheres);
        EXPECT_TRUE(spheres(l).empty() || session->verdict(0, l)->holds);
    }
}

TEST_F(SessionTest, PinsAndWeightsShapeTheWholeRobot) {
    begin({"arm.urdf"});
    apply({.kind = Kind::count, .spheres = 8});
    const Sphere kept{{0, 0, 0}, 0.151};
    apply({.kind = Kind::add, .link = base, .sphere = kept});
    apply({.kind = Kind::count, .spheres = 12});
    EXPECT_EQ(spheres(base), std::vector<Sphere>{kept}); // it covers the base
    EXPECT_TRUE(session->state(0)[base]->pinned[0]);
    EXPECT_TRUE(session->verdict(0, upper)->holds);
}

TEST_F(SessionTest, ARecipeGivesTheSameAgain) {
    begin({"arm.urdf"});
    apply({.kind = Kind::count, .spheres = 9});
    apply({.kind = Kind::add, .link = upper, .sphere = {{0.0123456789, -0.001, 0.11}, 0.0707}});
    apply({.kind = Kind::more, .link = left});
    const Saved saved = session->save(0, "recipe", "again.yaml", false);
    ASSERT_EQ(saved.files.size(), 1u);
    const RecipeResult read = read_recipe(saved.files[0], registry);
    ASSERT_TRUE(read.ok());
    RunOptions with = options();
    const RunResult result = run(read.recipes.at(0), registry, with);
    EXPECT_TRUE(result.certified);
    for (const SphereGroup& group : result.model.groups) {
        const Robot& robot = *session->subject().robots[0].robot;
        const auto l = static_cast<std::size_t>(robot.find_link(group.link) - robot.links.data());
        EXPECT_EQ(group.tree.finest(), spheres(l)) << group.link;
    }
    EXPECT_EQ(result.model.groups.size(), 4u);
}

TEST_F(SessionTest, ARecipeOfVisualGeometrySkipsLinksWithoutSpheres) {
    write("two.urdf",
          "<robot name=\"two\"><link name=\"a\"><visual><geometry><box size=\"1 1 1\"/></geometry></visual></link>"
          "<link name=\"b\"><visual><geometry><box size=\"1 1 1\"/></geometry></visual></link>"
          "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>");
    begin({"two.urdf"}, CoveredGeometry::visual);
    apply({.kind = Kind::count, .spheres = 2});
    ASSERT_EQ(spheres(1).size(), 1u);
    apply({.kind = Kind::remove, .link = 1, .index = 0});
    const RecipeResult read = read_recipe(session->save(0, "recipe", "two.yaml", false).files.at(0), registry);
    ASSERT_TRUE(read.ok());
    const RunResult result = run(read.recipes.at(0), registry, options());
    ASSERT_EQ(result.model.groups.size(), 1u); // a run would find spheres for a link that is not skipped
    EXPECT_EQ(result.model.groups[0].tree.finest(), spheres(0));
}

TEST_F(SessionTest, AChangeTellsOfTheSessionRightAfterIt) {
    begin({"arm.urdf", "arm.csv"});
    const Change first = apply({.kind = Kind::move, .link = upper, .index = 0, .sphere = {{0, 0, 0.2}, 0.1}});
    const Change second = apply({.kind = Kind::remove, .link = upper, .index = 0});
    EXPECT_EQ(first.version, 1u);
    EXPECT_EQ(second.version, 2u);
    EXPECT_EQ(first.state[upper]->spheres, (std::vector<Sphere>{{{0, 0, 0.2}, 0.1}}));
    EXPECT_NEAR(session->verdict(first, upper)->gap, std::hypot(0.2, 0.04, 0.04) - 0.1, 1e-3);
    EXPECT_TRUE(second.state[upper]->spheres.empty());
    const Change undone = session->undo(2);
    EXPECT_TRUE(undone.can_undo && undone.can_redo);
    EXPECT_FALSE(first.can_redo);
    EXPECT_FALSE(session->undo(3).can_undo);
}

TEST_F(SessionTest, ARecipeOfUncoveredLinksIsRefused) {
    begin({"arm.urdf", "arm.csv"});
    apply({.kind = Kind::move, .link = upper, .index = 0, .sphere = {{}, 0.05}});
    EXPECT_THAT(refusal([&] { session->save(0, "recipe", "a.yaml", false); }),
                HasSubstr("the spheres of upper do not cover it"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "saved/a.yaml"));
}

TEST_F(SessionTest, SavesFormatsThatReadBackTheSame) {
    begin({"arm.urdf", "arm.csv"});
    const Saved urdf = session->save(0, "urdf", "a.urdf", false);
    EXPECT_EQ(urdf.statement, "proved: the collision geometry of 4 of 4 links lies inside their spheres, as solids");
    EXPECT_EQ(spheres_in("saved/a.urdf").at("upper"), spheres(upper));
    session->save(0, "csv", "a.csv", false);
    const Subject again = subject(with({"arm.urdf", "saved/a.csv"}));
    EXPECT_EQ(again.models[0].spheres[upper], spheres(upper));
    EXPECT_THAT(refusal([&] { session->save(0, "csv", "a.csv", false); }), HasSubstr("exists already"));
    session->save(0, "csv", "a.csv", true);
    EXPECT_THAT(refusal([&] { session->save(0, "nonsense", "b.x", false); }), HasSubstr("no format 'nonsense'"));
}

TEST_F(SessionTest, NothingNamesTheStandardInput) {
    write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    const auto begin_nameless = [&](const std::string& file) {
        SubjectOptions options = with({file});
        options.nameless = options.files[0];
        std::filesystem::create_directories(folder.path() / "saved");
        session.emplace(subject(options), options, registry, folder.path() / "saved");
        apply({.kind = Kind::count, .spheres = 4});
    };
    begin_nameless("arm.urdf");
    EXPECT_EQ(refusal([&] { session->save(0, "recipe", "a.yaml", false); }),
              "a recipe names its input, and - has no name; remedy: a file instead of -");
    session->save(0, "urdf", "a.urdf", false);
    begin_nameless("part.obj");
    EXPECT_EQ(refusal([&] { session->save(0, "urdf", "b.urdf", false); }),
              "write.urdf writes the name of the mesh, and - has no name; remedy: another format, or a file instead of "
              "-");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "saved/b.urdf"));
    session->save(0, "csv", "b.csv", false);
}

TEST_F(SessionTest, SavesOnlyIntoItsFolder) {
    begin({"arm.urdf", "arm.csv"});
    for (const char* name : {"", ".", "..", "../a.urdf", "/tmp/a.urdf", "b/a.urdf", ".hidden", "a\\b", "a\nb",
                             "a\xE2\x80\xAE"
                             "b"}) {
        EXPECT_THAT(refusal([&] { session->save(0, "urdf", name, true); }), HasSubstr("is not a file name")) << name;
    }
    std::filesystem::create_symlink(folder.path() / "arm.urdf", folder.path() / "saved/link.urdf");
    EXPECT_THAT(refusal([&] { session->save(0, "urdf", "link.urdf", true); }), HasSubstr("is what this page shows"));
    EXPECT_EQ(text_of("arm.urdf"), arm_urdf);
}

TEST_F(SessionTest, NeverReplacesWhatThePageShows) {
    std::filesystem::create_directories(folder.path() / "saved");
    write("saved/arm.srdf", "<robot name=\"arm\"/>");
    write("saved/part.stl", "solid part\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                            "endloop\nendfacet\nendsolid part\n");
    std::string text = arm_urdf;
    text.replace(text.find("<box size=\"0.2 0.2 0.1\"/>"), 25, "<mesh filename=\"saved/part.stl\"/>");
    write("arm.urdf", text);
    SubjectOptions options = with({"arm.urdf", "arm.csv"});
    options.srdf = folder.path() / "saved/arm.srdf";
    session.emplace(subject(options), options, registry, folder.path() / "saved");
    for (const char* name : {"arm.srdf", "part.stl"}) {
        for (const char* format : {"csv", "recipe"}) {
            EXPECT_THAT(refusal([&] { session->save(0, format, name, true); }), HasSubstr("is what this page shows"));
        }
    }
    // The format that writes an SRDF beside the file would replace that of the page.
    EXPECT_THAT(refusal([&] { session->save(0, "vamp", "arm.urdf", true); }),
                HasSubstr("arm.srdf is what this page shows"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "saved/arm.urdf"));
    EXPECT_EQ(text_of("saved/arm.srdf"), "<robot name=\"arm\"/>");
}

TEST_F(SessionTest, KnowsWhatNeedsNoCheckAndHowFarSpheresProtrude) {
    begin({"arm.urdf", "arm.csv"});
    EXPECT_THAT(session->ignored(0), ::testing::Contains(std::pair<std::size_t, std::size_t>(base, upper))); // adjacent
    const ModelFigures figures = *session->figures(0);
    EXPECT_NEAR(figures.protrusions[upper][0], 0.168, 1e-3); // to the side of the box
}

TEST_F(SessionTest, WithoutGeometryNothingIsProvedOrSearched) {
    begin({"arm.csv"});
    EXPECT_EQ(session->verdict(0, upper), std::nullopt);
    EXPECT_EQ(session->figures(0).has_value(), false);
    EXPECT_THAT(refused({.kind = Kind::again, .link = upper}), HasSubstr("the geometry of this link is not known"));
    apply({.kind = Kind::move, .link = upper, .index = 0, .sphere = {{}, 0.05}});
    EXPECT_EQ(session->save(0, "csv", "a.csv", false).statement,
              "nothing is proved without the robot's original geometry");
}

} // namespace
} // namespace foam::test
