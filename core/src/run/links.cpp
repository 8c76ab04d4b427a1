#include "links.hpp"

#include "clip.hpp"
#include "cover.hpp"
#include "own_frame.hpp"

#include <foam/inner.hpp>
#include <foam/measure.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace foam {

std::shared_ptr<const Solid> solid_of(const LinkWork& link, const std::vector<std::size_t>& elements) {
    std::vector<Solid::Part> parts;
    for (const std::size_t e : elements) {
        const Element& element = link.elements[e];
        Solid::Part part;
        if (const Primitive* primitive = element.primitive()) {
            part.primitive = *primitive;
            part.pose = element.source->origin;
        } else {
            part.mesh = std::make_shared<const Mesh>(transformed(*element.raw, element.source->origin));
        }
        parts.push_back(std::move(part));
    }
    return Solid::make(std::move(parts));
}

namespace {

std::vector<std::size_t> all_elements(const LinkWork& link) {
    std::vector<std::size_t> elements(link.elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e) {
        elements[e] = e;
    }
    return elements;
}

Measures measured(const Workspace& workspace, const Solid& solid, const std::vector<Sphere>& spheres) {
    MeasureOptions options;
    options.seed = workspace.recipe.seed;
    Measures measures = measure(solid, spheres, options);
    switch (workspace.recipe.guarantee) {
    case Guarantee::outer: // as measured
        break;
    case Guarantee::inner:
        measures.certified = certify_inner(solid, spheres).holds;
        break;
    case Guarantee::fitted:
        measures.certified = false;
    }
    return measures;
}

/// On the numbers that are written.
void report_planes(const Workspace& workspace, LinkWork& link, const std::vector<Sphere>& spheres) {
    link.report.clip = reached(link.recipe.clip, spheres);
    for (const std::string& sentence : not_kept(link.report.clip)) {
        workspace.journal.finding({Severity::warning, link.link->name, "", sentence});
    }
}

/// Whether `body` ended before the time to cover and measure was over. Where there is nothing to write instead it
/// ends by Error(cancelled).
template <class Body> bool done_in_time(const Workspace& workspace, Body body) {
    try {
        body();
        return true;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled || workspace.ended() ||
            workspace.recipe.guarantee == Guarantee::inner) {
            throw;
        }
        return false;
    }
}

/// The vertices of a link that was loaded, in its frame; empty if it was not, or was refused.
std::vector<Vec3> vertices_of(const LinkWork& link) {
    std::vector<Vec3> points;
    if (!is_workable(link)) {
        return points;
    }
    for (const Element& element : link.elements) {
        const Primitive* primitive = element.primitive();
        if (!primitive && !element.raw) {
            return {};
        }
        const Mesh mesh = primitive ? enclosing_mesh(*primitive) : *element.raw;
        for (const Vec3& vertex : mesh.vertices) {
            points.push_back(element.source->origin * vertex);
        }
    }
    return points;
}

} // namespace

std::shared_ptr<const Solid> solid_of(const LinkWork& link) {
    return solid_of(link, all_elements(link));
}

FinishedModel finish_links(const Workspace& workspace, std::shared_ptr<const Robot> robot, std::vector<LinkWork>& links,
                           std::vector<Group> groups) {
    FinishedModel result;
    result.model.name = workspace.recipe.name;
    result.model.guarantee = workspace.recipe.guarantee;
    result.model.robot = std::move(robot);
    result.model.groups.resize(groups.size());
    std::vector<double> growth(groups.size());
    std::vector<std::array<StageReport, 2>> reports(groups.size());
    workspace.journal.expect(2 * groups.size());
    parallel_for(groups.size(), [&](std::size_t g) {
        LinkWork& link = links[groups[g].link];
        auto& [covering, measuring] = reports[g];
        SphereGroup& out = result.model.groups[g];
        out.link = link.link->name;
        for (const std::size_t e : groups[g].elements) {
            out.geometries.push_back(link.elements[e].geometry);
        }
        if (!groups[g].solid) {
            groups[g].solid = solid_of(link, groups[g].elements);
        }
        const Solid& solid = *groups[g].solid;
        covering.input = measuring.input = out.geometries.front();
        const auto finish = [&](const Workspace& in_time, const SphereTree& tree) {
            FinishedTree finished =
                run_stage(in_time, "cover", out.link, out.geometries.front(), "", covering,
                          [&](Context&) { return finished_tree(solid, tree, workspace.recipe.guarantee); });
            out.tree = std::move(finished.tree);
            growth[g] = finished.growth;
            out.measures = run_stage(in_time, "measure", out.link, out.geometries.front(), "", measuring,
                                     [&](Context&) { return measured(workspace, solid, out.tree.finest()); });
        };
        if (!done_in_time(workspace, [&] { finish(workspace.in(Phase::covering), groups[g].tree); })) {
            workspace.journal.finding(
                {Severity::warning, out.link, "",
                 fmt::format("there is no time before the limit of {} s is over to make its {} spheres cover and to "
                             "measure them: one enclosing sphere stands in",
                             *workspace.time_limit(), groups[g].tree.finest().size())});
            finish(workspace, flat_tree({minimum_enclosing_sphere(solid.surface().vertices)}));
        }
        covering.output = digest_of_content(out.tree);
        measuring.output = digest_of_content(out.measures);
    });
    for (std::size_t l = 0; l < links.size(); ++l) {
        FinishedLink link;
        link.work = &links[l];
        std::size_t parts = 0;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            if (groups[g].link == l) {
                const auto& spheres = result.model.groups[g].tree.finest();
                link.spheres.insert(link.spheres.end(), spheres.begin(), spheres.end());
                links[l].report.growth = std::max(links[l].report.growth, growth[g]);
                links[l].report.measures = result.model.groups[g].measures;
                links[l].report.stages.insert(links[l].report.stages.end(), reports[g].begin(), reports[g].end());
                link.solid = groups[g].solid;
                ++parts;
            }
        }
        if (parts > 0) {
            if (parts > 1) {
                link.solid = solid_of(links[l]);
                links[l].report.measures = measured(workspace, *link.solid, link.spheres);
            }
            report_planes(workspace, links[l], link.spheres);
            result.links.push_back(std::move(link));
        }
    }
    return result;
}

bool handle_errors(const Workspace& workspace, std::vector<LinkWork>& links, std::vector<Group>& groups) {
    bool lost = false;
    for (std::size_t l = 0; l < links.size(); ++l) {
        if (!links[l].error) {
            continue;
        }
        const std::string message = links[l].error->what();
        if (workspace.recipe.on_error == OnError::stop) {
            throw *links[l].error;
        }
        const std::vector<Vec3> points =
            workspace.recipe.on_error == OnError::fallback ? vertices_of(links[l]) : std::vector<Vec3>{};
        if (points.empty()) {
            links[l].report.error = message;
            workspace.journal.finding(
                {Severity::error, links[l].link->name, "", "the link keeps its collision geometry: " + message});
            lost = true;
            continue;
        }
        workspace.journal.finding(
            {Severity::warning, links[l].link->name, "", "one enclosing sphere stands in for the link: " + message});
        Group group;
        group.link = l;
        group.elements = all_elements(links[l]);
        group.tree.levels.resize(1);
        group.tree.levels[0].spheres = {minimum_enclosing_sphere(points)};
        groups.push_back(std::move(group));
    }
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.link < b.link; });
    return lost;
}

} // namespace foam
