#include "sphere_urdf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/engines.hpp>
#include <foam/sdk/writing.hpp>
#include <foam/yaml/write.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam {
namespace {

bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_identifier(const std::string& name) {
    return !name.empty() && is_letter(name.front()) &&
           std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

/// Returns the name as that of a C++ struct: "Ur5_robot" for "ur5-robot".
std::string identifier_of(const std::string& name) {
    std::string identifier = name.empty() ? "robot" : name;
    std::replace_if(
        identifier.begin(), identifier.end(), [](char c) { return !is_letter(c) && !is_digit(c); }, '_');
    identifier = is_letter(identifier.front()) ? identifier : "Robot_" + identifier;
    const char first = identifier.front();
    identifier.front() = first >= 'a' && first <= 'z' ? static_cast<char>(first - 'a' + 'A') : first;
    return identifier;
}

/// Puts a comment before the <robot>: the file is not the user's any more. It holds ASCII only, which every encoding
/// has.
void add_provenance(SphereUrdf& urdf) {
    std::string text = urdf.model().provenance;
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    for (std::size_t at = 0; (at = text.find("--", at)) != text.npos;) {
        text.replace(at, 2, "- -"); // "--" ends a comment
    }
    if (!text.empty()) {
        const std::size_t before = urdf.root().span.begin;
        urdf.editor().replace({before, before}, "<!-- " + text + " -->\n");
    }
}

/// Throws Error(output) for collision geometry that is no sphere: cricket refuses the robot.
void require_only_spheres(const SphereUrdf& urdf) {
    for (const Link& link : urdf.model().robot->links) {
        if (urdf.is_replaced(link.name)) {
            continue;
        }
        for (const xml::Element* collision : urdf.link(link.name).children_named("collision")) {
            const xml::Element* geometry = collision->child("geometry");
            if (!geometry || !geometry->child("sphere")) {
                throw Error(ErrorCode::output,
                            fmt::format("{}: link '{}' has collision geometry, but no spheres ({}), and cricket "
                                        "reads spheres only; remedy: a model with spheres for it",
                                        urdf.writer(), link.name, urdf.place_of(*collision)));
            }
        }
    }
}

/// Logs the link whose one bounding sphere, which cricket computes and VAMP checks first, is largest for its spheres.
void report_bounding_spheres(const std::vector<LinkSpheres>& links, Context& context) {
    double worst = 0;
    const LinkSpheres* of = nullptr;
    for (const LinkSpheres& link : links) {
        if (link.elements.spheres().size() < 2) {
            continue;
        }
        double spheres = 0;
        for (const Sphere& s : link.elements.spheres()) {
            spheres += s.radius * s.radius * s.radius;
        }
        const double radius = enclosing_sphere(link.elements.spheres()).radius;
        if (const double ratio = radius * radius * radius / spheres; ratio > worst) {
            worst = ratio;
            of = &link;
        }
    }
    if (of) {
        context.log(Severity::info, fmt::format("VAMP checks one bounding sphere a link first; that of '{}' is the "
                                                "largest for its spheres: {:.3g} times the sum of their volumes",
                                                of->link, worst));
    }
}

yaml::Value end_effector_of(const std::vector<std::string>& frames) {
    return frames.size() == 1 ? yaml::text(frames.front()) : yaml::list(frames);
}

} // namespace

VampWriter::VampWriter(const Parameters& parameters, const StageMaker& maker)
    : engine_(engine_of(parameters)), mesh_paths_(parameters.text("mesh_paths")), name_(parameters.text("name")),
      templates_(parameters.text("templates")), language_(parameters.text("language")),
      resolution_(parameters.integer("resolution")), srdf_(maker.make<Writer>("write.srdf")) {
    if (!name_.empty() && !is_identifier(name_)) {
        throw Error(ErrorCode::usage,
                    fmt::format("write.vamp: '{}' cannot be the name of a C++ struct; remedy: letters, digits and '_', "
                                "first no digit: {}",
                                shown(name_), identifier_of(name_)));
    }
}

std::string VampWriter::write(const SphereModel& model, Context& context) const {
    SphereUrdf urdf(model, "write.vamp");
    const std::vector<LinkSpheres> links = stated_for(engine_, spheres_by_link(model));
    urdf.put_elements(links, {}, mesh_paths_, context);
    require_only_spheres(urdf);
    fix_joints(urdf, context);
    urdf.move_references(mesh_paths_, context);
    add_provenance(urdf);
    report_bounding_spheres(links, context);
    return urdf.result();
}

std::map<std::string, Elements> VampWriter::read(const std::string& bytes, const std::map<std::string, std::string>&) const {
    return held_by(engine_, elements_of_urdf(bytes, {}));
}

std::string VampWriter::companion(const std::string& ending, const SphereModel& model, Context& context) const {
    return ending == "srdf" ? srdf(model, context) : job(model);
}

std::string VampWriter::srdf(const SphereModel& model, Context& context) const {
    if (!srdf_) {
        throw Error(ErrorCode::output, "write.vamp: no plugin has write.srdf, which writes the pairs of links that "
                                       "need no check; remedy: `foam plugins --why`");
    }
    return srdf_->write(model, context);
}

std::string VampWriter::job(const SphereModel& model) const {
    require_robot(model, "write.vamp");
    const std::string name = name_.empty() ? identifier_of(model.robot->name) : name_;
    const std::filesystem::path urdf = model.file.empty() ? model.robot->name + ".urdf" : model.file;
    const std::string ending = language_ == "rust" ? "rs" : "hh",
                      templates = templates_.empty() ? "" : templates_ + "/";
    yaml::Value job = yaml::map({{"name", yaml::text(name)},
                                 {"urdf", yaml::text(urdf.string())},
                                 {"srdf", yaml::text(companion_of(urdf, "srdf").string())}});
    if (!model.facts.tool_frames.empty()) { // a key without a value would be an error
        yaml::append(job, "end_effector", end_effector_of(require_tool_frames(model, "write.vamp")));
    }
    yaml::append(job, "resolution", yaml::integer(resolution_));
    yaml::append(job, "template", yaml::text(templates + "fk_template." + ending));
    yaml::append(job, "subtemplates",
                 yaml::list({yaml::map({{"name", yaml::text("ccfk")},
                                        {"template", yaml::text(templates + "ccfk_template." + ending)}})}));
    yaml::append(job, "output", yaml::text(lower_case(name) + "_fk." + ending));
    if (language_ == "rust") {
        yaml::append(job, "language", yaml::text(language_));
    }
    return yaml::json_text(job);
}

StageInfo info_of_vamp() {
    return {.name = "write.vamp",
            .summary = "Writes the three files of a robot of VAMP: a sphere URDF whose joints are planned or fixed, an "
                       "SRDF, and the job for cricket.",
            .reference = "https://github.com/CoMMALab/cricket",
            .parameters =
                {engine_parameter("write.vamp"),
                 Parameter::text("name", "")
                     .doc("Name of the C++ struct; empty: the name of the robot, with '_' for what it cannot hold."),
                 Parameter::integer("resolution", 32)
                     .bounds(1, 100000)
                     .doc("Collision checks per unit of length in joint space.")
                     .source("cricket's files of the Panda and the Fetch; 64 for robots of many joints."),
                 Parameter::choice("language", {"c++", "rust"}, "c++").doc("Language of the code that cricket writes."),
                 Parameter::text("templates", "templates")
                     .doc("Folder of cricket's templates, as seen from the job; cricket's are in resources/templates."),
                 mesh_paths_parameter()},
            .extensions = {"urdf"},
            .uses = {"write.srdf"},
            .consumer = {.name = "VAMP (f6de6a72e0), cricket (a2ad9d6db7, 0a1eff2513)", .float32 = true, .pairs = true,
                         .rest_pose = true, .tool_frames = true},
            .companions = {"srdf", "json"}};
}

} // namespace foam
