// COLLADA 1.4.1 and 1.5, chapter 5 "Geometry".
#include "collada.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace foam::load_mesh {
namespace {

using xml::Element;

std::string name_of(const Element& element) {
    const std::string* name = element.attribute("id");
    name = name ? name : element.attribute("name");
    return name ? printable(*name) : "without a name";
}

/// Returns an attribute as a natural number.
std::uint64_t natural(const ColladaDocument& document, const Element& element, const char* key,
                      std::uint64_t otherwise) {
    const std::string* text = element.attribute(key);
    if (!text) {
        return otherwise;
    }
    const auto value = to_integer(*text);
    if (!value || *value < 0 || static_cast<std::uint64_t>(*value) > document.source().bytes.size()) {
        throw document.error(element,
                             fmt::format("{}={} cannot be true of a file of {} bytes; remedy: export the mesh again",
                                         key, printable(*text), document.source().bytes.size()));
    }
    return static_cast<std::uint64_t>(*value);
}

/// The layout of the points of a <source> in the numbers of its array.
struct Layout {
    std::uint64_t offset = 0, stride = 3;
    std::array<std::uint64_t, 3> axes{0, 1, 2}; ///< positions of x, y and z within a stride
    std::optional<std::uint64_t> count;         ///< number of points
};

Layout layout_of(const ColladaDocument& document, const Element* accessor) {
    Layout layout;
    if (!accessor) {
        return layout;
    }
    layout.offset = natural(document, *accessor, "offset", 0);
    const auto parameters = accessor->children_named("param");
    layout.stride = natural(document, *accessor, "stride", std::max<std::size_t>(parameters.size(), 3));
    if (accessor->attribute("count")) {
        layout.count = natural(document, *accessor, "count", 0);
    }
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const std::string* name = parameters[i]->attribute("name");
        if (name && name->size() == 1 && (*name)[0] >= 'X' && (*name)[0] <= 'Z') {
            layout.axes[static_cast<std::size_t>((*name)[0] - 'X')] = i;
        }
    }
    for (const std::uint64_t axis : layout.axes) {
        if (axis >= layout.stride) {
            throw document.error(*accessor, fmt::format("the accessor's stride of {} holds no X, Y and Z; remedy: "
                                                        "export the mesh again",
                                                        layout.stride));
        }
    }
    return layout;
}

class GeometryReader {
public:
    GeometryReader(const ColladaDocument& document, const Element& geometry, Context& context)
        : document_(document), geometry_(geometry), context_(context) {}

    ColladaGeometry read() {
        for (const auto& child : geometry_.children) {
            if (child->name == "mesh" || child->name == "convex_mesh") {
                mesh_ = child.get();
                mesh();
            } else if (child->name == "spline" || child->name == "brep") {
                warn(*child, fmt::format("a <{}> is left out; remedy: export triangles", child->name));
            }
        }
        part_.error = [this_file = &document_.source(), places = std::move(places_), points = part_.points.size(),
                       name = name_of(geometry_)](std::size_t i, const std::string& what) {
            const Place* place = nullptr;
            for (const Place& candidate : places) {
                place = candidate.first_point <= i ? &candidate : place;
            }
            return place->error(*this_file, i, name, what);
        };
        return {std::move(part_), std::move(materials_)};
    }

private:
    /// The place in the file of the points from `first_point` on.
    struct Place {
        std::size_t first_point;
        const Element* array;
        Layout layout;

        Error error(const Source& source, std::size_t point, const std::string& name, const std::string& what) const {
            ElementWords words(source, *array);
            const std::size_t vertex = point - first_point;
            for (std::uint64_t i = 0; i < layout.offset + vertex * layout.stride + layout.axes[0] + 1; ++i) {
                words.next();
            }
            return source.error_at(words.line(),
                                   fmt::format("vertex {} (counted from 0) of geometry {} {}", vertex, name, what));
        }
    };

    /// Corners with a common <p> of a primitive: the position of the point in each group of indices.
    struct Input {
        std::uint64_t stride = 1, offset = 0;
        std::uint32_t first_point = 0;
        std::uint64_t points = 0;
    };

    void warn(const Element& element, const std::string& what) {
        context_.log(Severity::warning, document_.error(element, what).what());
    }

    void mesh() {
        if (const Element* whole = document_.target(*mesh_, "convex_hull_of")) {
            warn(*mesh_,
                 fmt::format("the convex hull of geometry {} is left out; remedy: export triangles", name_of(*whole)));
        }
        static const std::map<std::string_view, void (GeometryReader::*)(const Element&, const Input&)> kinds{
            {"triangles", &GeometryReader::triangles},
            {"polylist", &GeometryReader::polylist},
            {"polygons", &GeometryReader::polygons},
            {"tristrips", &GeometryReader::tristrips},
            {"trifans", &GeometryReader::trifans}};
        for (const auto& child : mesh_->children) {
            context_.check_cancelled();
            const auto kind = kinds.find(child->name);
            if (kind != kinds.end() && (child->child("p") || child->child("ph"))) {
                (this->*kind->second)(*child, input(*child));
                part_.materials.resize(part_.sizes.size(), material(*child));
            }
        }
    }

    /// Returns the number of a primitive's material.
    std::uint32_t material(const Element& primitive) {
        const std::string* name = primitive.attribute("material");
        const auto known = std::find(materials_.begin(), materials_.end(), name ? *name : "");
        if (known == materials_.end()) {
            materials_.push_back(name ? *name : "");
            return static_cast<std::uint32_t>(materials_.size() - 1);
        }
        return static_cast<std::uint32_t>(known - materials_.begin());
    }

    /// Returns the <input> of the positions, through <vertices> or directly.
    Input input(const Element& primitive) {
        Input result;
        const Element* source = nullptr;
        for (const Element* candidate : primitive.children_named("input")) {
            const std::uint64_t offset = natural(document_, *candidate, "offset", 0);
            result.stride = std::max(result.stride, offset + 1);
            const std::string* semantic = candidate->attribute("semantic");
            if (semantic && (*semantic == "VERTEX" || *semantic == "POSITION") && !source) {
                source = position_source(*candidate);
                result.offset = offset;
            }
        }
        if (!source) {
            throw document_.error(primitive, fmt::format("<{}> has no input of positions that is in the file; remedy: "
                                                         "export the mesh again",
                                                         primitive.name));
        }
        const auto [it, fresh] = sources_.try_emplace(source);
        if (fresh) {
            it->second = points(*source);
        }
        result.first_point = static_cast<std::uint32_t>(it->second.first);
        result.points = it->second.second;
        return result;
    }

    const Element* position_source(const Element& given) const {
        const Element* target = document_.target(given, "source");
        if (target && target->name == "vertices") {
            for (const Element* candidate : target->children_named("input")) {
                const std::string* semantic = candidate->attribute("semantic");
                if (semantic && *semantic == "POSITION") {
                    return document_.target(*candidate, "source");
                }
            }
            return nullptr;
        }
        return target && target->name == "source" ? target : nullptr;
    }

    /// Reads a <source>. Returns the index of its first point, and the number of its points.
    std::pair<std::size_t, std::size_t> points(const Element& source) {
        const Element* technique = source.child("technique_common");
        const Element* accessor = technique ? technique->child("accessor") : nullptr;
        const Element* array = accessor ? document_.target(*accessor, "source") : nullptr;
        array = array ? array : source.child("float_array");
        if (!array) {
            throw document_.error(
                source,
                fmt::format("source {} has no array of numbers; remedy: export the mesh again", name_of(source)));
        }
        const Layout layout = layout_of(document_, accessor);
        const std::vector<double> numbers = numbers_of(*array);
        const std::uint64_t available =
            numbers.size() <= layout.offset ? 0 : (numbers.size() - layout.offset) / layout.stride;
        if (layout.count.value_or(0) > available) {
            throw document_.error(
                *accessor, fmt::format("the accessor needs {} values, but {} has {}; remedy: export the mesh again",
                                       layout.offset + *layout.count * layout.stride, name_of(*array), numbers.size()));
        }
        const std::size_t first = part_.points.size(), count = layout.count.value_or(available);
        places_.push_back({first, array, layout});
        for (std::size_t i = 0; i < count; ++i) {
            const auto* group = numbers.data() + layout.offset + i * layout.stride;
            part_.points.push_back({group[layout.axes[0]], group[layout.axes[1]], group[layout.axes[2]]});
        }
        return {first, count};
    }

    std::vector<double> numbers_of(const Element& array) {
        std::vector<double> numbers;
        ElementWords words(document_.source(), array);
        while (const auto number = words.number()) {
            numbers.push_back(*number);
        }
        const std::string* promised = array.attribute("count");
        if (promised && to_integer(*promised) != static_cast<std::int64_t>(numbers.size())) {
            warn(array, fmt::format("{} promises {} numbers, but holds {}, which are taken", name_of(array),
                                    printable(*promised), numbers.size()));
        }
        return numbers;
    }

    /// The corners in a list of indices.
    class Corners {
    public:
        Corners(const ColladaDocument& document, const Element& list, const Input& input)
            : words_(document.source(), list), input_(input) {}

        /// Returns the next corner; empty at the end. Throws if the list ends within a corner's group of indices.
        std::optional<std::uint32_t> next() {
            std::optional<std::uint32_t> corner;
            for (std::uint64_t i = 0; i < input_.stride; ++i) {
                const auto value = words_.index();
                if (!value && i == 0) {
                    return std::nullopt;
                }
                if (!value) {
                    throw words_.error(fmt::format("ends within a corner, which has {} indices", input_.stride));
                }
                corner = i == input_.offset ? value : corner;
            }
            if (*corner >= input_.points) {
                throw words_.error(
                    fmt::format("refers to vertex {}, but there are {} (the first is 0)", *corner, input_.points));
            }
            return *corner + input_.first_point;
        }
        Error error(std::string_view what) const { return words_.error(what); }

    private:
        ElementWords words_;
        const Input& input_;
    };

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        part_.corners.insert(part_.corners.end(), {a, b, c});
        part_.sizes.push_back(3);
    }

    /// Adds the corners from `begin` on as a polygon, if there are enough.
    void end_polygon(std::size_t begin) {
        if (part_.corners.size() - begin < 3) {
            part_.corners.resize(begin);
        } else {
            part_.sizes.push_back(static_cast<std::uint32_t>(part_.corners.size() - begin));
        }
    }

    void triangles(const Element& primitive, const Input& input) {
        for (const Element* list : primitive.children_named("p")) {
            Corners corners(document_, *list, input);
            while (const auto a = corners.next()) {
                const auto b = corners.next(), c = b ? corners.next() : b;
                if (!c) {
                    throw corners.error("ends within a triangle");
                }
                add_triangle(*a, *b, *c);
            }
        }
    }

    void polylist(const Element& primitive, const Input& input) {
        const Element* sizes = primitive.child("vcount");
        if (!sizes) {
            throw document_.error(primitive, "<polylist> has no <vcount>; remedy: export the mesh again");
        }
        ElementWords counts(document_.source(), *sizes);
        Corners corners(document_, *primitive.child("p"), input);
        while (const auto size = counts.index()) {
            const std::size_t begin = part_.corners.size();
            for (std::uint32_t k = 0; k < *size; ++k) {
                const auto corner = corners.next();
                if (!corner) {
                    throw corners.error("ends within a polygon that <vcount> promises");
                }
                part_.corners.push_back(*corner);
            }
            end_polygon(begin);
        }
    }

    void loop(const Element& list, const Input& input) {
        const std::size_t begin = part_.corners.size();
        Corners corners(document_, list, input);
        while (const auto corner = corners.next()) {
            part_.corners.push_back(*corner);
        }
        end_polygon(begin);
    }

    void polygons(const Element& primitive, const Input& input) {
        for (const auto& child : primitive.children) {
            if (child->name == "p") {
                loop(*child, input);
            } else if (child->name == "ph" && child->child("p")) {
                loop(*child->child("p"), input);
                if (child->child("h")) {
                    warn(*child, "a polygon's holes are filled; remedy: export triangles");
                }
            }
        }
    }

    /// Adds triangle strips: every second triangle of a strip has the opposite orientation.
    void tristrips(const Element& primitive, const Input& input) {
        for (const Element* list : primitive.children_named("p")) {
            Corners corners(document_, *list, input);
            auto a = corners.next(), b = a ? corners.next() : a;
            bool odd = false;
            while (const auto c = b ? corners.next() : b) {
                odd ? add_triangle(*b, *a, *c) : add_triangle(*a, *b, *c);
                a = b;
                b = c;
                odd = !odd;
            }
        }
    }

    void trifans(const Element& primitive, const Input& input) {
        for (const Element* list : primitive.children_named("p")) {
            Corners corners(document_, *list, input);
            const auto centre = corners.next();
            auto b = centre ? corners.next() : centre;
            while (const auto c = b ? corners.next() : b) {
                add_triangle(*centre, *b, *c);
                b = c;
            }
        }
    }

    const ColladaDocument& document_;
    const Element& geometry_;
    Context& context_;
    const Element* mesh_ = nullptr;
    Part part_;
    std::vector<std::string> materials_;
    std::vector<Place> places_;
    std::map<const Element*, std::pair<std::size_t, std::size_t>> sources_; ///< first point and number of points
};

} // namespace

ColladaGeometry read_geometry(const ColladaDocument& document, const Element& geometry, Context& context) {
    return GeometryReader(document, geometry, context).read();
}

} // namespace foam::load_mesh
