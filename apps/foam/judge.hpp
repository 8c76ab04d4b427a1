// What evaluate, certify and compare share: options, input, and the figures as table and JSON.
#pragma once

#include "cli/program.hpp"

#include <foam/judge/judge_json.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace foam::cli {

struct JudgeOptions {
    std::string original;
    std::vector<std::string> renames, links;
    MeshUnit unit;
    std::string geometry = "collision";
    std::string reader;      ///< of the spheres; empty: the one that recognises them
    std::size_t threads = 0; ///< 0: all cores
};

/// --reader STAGE, which reads the sphere model.
CLI::Option* add_reader(CLI::App& command, std::string& reader);
/// Returns the values of JOINT=NUMBER. Throws Error(usage), naming the option, for another text.
JointValues positions_of(const std::vector<std::string>& texts, const char* option);
/// --rename OLD=NEW, repeatable.
void add_renames(CLI::App& command, std::vector<std::string>& texts);
/// Throws Error(usage) for a text without '='.
Renames renames_of(const std::vector<std::string>& texts);
/// --geometry collision|visual|both.
void add_geometry(CLI::App& command, std::string& geometry, const std::string& text);
/// Returns the geometry that --geometry names.
CoveredGeometry covered_geometry(const std::string& word);
/// ORIGINAL, --geometry, --unit, --scale, --reader, --rename, --link, -j.
void add_judge_options(CLI::App& command, Program& program, JudgeOptions& options);

/// The geometry, with what its loader warned of told on stderr.
Original original_of(Program& program, const JudgeOptions& options);
/// The spheres brought onto its links, with the notes told on stderr. `alone`: every rename must be of a link of it.
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

} // namespace foam::cli
