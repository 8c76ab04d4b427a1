// The report of a run: one HTML file for people, from its manifest, its recipe and its results.
#pragma once

#include <foam/report/internal/scene.hpp>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] report {

struct ReportLink {
    SceneLink scene;
    std::string spherizer; ///< the stage that made its spheres
};

struct Report {
    nlohmann::ordered_json manifest;
    std::string recipe;             ///< as YAML, with every default
    std::string name;               ///< of the robot or mesh
    std::vector<ReportLink> links;  ///< links with spheres, in the robot's order
    std::string picture;            ///< PNG of the robot; may be empty
    std::vector<std::string> files; ///< further files of the run directory for people
};

/// Returns the report. Equal reports give equal bytes. What may differ between two runs of a recipe (see manifest.hpp)
/// is between the comments <!--execution--> and <!--/execution-->.
std::string to_html(const Report& report);

} // namespace report
} // namespace foam
