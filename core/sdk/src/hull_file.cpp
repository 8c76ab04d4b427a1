// Mesh files of hulls: what is written is read as other programs read it, down to the corners.
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/elements.hpp>

#include <fmt/format.h>

#include <cstring>

namespace foam::inline sdk {
namespace {

constexpr std::size_t stl_header = 84, stl_triangle = 50;

[[noreturn]] void fail_in_line(std::size_t line, const std::string& why) {
    throw Error(ErrorCode::input, fmt::format("line {}: {}", line, why));
}

/// Returns the number of triangles that a binary STL states.
std::uint32_t stl_count(std::string_view bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + stl_header - sizeof count, sizeof count); // little-endian, as we are
    return count;
}

bool is_binary_stl(std::string_view bytes) {
    return bytes.size() >= stl_header && bytes.size() == stl_header + stl_triangle * std::size_t{stl_count(bytes)};
}

std::vector<Vec3> corners_of_stl(std::string_view bytes) {
    std::vector<Vec3> corners;
    for (std::size_t at = stl_header; at < bytes.size(); at += stl_triangle) {
        for (std::size_t corner = 1; corner < 4; ++corner) { // the first is the normal
            float p[3];
            std::memcpy(p, bytes.data() + at + 12 * corner, sizeof p);
            corners.push_back({p[0], p[1], p[2]});
        }
    }
    return corners;
}

} // namespace

std::string obj_text(const Mesh& mesh) {
    std::string text;
    for (const Vec3& p : mesh.vertices) {
        text += "v " + number_text(p.x) + ' ' + number_text(p.y) + ' ' + number_text(p.z) + '\n';
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
    return text;
}

std::vector<Vec3> corners_of(std::string_view bytes) {
    if (is_binary_stl(bytes)) {
        return corners_of_stl(bytes);
    }
    std::vector<Vec3> corners;
    for (std::size_t line = 1; !bytes.empty(); ++line) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        const std::vector<std::string_view> fields = words(bytes.substr(0, end));
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        if (fields.empty() || (fields[0] != "v" && fields[0] != "vertex")) { // of OBJ, of ASCII STL
            continue;
        }
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            const auto field = static_cast<std::size_t>(axis) + 1;
            const std::optional<double> value = field < fields.size() ? parse_number(fields[field]) : std::nullopt;
            if (!value) {
                fail_in_line(line, "a corner needs three finite numbers");
            }
            p[axis] = *value;
        }
        corners.push_back(p);
    }
    if (corners.empty()) {
        throw Error(ErrorCode::input, "there is no corner of an OBJ or STL mesh");
    }
    return corners;
}

Element hull_of(std::string_view bytes) {
    try {
        Element element{.kind = Element::Kind::hull};
        element.hull = convex_hull(corners_of(bytes));
        return element;
    } catch (const Error& error) {
        throw Error(ErrorCode::input, error.what());
    }
}

} // namespace foam::inline sdk
