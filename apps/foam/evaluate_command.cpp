// foam evaluate: every figure of a sphere model, anybody's.
#include "judge.hpp"
#include "table.hpp"

#include <fmt/format.h>

namespace foam::cli {
namespace {

struct Arguments {
    JudgeOptions judge;
    std::string spheres;
    std::uint64_t seed = 0;
    bool json = false;
};

std::string with_error(double value, double error, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f} ±{:.{}f}", value, digits, error, digits) : "inf";
}

std::string row(const std::string& name, std::size_t width, const Figures& figures) {
    const Measures& m = figures.measures;
    return fmt::format("{:<{}}  {:>7}  {:>13}  {:>9}  {:>13}  {:>13}  {:>9}  {:>9}  {:>9}\n", name, width, m.spheres,
                       with_error(100 * m.covered, 100 * figures.covered_error, 2), millimetres(m.gap),
                       with_error(m.excess, m.excess_error, 3), with_error(m.missing, m.missing_error, 3),
                       millimetres(m.protrusion_max), millimetres(m.protrusion_mean), m.certified ? "yes" : "no");
}

std::string table_of(const Original& original, const Evaluation& evaluation) {
    const std::size_t width = column_width("total", original.links, &OriginalLink::link);
    std::string table =
        fmt::format("{:<{}}  {:>7}  {:>13}  {:>9}  {:>13}  {:>13}  {:>9}  {:>9}  {:>9}\n", "link", width, "spheres",
                    "covered %", "gap mm", "excess", "missing", "out max", "mean mm", "certified");
    bool bare = false;
    for (std::size_t i = 0; i < original.links.size(); ++i) {
        table += row(original.links[i].link, width, evaluation.links[i]);
        bare = bare || evaluation.links[i].measures.spheres == 0;
    }
    if (bare) {
        table += row("links with spheres", width, evaluation.with_spheres);
    }
    return table + row("total", width, evaluation.total);
}

int evaluate_spheres(Program& program, const Arguments& arguments) {
    const ThreadLimit limit(arguments.judge.threads);
    const Original original = original_of(program, arguments.judge);
    const MatchedModel model = model_of(program, arguments.judge, original, arguments.spheres);
    const Evaluation evaluation = evaluate(original, model, arguments.seed);
    if (arguments.json) {
        nlohmann::ordered_json json{{"original", arguments.judge.original}, {"seed", arguments.seed}};
        json.update(json_of(original, model, evaluation));
        print(json.dump(2) + "\n");
    } else {
        print(fmt::format("{} ({}): {} sphere{} for {}\n", arguments.spheres, model.file.format, sphere_count(model),
                          sphere_count(model) == 1 ? "" : "s", arguments.judge.original) +
              table_of(original, evaluation));
    }
    return 0;
}

} // namespace

void add_evaluate(Program& program) {
    CLI::App* command = add_command(
        program, "evaluate", "Judge a sphere model, anybody's, by the geometry that it stands for",
        "  foam evaluate robot.urdf robot_spheres.urdf\n"
        "  foam evaluate panda.urdf franka.yml --json             cuRobo, Lula, XRDF, MorphIt, …\n"
        "  foam evaluate part.stl part.json\n"
        "  foam evaluate iiwa.urdf drake.urdf --rename iiwa_link_=lbr_iiwa_link_\n"
        "Formats are recognised by their content. covered: share of the surface in the spheres; gap: how far\n"
        "the geometry sticks out; excess, missing: volume wrongly claimed and left out, over the link's;\n"
        "out: how far spheres stick out; certified: gap 0 is proved. ±: standard error.");
    auto arguments = std::make_shared<Arguments>();
    add_judge_options(*command, arguments->judge);
    command->add_option("spheres", arguments->spheres, "The sphere model")->type_name("SPHERES")->required();
    command->add_option("--seed", arguments->seed, "Seed of the samples; default 0")->type_name("N");
    command->add_flag("--json", arguments->json, "Print the figures as JSON: metres, not millimetres");
    command->callback([&program, arguments] {
        program.action = [&program, arguments] { return evaluate_spheres(program, *arguments); };
    });
}

} // namespace foam::cli
