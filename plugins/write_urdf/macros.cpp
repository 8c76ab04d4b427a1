// write.xacro: the collision elements of each link as a macro of xacro, for the user's own file to include.
#include "sphere_urdf.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam {
namespace {

constexpr std::string_view suffix = "_collision";

/// Returns the macro's name. Throws Error(output) for a link whose name cannot be an element's.
std::string macro_of(const std::string& link) {
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
               c == '.';
    };
    if (link.empty() || !std::all_of(link.begin(), link.end(), fits)) {
        throw Error(ErrorCode::output, fmt::format("write.xacro: link '{}' gives no name of a macro; remedy: a name of "
                                                   "letters, digits and _",
                                                   link));
    }
    return link + std::string(suffix);
}

} // namespace

XacroWriter::XacroWriter(const Parameters& parameters) : level_(static_cast<int>(parameters.integer("level"))) {}

std::string XacroWriter::write(const SphereModel& model, Context&) const {
    std::string text = "<?xml version=\"1.0\"?>\n<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n"
                       "  <!-- In each <link name=\"LINK\">: <xacro:LINK_collision/> -->\n";
    HullNames names(file_name_of(model));
    for (const LinkSpheres& link : in_known_kinds(elements_by_link(model, level_))) {
        text += fmt::format("  <xacro:macro name=\"{}\">\n", macro_of(link.link));
        const auto uri_of_hull = [&] { return attribute_text(names.next(link.link), text); };
        for (const std::string& element : collision_elements(link, {}, uri_of_hull)) {
            text += "    " + element + "\n";
        }
        text += "  </xacro:macro>\n";
    }
    return text + "</robot>\n";
}

std::map<std::string, Elements> XacroWriter::read(const std::string& bytes,
                                                  const std::map<std::string, std::string>& beside) const {
    const auto root = xml::parse(bytes, "xacro", ErrorCode::output);
    std::map<std::string, Elements> result;
    for (const xml::Element* macro : root->children_named("xacro:macro")) {
        const std::string* name = macro->attribute("name");
        const Elements elements = elements_of_collisions(*macro, beside);
        if (name && name->ends_with(suffix) && elements.size() > 0) {
            result[name->substr(0, name->size() - suffix.size())].add(elements);
        }
    }
    return result;
}

std::map<std::string, std::string> XacroWriter::files_beside(const SphereModel& model, Context&) const {
    return hull_files(in_known_kinds(elements_by_link(model, level_)), file_name_of(model));
}

StageInfo info_of_xacro() {
    return {.name = "write.xacro",
            .summary =
                "Writes the elements of each link as a macro of xacro, LINK_collision, to include into a robot's own "
                "xacro file.",
            .reference = "http://wiki.ros.org/xacro",
            .parameters = {Parameter::integer("level", -1)
                               .bounds(-1, 32)
                               .doc("Level of the sphere trees that is written: 0 the bounding spheres, -1 the finest.")
                               .source("The finest level is the one that is measured and proved.")},
            .extensions = {"xacro"},
            .kinds = every_kind(),
            .consumer = {.name = "xacro 2"}};
}

} // namespace foam
