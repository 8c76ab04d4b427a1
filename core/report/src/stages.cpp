// The viewer, and each link after each stage: the elements for the script's drawings.
#include "sections.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

namespace foam::inline report {
namespace {

constexpr std::size_t max_triangles = 100'000; ///< some 1.3 MB
std::size_t level_count(const Report& report) {
    std::size_t levels = 1;
    for (const ReportLink& link : report.links) {
        levels = std::max(levels, link.scene.levels.size());
    }
    return levels;
}

/// Returns how far the stage moved the surface: the largest distance over the elements of the link.
std::string distance_text(const Json& manifest, const std::string& link, const std::string& stage) {
    std::optional<double> distance;
    for (const Json& worked : manifest["execution"]["links"]) {
        if (worked["link"] != link) {
            continue;
        }
        for (const Json& entry : worked["stages"]) {
            if (entry["stage"] == stage && entry.contains("change")) {
                for (const char* way : {"input_to_output", "output_to_input"}) {
                    distance = std::max(distance.value_or(0), value_of(entry["change"][way]["max_m"]));
                }
            }
        }
    }
    return distance ? fmt::format(", moved by up to {} mm", number(mm_per_m * *distance, 2)) : "";
}

std::string mesh_caption(const Json& manifest, const SceneLink& link, std::size_t stage) {
    const StageMesh& made = link.meshes[stage];
    std::string text = counted(made.mesh->triangles.size(), "triangle");
    if (stage > 0) {
        text = *made.mesh == *link.meshes[stage - 1].mesh ? "unchanged"
                                                          : text + distance_text(manifest, link.name, made.stage);
    }
    return fmt::format("<strong>{}</strong> {}", as_text(made.stage), text);
}

std::string frame(std::size_t link, const std::string& shows, const std::string& caption) {
    return fmt::format("<figure><canvas data-link=\"{}\" data-shows=\"{}\" aria-hidden=\"true\"></canvas>"
                       "<figcaption>{}</figcaption></figure>\n",
                       link, shows, caption);
}

std::string strip(const Report& report, std::size_t index) {
    const ReportLink& link = report.links[index];
    std::string frames;
    for (std::size_t stage = 0; stage < link.scene.meshes.size(); ++stage) {
        frames += frame(index, fmt::format("{}", stage), mesh_caption(report.manifest, link.scene, stage));
    }
    const Elements& finest = link.scene.levels.back();
    frames += frame(index, "spheres",
                    fmt::format("<strong>{}</strong> {}", as_text(link.spherizer),
                                counted(finest.size(), finest.are_spheres() ? "sphere" : "element")));
    return fmt::format("<h3>{}</h3>\n<div class=\"strip\">\n{}</div>\n", as_text(link.scene.name), frames);
}

std::vector<SceneLink> scene_of(const Report& report) {
    std::vector<SceneLink> links;
    for (const ReportLink& link : report.links) {
        links.push_back(link.scene);
    }
    return links;
}

std::string choice(const char* name, const char* value, const char* label, bool on) {
    return fmt::format("<label><input type=\"radio\" name=\"{}\" value=\"{}\"{}> {}</label>\n", name, value,
                       on ? " checked" : "", label);
}

std::string controls(const Report& report) {
    const std::size_t levels = level_count(report);
    const bool inner = report.manifest["settings"]["guarantee"] == "inner";
    std::string html = "<div class=\"controls\" hidden>\n<fieldset><legend>Show</legend>\n"
                       "<label><input type=\"checkbox\" id=\"show-spheres\" checked> spheres</label>\n"
                       "<label><input type=\"checkbox\" id=\"show-geometry\" checked> geometry</label>\n</fieldset>\n"
                       "<fieldset><legend>See through</legend>\n";
    html += choice("clear", "spheres", "spheres", !inner) + choice("clear", "geometry", "geometry", inner) +
            choice("clear", "none", "nothing", false);
    html += "</fieldset>\n<fieldset><legend>Colour by</legend>\n";
    html += choice("colour", "radius", "radius", true) + choice("colour", "link", "link", false) +
            "<p id=\"radius-scale\"><span></span><span class=\"gradient\"></span><span></span></p>\n</fieldset>\n";
    if (levels > 1) {
        html += fmt::format("<fieldset><legend>Level of the sphere tree</legend>\n<label><input type=\"range\" "
                            "id=\"level\" min=\"0\" max=\"{0}\" value=\"{0}\" aria-label=\"Level\"> "
                            "<output id=\"level-text\" for=\"level\">finest</output></label>\n</fieldset>\n",
                            levels - 1);
    }
    return html + "<fieldset><legend>Links</legend>\n<p><button type=\"button\" id=\"all-links\">all</button> "
                  "<button type=\"button\" id=\"no-links\">none</button></p>\n<div id=\"link-list\"></div>\n"
                  "</fieldset>\n<p><button type=\"button\" id=\"reset-view\">reset the view</button></p>\n</div>\n";
}

std::string fallback(const Report& report) {
    return report.picture.empty()
               ? ""
               : fmt::format("<img alt=\"The geometry and its spheres\" src=\"data:image/png;base64,{}\">\n",
                             base64(report.picture));
}

} // namespace

std::string viewer_section(const Report& report) {
    return section(
        "view", "In space",
        fmt::format(
            "<div class=\"viewer\">\n<div class=\"stage\">\n<canvas id=\"viewer\" tabindex=\"0\" role=\"application\" "
            "aria-label=\"The geometry and its spheres in 3-D\" aria-describedby=\"viewer-help\" hidden></canvas>\n"
            "<p id=\"viewer-message\" role=\"status\">The 3-D view needs a browser that runs scripts. All figures are "
            "in the tables below.</p>\n</div>\n{}</div>\n<p class=\"note\" id=\"viewer-help\">Drag to turn, Shift and "
            "drag or two fingers to move, wheel or pinch to zoom. Keys: arrows turn, Shift and arrows move, + and − "
            "zoom, 0 resets. <span id=\"viewer-detail\"></span></p>\n{}"
            "<script type=\"application/json\" id=\"scene\">{}</script>\n",
            controls(report),
            report.picture.empty() ? "" : "<details><summary>Picture</summary>" + fallback(report) + "</details>\n",
            scene_json(scene_of(report), max_triangles)));
}

std::string stages_section(const Report& report) {
    std::string html;
    for (std::size_t i = 0; i < report.links.size(); ++i) {
        html += strip(report, i);
    }
    return section("stages", "Stage by stage", html);
}

} // namespace foam::report
