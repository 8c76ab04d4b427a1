// The recognition of formats, and the checks common to all.
#include "formats.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline judge {
namespace {

/// m; geometry has a size of at most 10^9 m, and a distance of at most 10^9 times that.
constexpr double farthest_sphere = 1e20;

/// Returns the text after a byte order mark, blanks and comments with `#`.
std::string_view first_token(std::string_view text) {
    text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        if (!text.starts_with('#')) {
            return text;
        }
        text.remove_prefix(std::min(text.find('\n'), text.size()));
    }
}

/// Returns whether a line has only numbers, separated by spaces or commas; the first may be a name.
bool is_row(std::string_view text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    return !line.empty() && line.find_first_of(":{[<\"") == std::string_view::npos &&
           std::count_if(line.begin(), line.end(), [](char c) { return c >= '0' && c <= '9'; }) >= 4;
}

/// Removes disabled spheres, whose radius is not above 0, with a note.
void drop_disabled(SphereFile& result) {
    std::size_t dropped = 0;
    for (LinkSpheres& link : result.links) {
        dropped += std::erase_if(link.spheres, [](const Sphere& s) { return !(s.radius > 0); });
    }
    if (dropped > 0) {
        result.notes.push_back(fmt::format("{} sphere{} of a radius not above 0 {} switched off and left out", dropped,
                                           dropped == 1 ? "" : "s", dropped == 1 ? "is" : "are"));
    }
}

/// Throws Error(input) for numbers whose squares and cubes exceed a double: figures would be infinite.
void require_workable(const SphereFile& result) {
    for (const LinkSpheres& link : result.links) {
        for (const Sphere& s : link.spheres) {
            const double largest = std::max({std::abs(s.center.x), std::abs(s.center.y), std::abs(s.center.z), s.radius});
            if (!(largest <= farthest_sphere)) {
                throw Error(ErrorCode::input,
                            fmt::format("{}: the sphere [{}, {}, {}, {}] of link '{}' is farther away or larger than "
                                        "{} m, where figures and proofs have no meaning; remedy: correct the file",
                                        result.file.string(), s.center.x, s.center.y, s.center.z, s.radius,
                                        shown(link.link), farthest_sphere));
            }
        }
    }
}

} // namespace

std::vector<Sphere>& model_formats::spheres_of(SphereFile& result, const std::string& link) {
    auto it =
        std::find_if(result.links.begin(), result.links.end(), [&](const LinkSpheres& l) { return l.link == link; });
    if (it == result.links.end()) {
        it = result.links.insert(it, {link, {}});
    }
    return it->spheres;
}

SphereFile read_sphere_file(const std::filesystem::path& file, const Registry& registry) {
    return parse_sphere_file(read_file(file, most_model_bytes), file, registry);
}

SphereFile parse_sphere_file(const std::string& text, const std::filesystem::path& file, const Registry& registry) {
    SphereFile result;
    result.file = file;
    const std::string_view begin = first_token(text);
    if (begin.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: the file is empty; a sphere model is needed", file.string()));
    }
    if (begin.starts_with('<')) {
        model_formats::read_urdf(text, registry, result);
    } else if (begin.starts_with("ply")) {
        model_formats::read_written(text, "ply", registry, result);
    } else if (begin.starts_with("link,")) {
        model_formats::read_written(text, "csv", registry, result);
    } else if (is_row(begin)) {
        model_formats::read_rows(text, result);
    } else {
        model_formats::read_tree(text, result);
    }
    drop_disabled(result);
    require_workable(result);
    return result;
}

} // namespace foam::judge
