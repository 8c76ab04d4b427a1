#include "srdf.hpp"

#include "attributes.hpp"

#include <foam/base/error.hpp>
#include <foam/xml/editor.hpp>

#include <fmt/format.h>

namespace foam::xml_models {
namespace {

std::string pairs_text(const std::vector<IgnoredPair>& pairs) {
    std::string text;
    for (const IgnoredPair& pair : pairs) {
        // Tesseract requires a reason.
        text += "  <disable_collisions" + attribute_text("link1", pair.first) + attribute_text("link2", pair.second) +
                attribute_text("reason", pair.reason.empty() ? "User" : pair.reason) + "/>\n";
    }
    return text;
}

std::string spheres_text(const std::vector<LinkSpheres>& links) {
    std::string text;
    for (const LinkSpheres& link : links) {
        text += "  <link_sphere_approximation" + attribute_text("link", link.link) + ">\n";
        for (const Sphere& s : link.spheres) {
            text += "    <sphere" + attribute_text("center", vector_text(s.center)) +
                    attribute_text("radius", numbers_text({&s.radius, 1})) + "/>\n";
        }
        text += "  </link_sphere_approximation>\n";
    }
    return text;
}

/// Replaces the spheres, and the pairs if there are any, of an SRDF of the user.
std::string edited(const TextFile& into, const std::vector<LinkSpheres>& links, const std::vector<IgnoredPair>* pairs) {
    const auto root = xml::parse(into.text, into.file.string(), ErrorCode::input);
    if (root->name != "robot" || root->self_closing()) {
        throw Error(ErrorCode::input, fmt::format("{}:{}: <{}> is not the <robot> of an SRDF", into.file.string(),
                                                  root->line, root->name));
    }
    xml::Editor editor(into.text);
    for (const auto& child : root->children) {
        if (child->name == "link_sphere_approximation" || (pairs && child->name == "disable_collisions")) {
            editor.remove(*child);
        }
    }
    editor.replace({root->end_tag, root->end_tag}, (pairs ? pairs_text(*pairs) : "") + spheres_text(links));
    return editor.result();
}

} // namespace

SrdfWriter::SrdfWriter(const Parameters& parameters) : replaces_pairs_(parameters.boolean("pairs")) {}

std::string SrdfWriter::write(const SphereModel& model, Context& context) const {
    const std::vector<LinkSpheres> links = spheres_by_link(model);
    const std::vector<IgnoredPair>* pairs = model.ignored_pairs ? &*model.ignored_pairs : nullptr;
    if (model.into) {
        return edited(*model.into, links, replaces_pairs_ ? pairs : nullptr);
    }
    if (!pairs) {
        context.log(Severity::warning, "the pairs of links that need no check are not known: none is written");
    }
    const std::string name = model.robot && !model.robot->name.empty() ? model.robot->name : model.name;
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n" + comment_text(model.provenance) + "<robot" +
           attribute_text("name", name) + ">\n" + (pairs ? pairs_text(*pairs) : "") + spheres_text(links) +
           "</robot>\n";
}

std::map<std::string, std::vector<Sphere>> SrdfWriter::read(const std::string& bytes) const {
    std::map<std::string, std::vector<Sphere>> result;
    try {
        QuietContext context;
        for (LinkSpheres& link : SrdfReader().read(bytes, "SRDF", context).links) {
            result[link.link] = std::move(link.spheres);
        }
    } catch (const Error& error) {
        throw Error(ErrorCode::output, error.what());
    }
    return result;
}

bool SrdfReader::recognises(std::string_view text) const {
    return xml::root_name(text) == "robot" && text.find("<link_sphere_approximation") != text.npos;
}

SphereFile SrdfReader::read(const std::string& text, const std::filesystem::path& file, Context&) const {
    const auto root = xml::parse(text, file.string(), ErrorCode::input);
    SphereFile result;
    result.file = file;
    result.format = "SRDF";
    for (const xml::Element* link : root->children_named("link_sphere_approximation")) {
        std::vector<Sphere>& spheres = spheres_of(result, required(*link, "link", file.string()));
        for (const xml::Element* sphere : link->children_named("sphere")) {
            const std::vector<double> center = numbers_of(*sphere, "center", 3, file.string());
            spheres.push_back(
                {{center[0], center[1], center[2]}, numbers_of(*sphere, "radius", 1, file.string()).front()});
        }
    }
    return result;
}

} // namespace foam::xml_models
