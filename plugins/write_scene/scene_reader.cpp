// Reads as MoveIt's loadGeometryFromStream() and constructShapeFromText() do: words, whatever the lines, but for names.
#include "scene.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/elements.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

namespace foam::scene {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// Words and lines of a text, with their place.
class Words {
public:
    Words(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorCode::input, fmt::format("{}:{}: {}", file_, line_, shown(why)));
    }

    /// Returns the rest of the line, without blanks around it.
    std::string_view line() {
        const std::size_t end = rest_.find('\n');
        if (end == rest_.npos) {
            fail("the file ends too early");
        }
        const std::string_view result = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        ++line_;
        return trimmed(result);
    }

    std::string_view word(std::string_view expected) {
        const std::size_t begin = std::min(rest_.find_first_not_of(blanks), rest_.size());
        line_ += static_cast<int>(std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
        rest_.remove_prefix(begin);
        if (rest_.empty()) {
            fail(fmt::format("the file ends where {} is expected", expected));
        }
        const std::string_view result = rest_.substr(0, rest_.find_first_of(blanks));
        rest_.remove_prefix(result.size());
        return result;
    }

    double number(std::string_view expected) {
        const std::string_view text = word(expected);
        const std::optional<double> value = parse_number(text);
        if (!value) {
            fail(fmt::format("'{}' is not a finite number; expected is {}", text, expected));
        }
        return *value;
    }

    void skip_numbers(std::size_t count, std::string_view expected) {
        for (std::size_t i = 0; i < count; ++i) {
            number(expected);
        }
    }

    /// Returns a count. It is not trusted: whoever uses it reads a word for each, or fails.
    std::uint32_t count(std::string_view expected) {
        const std::string_view text = word(expected);
        std::uint32_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size()) {
            fail(fmt::format("'{}' is not a count; expected is {}", text, expected));
        }
        return value;
    }

    Vec3 point() {
        const double x = number("a position"), y = number("a position");
        return {x, y, number("a position")};
    }

    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
    std::string file_;
    int line_ = 1;
};

Pose read_pose(Words& words) {
    const Vec3 position = words.point();
    const double x = words.number("a quaternion"), y = words.number("a quaternion"), z = words.number("a quaternion"),
                 w = words.number("a quaternion");
    const bool none = x == 0 && y == 0 && z == 0 && w == 0;
    return none ? Pose{.translation = position} : from_quaternion(position, {w, x, y, z});
}

std::shared_ptr<const Polytope> read_mesh(Words& words) {
    const std::size_t vertices = words.count("the number of vertices");
    const std::size_t triangles = words.count("the number of triangles");
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < vertices; ++i) {
        corners.push_back(words.point());
    }
    Mesh mesh{std::move(corners), {}};
    for (std::size_t i = 0; i < triangles; ++i) {
        Triangle triangle{};
        for (std::uint32_t& corner : triangle) {
            corner = words.count("a corner");
            if (corner >= vertices) {
                words.fail(fmt::format("a triangle has corner {}, of {}", corner, vertices));
            }
        }
        mesh.triangles.push_back(triangle);
    }
    return hull_if_convex(mesh);
}

/// Reads the size of a shape. Returns nothing for one that is no convex element.
std::optional<Element> read_shape(std::string_view kind, Words& words) {
    if (kind == "sphere") {
        return Element{.kind = Element::Kind::sphere, .radius = words.number("a radius")};
    }
    if (kind == "box") {
        return Element{.kind = Element::Kind::box, .half = words.point() * 0.5};
    }
    if (kind == "cylinder") {
        const double radius = words.number("a size"), length = words.number("a size");
        return Element{.kind = Element::Kind::cylinder, .half = {0, 0, length / 2}, .radius = radius};
    }
    if (kind == "mesh") {
        Element element{.kind = Element::Kind::hull};
        element.hull = read_mesh(words);
        return element.hull ? std::optional(element) : std::nullopt;
    }
    const std::size_t sizes = kind == "plane" ? 4 : kind == "cone" ? 2 : 0;
    if (sizes == 0) {
        words.fail(fmt::format("unknown shape '{}'", kind));
    }
    words.skip_numbers(sizes, "a size");
    return {};
}

void read_object(Words& words, bool old_format, SphereFile& result) {
    const std::string name(words.line());
    if (!old_format) {
        read_pose(words); // elements are asked for in the frame of their link, not in the world
    }
    std::set<std::string> left_out;
    Elements elements;
    for (std::uint32_t left = words.count("the number of shapes"); left > 0; --left) {
        const std::string kind(words.word("a shape"));
        std::optional<Element> element = read_shape(kind, words);
        const Pose pose = read_pose(words);
        words.skip_numbers(4, "a colour");
        if (element) {
            element->pose = pose;
            elements.add(*element);
        } else {
            left_out.insert(kind);
        }
    }
    for (std::uint32_t left = old_format ? 0 : words.count("the number of subframes"); left > 0; --left) {
        words.word("a subframe");
        read_pose(words);
    }
    if (!left_out.empty()) {
        result.notes.push_back(fmt::format("object '{}' has shapes that are no convex elements ({}), which are not "
                                           "judged",
                                           shown(name), fmt::join(left_out, ", ")));
    }
    if (elements.size() > 0) {
        link_of(result, name).elements.add(elements);
    }
}

/// Returns the line after the first that begins with '*'; the text begins after the name of the scene.
std::string_view line_after_object(std::string_view text) {
    const std::size_t star = text.starts_with('*') ? 0 : text.find("\n*");
    const std::size_t begin = star == text.npos ? star : text.find('\n', star + 1);
    if (begin == text.npos) {
        return {};
    }
    return trimmed(text.substr(begin + 1, text.find('\n', begin + 1) - begin - 1));
}

} // namespace

bool is_scene(std::string_view text) {
    if (!text.starts_with("* ")) { // a blank name is not part of the text
        text.remove_prefix(std::min(text.find('\n'), text.size()));
        text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    }
    if (!text.starts_with("* ")) {
        return false;
    }
    const std::string_view numbers = line_after_object(text);
    const std::vector<std::string_view> fields = words(numbers.substr(0, 200));
    return (fields.size() == 1 || fields.size() == 3) &&
           std::all_of(fields.begin(), fields.end(),
                       [](std::string_view word) { return parse_number(word).has_value(); });
}

SphereFile read_scene(std::string_view text, const std::filesystem::path& file) {
    SphereFile result{.file = file, .format = "", .links = {}, .fixed_joints = {}, .notes = {}};
    Words words(text, file.string());
    words.line(); // the name of the scene
    // MoveIt decides so: the line holds a position in the new format, and a count in the old one.
    const bool old_format = line_after_object(words.rest()).find(' ') == std::string_view::npos;
    result.format = old_format ? "MoveIt scene (old)" : "MoveIt scene";
    for (;;) {
        const std::string_view marker = words.word("'*' before an object, or '.' at the end");
        if (marker == ".") {
            return result;
        }
        if (marker != "*") {
            words.fail(fmt::format("'{}' stands where '*' before an object, or '.' at the end, is expected", marker));
        }
        read_object(words, old_format, result);
    }
}

} // namespace foam::scene
