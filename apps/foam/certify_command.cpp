// foam certify: the proof alone.
#include "commands.hpp"
#include "judge.hpp"

#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <cctype>

namespace foam::cli {
namespace {

struct CertifyArguments {
    JudgeOptions judge;
    std::string model, guarantee = "outer";
    bool json = false;
};

constexpr int not_certified = 1;

std::string point_text(const Vec3& p) {
    return fmt::format("[{:.6f}, {:.6f}, {:.6f}]", p.x, p.y, p.z);
}

/// The links whose proof fails, with the place where it does.
std::string table_of_proofs(const Original& original, const MatchedModel& model, const std::vector<LinkProof>& proofs,
                            bool outer) {
    const std::size_t width = column_width("link", original.links, &OriginalLink::link);
    const std::string length = outer ? "growth mm" : "protrusion mm";
    std::string table = fmt::format("{:<{}}  {}  {:>8}  {}\n", "link", width, length, outer ? "triangle" : "sphere",
                                    outer ? "witness, m" : "center, m");
    for (std::size_t i = 0; i < proofs.size(); ++i) {
        if (proofs[i].holds) {
            continue;
        }
        if (outer && model.elements[i].empty()) {
            table += padded(original.links[i].link, width) + fmt::format("  {}\n", no_elements);
            continue;
        }
        const std::string place = !outer              ? std::to_string(proofs[i].sphere)
                                  : proofs[i].cavity ? "inside"
                                                     : std::to_string(proofs[i].triangle);
        table += fmt::format("{}  {:>{}}  {:>8}  {}\n", padded(original.links[i].link, width),
                             millimetres(proofs[i].growth, 6), length.size(), place, point_text(proofs[i].witness));
    }
    return table;
}

std::string with_capital(std::string text) {
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

int certify_spheres(Program& program, const CertifyArguments& arguments) {
    const ThreadLimit limit(arguments.judge.threads);
    const bool outer = arguments.guarantee == "outer";
    const Original original = original_of(program, arguments.judge);
    const MatchedModel model = model_of(program, arguments.judge, original, arguments.model);
    const std::vector<LinkProof> proofs = prove(original, model, outer ? Guarantee::outer : Guarantee::inner);
    const ProvedLinks proved = proved_links(original, model, proofs, outer ? Guarantee::outer : Guarantee::inner);
    // Those that --keep and --skip leave out are not asked for: the exit code is of the others, the verdict of the whole robot.
    const auto failed = std::count_if(proofs.begin(), proofs.end(), [](const LinkProof& p) { return !p.holds; });
    if (arguments.json) {
        const nlohmann::ordered_json json{{"original", arguments.judge.original},
                                          {"model", arguments.model},
                                          {"model_format", model.file.format},
                                          {"guarantee", arguments.guarantee},
                                          {"certified", proved.all()},
                                          {"proof", json_of_proof<nlohmann::ordered_json>(proved)},
                                          {"notes", model.notes},
                                          {"links", json_of_proofs<nlohmann::ordered_json>(original, proofs, outer)}};
        print_json(json);
    } else if (failed == 0) {
        const KindCounts kinds = kinds_of_model(model);
        std::string more;
        for (const std::string& sentence : {surfaces_text(proved), missing_text(proved)}) {
            more += sentence.empty() ? "" : with_capital(sentence) + ".\n";
        }
        print(fmt::format("Certified{} ({}): {} on {}{}{}, {}.\n{}", proved.all() ? "" : " in part", arguments.guarantee,
                          outer ? fmt::format("the geometry lies inside the {}", proved.elements)
                                : fmt::format("the {} lie inside the geometry", proved.elements),
                          proved.all() ? "" : fmt::format("{} of ", proofs.size()),
                          counted(proved.with_geometry, "link"), outer ? ", " + as_what(proved) : "",
                          counts_text(kinds), more) +
              not_judged_text(proved));
    } else {
        const char* const remedy = outer ? "Remedy: make the model again of this geometry, by foam spherize, "
                                           "foam approximate or foam run.\n"
                                         : "";
        print(table_of_proofs(original, model, proofs, outer) +
              fmt::format("Not certified ({}): {} of {}.\n{}", arguments.guarantee, failed,
                          counted(proofs.size(), "link"), remedy) +
              not_judged_text(proved));
    }
    return failed == 0 ? 0 : not_certified;
}

} // namespace

void add_certify(Program& program) {
    CLI::App* command = add_command(program, "certify", "Prove that elements cover a geometry, or find a gap",
                                    "  foam certify robot.urdf robot_spheres.urdf\n"
                                    "  foam certify part.stl part.json --json\n"
                                    "\n"
                                    "The proof covers every triangle of the raw geometry. If it fails, foam prints\n"
                                    "a point outside the elements (witness), and the length by which the nearest\n"
                                    "element would have to grow to cover it (growth).\n"
                                    "Exit codes: 0 certified, 1 not certified, 2 invalid command line. They are of\n"
                                    "the links that were asked for.");
    auto arguments = std::make_shared<CertifyArguments>();
    add_judge_options(*command, program, arguments->judge);
    command->add_option("model", arguments->model, "The model, spheres or other elements; - is the standard input")
        ->type_name("MODEL")
        ->required();
    program.standard_input.may_be(arguments->model, StandardInput::Holds::model);
    command
        ->add_option("--guarantee", arguments->guarantee,
                     "outer: the geometry lies inside the elements; inner: the elements lie inside the geometry")
        ->type_name("outer|inner")
        ->capture_default_str()
        ->check(CLI::IsMember({"outer", "inner"}).description(""));
    command->add_flag("--json", arguments->json, "Print the proof of each link as JSON");
    command->callback([&program, arguments] {
        program.action = [&program, arguments] { return certify_spheres(program, *arguments); };
    });
}

} // namespace foam::cli
