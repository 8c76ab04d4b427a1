#include <foam/runtime/internal/cover.hpp>
#include <foam/runtime/internal/output.hpp>

#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

class Album {
public:
    Album(const Workspace& workspace, const RunDirectory& directory) : workspace_(workspace), directory_(directory) {
        const std::string& named = workspace.recipe.renderer.stage;
        stage_ = named.empty() ? "snapshot.osmesa" : named;
        renderer_ = workspace.registry.make<Renderer>(stage_, workspace.recipe.renderer.given);
    }

    /// Returns the PNG.
    std::string add(const std::filesystem::path& file, const std::string& link, const Figure& figure) {
        StageReport report;
        Image image = run_stage(workspace_, stage_, link, file.string(), file.string(), report,
                                [&](Context& context) { return renderer_->render(figure, context); });
        directory_.write(file, image.png);
        files.push_back(file);
        return std::move(image.png);
    }

    std::vector<std::filesystem::path> files;

private:
    const Workspace& workspace_;
    const RunDirectory& directory_;
    std::string stage_;
    std::unique_ptr<Renderer> renderer_;
};

std::shared_ptr<const Mesh> shared_mesh(const LinkWork& link, std::size_t stage) {
    return std::make_shared<const Mesh>(link_mesh(link, stage));
}

Figure robot_figure(const Recipe& recipe, const FinishedModel& finished) {
    const Robot& robot = *finished.model.robot;
    const auto poses = link_poses(robot, recipe.pose);
    Figure figure;
    figure.width = recipe.snapshot_size[0];
    figure.height = recipe.snapshot_size[1];
    KindCounts kinds{};
    Panel panel;
    for (const FinishedLink& link : finished.links) {
        const auto pose = poses.find(link.work->link->name);
        if (pose == poses.end()) {
            continue;
        }
        panel.meshes.push_back({shared_mesh(*link.work, 0), pose->second, true});
        add_elements(panel, link.elements, pose->second);
        kinds = sum_of(kinds, kinds_of(link.elements));
    }
    figure.title = fmt::format("{}: {}", finished.model.name, counts_text(kinds));
    figure.panels = {std::move(panel)};
    return figure;
}

/// Returns the figure of a link over its elements, half as wide and high as that of the robot: there are many.
Figure link_figure(const Recipe& recipe, const FinishedLink& link) {
    constexpr int smallest = 16; // pixels
    Figure figure;
    figure.width = std::max(smallest, recipe.snapshot_size[0] / 2);
    figure.height = std::max(smallest, recipe.snapshot_size[1] / 2);
    const Measures& m = link.work->report.measures;
    const bool inner = recipe.guarantee == Guarantee::inner;
    const std::string gap = fmt::format("gap {:.1f} mm", 1000 * m.gap);
    figure.title = fmt::format("{}: {}, {} {:.2f}, {}", link.work->link->name, counts_text(kinds_of(link.elements)),
                               inner ? "missing" : "excess", inner ? m.missing : m.excess,
                               !m.certified    ? gap
                               : inner         ? "proved inside"
                               : m.missing > 0 ? "cover of the surface proved"
                                               : "cover proved");
    Panel panel;
    panel.meshes.push_back({shared_mesh(*link.work, 0), Pose{}, true});
    add_elements(panel, link.elements, {});
    figure.panels = {std::move(panel)};
    return figure;
}

/// Returns the figure original → after each filter → spheres, as the figures of Coumar et al. 2025 show a link.
Figure stages_figure(const FinishedLink& link) {
    Figure figure;
    figure.title = link.work->link->name;
    const auto& filters = link.work->recipe.filters;
    for (std::size_t stage = 0; stage <= filters.size(); ++stage) {
        const auto mesh = shared_mesh(*link.work, stage);
        Panel panel;
        panel.caption = fmt::format("{} ({} triangles)", stage == 0 ? "original" : filters[stage - 1].stage,
                                    mesh->triangles.size());
        panel.meshes.push_back({mesh, Pose{}, false});
        figure.panels.push_back(std::move(panel));
    }
    Panel spheres;
    spheres.caption =
        fmt::format("{} ({})", link.work->recipe.spherizer.stage, counts_text(kinds_of(link.elements)));
    add_elements(spheres, link.elements, {});
    figure.panels.push_back(std::move(spheres));
    figure.width = 480 * static_cast<int>(figure.panels.size());
    figure.height = 560;
    return figure;
}

/// Draws all pictures. `robot`: receives the robot's picture.
void fill(Album& album, const Recipe& recipe, const FinishedModel& finished, std::string& robot) {
    if (recipe.snapshots) {
        robot = album.add("snapshots/robot.png", "", robot_figure(recipe, finished));
    }
    for (const FinishedLink& link : finished.links) {
        const std::string& name = link.work->link->name;
        const std::filesystem::path folder = std::filesystem::path("links") / folder_name(name);
        if (recipe.debug_snapshots) {
            album.add(folder / "spheres.png", name, link_figure(recipe, link));
            album.add(folder / "stages.png", name, stages_figure(link));
        }
    }
}

} // namespace

Snapshots write_snapshots(const Workspace& workspace, const FinishedModel& finished, const RunDirectory& directory) {
    const Recipe& recipe = workspace.recipe;
    if (!recipe.snapshots && !recipe.debug_snapshots) {
        return {};
    }
    workspace.journal.expect((recipe.snapshots ? 1 : 0) + (recipe.debug_snapshots ? 2 * finished.links.size() : 0));
    Album album(workspace, directory);
    std::string robot;
    try {
        fill(album, recipe, finished, robot);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled || workspace.in(Phase::finishing).ended()) {
            throw;
        }
        workspace.journal.finding(
            {Severity::warning, "", "", fmt::format("{}: pictures are missing", why_dropped(workspace))});
    }
    return {std::move(album.files), std::move(robot)};
}

} // namespace foam::runtime
