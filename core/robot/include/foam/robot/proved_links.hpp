// The verdict on a model: the links of a robot that are proved, those that are not, and what of them.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/robot/robot.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] robot {

struct ProvedLinks {
    /// A link with geometry to be covered that is not proved.
    struct LeftOut {
        std::string link, reason;
    };
    Guarantee guarantee = Guarantee::outer;
    CoveredGeometry geometry = CoveredGeometry::collision;
    std::size_t with_geometry = 0; ///< links with geometry to be covered
    std::size_t proved = 0;
    std::vector<LeftOut> left_out;        ///< in the robot's order
    /// Those of the proved links of which the surface alone is covered, and why; in the robot's order. For
    /// Guarantee::outer.
    std::vector<LeftOut> as_surface{};
    std::vector<std::string> visual_only; ///< links with visual geometry only: they have no spheres
    std::vector<std::string> collision_only; ///< the same where only visual geometry is covered
    std::string elements = "spheres"; ///< what encloses the geometry; "elements" where they are not all spheres
    bool float32 = false;             ///< proved also for the numbers in single precision
    /// Share of the volume of the proved links, of all links for Guarantee::fitted, that lies outside all elements, as
    /// measured; not a number where there was no time to measure it. It is 0 where all are covered as solids.
    double missing = 0;

    /// Returns whether every link with geometry to be covered is proved.
    bool all() const { return proved > 0 && proved == with_geometry; }
};

/// Returns why covers hold the surface of a solid alone: "its mesh is open"; empty if they hold all of it.
std::string why_surface_alone(const Solid& solid);

/// Returns the names of the links that have visual geometry and no collision geometry.
std::vector<std::string> visual_only_links(const Robot& robot);

/// Returns sentences about the proof, each on a line: how many links lie inside their elements as solids, and which as
/// surfaces. For Guarantee::fitted they say that nothing is proved.
std::string verdict_of(const ProvedLinks& links);
/// Returns the same in one line for comments in files, with the links that are left out: "proved: the collision
/// geometry of 2 of 2 links lies inside their spheres, as solids".
std::string statement_of(const ProvedLinks& links);
/// Returns "as solids", or "as a solid" of one link, or "1 as a solid, 2 as surfaces", of the proved links.
std::string as_what(const ProvedLinks& links);
/// Returns "as a surface: a (its mesh is open)"; empty if there is none.
std::string surfaces_text(const ProvedLinks& links);
/// Returns "67 % of the volume lies outside all elements", or that it was not measured; empty where nothing is missing.
std::string missing_text(const ProvedLinks& links);
/// Returns sentences about the links that are left out or have visual geometry only, each on a line. Names are fit for
/// a terminal; if there are many, only the first are named.
std::string omissions_of(const ProvedLinks& links);

/// Returns a JSON object, of a class such as nlohmann's.
template <class Json> Json json_of_proof(const ProvedLinks& links) {
    Json json{{"geometry", words_of_covered_geometry()[static_cast<std::size_t>(links.geometry)]},
              {"links_with_geometry", links.with_geometry},
              {"links_proved", links.proved},
              {"statement", statement_of(links)},
              {"missing", std::isfinite(links.missing) ? Json(links.missing) : Json()},
              {"as_surface", Json::array()},
              {"left_out", Json::array()},
              {"visual_only", Json(links.visual_only)},
              {"collision_only", Json(links.collision_only)}};
    for (const ProvedLinks::LeftOut& link : links.left_out) {
        json["left_out"].push_back({{"link", link.link}, {"reason", link.reason}});
    }
    for (const ProvedLinks::LeftOut& link : links.as_surface) {
        json["as_surface"].push_back({{"link", link.link}, {"reason", link.reason}});
    }
    return json;
}

} // namespace robot
} // namespace foam
