// Elements in and out.
#include "handles.hpp"
#include "reporting.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace foam::c {

foam_elements* handle_of(const std::vector<Element>& elements) {
    auto kept = std::make_unique<foam_elements>();
    kept->all = elements;
    for (const Element& element : elements) {
        std::vector<double>& corners = kept->vertices.emplace_back();
        if (element.hull) {
            for (const Vec3& p : element.hull->surface.vertices) {
                corners.insert(corners.end(), {p.x, p.y, p.z});
            }
        }
    }
    return kept.release();
}

/// Returns the word of a kind in a sentence: "swept box".
static std::string noun(Element::Kind kind) {
    std::string word = to_string(kind);
    std::ranges::replace(word, '_', ' ');
    return word;
}

static std::shared_ptr<const Polytope> hull_of(const foam_element& given, std::size_t index) {
    if (!given.vertices) {
        throw usage(
            fmt::format("element {} is a hull without vertices; remedy: set .vertices and .vertex_count", index));
    }
    std::vector<Vec3> corners(given.vertex_count);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = {given.vertices[3 * i], given.vertices[3 * i + 1], given.vertices[3 * i + 2]};
    }
    try {
        return convex_hull(corners);
    } catch (const Error& error) {
        throw Error(error.code(),
                    fmt::format("element {}: {}; remedy: finite points around a volume", index, error.what()));
    }
}

/// Returns the element that a caller describes.
static Element element_of(const foam_element& given, std::size_t index) {
    const auto bit = static_cast<unsigned>(given.kind);
    if (!std::has_single_bit(bit) || bit >> element_kinds != 0) {
        throw usage(fmt::format("element {} has the kind {}; remedy: one of FOAM_SPHERE, FOAM_CAPSULE, …", index,
                                given.kind));
    }
    Element element{.kind = static_cast<Element::Kind>(std::countr_zero(bit)), .radius = given.radius};
    for (int axis = 0; axis < 3; ++axis) {
        element.pose.translation[axis] = given.position[axis];
        element.half[axis] = given.half[axis];
        for (int column = 0; column < 3; ++column) {
            element.pose.rotation[static_cast<std::size_t>(axis)][column] = given.rotation[3 * axis + column];
        }
    }
    if (std::ranges::all_of(given.rotation, [](double number) { return number == 0; })) {
        element.pose.rotation = Pose{}.rotation;
    }
    if (element.kind == Element::Kind::hull) {
        element.hull = hull_of(given, index);
    }
    if (!is_valid(element)) {
        constexpr const char* text =
            "element {} is not {}; remedy: finite numbers, lengths above 0, and an orthonormal rotation";
        throw Error(ErrorCode::geometry, fmt::format(text, index, with_article(noun(element.kind))));
    }
    return element;
}

/// Returns elements of the kinds alone that together contain the element.
static std::vector<Element> in_kinds(const Element& element, const std::vector<Element::Kind>& kinds, int segments,
                                     std::size_t index) {
    const auto may_be = [&](Element::Kind kind) { return std::ranges::find(kinds, kind) != kinds.end(); };
    if (may_be(element.kind)) {
        return {element};
    }
    if (element.kind == Element::Kind::capsule && may_be(Element::Kind::cylinder) && may_be(Element::Kind::sphere)) {
        return capsule_parts(element);
    }
    if (may_be(Element::Kind::hull)) {
        return {enclosing_hull(element, segments)};
    }
    throw usage(fmt::format("element {} is {}, which no element of the kinds replaces; remedy: add FOAM_HULL, or for "
                            "capsules FOAM_CYLINDER | FOAM_SPHERE",
                            index, with_article(noun(element.kind))));
}

static void require_segments(int segments) {
    if (segments < 4 || segments > 1024 || segments % 4 != 0) {
        throw usage(fmt::format("segments is {}; remedy: a multiple of 4, from 4 to 1024", segments));
    }
}

} // namespace foam::c

using namespace foam::c;

extern "C" {

int foam_elements_make(const foam_element* array, size_t count, foam_elements** elements, foam_report* report) {
    return reported(report, [&] {
        require_place(elements, "elements");
        require_given(count == 0 ? elements : static_cast<const void*>(array), "array", "an array of foam_element");
        std::vector<foam::Element> made;
        made.reserve(count);
        for (size_t i = 0; i < count; ++i) {
            made.push_back(element_of(array[i], i));
        }
        *elements = handle_of(made);
        report->spheres = count;
    });
}

int foam_elements_in_kinds(const foam_elements* elements, unsigned kinds, int segments, foam_elements** converted,
                           foam_report* report) {
    return reported(report, [&] {
        require_place(converted, "converted");
        require_given(elements, "elements", "those of foam_cover() or foam_elements_make()");
        require_segments(segments);
        const std::vector<foam::Element::Kind> allowed = kinds_in(kinds);
        std::vector<foam::Element> made;
        for (size_t i = 0; i < elements->all.size(); ++i) {
            std::ranges::copy(in_kinds(elements->all[i], allowed, segments, i), std::back_inserter(made));
        }
        *converted = handle_of(made);
        report->spheres = made.size();
    });
}

size_t foam_elements_count(const foam_elements* elements) {
    return elements ? elements->all.size() : 0;
}

int foam_elements_get(const foam_elements* elements, size_t index, foam_element* element) {
    if (!element || index >= foam_elements_count(elements)) {
        return FOAM_USAGE;
    }
    const foam::Element& e = elements->all[index];
    const std::vector<double>& vertices = elements->vertices[index];
    *element = {};
    element->kind = 1 << static_cast<int>(e.kind);
    element->radius = e.radius;
    element->vertex_count = vertices.size() / 3;
    element->vertices = vertices.empty() ? nullptr : vertices.data();
    for (int axis = 0; axis < 3; ++axis) {
        element->position[axis] = e.pose.translation[axis];
        element->half[axis] = e.half[axis];
        for (int column = 0; column < 3; ++column) {
            element->rotation[3 * axis + column] = e.pose.rotation[static_cast<std::size_t>(axis)][column];
        }
    }
    return FOAM_OK;
}

int foam_elements_mesh(const foam_elements* elements, size_t index, int segments, foam_mesh** mesh,
                       foam_report* report) {
    return reported(report, [&] {
        require_place(mesh, "mesh");
        require_segments(segments);
        if (index >= foam_elements_count(elements)) {
            throw usage(fmt::format("index is {}, and there are {} elements; remedy: an index from 0", index,
                                    foam_elements_count(elements)));
        }
        *mesh = new foam_mesh{foam::enclosing_mesh(elements->all[index], segments)};
    });
}

void foam_elements_free(foam_elements* elements) {
    delete elements;
}

size_t foam_mesh_vertex_count(const foam_mesh* mesh) {
    return mesh ? mesh->mesh.vertices.size() : 0;
}

size_t foam_mesh_triangle_count(const foam_mesh* mesh) {
    return mesh ? mesh->mesh.triangles.size() : 0;
}

const double* foam_mesh_vertices(const foam_mesh* mesh) {
    static_assert(sizeof(foam::Vec3) == 3 * sizeof(double));
    return mesh && !mesh->mesh.vertices.empty() ? &mesh->mesh.vertices.front().x : nullptr;
}

const uint32_t* foam_mesh_triangles(const foam_mesh* mesh) {
    return mesh && !mesh->mesh.triangles.empty() ? mesh->mesh.triangles.front().data() : nullptr;
}

void foam_mesh_free(foam_mesh* mesh) {
    delete mesh;
}
}
