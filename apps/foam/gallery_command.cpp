// foam gallery: a robot and models of it with more and more spheres, side by side in one picture.
#include "cli/files.hpp"
#include "cli/messages.hpp"
#include "commands.hpp"
#include "judge.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/figure.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/view/session.hpp>

#include <fmt/format.h>
#include <png.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace foam::cli {

namespace {

struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

Pixels decoded(const std::string& png) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    Pixels pixels;
    bool read = png_image_begin_read_from_memory(&image, png.data(), png.size()) != 0;
    if (read) {
        image.format = PNG_FORMAT_RGBA;
        pixels = {static_cast<int>(image.width), static_cast<int>(image.height), {}};
        pixels.rgba.resize(PNG_IMAGE_SIZE(image));
        read = png_image_finish_read(&image, nullptr, pixels.rgba.data(), 0, nullptr) != 0;
    }
    png_image_free(&image);
    if (!read) {
        throw Error(ErrorCode::internal, std::string("a frame of the animation is no PNG: ") + image.message);
    }
    return pixels;
}

void require(bool done, const char* what) {
    if (!done) {
        throw Error(ErrorCode::internal, std::string("the animation could not be encoded: ") + what);
    }
}

/// A still picture as libwebp takes it.
class Picture {
public:
    explicit Picture(const Pixels& pixels) {
        require(WebPPictureInit(&picture_) != 0, "version of libwebp");
        picture_.use_argb = 1;
        picture_.width = pixels.width;
        picture_.height = pixels.height;
        require(WebPPictureImportRGBA(&picture_, pixels.rgba.data(), 4 * pixels.width) != 0, "memory");
    }
    ~Picture() { WebPPictureFree(&picture_); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    WebPPicture* get() { return &picture_; }

private:
    WebPPicture picture_{};
};

using Encoder = std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)>;

Encoder encoder_for(const Pixels& first) {
    WebPAnimEncoderOptions options;
    require(WebPAnimEncoderOptionsInit(&options) != 0, "version of libwebp");
    options.anim_params.loop_count = 0; // for ever
    Encoder encoder(WebPAnimEncoderNew(first.width, first.height, &options), &WebPAnimEncoderDelete);
    require(encoder != nullptr, "memory");
    return encoder;
}

/// Returns an animated WebP that repeats for ever. `frames`: PNG files of one size, at least one; each is shown for
/// `each`. Equal frames give equal bytes. Throws Error(internal) for frames that are no such files.
std::string animated_webp(const std::vector<std::string>& frames, std::chrono::milliseconds each) {
    constexpr float quality = 85; // of 100; edges stay sharp
    WebPConfig config;
    require(WebPConfigInit(&config) != 0, "version of libwebp");
    config.quality = quality;
    const Encoder encoder = encoder_for(decoded(frames.at(0)));
    int time = 0; // ms
    for (const std::string& frame : frames) {
        Picture picture(decoded(frame));
        require(WebPAnimEncoderAdd(encoder.get(), picture.get(), time, &config) != 0,
                WebPAnimEncoderGetError(encoder.get()));
        time += static_cast<int>(each.count());
    }
    require(WebPAnimEncoderAdd(encoder.get(), nullptr, time, nullptr) != 0, WebPAnimEncoderGetError(encoder.get()));
    WebPData data;
    WebPDataInit(&data);
    require(WebPAnimEncoderAssemble(encoder.get(), &data) != 0, WebPAnimEncoderGetError(encoder.get()));
    std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    return bytes;
}

constexpr const char* renderer_stage = "snapshot.osmesa";

struct GalleryArguments {
    std::string input, output, turntable, size, pose, srdf;
    std::vector<std::size_t> counts;
    std::vector<std::string> packages;
    RobotOptions robot;
    int frames = 48;
    MeshUnit unit;
    std::size_t threads = 0;
    bool force = false;
};

using Size = std::pair<int, int>; ///< width and height in pixels

/// Returns the size of "1600x600".
Size size_of(const std::string& text) {
    int width = 0, height = 0;
    const char* const end = text.data() + text.size();
    const auto [between, wrong] = std::from_chars(text.data(), end, width);
    if (wrong == std::errc{} && between != end && *between == 'x') {
        const auto [rest, also_wrong] = std::from_chars(between + 1, end, height);
        constexpr int least = 64, most = 8192;
        if (also_wrong == std::errc{} && rest == end && std::min(width, height) >= least &&
            std::max(width, height) <= most) {
            return {width, height};
        }
    }
    throw Error(ErrorCode::usage,
                fmt::format("--size expects pixels such as 1600x600, from 64 to 8192 along each side, got '{}'", text));
}

std::vector<Pose> link_poses(const ViewedRobot& robot, const std::string& name) {
    const auto pose = std::find_if(robot.poses.begin(), robot.poses.end(),
                                   [&](const NamedPose& known) { return name.empty() || known.name == name; });
    if (pose == robot.poses.end()) {
        std::vector<std::string> names;
        for (const NamedPose& known : robot.poses) {
            names.push_back(known.name);
        }
        throw Error(ErrorCode::usage,
                    fmt::format("there is no pose '{}'; remedy: --pose with one of: {}", name, fmt::join(names, ", ")));
    }
    return robot.kinematics->link_poses(pose->configuration);
}

/// Returns the colour of each triangle: the file's, else the material's. Empty: there is none.
std::vector<view::Colour> colours_of(const ViewedElement& element) {
    std::vector<view::Colour> colours = element.mesh->colours;
    if (element.colour) {
        colours.resize(element.mesh->mesh->triangles.size());
        std::replace(colours.begin(), colours.end(), view::Colour{0}, *element.colour);
    }
    return colours;
}

Panel geometry_panel(const ViewedRobot& robot, const std::vector<Pose>& poses, const char* caption,
                     std::vector<ViewedElement> ViewedLink::*elements) {
    Panel panel;
    panel.caption = caption;
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
        for (const ViewedElement& element : robot.links[i].*elements) {
            panel.meshes.push_back(
                {.mesh = element.mesh->mesh, .pose = poses[i] * element.pose, .colours = colours_of(element)});
        }
    }
    return panel;
}

Panel sphere_panel(const std::vector<std::vector<Sphere>>& spheres, const std::vector<Pose>& poses) {
    Panel panel;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        for (const Sphere& sphere : spheres[i]) {
            panel.spheres.push_back({poses[i] * sphere.center, sphere.radius});
        }
    }
    panel.caption = counted(panel.spheres.size(), "sphere");
    return panel;
}

/// Returns the picture: what the robot looks like, what collides, and the spheres for each count, fewest first.
Figure figure_of(const GalleryArguments& arguments, std::optional<Size> size, const ViewedRobot& robot,
                 const SubjectOptions& options, Registry& registry) {
    const std::vector<Pose> poses = link_poses(robot, arguments.pose);
    Figure figure;
    Panel looks = geometry_panel(robot, poses, "visual geometry", &ViewedLink::visuals);
    if (!looks.meshes.empty()) {
        figure.panels.push_back(std::move(looks));
    }
    figure.panels.push_back(geometry_panel(robot, poses, "collision geometry", &ViewedLink::collisions));
    for (const std::size_t count : std::set<std::size_t>(arguments.counts.begin(), arguments.counts.end())) {
        figure.panels.push_back(
            sphere_panel(spheres_of(robot, options, registry, count, {}, &stop_on_interrupt()), poses));
        tell(fmt::format("{} of at most {}", figure.panels.back().caption, count));
    }
    constexpr int width_of_panel = 440, height = 640, widest = 8192;
    const int width =
        std::min(widest, width_of_panel * static_cast<int>(std::min<std::size_t>(figure.panels.size(), 100)));
    std::tie(figure.width, figure.height) = size.value_or(Size{width, height});
    return figure;
}

std::string drawn(const Registry& registry, const Figure& figure, std::map<std::string, ParameterValue> parameters) {
    Telling context;
    return registry.make<Renderer>(renderer_stage, parameters)->render(figure, context).png;
}

/// Returns the figure seen from all around.
std::string turned(const Registry& registry, const Figure& figure, int frames) {
    constexpr double begin = -55; // deg; where a picture is seen from
    constexpr std::chrono::milliseconds turn(6000);
    std::vector<std::string> pictures;
    for (int i = 0; i < frames; ++i) {
        if (interrupted()) {
            throw Error(ErrorCode::cancelled, "cancelled; nothing was written");
        }
        const double azimuth = std::remainder(begin + 360.0 * i / frames, 360.0);
        pictures.push_back(drawn(registry, figure, {{"azimuth", azimuth}, {"turntable", true}}));
    }
    return animated_webp(pictures, turn / frames);
}

int gallery(Program& program, const GalleryArguments& arguments) {
    const ThreadLimit limit(arguments.threads);
    Registry& registry = program.registry();
    if (registry.find(renderer_stage) == nullptr) {
        throw Error(ErrorCode::plugin, fmt::format("no plugin offers {}, which draws pictures", renderer_stage));
    }
    if (arguments.output.empty() && program.standard_input.is(arguments.input)) {
        throw Error(ErrorCode::usage, "the input - gives the picture no name; remedy: -o FILE");
    }
    const std::optional<Size> size = arguments.size.empty() ? std::nullopt : std::optional(size_of(arguments.size));
    const SubjectOptions options{.files = {arguments.input},
                                 .unit = arguments.unit,
                                 .package_path = package_path_of(arguments.packages),
                                 .geometry = covered_geometry(arguments.robot.geometry),
                                 .srdf = arguments.srdf,
                                 .nameless = program.standard_input.file(),
                                 .nameless_name = program.standard_input.name(),
                                 .choices = choices_of(arguments.robot)};
    const Subject subject = load_subject(options, registry);
    for (const std::string& note : subject.notes) {
        tell(fmt::format("warning: {}", note));
    }
    const ViewedRobot& robot = subject.robots.front();
    if (!robot.judged) {
        throw Error(ErrorCode::input, fmt::format("{}: it has no geometry that spheres could cover; remedy: a URDF "
                                                  "or a mesh, or another --geometry",
                                                  arguments.input));
    }
    const std::filesystem::path stem = std::filesystem::path(arguments.input).stem();
    const std::string output = arguments.output.empty() ? stem.string() + "_gallery.png" : arguments.output;
    const auto inputs = inputs_of(subject, options);
    refuse_overwriting(output, inputs, arguments.force);
    refuse_overwriting(arguments.turntable, inputs, arguments.force);
    const Figure figure = figure_of(arguments, size, robot, options, registry);
    write_whole_file(output, drawn(registry, figure, {}));
    tell(fmt::format("written: {}", output));
    if (!arguments.turntable.empty()) {
        write_whole_file(arguments.turntable, turned(registry, figure, arguments.frames));
        tell(fmt::format("written: {}", arguments.turntable));
    }
    return 0;
}

} // namespace

void add_gallery(Program& program) {
    CLI::App* command = add_command(program, "gallery", "Draw a robot beside models of it, as one picture",
                                    "  foam gallery robot.urdf 10 30 100              writes robot_gallery.png\n"
                                    "  foam gallery part.stl 4 16 -o part.png --size 1600x600\n"
                                    "  foam gallery robot.urdf 60 --turntable robot.webp");
    auto arguments = std::make_shared<GalleryArguments>();
    command->add_option("input", arguments->input,
                        "A robot (URDF, xacro, MJCF, SDF, USD) or a mesh; - is the standard input")
        ->type_name("INPUT")
        ->required();
    program.standard_input.may_be(arguments->input, StandardInput::Holds::geometry);
    program.standard_input.add_format(*command);
    command->add_option("counts", arguments->counts, "Numbers of spheres of the whole robot, a view each")
        ->type_name("N")
        ->required()
        ->check(whole_number(1, 1'000'000));
    command
        ->add_option("-o,--output", arguments->output, "The picture, a PNG; default: the name of INPUT with _gallery")
        ->type_name("FILE");
    command
        ->add_option("--turntable", arguments->turntable,
                     "Write the same seen from all around, too: an animation as WebP")
        ->type_name("FILE");
    command->add_option("--frames", arguments->frames, "Frames of a turn")
        ->type_name("N")
        ->capture_default_str()
        ->needs("--turntable")
        ->check(whole_number(2, 360));
    command->add_option("--size", arguments->size, "Size of the picture in pixels; default: 440x640 for each view")
        ->type_name("WxH");
    command->add_option("--pose", arguments->pose, "zero (the default), middle, or a group state of --srdf")
        ->type_name("NAME");
    command->add_option("--srdf", arguments->srdf, "Take named poses from the group states of this SRDF")
        ->type_name("FILE");
    add_force(*command, arguments->force);
    using enum RobotOption;
    add_robot_options(*command, arguments->robot, {geometry, keep, skip, weight, lock});
    add_packages(*command, arguments->packages);
    add_mesh_unit(*command, arguments->unit);
    add_threads(*command, arguments->threads);
    command->callback(
        [&program, arguments] { program.action = [&program, arguments] { return gallery(program, *arguments); }; });
}

} // namespace foam::cli
