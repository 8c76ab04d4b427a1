#include "object.hpp"

#include "collisions.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

namespace foam::sdf {

void require_name(const std::string& name, std::string_view what) {
    const bool reserved = name == "world" || (name.size() >= 4 && name.starts_with("__") && name.ends_with("__"));
    if (name.empty() || reserved || name.find("::") != name.npos || shown(name) != name) {
        throw Error(ErrorCode::output,
                    fmt::format("{} '{}': SDF holds no name that is empty, 'world' or '__…__', or has '::' or control "
                                "characters; remedy: another name",
                                what, shown(name)));
    }
}

std::string provenance_comment(std::string_view provenance) {
    std::string text = shown(provenance);
    for (std::size_t at = 0; (at = text.find("--", at)) != text.npos;) {
        text.replace(at, 2, "- -"); // "--" may not stand in a comment
    }
    return text.empty() ? "" : "<!-- " + text + " -->\n";
}

std::string file_name_of(const SphereModel& model) {
    return model.file.empty() ? model.name + ".sdf" : model.file;
}

std::string object_text(const SphereModel& model, bool is_static, const KnownKinds& known) {
    const std::vector<LinkSpheres> links = in_known_kinds(elements_by_link(model), known);
    if (links.size() != 1) {
        throw Error(ErrorCode::output, fmt::format("write.sdf: the model has {} links, and no robot says how they are "
                                                   "joined; remedy: name the robot",
                                                   links.size()));
    }
    const LinkSpheres& link = links.front();
    const std::string name = model.robot && !model.robot->name.empty() ? model.robot->name : model.name;
    require_name(name, "model");
    require_name(link.link, "link");
    std::string text = "<?xml version=\"1.0\"?>\n" + provenance_comment(model.provenance) +
                       fmt::format("<sdf version=\"1.9\">\n  <model name=\"{}\">\n    <static>{}</static>\n"
                                   "    <link name=\"{}\">\n",
                                   markup_escaped(name), is_static, markup_escaped(link.link));
    HullNames hulls(file_name_of(model));
    for (const CollisionText& collision : collisions_of(link, hulls)) {
        text += fmt::format("      <collision name=\"{}\">\n        {}\n        {}\n      </collision>\n",
                            collision.name, collision.pose, collision.geometry);
    }
    return text + "    </link>\n  </model>\n</sdf>\n";
}

} // namespace foam::sdf
