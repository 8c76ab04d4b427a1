// Sphere models in XML: SRDF and MJCF, read.* and write.*.
#include <foam/sdk/engines.hpp>
#include <foam/sdk/plugin.hpp>

#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <set>

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

/// Returns the links that have spheres alone: SRDF has no word for other elements.
std::vector<LinkSpheres> links_of_spheres(const SphereModel& model, Context& context) {
    std::vector<LinkSpheres> links = elements_by_link(model);
    KindCounts left_out{};
    std::erase_if(links, [&](const LinkSpheres& link) {
        if (!link.elements.are_spheres()) {
            left_out = sum_of(left_out, kinds_of(link.elements));
        }
        return !link.elements.are_spheres();
    });
    if (!spheres_alone(left_out)) {
        context.log(Severity::warning,
                    fmt::format("SRDF has no elements but spheres: {}not in the file: {}",
                                model.ignored_pairs ? "it has the pairs of links; " : "", counts_text(left_out)));
    }
    return links;
}

std::string spheres_text(const std::vector<LinkSpheres>& links) {
    std::string text;
    for (const LinkSpheres& link : links) {
        text += "  <link_sphere_approximation" + attribute_text("link", link.link) + ">\n";
        for (const Sphere& s : link.elements.spheres()) {
            text += "    <sphere" + attribute_text("center", vector_text(s.center)) +
                    attribute_text("radius", numbers_text({&s.radius, 1})) + "/>\n";
        }
        text += "  </link_sphere_approximation>\n";
    }
    return text;
}

/// Returns a link's name as srdfdom reads it, without blanks around it; empty if there is none.
std::string link_name(const xml::Element& element, const char* attribute) {
    constexpr const char* blanks = " \t\r\n\f\v";
    const std::string* text = element.attribute(attribute);
    const std::size_t begin = text ? text->find_first_not_of(blanks) : std::string::npos;
    return begin == std::string::npos ? "" : text->substr(begin, text->find_last_not_of(blanks) + 1 - begin);
}

/// Returns what an SRDF says of pairs. MoveIt lets <disable_collisions> overrule <enable_collisions>, so foam adds none
/// for a pair that the user enables; <disable_default_collisions> switches all pairs of a link off but for these.
StatedPairs pairs_of(const xml::Element& root, const std::string& file) {
    StatedPairs stated{.file = file, .ignored = {}, .decided = {}};
    std::set<std::pair<std::string, std::string>> enabled;
    std::set<std::string> off;
    for (const auto& child : root.children) {
        const std::string first = link_name(*child, "link1"), second = link_name(*child, "link2");
        const std::string* reason = child->attribute("reason");
        if (child->name == "disable_default_collisions") {
            off.insert(link_name(*child, "link"));
        } else if (first.empty() || second.empty()) {
            continue;
        } else if (child->name == "disable_collisions") {
            stated.ignored.push_back({first, second, reason ? *reason : ""});
        } else if (child->name == "enable_collisions") {
            enabled.insert(std::minmax(first, second));
        }
    }
    stated.decided = [enabled, off](const IgnoredPair& pair) {
        return enabled.contains(std::minmax(pair.first, pair.second)) || off.contains(pair.first) ||
               off.contains(pair.second);
    };
    return stated;
}

/// Replaces the spheres of an SRDF of the user, and edits its pairs.
std::string edited(const SphereModel& model, const std::vector<LinkSpheres>& links, PairEdit edit, Context& context) {
    const TextFile& into = *model.into;
    const auto root = xml::parse(into.text, into.file.string(), ErrorCode::input);
    if (root->name != "robot" || root->self_closing()) {
        throw Error(ErrorCode::input, fmt::format("{}:{}: <{}> is not the <robot> of an SRDF", into.file.string(),
                                                  root->line, root->name));
    }
    const auto pairs = pairs_into(edit, pairs_of(*root, into.file.string()), model.ignored_pairs, context);
    xml::Editor editor(into.text);
    for (const auto& child : root->children) {
        if (child->name == "link_sphere_approximation" ||
            (pairs && edit == PairEdit::replace && child->name == "disable_collisions")) {
            editor.remove(*child);
        }
    }
    editor.replace({root->end_tag, root->end_tag}, (pairs ? pairs_text(*pairs) : "") + spheres_text(links));
    return editor.result();
}

} // namespace

SrdfWriter::SrdfWriter(const Parameters& parameters) : pairs_(pair_edit(parameters)) {}

std::string SrdfWriter::write(const SphereModel& model, Context& context) const {
    const std::vector<LinkSpheres> links = links_of_spheres(model, context);
    const std::vector<IgnoredPair>* pairs = model.ignored_pairs ? &*model.ignored_pairs : nullptr;
    if (model.into) {
        return edited(model, links, pairs_, context);
    }
    warn_without_pairs(model, context);
    const std::string name = model.robot && !model.robot->name.empty() ? model.robot->name : model.name;
    const bool whole = links.size() == elements_by_link(model).size();
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n" +
           comment_text((whole ? "" : "pairs for a model whose elements are in another file: ") + model.provenance) +
           "<robot" + attribute_text("name", name) + ">\n" + (pairs ? pairs_text(*pairs) : "") + spheres_text(links) +
           "</robot>\n";
}

std::map<std::string, Elements> SrdfWriter::read(const std::string& bytes, const std::map<std::string, std::string>&) const {
    try {
        QuietContext context;
        return elements_of(SrdfReader().read(bytes, "SRDF", context));
    } catch (const Error& error) {
        throw Error(ErrorCode::output, error.what());
    }
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

FOAM_PLUGIN("xml_models", "1.0", "Apache-2.0") {
    using namespace foam::xml_models;
    using foam::Parameter;
    enrol.add<SrdfWriter>(
        {.name = "write.srdf",
         .summary = "Writes an SRDF: pairs of links that need no check, and the spheres of links as a side-car.",
         .reference = "https://github.com/moveit/srdfdom",
         .parameters = {foam::pairs_parameter()},
         .extensions = {"srdf"},
         .consumer = {.name = "srdfdom (e23af6e63a), Pinocchio 3.7, Tesseract (c3f7109d07)",
                      .pairs = true,
                      .elements_optional = true,
                      .edits = true}});
    enrol.add<MjcfWriter>(
        {.name = "write.mjcf",
         .summary = "Writes the robot as MJCF: bodies with their elements and visuals, joints, inertias, pairs without "
                    "contact, the rest pose, and actuators.",
         .reference = "https://mujoco.readthedocs.io/en/stable/XMLreference.html",
         .parameters = {foam::engine_parameter("write.mjcf"),
                        Parameter::choice("base", {"fixed", "free"}, "fixed")
                            .doc("fixed: the base is part of the world; free: it moves freely, as an object does."),
                        Parameter::number("density", 1000)
                            .bounds(1e-3, 1e5)
                            .unit("kg/m³")
                            .doc("Density of the geometry of links without <inertial>.")
                            .source("MuJoCo's own default."),
                        foam::segments_parameter(),
                        Parameter::boolean("collision", false)
                            .doc("With 'into': also replace geoms with contact that are no spheres."),
                        foam::pairs_parameter(),
                        Parameter::boolean("visuals", true)
                            .doc("Write the visual geometry of the robot, which names its mesh files. false: the file "
                                 "stands alone, and its elements are seen."),
                        Parameter::choice("actuators", {"none", "position", "velocity", "motor"}, "none")
                            .doc("What moves each joint. position: a servo that reaches the effort at an error of a "
                                 "fiftieth of the range; velocity: one that reaches it at an error of the greatest "
                                 "velocity; motor: a force up to the effort.")
                            .source("MuJoCo's import of URDF makes none.")},
         .extensions = {"xml", "mjcf"},
         .uses = {"load.mesh"},
         .kinds = foam::every_kind(),
         .consumer = {.name = "MuJoCo 3.3.0 to 4.0 (a7255075b0)", .pairs = true, .rest_pose = true, .edits = true}});
    enrol.add<SrdfReader>({.name = "read.srdf",
                           .summary = "Reads the spheres of links of an SRDF: link_sphere_approximation.",
                           .reference = "https://github.com/moveit/srdfdom",
                           .extensions = {"srdf"}});
    enrol.add<MjcfReader>(
        {.name = "read.mjcf",
         .summary = "Reads the spheres and other convex elements of an MJCF file: geoms of its bodies.",
         .reference = "https://mujoco.readthedocs.io/en/stable/XMLreference.html",
         .extensions = {"xml", "mjcf"}});
}
