// Several sphere models of one robot, judged, side by side.
#pragma once

#include "judge.hpp"

#include <foam/figure.hpp>

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
/// A page that needs no other file. `png`: the picture, may be empty.
std::string html_of(const Comparison& comparison, const std::string& png);

} // namespace foam::cli
