#include <foam/view/scene.hpp>

#include "embedded_resources.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/report/internal/report.hpp>

#include <fmt/format.h>

namespace foam::inline view {
namespace {

std::string title_of(const Subject& subject) {
    const ViewedRobot& robot = subject.robots.front();
    const std::string name = robot.file.empty() ? robot.robot->name : robot.file.filename().string();
    return markup_escaped(shown(name)) + " – foam view";
}

std::string page(const std::string& head, const std::string& title, const std::string& end) {
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
                       "<title>{}</title>\n{}</head>\n<body>\n{}{}</body>\n</html>\n",
                       title, head, resources::view_html.text, end);
}

} // namespace

std::string static_page(const Subject& subject, const std::vector<SceneModel>& models) {
    const std::string head = fmt::format(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src {}; "
        "script-src {}; base-uri 'none'; form-action 'none'\">\n<link rel=\"icon\" "
        "href=\"data:,\">\n<style>{}</style>\n",
        policy_source(resources::view_css), policy_source(resources::view_js), resources::view_css.text);
    return page(head, title_of(subject),
                fmt::format("<script type=\"text/plain\" id=\"scene\">{}</script>\n"
                            "<script type=\"module\" async>{}</script>\n" // draws before the rest of the page is read
                            "<script type=\"text/plain\" id=\"meshes\">{}</script>\n",
                            base64(scene_bytes(subject, models, "null")), resources::view_js.text,
                            base64(fine_mesh_bytes(subject))));
}

PageFile served_file(const std::string& name) {
    if (name.empty()) {
        return {page("<link rel=\"icon\" href=\"data:,\">\n<link rel=\"stylesheet\" href=\"view.css\">\n", "foam view",
                     "<script type=\"module\" src=\"view.js\"></script>\n"),
                "text/html; charset=utf-8"};
    }
    if (name == "view.css") {
        return {std::string(resources::view_css.text), "text/css; charset=utf-8"};
    }
    if (name == "view.js") {
        return {std::string(resources::view_js.text), "text/javascript; charset=utf-8"};
    }
    throw Error(ErrorCode::internal, "the page has no file " + name);
}

} // namespace foam::inline view
