// The scene that is shown, and the page with it.
#pragma once

#include <foam/view/subject.hpp>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] view {

/// Figures of a sphere model, for colours and labels.
struct ModelFigures {
    std::vector<std::vector<double>> protrusions; ///< of each sphere of each link, m
};

/// What is proved and measured of the spheres of a link.
struct LinkVerdict {
    bool holds = false;    ///< the spheres are proved to cover the link
    Vec3 witness{};        ///< if not: a point that they do not cover, in the link's frame
    double gap = 0;        ///< m; infinite without spheres
    double excess = 0;     ///< excess volume / volume of the link
    double protrusion = 0; ///< m
    double missing = 0;    ///< volume of the link outside the spheres / volume of the link
};
/// Of each link of a robot; nothing where its geometry is not known.
using LinkVerdicts = std::vector<std::optional<LinkVerdict>>;

/// Returns the verdict as a JSON object, of a class such as nlohmann's. JSON has no infinity: it has null instead.
template <class Json> Json json_of(const LinkVerdict& verdict) {
    const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
    const Vec3& w = verdict.witness;
    return {{"holds", verdict.holds},
            {"witness", {w.x, w.y, w.z}},
            {"gap", number(verdict.gap)},
            {"excess", number(verdict.excess)},
            {"protrusion", number(verdict.protrusion)},
            {"missing", number(verdict.missing)}};
}

/// One of several sphere models of a robot that differ in their number of spheres.
struct ModelStep {
    std::vector<std::vector<Sphere>> spheres; ///< of each link of the robot
    std::optional<ModelFigures> figures;
    std::optional<LinkVerdicts> verdicts;
};

/// Pairs of links, first < second, that never need a check.
using LinkPairs = std::vector<std::pair<std::size_t, std::size_t>>;

struct SceneModel {
    std::string name; ///< for people
    std::string format;
    std::size_t robot = 0;
    std::vector<ModelStep> steps; ///< at least one, in the order of their number of spheres
    std::size_t at = 0;           ///< the one that is shown first
    std::optional<LinkPairs> ignored;
};

/// Returns the scene: "foamview", the length of the JSON as 32-bit number, the JSON, zeros up to a multiple of 8, and
/// arrays, each at a multiple of 8. Little-endian. The JSON refers to an array by {"at": byte, "count": numbers}.
/// Names are fit for display (shown()). Of robots with many triangles it has coarse meshes, so that the first picture
/// comes soon; fine_mesh_bytes() has the others.
std::string scene_bytes(const Subject& subject, const std::vector<SceneModel>& models, const std::string& session_json);

/// Returns the meshes that are coarse in the scene, in its form: {"meshes": [mesh or null, …]} in the scene's order.
std::string fine_mesh_bytes(const Subject& subject);

/// Returns one HTML file that needs no other: it shows the models, and edits nothing. Its security policy lets browsers
/// run only foam's own script.
std::string static_page(const Subject& subject, const std::vector<SceneModel>& models);

/// A file that the server of a session offers: text and kind.
struct PageFile {
    std::string content, type;
};
/// Returns "", "view.css" or "view.js" of the served page; throws Error(internal) for another name.
PageFile served_file(const std::string& name);

} // namespace view
} // namespace foam
