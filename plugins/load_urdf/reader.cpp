#include "reader.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

namespace foam::urdf {

bool is_xacro_expression(std::string_view text) {
    return text.find("${") != std::string_view::npos || text.find("$(") != std::string_view::npos;
}

std::string Reader::place(const xml::Element& element) const {
    return fmt::format("{}:{}", label_, element.line);
}

void Reader::fail(const xml::Element& element, const std::string& what) const {
    throw Error(ErrorCode::input, fmt::format("{}: {}", place(element), shown(what)));
}

const std::string& Reader::required(const xml::Element& element, std::string_view attribute) const {
    const std::string* text = element.attribute(attribute);
    if (!text || text->empty()) {
        fail(element, fmt::format("<{}> has no {}", element.name, attribute));
    }
    if (is_xacro_expression(*text)) {
        fail(element, fmt::format("<{} {}=\"{}\"> is a xacro expression; run xacro first: xacro IN.xacro > OUT.urdf",
                                  element.name, attribute, *text));
    }
    return *text;
}

double Reader::parse(const xml::Element& element, std::string_view attribute, std::string_view text) const {
    if (const std::optional<double> value = parse_number(text)) {
        return *value;
    }
    fail(element, fmt::format("<{} {}>: '{}' is not a finite number", element.name, attribute, text));
}

std::optional<double> Reader::number(const xml::Element& element, std::string_view attribute) const {
    if (!element.attribute(attribute)) {
        return {};
    }
    const std::string& text = required(element, attribute);
    const std::vector<std::string_view> pieces = words(text);
    return parse(element, attribute, pieces.size() == 1 ? pieces.front() : text);
}

double Reader::required_number(const xml::Element& element, std::string_view attribute) const {
    required(element, attribute);
    return *number(element, attribute);
}

std::optional<Vec3> Reader::vector(const xml::Element& element, std::string_view attribute) const {
    if (!element.attribute(attribute)) {
        return {};
    }
    const std::string& text = required(element, attribute);
    const std::vector<std::string_view> pieces = words(text);
    if (pieces.size() != 3) {
        fail(element,
             fmt::format("<{} {}=\"{}\"> expects three numbers, got {}", element.name, attribute, text, pieces.size()));
    }
    return Vec3{parse(element, attribute, pieces[0]), parse(element, attribute, pieces[1]),
                parse(element, attribute, pieces[2])};
}

const xml::Element* Reader::only_child(const xml::Element& element, std::string_view name) const {
    const std::vector<const xml::Element*> found = element.children_named(name);
    if (found.size() > 1) {
        fail(*found[1], fmt::format("a second <{0}> in <{1}>; the first is in line {2}; keep one", name, element.name,
                                    found[0]->line));
    }
    return found.empty() ? nullptr : found.front();
}

Pose Reader::origin(const xml::Element& element) const {
    const xml::Element* origin = only_child(element, "origin");
    if (!origin) {
        return {};
    }
    if (origin->attribute("quat_xyzw")) {
        fail(*origin, "<origin quat_xyzw> is not understood; give the rotation as rpy");
    }
    return Pose::from_xyz_rpy(vector(*origin, "xyz").value_or(Vec3{}), vector(*origin, "rpy").value_or(Vec3{}));
}

} // namespace foam::urdf
