// The files of a model with the verdict on what they hold: what a writer's files read back to is what is proved.
#include "made_models.hpp"

#include <foam/base/error.hpp>
#include <foam/judge/written_model.hpp>

#include <gmock/gmock.h>

#include <cmath>

namespace foam::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Levels = std::map<std::string, Elements>;

const double half_diagonal = std::sqrt(0.03);
const std::string all_proved = "proved: the collision geometry of 1 of 1 link lies inside its spheres, as a solid";
const std::string none_proved = "not proved: the geometry may extend beyond the spheres";

SphereFile given_file(std::vector<LinkSpheres> links) {
    return file_of(std::move(links), "folder/model.yaml");
}

LinkSpheres ball_of(const std::string& link, double radius) {
    return {link, {{{}, radius}}};
}

Element box_of(double half) {
    return {.kind = Element::Kind::box, .half = {half, half, half}};
}

/// A writer of the line of provenance, whose files read back to what is said here.
class Told final : public Writer {
public:
    explicit Told(Levels read) : read_(std::move(read)) {}
    std::string write(const SphereModel& model, Context&) const override {
        written.push_back(model);
        return model.provenance;
    }
    std::string companion(const std::string& ending, const SphereModel& model, Context&) const override {
        return ending + " " + model.file + " " + model.folder.filename().string();
    }
    Levels read(const std::string&, const std::map<std::string, std::string>& others) const override {
        beside_read = others;
        return read_;
    }
    std::map<std::string, std::string> files_beside(const SphereModel&, Context&) const override { return beside; }

    mutable std::vector<SphereModel> written;
    mutable std::map<std::string, std::string> beside_read;
    std::map<std::string, std::string> beside;

private:
    Levels read_;
};

StageInfo told_info(const Consumer& consumer = {}) {
    StageInfo info;
    info.name = "write.told";
    info.extensions = {"told"};
    info.kinds = {Element::Kind::sphere, Element::Kind::box};
    info.consumer = consumer;
    return info;
}

Levels levels_of(const std::vector<LinkSpheres>& links) {
    Levels levels;
    for (const LinkSpheres& link : links) {
        levels[link.link] = link.elements;
    }
    return levels;
}

/// What is said of given links, whose files read back to others.
struct Said {
    std::string statement, bytes;
    SphereModel model; ///< the last that was written
    std::size_t times; ///< it was written
};
Said said(const Original* original, const std::vector<LinkSpheres>& given, const std::vector<LinkSpheres>& read,
          const Consumer& consumer = {}) {
    const SphereFile file = given_file(given);
    SphereModel model = sphere_model_of(file, original ? original->robot : links_alone(file));
    model.provenance = "origin";
    const Told writer(levels_of(read));
    QuietContext context;
    const JudgedFiles judged =
        judged_files(writer, told_info(consumer), model, original, file, "folder/out.told", context);
    EXPECT_EQ(judged.files.size(), 1u);
    EXPECT_EQ(judged.files.front().file, "folder/out.told");
    EXPECT_EQ(judged.files.front().bytes, "origin; " + judged.statement);
    return {judged.statement, judged.files.front().bytes, writer.written.back(), writer.written.size()};
}

std::pair<ErrorCode, std::string> refused(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return {error.code(), error.what()};
    }
    return {ErrorCode::internal, "no error"};
}

TEST(WrittenModel, TheStatementIsThatOfTheProof) {
    const Original one = cubes_of_links({"a"});
    const Said covered = said(&one, {ball_of("a", 0.1733)}, {ball_of("a", 0.1733)});
    EXPECT_EQ(covered.statement, all_proved);
    EXPECT_EQ(covered.model.guarantee, Guarantee::outer);
    EXPECT_TRUE(covered.model.groups[0].measures.certified);
    EXPECT_TRUE(covered.model.verdict.all());
    EXPECT_EQ(covered.times, 1u);
    const Said open = said(&one, {ball_of("a", 0.173)}, {ball_of("a", 0.173)});
    EXPECT_EQ(open.statement, none_proved + "; not part of the proof: a (the proof does not hold)");
    EXPECT_EQ(open.model.guarantee, Guarantee::fitted);
    EXPECT_FALSE(open.model.groups[0].measures.certified);
    const Said unknown = said(nullptr, {ball_of("a", 9)}, {ball_of("a", 9)});
    EXPECT_EQ(unknown.statement, "nothing is proved without the robot's original geometry");
    EXPECT_EQ(unknown.model.guarantee, Guarantee::fitted);
    EXPECT_FALSE(unknown.model.groups[0].measures.certified);
}

TEST(WrittenModel, EachLinkHasItsOwnVerdict) {
    const Original two = cubes_of_links({"a", "b"});
    const std::vector<LinkSpheres> links{ball_of("b", 0.1), ball_of("a", 0.2)};
    const Said part = said(&two, links, links);
    EXPECT_THAT(part.statement, HasSubstr("proved in part: the collision geometry of 1 of 2 links lies inside their "
                                          "spheres, as a solid; not part of the proof: b (the proof does not hold)"));
    ASSERT_EQ(part.model.groups.size(), 2u);
    EXPECT_EQ(part.model.groups[0].link, "a") << "in the order of the robot";
    EXPECT_TRUE(part.model.groups[0].measures.certified);
    EXPECT_FALSE(part.model.groups[1].measures.certified);
    EXPECT_EQ(part.model.guarantee, Guarantee::fitted) << "not of all";
}

TEST(WrittenModel, WhatTheFilesHoldIsProvedNotWhatWasGiven) {
    const Original one = cubes_of_links({"a"});
    // With the buffer of the file the ball covers the cube.
    const Said larger = said(&one, {ball_of("a", 0.15)}, {ball_of("a", 0.2)});
    EXPECT_EQ(larger.statement, all_proved);
    EXPECT_EQ(larger.times, 2u) << "with another line";
    EXPECT_EQ(larger.model.guarantee, Guarantee::outer);
    EXPECT_TRUE(larger.model.groups[0].measures.certified);
    EXPECT_EQ(said(&one, {ball_of("a", 0.2)}, {ball_of("a", 0.3)}).times, 1u) << "the line stays";
    // Elements come back in other numbers, here in smaller ones.
    const std::vector<LinkSpheres> given{{"a", {{}, {box_of(0.11)}}}};
    const std::string elements = "proved: the collision geometry of 1 of 1 link lies inside its elements, as a solid";
    EXPECT_EQ(said(&one, given, given).statement, elements);
    const Said smaller = said(&one, given, {{"a", {{}, {box_of(0.09)}}}});
    EXPECT_THAT(smaller.statement, HasSubstr("not proved: the geometry may extend beyond the elements"));
    EXPECT_FALSE(smaller.model.groups[0].measures.certified);
    EXPECT_EQ(smaller.model.guarantee, Guarantee::fitted);
    EXPECT_EQ(smaller.times, 2u);
    const std::vector<LinkSpheres> both{{"a", {{{{}, 0.05}}, {box_of(0.11)}}}};
    EXPECT_THAT(said(&one, both, {{"a", {{{{}, 0.05}}, {box_of(0.09)}}}}).statement, HasSubstr("not proved"));
}

TEST(WrittenModel, AFormatWithoutNamesOfLinksIsThatOfTheOnlyLink) {
    const Original one = cubes_of_links({"a"});
    const SphereFile file = given_file({ball_of("a", 0.2)});
    SphereModel model = sphere_model_of(file, one.robot);
    model.groups[0].link = ""; // as the writer has it
    const Told writer(levels_of({ball_of("", 0.2)}));
    QuietContext context;
    const JudgedFiles judged = judged_files(writer, told_info(), model, &one, file, "out.told", context);
    EXPECT_EQ(judged.statement, all_proved);
    const Original two = cubes_of_links({"a", "b"});
    const auto [code, text] =
        refused([&] { judged_files(writer, told_info(), model, &two, file, "out.told", context); });
    EXPECT_EQ(code, ErrorCode::input);
    EXPECT_THAT(text, HasSubstr("has 2 links with collision geometry; remedy: a model by link"));
}

TEST(WrittenModel, ElementsThatAnotherFileHoldsAreThoseThatWereGiven) {
    const Original one = cubes_of_links({"a"});
    const std::vector<LinkSpheres> given{{"a", {{}, {box_of(0.11)}}}};
    const Said said_of_given = said(&one, given, {ball_of("a", 0.01)}, {.elements_optional = true});
    EXPECT_EQ(said_of_given.statement, "proved: the collision geometry of 1 of 1 link lies inside its elements, as a solid");
    EXPECT_EQ(said_of_given.times, 1u);
    // Of a model of spheres alone the files hold all.
    EXPECT_EQ(said(&one, {ball_of("a", 0.15)}, {ball_of("a", 0.2)}, {.elements_optional = true}).statement, all_proved);
}

TEST(WrittenModel, SinglePrecisionIsProvedToo) {
    const Original two = cubes_of_links({"a", "b"});
    // Between the half diagonal and the float above it are doubles that are rounded to the float below.
    const double below = static_cast<double>(std::nextafter(static_cast<float>(half_diagonal), 0.0F)),
                 nearest = static_cast<double>(static_cast<float>(half_diagonal)),
                 lower = nearest < half_diagonal ? nearest : below,
                 upper = static_cast<double>(std::nextafter(static_cast<float>(lower), 1.0F)),
                 between = std::min(half_diagonal + 1e-12, (lower + upper) / 2 - 1e-12);
    ASSERT_LT(lower, half_diagonal);
    ASSERT_GT(upper, half_diagonal);
    const bool lost = static_cast<double>(static_cast<float>(between)) < half_diagonal;
    const std::vector<LinkSpheres> links{ball_of("a", between), ball_of("b", 0.2)};
    const std::string in_double = said(&two, links, links).statement;
    EXPECT_THAT(in_double, HasSubstr("of 2 of 2 links"));
    const Said single = said(&two, links, links, {.float32 = true});
    EXPECT_TRUE(lost);
    EXPECT_THAT(single.statement, HasSubstr("of 1 of 2 links lies inside their spheres, as a solid, also in single precision"));
    EXPECT_FALSE(single.model.groups[0].measures.certified);
    EXPECT_TRUE(single.model.groups[1].measures.certified);
    // Rounded up it covers, but not as it stands.
    const double short_of = std::nextafter(upper, 0);
    const Original one = cubes_of_links({"a"});
    const std::vector<LinkSpheres> enough{ball_of("a", short_of)};
    EXPECT_THAT(said(&one, enough, enough, {.float32 = true}).statement, HasSubstr("also in single precision"));
    const std::vector<LinkSpheres> open{ball_of("a", half_diagonal * (1 - 1e-13)), ball_of("b", 0.2)};
    EXPECT_THAT(said(&two, open, open, {.float32 = true}).statement, HasSubstr("of 1 of 2 links"));
}

TEST(WrittenModel, FilesWithOtherElementsAreRefused) {
    const Original two = cubes_of_links({"a", "b"});
    const auto refusal = [&](const std::vector<LinkSpheres>& given, const std::vector<LinkSpheres>& read,
                             const Consumer& consumer = {}) {
        return refused([&] { said(&two, given, read, consumer); });
    };
    const std::vector<LinkSpheres> balls{{"a", {{{}, 0.1}, {{1, 0, 0}, 0.2}}}, ball_of("b", 0.3)};
    const auto with = [&](const std::vector<Sphere>& spheres) {
        std::vector<LinkSpheres> read = balls;
        read[0].elements.spheres() = spheres;
        return read;
    };
    const auto other = std::pair(ErrorCode::internal,
                                 std::string("link 'a': the written file gives other spheres than the model"));
    EXPECT_EQ(refusal(balls, balls).second, "no error");
    EXPECT_EQ(refusal(balls, with({{{}, 0.15}, {{1, 0, 0}, 0.25}})).second, "no error") << "a buffer";
    EXPECT_EQ(refusal(balls, with({{{}, 0.15}, {{1, 0, 0}, 0.25 + 1e-11}})).second, "no error") << "rounded";
    EXPECT_EQ(refusal(balls, with({{{}, 0.15}, {{1, 0, 0}, 0.25 + 1e-9}})), other) << "two buffers";
    EXPECT_EQ(refusal(balls, with({{{}, 0.15}, {{1, 0, 0}, 0.25 - 1e-9}})), other);
    EXPECT_EQ(refusal(balls, with({{{}, 0.1}, {{1, 0, 1e-9}, 0.2}})), other) << "moved";
    EXPECT_EQ(refusal(balls, with({{{}, 0.1}})), other) << "one is missing";
    EXPECT_EQ(refusal(balls, with({{{}, 0.1}, {{1, 0, 0}, 0.2}, {{}, 0.1}})), other) << "one more";
    EXPECT_EQ(refusal(balls, {ball_of("b", 0.3)}), other) << "none";
    EXPECT_EQ(refusal(balls, with({{{1, 0, 0}, 0.2}, {{}, 0.1}})), other) << "in another order";
    for (const std::vector<Sphere>& smaller :
         {std::vector<Sphere>{{{}, 0.05}, {{1, 0, 0}, 0.15}}, std::vector<Sphere>{{{1, 0, 0}, 0.1}}}) {
        const auto [code, text] = refusal(balls, with(smaller));
        EXPECT_EQ(code, ErrorCode::output);
        EXPECT_EQ(text, "link 'a': with its buffer, the file's reader takes smaller spheres than the model's; remedy: a "
                        "buffer that is not negative");
    }
    EXPECT_EQ(refusal(balls, with({{{}, 0.05}, {{1, 0, 0}, 0.2}})), other) << "one alone is no buffer";
    const std::vector<LinkSpheres> boxed{{"a", {{{{}, 0.1}}, {box_of(0.2)}}}};
    EXPECT_EQ(refusal(boxed, {ball_of("a", 0.1)}),
              std::pair(ErrorCode::internal,
                        std::string("link 'a': the written file gives 1 sphere, the model has 1 sphere, 1 box")));
    EXPECT_EQ(refusal({ball_of("a", 0.1)}, boxed).second,
              "link 'a': the written file gives 1 sphere, 1 box, the model has 1 sphere");
    EXPECT_EQ(refusal(boxed, {ball_of("a", 0.1)}, {.elements_optional = true}).second, "no error");
    for (const double radius : {0.09, 0.11}) { // in other numbers, as elements come back; the verdict is on these
        const std::vector<LinkSpheres> read{{"a", {{{{0, 0, 0.01}, radius}}, {box_of(0.2)}}}}, at{{"a", {{{{}, radius}}, {box_of(0.2)}}}};
        EXPECT_EQ(refusal(boxed, read).second, "no error");
        EXPECT_EQ(refusal(boxed, at).second, "no error");
    }
    EXPECT_EQ(refusal(balls, with({{{}, 0.1}}), {.elements_optional = true}), other) << "of spheres all are required";
}

TEST(WrittenModel, GroupsOfALinkAreReadTogether) {
    SphereModel model = sphere_model_of(given_file({ball_of("a", 0.1), ball_of("b", 0.2)}),
                                        cubes_of_links({"a", "b"}).robot);
    model.groups.push_back(model.groups[0]);
    model.groups[2].tree = flat_tree({{{1, 0, 0}, 0.3}});
    const std::vector<WrittenFile> files{{"out.told", ""}};
    const auto text = [&](const std::vector<Sphere>& of_a) {
        return refused([&] {
                   require_written(model, Told(levels_of({{"a", of_a}, ball_of("b", 0.2)})), told_info(), files);
               })
            .second;
    };
    EXPECT_EQ(text({{{}, 0.1}, {{1, 0, 0}, 0.3}}), "no error");
    EXPECT_THAT(text({{{}, 0.1}}), HasSubstr("other spheres"));
}

TEST(WrittenModel, LinksAreNamedAndKnown) {
    const Original one = cubes_of_links({"arm"}), two = cubes_of_links({"arm", "leg"});
    SphereFile file = given_file({ball_of("", 1), ball_of("leg", 1)});
    const auto [code, text] = refused([&] { name_only_link(file, &two); });
    EXPECT_EQ(code, ErrorCode::input);
    EXPECT_THAT(text, HasSubstr("folder/model.yaml: its spheres name no link, and folder/robot.urdf has 2 links"));
    SphereFile named = given_file({ball_of("x", 1)});
    name_only_link(named, &two);
    EXPECT_EQ(named.links[0].link, "x");
    SphereFile of_file = file;
    name_only_link(of_file, nullptr);
    EXPECT_EQ(of_file.links[0].link, "model");
    name_only_link(file, &one);
    EXPECT_EQ(file.links[0].link, "arm");
    EXPECT_EQ(file.links[1].link, "leg");
    require_links(file, *two.robot);
    const auto unknown = refused([&] { require_links(given_file({ball_of("arn", 1)}), *one.robot); });
    EXPECT_EQ(unknown.first, ErrorCode::input);
    EXPECT_THAT(unknown.second, HasSubstr("link 'arn' is no link of"));
    EXPECT_THAT(unknown.second, HasSubstr("did you mean 'arm'?"));
    const auto robot = links_alone(given_file({ball_of("x", 1), ball_of("y", 1)}));
    EXPECT_EQ(robot->name, "model");
    EXPECT_EQ(robot->root, "x");
    ASSERT_EQ(robot->links.size(), 2u);
    EXPECT_EQ(robot->links[1].name, "y");
    EXPECT_EQ(links_alone(given_file({}))->root, "");
}

TEST(WrittenModel, OfAFileIsNothingMeasured) {
    const auto robot = cubes_of_links({"b", "a", "c"}).robot;
    const SphereModel model = sphere_model_of(
        given_file({ball_of("a", 1), {"b", {{{{}, 1}, {{}, 2}}, {box_of(1)}}}, {"c", {}}}), robot);
    EXPECT_EQ(model.name, "model");
    EXPECT_EQ(model.guarantee, Guarantee::fitted);
    ASSERT_EQ(model.groups.size(), 2u);
    EXPECT_EQ(model.groups[0].link, "b");
    EXPECT_EQ(model.groups[0].measures.spheres, 3u);
    EXPECT_FALSE(model.groups[0].measures.certified);
    const Measures& m = model.groups[0].measures;
    for (const double figure : {m.area, m.volume, m.covered, m.gap, m.excess, m.missing, m.protrusion_max}) {
        EXPECT_TRUE(std::isnan(figure));
    }
    EXPECT_EQ(refused([&] { sphere_model_of(given_file({{"a", {}}, ball_of("else", 1)}), robot); }),
              std::pair(ErrorCode::input, std::string("folder/model.yaml: there are no spheres to write")));
}

TEST(WrittenModel, FilesHaveTheirNames) {
    StageInfo info = told_info();
    info.companions = {"srdf", "told"};
    EXPECT_EQ(refused([&] { files_of(info, "x/out.told"); }).first, ErrorCode::usage);
    info.companions = {"srdf"};
    EXPECT_THAT(files_of(info, "x/out.told"), ElementsAre("x/out.told", "x/out.srdf"));
    SphereModel model = sphere_model_of(given_file({ball_of("a", 1)}), cubes_of_links({"a"}).robot);
    model.provenance = "line";
    Told writer({});
    writer.beside = {{"meshes/one.stl", "bytes"}};
    QuietContext context;
    const std::vector<WrittenFile> files = written_files(writer, info, model, "x/out.told", context);
    ASSERT_EQ(files.size(), 3u);
    EXPECT_EQ(files[0].bytes, "line");
    EXPECT_EQ(files[1].file, "x/out.srdf");
    EXPECT_EQ(files[1].bytes, "srdf out.told x");
    EXPECT_FALSE(files[0].beside || files[1].beside);
    EXPECT_EQ(files[2].file, "x/meshes/one.stl");
    EXPECT_TRUE(files[2].beside);
    EXPECT_TRUE(writer.written[0].folder.is_absolute());
    read_back(writer, files);
    EXPECT_EQ(writer.beside_read, writer.beside);
    EXPECT_EQ(refused([&] { written_files(writer, told_info(), model, "", context); }).first, ErrorCode::usage);
    writer.beside = {{"../one.stl", "bytes"}};
    EXPECT_EQ(refused([&] { written_files(writer, info, model, "x/out.told", context); }).first, ErrorCode::plugin);
}

TEST(WrittenModel, ElementsThatTheFormatCannotHoldAreRefused) {
    StageInfo info = told_info();
    const SphereModel model = sphere_model_of(given_file({{"a", {{}, {box_of(0.1)}}}}), cubes_of_links({"a"}).robot);
    const Told writer({});
    QuietContext context;
    EXPECT_EQ(written_files(writer, info, model, "x/out.told", context).size(), 1u);
    info.kinds = {Element::Kind::sphere};
    EXPECT_THAT(refused([&] { written_files(writer, info, model, "x/out.told", context); }).second, HasSubstr("box"));
    EXPECT_EQ(writer.written.size(), 1u);
}

TEST(WrittenModel, AnEditedFileHasTheNewLineOnly) {
    SphereModel model = sphere_model_of(given_file({ball_of("a", 1)}), cubes_of_links({"a"}).robot);
    model.provenance = "# foam 1: it was proved";
    QuietContext context;
    const Told writer({});
    EXPECT_EQ(written_files(writer, told_info(), model, "out.told", context)[0].bytes, model.provenance);
    model.into = TextFile{"out.told", ""};
    class Keeping final : public Writer {
    public:
        std::string write(const SphereModel&, Context&) const override { return "# foam 1: old, proved\n"; }
        std::map<std::string, Elements> read(const std::string&, const std::map<std::string, std::string>&) const override { return {}; }
    };
    model.provenance = "foam 2: not proved";
    EXPECT_EQ(written_files(Keeping(), told_info(), model, "out.told", context)[0].bytes, "# foam 2: not proved\n");
    model.into.reset();
    EXPECT_EQ(written_files(Keeping(), told_info(), model, "out.told", context)[0].bytes, "# foam 1: old, proved\n");
}

/// The pairs that need no check of a row of cubes, each 0.25 m from the next, with these spheres around them. `edge`: of the
/// cubes; 0: they are not known.
std::vector<std::string> ignored_of(const std::vector<LinkSpheres>& spheres, double edge,
                                    const std::atomic<bool>* cancel = nullptr) {
    const auto original = cubes_of_links({"a", "b", "c"});
    Robot robot = *original.robot;
    robot.root = "a";
    for (const auto& [parent, child] : {std::pair("a", "b"), std::pair("b", "c")}) {
        robot.joints.push_back({.name = child,
                                .kind = Joint::Kind::prismatic,
                                .parent = parent,
                                .child = child,
                                .origin = Pose::from_xyz_rpy({0.25, 0, 0}, {}),
                                .axis = {0, 1, 0},
                                .lower = -0.01,
                                .upper = 0.01});
    }
    SphereModel model = sphere_model_of(given_file(spheres), std::make_shared<const Robot>(robot));
    if (edge > 0) {
        for (const OriginalLink& link : original.links) {
            model.geometry[link.link] = Solid::make({{nullptr, Element::box({edge, edge, edge}), {}}});
        }
    }
    std::vector<std::string> names;
    for (const IgnoredPair& pair : ignored_pairs_of(model, cancel)) {
        names.push_back(pair.first + pair.second + " " + pair.reason);
    }
    return names;
}

std::vector<std::string> ignored(double radius, bool with_geometry) {
    return ignored_of({ball_of("a", radius), ball_of("b", radius), ball_of("c", radius)}, with_geometry ? 0.2 : 0);
}

TEST(WrittenModel, PairsAreThoseOfTheElementsAndTheGeometry) {
    EXPECT_THAT(ignored(0.18, true), ElementsAre("ab Adjacent", "ac Never", "bc Adjacent"));
    EXPECT_THAT(ignored(0.18, false), ElementsAre("ab Adjacent", "ac Never", "bc Adjacent"));
    EXPECT_THAT(ignored(0.4, false), ElementsAre("ab Adjacent", "bc Adjacent")) << "touch, of what is not known";
    EXPECT_THAT(ignored(0.4, true), ElementsAre("ab Adjacent", "ac Never", "bc Adjacent")) << "the geometry is apart";
}

TEST(WrittenModel, PairsAreThoseOfAllGroupsOfALink) {
    // The larger one of the two reaches the third link, whichever comes first.
    const std::vector<LinkSpheres> others{ball_of("b", 0.1), ball_of("c", 0.18)};
    for (const bool larger_first : {false, true}) {
        std::vector<LinkSpheres> links{ball_of("a", larger_first ? 0.4 : 0.1), ball_of("a", larger_first ? 0.1 : 0.4)};
        links.insert(links.end(), others.begin(), others.end());
        EXPECT_THAT(ignored_of(links, 0), ElementsAre("ab Adjacent", "bc Adjacent")) << larger_first;
    }
    // Elements that are no spheres count, too.
    const LinkSpheres bar{"a", {{{{}, 0.1}}, {{.kind = Element::Kind::box, .half = {0.4, 0.1, 0.1}}}}};
    EXPECT_THAT(ignored_of({bar, others[0], others[1]}, 0), ElementsAre("ab Adjacent", "bc Adjacent"));
}

TEST(WrittenModel, SpheresThatLeaveGeometryOutDoNotSpeakForIt) {
    const std::vector<LinkSpheres> small{ball_of("a", 0.05), ball_of("b", 0.05), ball_of("c", 0.05)};
    EXPECT_THAT(ignored_of(small, 0.2), ElementsAre("ab Adjacent", "ac Never", "bc Adjacent"));
    EXPECT_THAT(ignored_of(small, 0.6), ElementsAre("ab Adjacent", "bc Adjacent")) << "cubes that touch";
    std::vector<LinkSpheres> one = small; // that one of them covers its cube is not enough
    one[0] = ball_of("a", 0.2);
    EXPECT_THAT(ignored_of(one, 0.2), ElementsAre("ab Adjacent", "ac Never", "bc Adjacent"));
    const std::atomic<bool> cancel = true;
    EXPECT_EQ(refused([&] { ignored_of(small, 0.2, &cancel); }).first, ErrorCode::cancelled);
}

} // namespace
} // namespace foam::test
