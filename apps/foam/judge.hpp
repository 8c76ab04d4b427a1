// What evaluate, certify and compare share: options, input, and the figures as table and JSON.
#pragma once

#include "cli/program.hpp"
#include "robot_options.hpp"

#include <foam/collision/self_collision.hpp>
#include <foam/geometry/figure.hpp>
#include <foam/judge/collision_model.hpp>
#include <foam/judge/judge_json.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace foam::cli {

struct JudgeOptions {
    std::string original;
    std::vector<std::string> renames, packages;
    RobotOptions robot;
    MeshUnit unit;
    std::string covers = "solid";
    std::string reader;      ///< of the spheres; empty: the one that recognises them
    std::size_t threads = 0; ///< 0: all cores
};

/// --reader STAGE, which reads the sphere model.
CLI::Option* add_reader(CLI::App& command, std::string& reader);
/// --rename OLD=NEW, repeatable.
void add_renames(CLI::App& command, std::vector<std::string>& texts);
/// Throws Error(usage) for a text without '='.
Renames renames_of(const std::vector<std::string>& texts);
/// --covers solid|surface.
void add_covers(CLI::App& command, std::string& covers, const std::string& text);
/// Returns what --covers names.
Covers covers_named(const std::string& word);
/// ORIGINAL, --geometry, --keep, --skip, --pad, --unit, --scale, --reader, --rename, -j.
void add_judge_options(CLI::App& command, Program& program, JudgeOptions& options);
/// Adds the padding to all radii of a model. Warns of one without unit that is larger than the robot; `original`: null
/// where it is not known.
void pad(SphereFile& file, const RobotOptions& options, const Original* original);
/// Returns the longest edge of the geometry in the zero pose, m.
double size_of(const Original& original);

/// Returns the geometry. Warnings of its loader go to stderr.
Original original_of(Program& program, const JudgeOptions& options);
/// Returns the model brought onto its links. Notes go to stderr. `alone`: every rename must be of a link of it.
MatchedModel model_of(Program& program, const JudgeOptions& options, const Original& original, const std::string& file,
                      bool alone = true);
/// Throws Error(usage) for a --rename whose OLD no link of the files has, or begins with.
void require_renames(const std::vector<std::string>& renames, const std::vector<const SphereFile*>& files);
/// "yes", "no", or "in part" where only some links are proved: the verdict in a row for all links.
std::string certified_cell(const ProvedLinks& links);
/// Sentences about the links that are not judged; those whose proof fails stand in tables.
std::string not_judged_text(ProvedLinks links);

/// In one step, so that a reader never sees half of it. Throws Error(output).
void write_whole_file(const std::filesystem::path& file, const std::string& text);

/// Lengths for people: millimetres; "inf" for what has no end.
std::string millimetres(double metres, int digits = 2);
/// The numbers of elements that are judged, by kind.
KindCounts kinds_of_model(const MatchedModel& model);

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

struct Agreement {
    std::string file;
    std::size_t both = 0;             ///< left out here and there
    std::vector<IgnoredPair> unknown; ///< of links that have no spheres, or that the robot lacks
    struct Difference {
        LinkPair pair;
        std::string reason; ///< there
    };
    std::vector<Difference> only_there; ///< to check here
    std::vector<LinkPair> only_here;
};

Agreement agreement(const std::string& file, const Robot& robot, const SelfCollisionMatrix& matrix);
std::string text_of(const Agreement& agreement, const Robot& robot, const SelfCollisionMatrix& matrix);
nlohmann::ordered_json json_of(const Agreement& agreement, const Robot& robot);

/// What is known of a pair, in words.
std::string evidence(const SelfCollisionMatrix& matrix, const LinkPair& pair);

} // namespace foam::cli
