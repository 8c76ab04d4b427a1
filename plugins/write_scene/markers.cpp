#include "markers.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/yaml/write.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace foam::scene {
namespace {

using yaml::Value;
using Kind = Value::Kind;

constexpr int sphere_type = 2; // visualization_msgs/Marker.SPHERE
constexpr yaml::TextKind marker_file{.name = "marker file", .most_bytes = 64'000'000};

/// Colours that differ for people with any vision (Okabe and Ito 2008).
constexpr std::array<std::array<double, 3>, 6> colours{
    {{0.0, 0.45, 0.7}, {0.9, 0.6, 0.0}, {0.0, 0.6, 0.5}, {0.8, 0.4, 0.0}, {0.35, 0.7, 0.9}, {0.8, 0.6, 0.7}}};

Value vector_value(const Vec3& v) {
    return yaml::map({{"x", yaml::real(v.x)}, {"y", yaml::real(v.y)}, {"z", yaml::real(v.z)}});
}

Value colour_value(std::size_t link, double alpha) {
    const auto& [r, g, b] = colours[link % colours.size()];
    return yaml::map({{"r", yaml::real(r)}, {"g", yaml::real(g)}, {"b", yaml::real(b)}, {"a", yaml::real(alpha)}});
}

Value marker_value(const std::string& link, std::int64_t id, const Sphere& s, const Value& colour) {
    const double diameter = 2 * s.radius;
    if (!std::isfinite(diameter)) {
        throw Error(ErrorCode::output, fmt::format("sphere {} of link '{}': the diameter exceeds a double; remedy: a "
                                                   "smaller sphere",
                                                   id, shown(link)));
    }
    const Value turned =
        yaml::map({{"x", yaml::real(0)}, {"y", yaml::real(0)}, {"z", yaml::real(0)}, {"w", yaml::real(1)}});
    return yaml::map({{"header", yaml::map({{"frame_id", yaml::text(link)}})},
                      {"ns", yaml::text(link)},
                      {"id", yaml::integer(id)},
                      {"type", yaml::integer(sphere_type)},
                      {"action", yaml::integer(0)},
                      {"pose", yaml::map({{"position", vector_value(s.center)}, {"orientation", turned}})},
                      {"scale", vector_value({diameter, diameter, diameter})},
                      {"color", colour},
                      {"frame_locked", yaml::boolean(true)}});
}

/// Reads the values of a message, with places for errors.
class Message {
public:
    explicit Message(const std::filesystem::path& file)
        : result{.file = file, .format = "ROS markers", .links = {}, .fixed_joints = {}, .notes = {}} {}

    void add(const Value& marker) {
        const double type = number(at(marker, "type"));
        const Value* action = marker.find("action");
        const Value& scale = at(marker, "scale");
        const Vec3 size = point(scale);
        if (type != sphere_type || (action && number(*action) != 0) || size.x != size.y || size.x != size.z) {
            ++left_out_;
            return;
        }
        const Value& frame = at(at(marker, "header"), "frame_id");
        if (!frame.is_scalar() || frame.text.empty()) {
            fail(frame, "expected the name of a frame, got " + frame.description());
        }
        spheres_of(result, frame.text).push_back({point(at(at(marker, "pose"), "position")), size.x / 2});
    }

    const Value& list(const Value& value) const {
        if (!value.is(Kind::list)) {
            fail(value, "expected a list of markers, got " + value.description());
        }
        return value;
    }

    const Value& at(const Value& map, std::string_view key) const {
        const Value* value = map.is(Kind::map) ? map.find(key) : nullptr;
        if (!value) {
            fail(map, fmt::format("expected a map with the key '{}', got {}", key,
                                  map.is(Kind::map) ? "one without" : map.description()));
        }
        return *value;
    }

    void finish() {
        if (left_out_ > 0) {
            result.notes.push_back(fmt::format("{} marker{} no single sphere{}, and left out", left_out_,
                                               left_out_ == 1 ? " is" : "s are", left_out_ == 1 ? "" : "s"));
        }
    }

    SphereFile result;

private:
    [[noreturn]] void fail(const Value& at, const std::string& why) const {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}:{}: {}", result.file.string(), at.where.line, at.where.column, shown(why)));
    }

    double number(const Value& value) const {
        const bool whole = value.is(Kind::integer);
        const double number = whole ? static_cast<double>(value.whole) : value.real;
        if ((!whole && !value.is(Kind::number)) || !std::isfinite(number)) {
            fail(value, "expected a finite number, got " + value.description());
        }
        return number;
    }

    Vec3 point(const Value& value) const {
        return {number(at(value, "x")), number(at(value, "y")), number(at(value, "z"))};
    }

    std::size_t left_out_ = 0;
};

Value parse(const std::string& text, const std::filesystem::path& file) {
    yaml::Findings findings(file.string());
    std::optional<Value> root;
    if (yaml::check_text(text, 0, findings, marker_file)) {
        root = yaml::read_yaml(text, 0, findings, marker_file);
    }
    if (findings.any_error() || !root) {
        const std::vector<yaml::Diagnostic> all = findings.take();
        throw Error(ErrorCode::input, fmt::format("{}: {}", all.front().where.text(), all.front().message));
    }
    return std::move(*root);
}

} // namespace

std::string markers_text(const SphereModel& model, double alpha) {
    Value markers = yaml::list();
    std::size_t number = 0;
    for (const LinkSpheres& link : spheres_by_link(model)) {
        if (link.link.empty()) {
            throw Error(ErrorCode::output, "a link without a name is no frame of ROS; remedy: name the link");
        }
        const Value colour = colour_value(number++, alpha);
        CancellationCounter asking(1024);
        for (std::size_t i = 0; i < link.spheres.size(); ++i) {
            asking.check();
            markers.items.push_back(marker_value(link.link, static_cast<std::int64_t>(i), link.spheres[i], colour));
        }
    }
    return (model.provenance.empty() ? "" : "# " + shown(model.provenance) + "\n") +
           yaml::block_text(yaml::map({{"markers", std::move(markers)}}));
}

bool is_markers(std::string_view text) {
    text.remove_prefix(text.starts_with("---\n") ? 4 : 0);
    if (text.starts_with('{')) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n", 1), text.size()));
        text.remove_prefix(text.starts_with('"') ? 1 : 0);
    }
    return (text.starts_with("markers:") || text.starts_with("markers\"")) && text.find("frame_id") != text.npos;
}

SphereFile read_markers(const std::string& text, const std::filesystem::path& file) {
    const Value root = parse(text, file);
    Message message(file);
    for (const Value& marker : message.list(message.at(root, "markers")).items) {
        message.add(marker);
    }
    message.finish();
    return std::move(message.result);
}

} // namespace foam::scene
