// snapshot.osmesa as a caller sees it: figures in, pictures out.
#include <foam/base/error.hpp>
#include <foam/base/random.hpp>
#include <foam/sdk/registry.hpp>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>

namespace {

using namespace foam;

class Recorder : public QuietContext {
public:
    void log(Severity severity, std::string_view message) override {
        const std::lock_guard lock(mutex_);
        if (severity >= Severity::warning) {
            warnings.emplace_back(message);
        }
    }
    std::vector<std::string> warnings;

private:
    std::mutex mutex_;
};

/// Twelve triangles around the origin.
std::shared_ptr<const Mesh> box(const Vec3& size) {
    auto mesh = std::make_shared<Mesh>();
    for (int i = 0; i < 8; ++i) {
        mesh->vertices.push_back(
            {(i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 0.5 : -0.5) * size.y, (i & 4 ? 0.5 : -0.5) * size.z});
    }
    mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// Row-wise mean of |a - b| over pixels and channels.
double difference(const cv::Mat3b& a, const cv::Mat3b& b) {
    return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(3 * a.total());
}

/// Pixels whose colour is not grey: those of spheres and the colour bar.
int coloured(const cv::Mat3b& picture, const cv::Rect& area) {
    int count = 0;
    for (const cv::Vec3b& pixel : cv::Mat3b(picture(area).clone())) {
        count += std::max({pixel[0], pixel[1], pixel[2]}) - std::min({pixel[0], pixel[1], pixel[2]}) > 60;
    }
    return count;
}

int coloured(const cv::Mat3b& picture) {
    return coloured(picture, {0, 0, picture.cols, picture.rows});
}

bool blank(const cv::Mat3b& picture) {
    return cv::countNonZero(picture.reshape(1) != 255) == 0;
}

class Snapshot : public testing::Test {
protected:
    Snapshot() {
        const PluginRecord& record = registry.load(FOAM_TEST_PLUGINS "/snapshot_osmesa.so");
        EXPECT_TRUE(record.loaded()) << record.rejection;
    }

    cv::Mat3b draw(const Figure& figure, const std::map<std::string, ParameterValue>& parameters = {}) {
        const Image image = registry.make<Renderer>("snapshot.osmesa", parameters)->render(figure, context);
        EXPECT_EQ(image.width, figure.width);
        EXPECT_EQ(image.height, figure.height);
        const std::vector<unsigned char> bytes(image.png.begin(), image.png.end());
        cv::Mat3b picture = cv::imdecode(bytes, cv::IMREAD_COLOR);
        EXPECT_EQ(picture.cols, figure.width);
        EXPECT_EQ(picture.rows, figure.height);
        return picture;
    }

    static Figure small(std::vector<Panel> panels) {
        Figure figure;
        figure.panels = std::move(panels);
        figure.width = 320;
        figure.height = 240;
        return figure;
    }

    Registry registry;
    Recorder context;
};

const cv::Rect bar_area{276, 0, 44, 240}; // of a picture of 320 × 240

TEST_F(Snapshot, SpheresAreColouredByRadiusBesideABar) {
    const Figure figure = small({{"", {}, {{{-1, 0, 0}, 0.5}, {{1.2, 0, 0}, 1.0}}}});
    const cv::Mat3b with_bar = draw(figure, {{"azimuth", -90.0}, {"elevation", 0.0}});
    EXPECT_GT(coloured(with_bar, bar_area), 300);
    // The middles of the small sphere, viridis' dark violet, and of the large one, its yellow (blue, green, red).
    const cv::Rect left{50, 110, 20, 20}, right{180, 110, 20, 20};
    EXPECT_GT(cv::mean(with_bar(left))[0], cv::mean(with_bar(left))[1] + 20);
    EXPECT_GT(cv::mean(with_bar(right))[2], cv::mean(with_bar(right))[0] + 60);

    Figure tall = small({{"", {}, {{{0, 0, 0}, 0.5}, {{0, 0, 2}, 1.0}}}});
    EXPECT_GT(coloured(draw(tall), bar_area), 300);
    tall.colour_bar = false;
    EXPECT_EQ(coloured(draw(tall), bar_area), 0);
    const cv::Mat3b mesh_only = draw(small({{"a mesh", {{box({1, 1, 1}), {}, false}}, {}}}));
    EXPECT_EQ(coloured(mesh_only, bar_area), 0) << "a bar without spheres";
    EXPECT_FALSE(blank(mesh_only));
}

TEST_F(Snapshot, MeshesHaveTheirColours) {
    FigureMesh mesh{.mesh = box({1, 1, 1}), .pose = {}};
    const int grey = coloured(draw(small({{"", {mesh}, {}}})));
    EXPECT_EQ(grey, 0);
    mesh.colours.assign(12, 0xd01010ff);
    const cv::Mat3b red = draw(small({{"", {mesh}, {}}}));
    const cv::Scalar middle = cv::mean(red({150, 110, 20, 20}));
    EXPECT_GT(middle[2], middle[0] + 60) << "not red (blue, green, red)";
    mesh.colours.assign(12, 0); // the file has a colour for none of them
    EXPECT_EQ(coloured(draw(small({{"", {mesh}, {}}}))), 0);
    mesh.colours.assign(3, 0xd01010ff); // fewer colours than triangles
    EXPECT_FALSE(blank(draw(small({{"", {mesh}, {}}}))));
}

TEST_F(Snapshot, SpheresShineThroughATranslucentMesh) {
    const std::vector<Sphere> inside{{{0, 0, 0}, 0.3}};
    const auto cube = box({1, 1, 1});
    const cv::Mat3b translucent = draw(small({{"", {{cube, {}, true}}, inside}}));
    const cv::Mat3b opaque = draw(small({{"", {{cube, {}, false}}, inside}}));
    const cv::Mat3b empty_cube = draw(small({{"", {{cube, {}, true}}, {}}}));
    const cv::Rect middle{90, 80, 100, 80};
    EXPECT_GT(coloured(translucent, middle), 300);
    EXPECT_EQ(coloured(opaque, middle), 0);
    EXPECT_FALSE(blank(empty_cube));

    // A mesh inside a sphere, as covering spheres have it, shows as well.
    const cv::Mat3b within = draw(small({{"", {{box({0.4, 0.4, 0.4}), {}, true}}, {{{0, 0, 0}, 0.5}}}}));
    const cv::Mat3b alone = draw(small({{"", {}, {{{0, 0, 0}, 0.5}}}}));
    EXPECT_GT(difference(within, alone), 1.0);
    EXPECT_LT(
        difference(draw(small({{"", {{box({0.4, 0.4, 0.4}), {}, true}}, {{{0, 0, 0}, 0.5}}}}), {{"mesh_opacity", 0.0}}),
                   alone),
        0.1);
}

TEST_F(Snapshot, ThePoseOfAMeshMovesIt) {
    Pose lifted;
    lifted.translation = {0, 0, 2};
    const auto cube = box({1, 1, 1});
    const cv::Mat3b picture = draw(small({{"", {{cube, {}, false}, {cube, lifted, false}}, {}}}), {{"elevation", 0.0}});
    const cv::Mat1b dark = cv::Mat1b(picture.reshape(1) < 250);
    EXPECT_GT(cv::countNonZero(dark.rowRange(10, 70)), 0);
    EXPECT_EQ(cv::countNonZero(dark.rowRange(112, 128)), 0) << "the gap between the cubes";
    EXPECT_GT(cv::countNonZero(dark.rowRange(170, 230)), 0);
}

TEST_F(Snapshot, PanelsShareOneScale) {
    const Figure figure =
        small({{"big", {{box({1, 1, 1}), {}, false}}, {}}, {"small", {{box({0.25, 0.25, 0.25}), {}, false}}, {}}});
    const cv::Mat3b picture = draw(figure);
    const auto drawn = [&](const cv::Rect& half) {
        return cv::countNonZero(cv::Mat1b(picture(half).clone().reshape(1) < 240));
    };
    const double ratio = 1.0 * drawn({0, 40, 160, 160}) / drawn({160, 40, 160, 160});
    EXPECT_NEAR(ratio, 16, 3);
}

TEST_F(Snapshot, ATurntableKeepsItsScale) {
    // A long body, off the origin: a fitted view of its end would be larger than one of its side.
    Pose away;
    away.translation = {3, 1, 0};
    const Figure figure = small({{"", {{box({1, 0.2, 0.1}), away, false}}, {}}});
    const auto height_from = [&](double azimuth, bool turntable) {
        const cv::Mat3b picture = draw(figure, {{"azimuth", azimuth}, {"elevation", 0.0}, {"turntable", turntable}});
        cv::Mat1b inked(picture.rows, 1, static_cast<unsigned char>(0));
        for (int row = 0; row < picture.rows; ++row) {
            inked(row, 0) = !blank(picture.row(row).clone());
        }
        return cv::countNonZero(inked);
    };
    EXPECT_GT(height_from(0, false), 3 * height_from(90, false) / 2);
    EXPECT_NEAR(height_from(0, true), height_from(90, true), 1);
    EXPECT_NEAR(height_from(30, true), height_from(90, true), 1);
}

TEST_F(Snapshot, NothingToDraw) {
    EXPECT_TRUE(blank(draw(small({}))));
    EXPECT_TRUE(blank(draw(small({{}, {}}))));
    Figure titled = small({});
    titled.title = "Nothing — “but” a title";
    EXPECT_FALSE(blank(draw(titled)));
    EXPECT_TRUE(context.warnings.empty());
    EXPECT_FALSE(blank(draw(small({{"a point", {}, {}}}))));
}

TEST_F(Snapshot, TheSamePictureAtAnyScaleAndPlace) {
    const auto figure_at = [](double scale, const Vec3& offset) {
        Panel panel{"", {{box(Vec3{1, 2, 1} * scale), {}, true}}, {}};
        panel.meshes[0].pose.translation = offset;
        for (int i = -1; i <= 1; ++i) {
            panel.spheres.push_back({offset + Vec3{0, 0.7 * i, 0} * scale, (0.6 + 0.2 * i) * scale});
        }
        Figure figure = small({panel});
        figure.colour_bar = false;
        return figure;
    };
    const cv::Mat3b reference = draw(figure_at(1, {}));
    EXPECT_GT(coloured(reference), 1000);
    EXPECT_LT(difference(draw(figure_at(1e-7, {})), reference), 0.1);
    EXPECT_LT(difference(draw(figure_at(1e4, {})), reference), 0.1);
    EXPECT_LT(difference(draw(figure_at(1, {5e4, -3e4, 1e4})), reference), 0.1);
}

TEST_F(Snapshot, ValuesThatAreNotFiniteAreLeftOutWithAWarning) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    auto broken = std::make_shared<Mesh>(*box({1, 1, 1}));
    broken->vertices.push_back({nan, 0, 0});
    broken->triangles.push_back({0, 1, 8});
    broken->triangles.push_back({0, 1, 99});
    const cv::Mat3b sound = draw(small({{"", {{box({1, 1, 1}), {}, false}}, {{{0, 0, 1}, 0.5}}}}));
    const cv::Mat3b picture =
        draw(small({{"",
                     {{broken, {}, false}, {nullptr, {}, true}},
                     {{{0, 0, 1}, 0.5}, {{0, nan, 0}, 1}, {{0, 0, 0}, nan}, {{0, 0, 0}, infinity}, {{0, 0, 0}, -1}}}}));
    EXPECT_EQ(difference(picture, sound), 0);
    EXPECT_THAT(context.warnings, testing::ElementsAre(testing::HasSubstr("2 triangles, 4 spheres")));
}

TEST_F(Snapshot, AThousandSpheres) {
    Random random(7);
    Panel panel;
    for (int i = 0; i < 1000; ++i) {
        panel.spheres.push_back({{random.uniform(), random.uniform(), random.uniform()}, random.uniform(0.01, 0.06)});
    }
    EXPECT_GT(coloured(draw(small({panel}))), 10'000);
}

TEST_F(Snapshot, ThreadsGetTheSameBytes) {
    const auto renderer = registry.make<Renderer>("snapshot.osmesa");
    const Figure figure =
        small({{"one", {{box({1, 1, 1}), {}, true}}, {{{0, 0, 0}, 0.6}}}, {"two", {{box({1, 1, 1}), {}, false}}, {}}});
    const std::string expected = renderer->render(figure, context).png;
    std::vector<std::string> results(6);
    std::vector<std::thread> threads;
    for (std::string& result : results) {
        threads.emplace_back([&] { result = renderer->render(figure, context).png; });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_THAT(results, testing::Each(expected));
    EXPECT_EQ(registry.make<Renderer>("snapshot.osmesa")->render(figure, context).png, expected) << "another context";
}

TEST_F(Snapshot, SamplesSmoothEdges) {
    const Figure figure = small({{"", {{box({1, 1, 1}), {}, false}}, {{{0, 0, 1}, 0.5}}}});
    const cv::Mat3b coarse = draw(figure, {{"supersampling", std::int64_t{1}}});
    const cv::Mat3b fine = draw(figure, {{"supersampling", std::int64_t{4}}});
    EXPECT_GT(difference(coarse, fine), 0.05);
    EXPECT_LT(difference(coarse, fine), 10);
}

TEST_F(Snapshot, AMissingFontIsReported) {
    Figure figure =
        small({{"a caption that is far too long for the room below its small view, really", {}, {{{0, 0, 0}, 1}}}});
    figure.title = "title µm …";
    EXPECT_FALSE(blank(draw(figure, {{"font", std::string("/nowhere/none.ttf")}})));
    EXPECT_THAT(context.warnings, testing::ElementsAre(testing::HasSubstr("cannot read the font /nowhere/none.ttf")));
}

TEST_F(Snapshot, ImpossibleSizesAreRefused) {
    for (const auto& [width, height] : {std::pair{0, 240}, {320, -1}, {1'000'000, 240}}) {
        Figure figure = small({});
        figure.width = width;
        figure.height = height;
        try {
            registry.make<Renderer>("snapshot.osmesa")->render(figure, context);
            FAIL() << width << " x " << height;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_THAT(error.what(), testing::HasSubstr(std::to_string(width) + " x " + std::to_string(height)));
        }
    }
}

TEST_F(Snapshot, NoContextIsAnErrorThatNamesARemedy) {
    setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1); // read once, by the process's first context
    try {
        registry.make<Renderer>("snapshot.osmesa")->render(small({}), context);
        FAIL() << "OpenGL 2.1 has no core profile";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::output);
        EXPECT_THAT(error.what(), testing::HasSubstr("OpenGL 3.3"));
    }
    unsetenv("MESA_GL_VERSION_OVERRIDE");
}

} // namespace
