// foam compare: several sphere models of one robot.
#include "cli/files.hpp"
#include "cli/messages.hpp"
#include "commands.hpp"
#include "judge.hpp"

#include <foam/base/parallel.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>

namespace foam::cli {
namespace {

struct CompareArguments {
    JudgeOptions judge;
    std::vector<std::string> models;
    std::string html;
    std::uint64_t seed = 0;
    bool json = false, force = false;
};

/// A, B, …, Z, then 27, 28, …
std::string label_of(std::size_t i) {
    return i < 26 ? std::string(1, static_cast<char>('A' + i)) : std::to_string(i + 1);
}

/// None, with a warning, if there is no renderer.
Pictures pictures_of(Program& program, const Comparison& comparison) {
    const Registry& registry = program.registry();
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind == StageKind::renderer) {
            QuietContext context;
            const auto renderer = registry.make<Renderer>(name);
            Pictures pictures{renderer->render(figure_of(comparison), context).png, {}};
            for (std::size_t i = 0; comparison.original.links.size() > 1 && i < comparison.original.links.size(); ++i) {
                pictures.links.push_back(renderer->render(figure_of_link(comparison, i), context).png);
            }
            return pictures;
        }
    }
    tell("warning: no plugin renders pictures; the page has none");
    return {};
}

int compare_models(Program& program, const CompareArguments& arguments) {
    const ThreadLimit limit(arguments.judge.threads);
    std::vector<std::filesystem::path> inputs(arguments.models.begin(), arguments.models.end());
    inputs.emplace_back(arguments.judge.original);
    refuse_overwriting(arguments.html, inputs, arguments.force);
    Comparison comparison{original_of(program, arguments.judge), {}};
    for (const std::string& file : arguments.models) {
        MatchedModel model = model_of(program, arguments.judge, comparison.original, file, false);
        Evaluation evaluation = evaluate(comparison.original, model, arguments.seed);
        comparison.models.push_back({label_of(comparison.models.size()), std::move(model), std::move(evaluation)});
    }
    std::vector<const SphereFile*> files;
    for (const JudgedModel& judged : comparison.models) {
        files.push_back(&judged.model.file);
    }
    require_renames(arguments.judge.renames, files);
    if (!arguments.html.empty()) {
        write_whole_file(arguments.html, with_names(html_of(comparison, pictures_of(program, comparison))));
        tell(fmt::format("written: {}", arguments.html));
    }
    if (arguments.json) {
        print_json(json_of(comparison));
    } else {
        print(table_of(comparison));
    }
    return 0;
}

} // namespace

void add_compare(Program& program) {
    CLI::App* command = add_command(program, "compare", "Evaluate several models of one robot side by side",
                                    "  foam compare robot.urdf a.urdf b.yaml c.json\n"
                                    "  foam compare robot.urdf a.urdf b.urdf --html comparison.html\n"
                                    "\n"
                                    "The figures are those of `foam evaluate`.");
    auto arguments = std::make_shared<CompareArguments>();
    add_judge_options(*command, program, arguments->judge);
    command
        ->add_option("models", arguments->models,
                     "The models, spheres or other elements; one may be -, the standard input")
        ->type_name("MODEL")
        ->required();
    program.standard_input.may_be(arguments->models, StandardInput::Holds::model);
    command->add_option("--html", arguments->html, "Also write one HTML file with tables and pictures")
        ->type_name("FILE");
    add_force(*command, arguments->force);
    command->add_option("--seed", arguments->seed, "Seed of the samples; default: 0")
        ->type_name("N")
        ->check(whole_number());
    command->add_flag("--json", arguments->json, "Print the figures as JSON, in metres instead of millimetres");
    command->callback([&program, arguments] {
        program.action = [&program, arguments] { return compare_models(program, *arguments); };
    });
}

} // namespace foam::cli
