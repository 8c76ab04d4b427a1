#include "judge.hpp"

#include <foam/error.hpp>

#include <fmt/format.h>

#include <unistd.h>

#include <cmath>
#include <fstream>

namespace foam::cli {
namespace {

using Json = nlohmann::ordered_json;

} // namespace

Renames renames_of(const std::vector<std::string>& texts) {
    Renames renames;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == text.npos) {
            throw Error(ErrorCode::usage, fmt::format("--rename expects OLD=NEW, got '{}'", text));
        }
        renames.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return renames;
}

void add_renames(CLI::App& command, std::vector<std::string>& texts) {
    command
        .add_option("--rename", texts,
                    "A link of SPHERES that is called OLD, or begins with it, is NEW in ORIGINAL; '=LINK' for "
                    "spheres that name no link; repeatable")
        ->type_name("OLD=NEW")
        ->expected(1)
        ->take_all();
}

void add_judge_options(CLI::App& command, JudgeOptions& options) {
    command.add_option("original", options.original, "The geometry: a URDF or a mesh file")
        ->type_name("ORIGINAL")
        ->required();
    add_mesh_unit(command, options.unit);
    add_renames(command, options.renames);
    command.add_option("--link", options.links, "Judge only links that this glob names; repeatable")
        ->type_name("GLOB")
        ->expected(1)
        ->take_all();
    command.add_option("-j,--threads", options.threads, "Number of threads; default: one a core")
        ->type_name("N")
        ->check(CLI::Range(std::size_t{1}, std::size_t{1024}));
}

Original original_of(Program& program, const JudgeOptions& options) {
    Original original = load_original(options.original, program.registry(), options.links, options.unit);
    for (const std::string& note : original.notes) {
        tell(fmt::format("warning: {}: {}", options.original, note));
    }
    return original;
}

MatchedModel model_of(Program& program, const JudgeOptions& options, const Original& original,
                      const std::string& file) {
    MatchedModel model = match(original, read_sphere_file(file, program.registry()), renames_of(options.renames));
    for (const std::string& note : model.notes) {
        tell(fmt::format("warning: {}: {}", file, note));
    }
    return model;
}

void write_whole_file(const std::filesystem::path& file, const std::string& text) {
    const std::filesystem::path partial = file.string() + fmt::format(".partial-{}", getpid());
    std::ofstream stream(partial, std::ios::binary | std::ios::trunc);
    stream << text;
    stream.close();
    std::error_code error = stream ? std::error_code() : std::make_error_code(std::errc::io_error);
    if (!error) {
        std::filesystem::rename(partial, file, error);
    }
    if (error) {
        std::error_code ignored;
        std::filesystem::remove(partial, ignored);
        throw Error(ErrorCode::output, fmt::format("{}: it cannot be written; remedy: check that its folder exists and "
                                                   "has room",
                                                   file.string()));
    }
}

std::string millimetres(double metres, int digits) {
    return std::isfinite(metres) ? fmt::format("{:.{}f}", 1000 * metres, digits) : "inf";
}

Json json_number(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json json_of(const Figures& figures) {
    const Measures& m = figures.measures;
    return {{"spheres", m.spheres},
            {"area_m2", m.area},
            {"volume_m3", m.volume},
            {"covered", m.covered},
            {"covered_standard_error", figures.covered_error},
            {"gap_m", json_number(m.gap)},
            {"excess", json_number(m.excess)},
            {"excess_standard_error", json_number(m.excess_error)},
            {"missing", json_number(m.missing)},
            {"missing_standard_error", json_number(m.missing_error)},
            {"protrusion_max_m", m.protrusion_max},
            {"protrusion_mean_m", m.protrusion_mean},
            {"volume_ratio", json_number(1 + m.excess - m.missing)},
            {"certified", m.certified}};
}

Json json_of(const Original& original, const MatchedModel& model, const Evaluation& evaluation) {
    Json json{{"model", model.file.file.string()},
              {"format", model.file.format},
              {"notes", model.notes},
              {"total", json_of(evaluation.total)},
              {"with_spheres", json_of(evaluation.with_spheres)},
              {"links", Json::array()}};
    for (std::size_t i = 0; i < original.links.size(); ++i) {
        Json link{{"link", original.links[i].link}};
        link.update(json_of(evaluation.links[i]));
        json["links"].push_back(std::move(link));
    }
    return json;
}

std::size_t sphere_count(const MatchedModel& model) {
    std::size_t count = 0;
    for (const std::vector<Sphere>& spheres : model.spheres) {
        count += spheres.size();
    }
    return count;
}

} // namespace foam::cli
