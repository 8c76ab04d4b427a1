#include "judge.hpp"

#include <foam/base/text.hpp>
#include <foam/robot/robot.hpp>

#include <fmt/format.h>

#include <map>
#include <utility>

namespace foam::cli {
namespace {

using Json = nlohmann::ordered_json;

std::pair<std::string, std::string> names_of(const LinkPair& pair, const Robot& robot) {
    return std::minmax(robot.links[pair.first].name, robot.links[pair.second].name);
}

Json json_of_pair(const LinkPair& pair, const Robot& robot) {
    return {robot.links[pair.first].name, robot.links[pair.second].name};
}

std::string line(const char* where, const LinkPair& pair, const std::string& reason, const Robot& robot,
                 const SelfCollisionMatrix& matrix) {
    return fmt::format("  {}: {}, {}{}: {}\n", where, robot.links[pair.first].name, robot.links[pair.second].name,
                       reason.empty() ? "" : fmt::format(" ({})", reason), evidence(matrix, pair));
}

} // namespace

Agreement agreement(const std::string& file, const Robot& robot, const SelfCollisionMatrix& matrix) {
    Agreement result;
    result.file = file;
    std::map<std::pair<std::string, std::string>, std::string> theirs;
    for (const IgnoredPair& pair : read_ignored_pairs(file)) {
        theirs[{pair.first, pair.second}] = pair.reason;
    }
    for (const LinkPair& pair : matrix.pairs) {
        const bool here = pair.reason != PairReason::none;
        const auto there = theirs.extract(names_of(pair, robot));
        if (there) {
            here ? void(++result.both) : result.only_there.push_back({pair, there.mapped()});
        } else if (here) {
            result.only_here.push_back(pair);
        }
    }
    for (const auto& [links, reason] : theirs) {
        result.unknown.push_back({links.first, links.second, reason});
    }
    return result;
}

std::string text_of(const Agreement& agreement, const Robot& robot, const SelfCollisionMatrix& matrix) {
    std::string text =
        fmt::format("{} excludes {}: {} of them are excluded here, {} need a check here, {} contain links "
                    "without spheres; {} more are excluded here.\n",
                    agreement.file, counted(agreement.both + agreement.only_there.size() + agreement.unknown.size(), "pair"),
                    agreement.both, agreement.only_there.size(), agreement.unknown.size(), agreement.only_here.size());
    for (const Agreement::Difference& difference : agreement.only_there) {
        text += line("to check here", difference.pair, difference.reason, robot, matrix);
    }
    for (const LinkPair& pair : agreement.only_here) {
        text += line("excluded here", pair, to_string(pair.reason), robot, matrix);
    }
    return text;
}

Json json_of(const Agreement& agreement, const Robot& robot) {
    Json json{{"file", agreement.file},
              {"both", agreement.both},
              {"only_there", Json::array()},
              {"only_here", Json::array()},
              {"without_spheres", Json::array()}};
    for (const Agreement::Difference& difference : agreement.only_there) {
        json["only_there"].push_back(json_of_pair(difference.pair, robot));
    }
    for (const LinkPair& pair : agreement.only_here) {
        json["only_here"].push_back(json_of_pair(pair, robot));
    }
    for (const IgnoredPair& pair : agreement.unknown) {
        json["without_spheres"].push_back({pair.first, pair.second});
    }
    return json;
}

} // namespace foam::cli
