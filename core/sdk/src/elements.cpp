#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/engines.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline sdk {
namespace {

using Kind = Element::Kind;

void require_number_count(std::string_view name, const std::vector<double>& numbers, std::size_t count) {
    if (numbers.size() != count) {
        throw Error(ErrorCode::input, fmt::format("{} has {} numbers, not {}", name, numbers.size(), count));
    }
}

Vec3 point_of(const std::vector<double>& numbers, std::size_t first = 0) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// Sets what one name states.
void take_numbers(Element& element, const std::string& name, const std::vector<double>& numbers) {
    if (name == "position" || name == "size" || name == "radii") {
        require_number_count(name, numbers, 3);
        (name == "position" ? element.pose.translation : element.half) = point_of(numbers) * (name == "size" ? 0.5 : 1.0);
    } else if (name == "rotation") {
        require_number_count(name, numbers, 9);
        element.pose.rotation = {point_of(numbers), point_of(numbers, 3), point_of(numbers, 6)};
    } else if (name == "length" || name == "radius") {
        require_number_count(name, numbers, 1);
        (name == "length" ? element.half.z : element.radius) = numbers[0] * (name == "length" ? 0.5 : 1.0);
    } else {
        std::vector<Vec3> points;
        for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
            points.push_back(point_of(numbers, i));
        }
        require_number_count(name, numbers, 3 * points.size());
        try {
            element.hull = convex_hull(points);
        } catch (const Error& error) {
            throw Error(ErrorCode::input, fmt::format("vertices: {}", error.what()));
        }
    }
}

/// Letters, digits, '.', '_' and '-', which no program and no file system changes.
std::string file_word(const std::string& name) {
    std::string word;
    for (const char c : name) {
        const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                          c == '-' || (c == '.' && !word.empty());
        word += kept ? c : '_';
    }
    constexpr std::size_t longest = 100; // of 255 that file systems allow
    return word.empty() ? "link" : word.substr(0, longest);
}

} // namespace

std::map<std::string, Elements> elements_of(SphereFile file) {
    std::map<std::string, Elements> result;
    for (LinkSpheres& link : file.links) {
        result[link.link] = std::move(link.elements);
    }
    return result;
}

/// Returns whether it is a capsule that hardly differs from a sphere. MuJoCo 4 misses boxes that touch capsules whose
/// half length is 1e-6 m or less.
static bool is_nearly_round(const Element& element) {
    constexpr double short_length = 2e-6; // m
    return element.kind == Kind::capsule &&
           element.half.z <= std::max(1e-4 * element.radius, std::min(short_length, 1e-2 * element.radius));
}

/// Returns the box around a swept box of almost no radius, or a hull around the round edges of another.
static Element box_or_hull(const Element& swept, int segments) {
    constexpr double almost_none = 1e-2; // of the least half edge
    const double least = std::min({swept.half.x, swept.half.y, swept.half.z}) + swept.radius;
    if (swept.radius > almost_none * least) {
        return enclosing_hull(swept, segments);
    }
    Element box = swept;
    box.kind = Kind::box;
    box.half = box.half + Vec3{box.radius, box.radius, box.radius};
    box.radius = 0;
    return box;
}

/// Returns an element of a kind that the format knows, or a capsule, which contains the given one.
static Element in_known_kind(const Element& element, const KnownKinds& known) {
    if (is_nearly_round(element)) {
        return {.pose = {.translation = element.pose.translation}, .radius = element.radius + element.half.z};
    }
    if (element.kind == Kind::swept_box) {
        return box_or_hull(element, known.segments);
    }
    return element.kind == Kind::ellipsoid && !known.ellipsoids ? enclosing_hull(element, known.segments) : element;
}

static Elements with_float32_hulls(Elements elements) {
    for (Element& element : elements.shaped()) {
        element = element.kind == Kind::hull ? float32_hull(element) : element;
    }
    return elements;
}

std::vector<LinkSpheres> in_known_kinds(std::vector<LinkSpheres> links, const KnownKinds& known) {
    for (LinkSpheres& link : links) {
        Elements stated(std::move(link.elements.spheres()));
        for (const Element& given : link.elements.shaped()) {
            const Element element = in_known_kind(given, known);
            if (element.kind == Kind::capsule && !known.capsules) {
                for (const Element& part : capsule_parts(element)) {
                    stated.add(part);
                }
            } else {
                stated.add(element);
            }
        }
        link.elements = std::move(stated);
    }
    links = stated_for(known.engine, std::move(links));
    for (LinkSpheres& link : links) {
        if (known.float32_hulls) {
            link.elements = with_float32_hulls(std::move(link.elements));
        }
    }
    return links;
}

std::size_t least_count(const Elements& elements) {
    const auto cylinders = std::count_if(elements.shaped().begin(), elements.shaped().end(),
                                         [](const Element& element) { return element.kind == Kind::cylinder; });
    return elements.size() - 2 * std::min(static_cast<std::size_t>(cylinders), elements.spheres().size() / 2);
}

std::string with_provenance(std::string text, const SphereModel& model) {
    struct Comment {
        std::string_view begin, end;
    };
    for (const auto& [begin, end] : {Comment{"# ", "\n"}, Comment{"<!-- ", " -->"}, Comment{"% ", "\n"}}) {
        const std::string mark = std::string(begin) + "foam ";
        for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + 1)) {
            const std::size_t from = at + begin.size(), to = text.find(end, from);
            const std::string_view line = std::string_view(text).substr(from, to - from);
            const bool own = to != text.npos && (at == 0 || text[at - 1] == '\n') && line.find("prove") != line.npos &&
                             line.find('\n') == line.npos;
            if (own) {
                std::string now = shown(model.provenance);
                for (std::size_t dash = 0; end == " -->" && (dash = now.find("--", dash)) != now.npos;) {
                    now.replace(dash, 2, "- -"); // "--" ends a comment
                }
                text.replace(from, to - from, now);
            }
        }
    }
    return text;
}

Parameter segments_parameter() {
    return Parameter::integer("segments", 8)
        .bounds(4, 64)
        .unit("1")
        .doc("Around a circle of the hull that stands for a round element that this format does not know: a multiple of "
             "4. The hull encloses the element.")
        .source("48 vertices; engines want at most 64.");
}

int segments_of(const Parameters& parameters, std::string_view writer) {
    const std::int64_t segments = parameters.integer("segments");
    if (segments % 4 != 0) {
        throw Error(ErrorCode::usage, fmt::format("{}: segments: {} is no multiple of 4; remedy: {}", writer, segments,
                                                  segments / 4 * 4 + 4));
    }
    return static_cast<int>(segments);
}

ElementNumbers numbers_of(const Element& element) {
    ElementNumbers numbers{
        {"position", {element.pose.translation.x, element.pose.translation.y, element.pose.translation.z}}};
    if (element.pose.rotation != Pose{}.rotation) {
        std::vector<double> rotation;
        for (const Vec3& row : element.pose.rotation) {
            rotation.insert(rotation.end(), {row.x, row.y, row.z});
        }
        numbers.emplace_back("rotation", std::move(rotation));
    }
    for (const std::string_view name : number_names(element.kind)) {
        std::vector<double> values;
        if (name == "length") {
            values = {2 * element.half.z};
        } else if (name == "radius") {
            values = {element.radius};
        } else if (name == "size") {
            values = {2 * element.half.x, 2 * element.half.y, 2 * element.half.z};
        } else if (name == "radii") {
            values = {element.half.x, element.half.y, element.half.z};
        } else {
            for (const Vec3& p : element.hull->surface.vertices) {
                values.insert(values.end(), {p.x, p.y, p.z});
            }
        }
        numbers.emplace_back(name, std::move(values));
    }
    return numbers;
}

Element element_of(std::string_view kind, const ElementNumbers& numbers) {
    const std::optional<Kind> known = element_kind_named(kind);
    if (!known) {
        throw Error(ErrorCode::input,
                    fmt::format("'{}' is no kind of element; there are {}", shown(kind), fmt::join(kind_words(), ", ")));
    }
    Element element{.kind = *known};
    const auto own = number_names(*known);
    std::vector<std::string_view> wanted(own.begin(), own.end());
    wanted.insert(wanted.begin(), "position");
    for (const auto& [name, values] : numbers) {
        if (std::erase(wanted, name) == 0 && name != "rotation") {
            throw Error(ErrorCode::input,
                        fmt::format("{} has no '{}', or has it twice", with_article(kind), shown(name)));
        }
        take_numbers(element, name, values);
    }
    if (!wanted.empty()) {
        throw Error(ErrorCode::input, fmt::format("{} needs '{}'", with_article(kind), wanted.front()));
    }
    if (!is_valid(element)) {
        throw Error(ErrorCode::input, fmt::format("these are the numbers of no {}: all must be finite, lengths not "
                                                  "negative, the volume above 0, and a rotation without scale",
                                                  kind));
    }
    return element;
}

HullNames::HullNames(const std::string& file)
    : folder_(file_word(std::filesystem::path(file).stem().string()) + "_hulls/") {}

std::string HullNames::next(const std::string& link) {
    const std::string word = file_word(link);
    std::string name;
    do { // "a_1" may be the first of link "a", or a link's own name
        name = fmt::format("{}_{}", word, ++uses_["link " + lower_case(word)]);
    } while (!uses_.emplace("file " + lower_case(name), 1).second);
    return folder_ + name + ".obj";
}

std::map<std::string, std::string> hull_files(const std::vector<LinkSpheres>& links, const std::string& file) {
    std::map<std::string, std::string> files;
    HullNames names(file);
    for (const LinkSpheres& link : links) {
        for (const Element& element : link.elements.shaped()) {
            if (element.kind == Kind::hull) {
                files[names.next(link.link)] = obj_text(element.hull->surface);
            }
        }
    }
    return files;
}

const std::string* text_beside(const std::map<std::string, std::string>& beside, std::string_view reference) {
    for (const auto& [name, text] : beside) {
        if (reference == name || reference.ends_with("/" + name)) {
            return &text;
        }
    }
    return nullptr;
}

} // namespace foam::inline sdk
