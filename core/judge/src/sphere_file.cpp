// The choice of the reader, and the checks common to all formats.
#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/sdk/kinds.hpp>

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

/// Removes disabled spheres, whose radius is not above 0, with a note.
void drop_disabled(SphereFile& result) {
    std::size_t dropped = 0;
    for (LinkSpheres& link : result.links) {
        dropped += std::erase_if(link.elements.spheres(), [](const Sphere& s) { return !(s.radius > 0); });
    }
    if (dropped > 0) {
        result.notes.push_back(fmt::format("{} sphere{} of a radius not above 0 {} switched off and left out", dropped,
                                           dropped == 1 ? "" : "s", dropped == 1 ? "is" : "are"));
    }
}

/// Returns the largest coordinate of the element.
double far_of(const Element& element) {
    const Box box = bounds(element);
    return std::max({-box.low.x, -box.low.y, -box.low.z, box.high.x, box.high.y, box.high.z});
}

/// Throws Error(input) for numbers whose squares and cubes exceed a double: figures would be infinite.
void require_workable(const SphereFile& result) {
    for (const LinkSpheres& link : result.links) {
        for (const Sphere& s : link.elements.spheres()) {
            const double largest = std::max({std::abs(s.center.x), std::abs(s.center.y), std::abs(s.center.z), s.radius});
            if (!(largest <= farthest_sphere)) {
                throw Error(ErrorCode::input,
                            fmt::format("{}: the sphere [{}, {}, {}, {}] of link '{}' is farther away or larger than "
                                        "{} m, where figures and proofs have no meaning; remedy: correct the file",
                                        result.file.string(), s.center.x, s.center.y, s.center.z, s.radius,
                                        shown(link.link), farthest_sphere));
            }
        }
        for (const Element& element : link.elements.shaped()) {
            if (!is_valid(element) || !(far_of(element) <= farthest_sphere)) {
                throw Error(ErrorCode::input,
                            fmt::format("{}: {} of link '{}' has no volume, numbers that are not finite, a rotation "
                                        "that is none, or is farther away or larger than {} m, where figures and "
                                        "proofs have no meaning; remedy: correct the file",
                                        result.file.string(), with_article(noun_of(element.kind, 1)), shown(link.link),
                                        farthest_sphere));
            }
        }
    }
}

/// Returns the model readers of the registry, by name.
std::vector<std::string> readers_of(const Registry& registry) {
    std::vector<std::string> names;
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind == StageKind::model_reader) {
            names.push_back(name);
        }
    }
    return names;
}

/// Returns the only reader that recognises the text.
std::unique_ptr<ModelReader> reader_for(std::string_view begin, const std::string& file, const Registry& registry) {
    const std::vector<std::string> readers = readers_of(registry);
    std::vector<std::string> fitting;
    std::unique_ptr<ModelReader> result;
    for (const std::string& name : readers) {
        if (auto reader = registry.make<ModelReader>(name); reader->recognises(begin)) {
            fitting.push_back(name);
            result = std::move(reader);
        }
    }
    if (readers.empty()) {
        throw Error(ErrorCode::plugin, "no plugin reads sphere models; `foam plugins --why` shows which plugins were "
                                       "loaded, and why others were not");
    }
    if (fitting.empty()) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: no reader recognises this file as a sphere model; remedy: `foam formats` lists "
                                "what is read, and --reader NAME shows the error of one reader",
                                file));
    }
    if (fitting.size() > 1) {
        throw Error(ErrorCode::input, fmt::format("{}: several readers recognise this file: {}; remedy: choose one by "
                                                  "--reader",
                                                  file, fmt::join(fitting, ", ")));
    }
    return result;
}

} // namespace

SphereFile read_sphere_file(const std::filesystem::path& file, const Registry& registry, const std::string& reader,
                            Radii radii, const std::filesystem::path& name) {
    return parse_sphere_file(read_file(file, most_model_bytes), name.empty() ? file : name, registry, reader, radii);
}

SphereFile parse_sphere_file(const std::string& text, const std::filesystem::path& file, const Registry& registry,
                             const std::string& reader, Radii radii) {
    const std::string_view begin = first_token(text);
    if (begin.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: the file is empty; a sphere model is needed", file.string()));
    }
    const std::unique_ptr<ModelReader> stage =
        reader.empty() ? reader_for(begin, file.string(), registry) : registry.make<ModelReader>(reader);
    QuietContext context;
    SphereFile result = stage->read(text, file, context);
    result.file = file;
    if (radii == Radii::as_used) {
        add_buffers(result);
    }
    drop_disabled(result);
    require_workable(result);
    return result;
}

} // namespace foam::judge
