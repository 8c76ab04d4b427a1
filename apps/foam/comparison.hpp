// Several sphere models of one robot, judged, side by side.
#pragma once

#include "judge.hpp"

#include <foam/geometry/figure.hpp>

#include <string>
#include <vector>

namespace foam::cli {

struct JudgedModel {
    std::string label; ///< "A", "B", …
    MatchedModel model;
    Evaluation evaluation;
};

struct Comparison {
    Original original;
    std::vector<JudgedModel> models;
};

std::string table_of(const Comparison& comparison);
nlohmann::ordered_json json_of(const Comparison& comparison);
/// The robot in its zero pose under the spheres of each model, a panel each.
Figure figure_of(const Comparison& comparison);
/// One link of the original under the spheres of each model.
Figure figure_of_link(const Comparison& comparison, std::size_t link);

/// PNG files.
struct Pictures {
    std::string whole;              ///< may be empty
    std::vector<std::string> links; ///< of each link of the original; none where there is only one
};
/// A page that needs no other file.
std::string html_of(const Comparison& comparison, const Pictures& pictures);

/// The heading of the numbers of elements: "spheres" where all models have spheres alone, else "elements".
const char* noun_of_elements(const Comparison& comparison);

} // namespace foam::cli
