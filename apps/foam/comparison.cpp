#include "judge.hpp"

#include "commands.hpp"

#include <foam/robot/robot.hpp>
#include <foam/runtime/shown_elements.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::cli {
namespace {

std::string total_row(const std::string& label, const Figures& figures, const std::string& certified) {
    const Measures& m = figures.measures;
    return fmt::format("{:<5}  {:>7}  {:>9.2f}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}  {:>9}\n", label, m.spheres,
                       100 * m.covered, millimetres(m.gap), figure_text(m.excess, 3), figure_text(m.missing, 3),
                       millimetres(m.protrusion_max), millimetres(m.protrusion_mean), certified);
}

std::string cells(const Figures& figures) {
    const Measures& m = figures.measures;
    return m.spheres == 0
               ? fmt::format("  |{:>8}{:>9}{:>9}", "-", "-", "-")
               : fmt::format("  |{:>8}{:>9}{:>9}", m.spheres, figure_text(m.excess, 3), m.certified ? "0" : millimetres(m.gap));
}

std::string table_of_links(const Comparison& comparison) {
    const std::size_t width = column_width("total", comparison.original.links, &OriginalLink::link);
    std::string first = fmt::format("{:<{}}", "", width), second = fmt::format("{:<{}}", "link", width);
    for (const JudgedModel& judged : comparison.models) {
        first += fmt::format("  |  {:<24}", judged.label);
        second += fmt::format("  |{:>8}{:>9}{:>9}", noun_of_elements(comparison), "excess", "gap mm");
    }
    std::string table = first + "\n" + second + "\n";
    for (std::size_t i = 0; i < comparison.original.links.size(); ++i) {
        table += padded(comparison.original.links[i].link, width);
        for (const JudgedModel& judged : comparison.models) {
            table += cells(judged.evaluation.links[i]);
        }
        table += "\n";
    }
    return table;
}

/// Without panels yet; `width`, `height`: of one, in pixels.
Figure empty_figure(const Comparison& comparison, int width, int height) {
    Figure figure;
    figure.width = std::min(3840, width * static_cast<int>(comparison.models.size()));
    figure.height = height;
    return figure;
}

/// `pose`: from the link's frame to the panel's.
void add_link(Panel& panel, const OriginalLink& link, const Elements& elements, const Pose& pose) {
    panel.meshes.push_back({std::shared_ptr<const Mesh>(link.solid, &link.solid->surface()), pose, true});
    add_elements(panel, elements, pose);
}

} // namespace

const char* noun_of_elements(const Comparison& comparison) {
    const bool spheres = std::all_of(comparison.models.begin(), comparison.models.end(), [](const JudgedModel& judged) {
        return spheres_alone(kinds_of_model(judged.model));
    });
    return spheres ? "spheres" : "elements";
}

std::string table_of(const Comparison& comparison) {
    std::string table, verdicts;
    for (const JudgedModel& judged : comparison.models) {
        table +=
            fmt::format("{:<3} {} ({})\n", judged.label, judged.model.file.file.string(), judged.model.file.format);
    }
    table += fmt::format("\n{:<5}  {:>7}  {:>9}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}  {:>9}\n", "model", noun_of_elements(comparison),
                         "covered %", "gap mm", "excess", "missing", "out max", "mean mm", "certified");
    for (const JudgedModel& judged : comparison.models) {
        const ProvedLinks verdict = proved_links(comparison.original, judged.model, judged.evaluation);
        table += total_row(judged.label, judged.evaluation.total, certified_cell(verdict));
        verdicts += fmt::format("{:<3} {}", judged.label, verdict_of(verdict));
    }
    return table + "\n" + table_of_links(comparison) + "\n" + verdicts;
}

nlohmann::ordered_json json_of(const Comparison& comparison) {
    nlohmann::ordered_json json{{"original", comparison.original.file.string()},
                                {"models", nlohmann::ordered_json::array()}};
    for (const JudgedModel& judged : comparison.models) {
        json["models"].push_back(
            json_of_evaluation<nlohmann::ordered_json>(comparison.original, judged.model, judged.evaluation));
    }
    return json;
}

Figure figure_of(const Comparison& comparison) {
    const auto poses = link_poses(*comparison.original.robot);
    Figure figure = empty_figure(comparison, 640, 720);
    for (const JudgedModel& judged : comparison.models) {
        Panel panel;
        panel.caption = fmt::format("{}: {}", judged.label, counts_text(kinds_of_model(judged.model)));
        for (std::size_t i = 0; i < comparison.original.links.size(); ++i) {
            const auto pose = poses.find(comparison.original.links[i].link);
            if (pose != poses.end()) {
                add_link(panel, comparison.original.links[i], judged.model.elements[i], pose->second);
            }
        }
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

Figure figure_of_link(const Comparison& comparison, std::size_t link) {
    Figure figure = empty_figure(comparison, 400, 320);
    for (const JudgedModel& judged : comparison.models) {
        const Elements& elements = judged.model.elements[link];
        Panel panel;
        panel.caption = fmt::format("{}: {}", judged.label, counts_text(kinds_of(elements)));
        add_link(panel, comparison.original.links[link], elements, Pose{});
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

} // namespace foam::cli
