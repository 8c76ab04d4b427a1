#include <foam/runtime/internal/links.hpp>

#include "allocate/allocation.hpp"
#include "finish/finish.hpp"
#include "input/inputs.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/internal/solids.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace foam::inline runtime {

static std::vector<Solid::Part> parts_of(const LoadedLink& link, const std::vector<std::size_t>& elements) {
    std::vector<Solid::Part> parts;
    for (const std::size_t e : elements) {
        const CollisionElement& element = link.elements[e];
        Solid::Part part;
        part.covers = link.covers;
        if (const Element* primitive = element.primitive()) {
            part.primitive = *primitive;
            part.pose = element.source->origin;
        } else {
            const Pose& origin = element.source->origin;
            part.mesh =
                origin == Pose{} ? element.raw : std::make_shared<const Mesh>(transformed(*element.raw, origin));
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

std::shared_ptr<const Solid> solid_of(const LoadedLink& link, const std::vector<std::size_t>& elements) {
    return Solid::make(parts_of(link, elements));
}

namespace {

std::vector<std::size_t> all_elements(const LoadedLink& link) {
    std::vector<std::size_t> elements(link.elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e) {
        elements[e] = e;
    }
    return elements;
}

Measures measured(const Workspace& workspace, const Solid& solid, const Elements& elements) {
    MeasureOptions options;
    options.seed = workspace.recipe.seed;
    Measures measures = measure(solid, elements, options);
    switch (workspace.recipe.guarantee) {
    case Guarantee::outer: // as measured
        break;
    case Guarantee::inner:
        measures.certified = elements.are_spheres() && certify_inner(solid, elements.spheres()).holds;
        break;
    case Guarantee::fitted:
        measures.certified = false;
    }
    return measures;
}

/// Returns bounds on the measures of covering elements, where there is no time to measure.
Measures bounded(const Workspace& workspace, const Solid& solid, const Elements& elements) {
    Measures bounds = geometry::bounds_of_measures(solid, elements);
    bounds.certified = bounds.certified && workspace.recipe.guarantee == Guarantee::outer;
    return bounds;
}

/// Returns the measures of a solid whose inside counts as geometry; what is proved and how much of the surface is
/// covered is that of the solid itself. `full`: the solid with its inside, `volume`: of what was filled, m³.
Measures measured_filled(const Workspace& workspace, const std::shared_ptr<const Solid>& solid,
                         const std::shared_ptr<const Solid>& full, const Elements& elements, double& volume) {
    const Measures own = measured(workspace, *solid, elements);
    if (full == solid) {
        return own;
    }
    volume = std::max(0.0, full->volume() - solid->volume());
    Measures measures = measured(workspace, *full, elements);
    measures.certified = own.certified;
    measures.gap = own.gap;
    measures.covered = own.covered;
    measures.area = own.area;
    return measures;
}

/// Tells that figures of a link are bounds.
void tell_bounds(const Workspace& workspace, const LinkWork& link) {
    workspace.journal.finding(
        {Severity::warning, link.link->name, "measure",
         fmt::format("the time limit of {} s is too short to measure its elements: its excess and protrusion are "
                     "bounds, as if the link had no volume; the proof is as usual",
                     *workspace.time_limit())});
}

/// Reports the half-space constraints on the numbers that are written.
void report_planes(const Workspace& workspace, LinkWork& link, const Elements& elements) {
    link.report.clip = reached(link.recipe.clip, elements);
    for (const std::string& sentence : not_kept(link.report.clip)) {
        workspace.journal.finding({Severity::warning, link.link->name, "", sentence});
    }
}

/// Returns whether `body` ended within the time for growing and measuring. Where nothing else can be written, it lets
/// Error(cancelled) pass.
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

/// Returns the vertices of a loaded link in its frame; empty if it was not loaded or was refused.
std::vector<Vec3> vertices_of(const LinkWork& link) {
    std::vector<Vec3> points;
    if (!is_workable(link)) {
        return points;
    }
    for (const CollisionElement& element : link.elements) {
        const Element* primitive = element.primitive();
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

/// Returns whether one enclosing sphere may replace the spherizer's spheres if those have more excess volume: not with
/// another objective than excess, nor with half-space constraints or kept spheres.
bool one_may_stand_in(const Workspace& workspace, const LinkWork& link) {
    return link.recipe.clip.empty() && link.recipe.keep.empty() &&
           objective_of(link.recipe.spherizer, workspace.registry) == Objective::excess;
}

/// Throws Error(geometry) if the proof does not hold for a whole link. Proofs allow for rounding in proportion to the
/// distances in the frame, which may be larger in the link's frame than in those of its elements.
void require_proof(const Workspace& workspace, const LinkWork& link) {
    if (workspace.recipe.guarantee != Guarantee::fitted && !link.report.measures.certified) {
        throw Error(ErrorCode::geometry,
                    fmt::format("link '{}': its collision elements are too small for the distance between them: the "
                                "proof of each in its own frame does not hold in the link's frame; remedy: per: link",
                                shown(link.link->name)));
    }
}

/// Finishes groups of spheres for the model: grows them to cover, then measures them.
class Finishing {
public:
    Finishing(const Workspace& workspace, const std::vector<LinkWork>& links, std::vector<Group>& groups,
              std::vector<SphereGroup>& out)
        : growth(groups.size()), reports(groups.size()), unpadded(groups.size()), filled(groups.size()),
          workspace_(workspace), links_(links), groups_(groups), out_(out) {
        out.resize(groups.size());
    }

    void cover(std::size_t g) {
        Group& group = groups_[g];
        const LinkWork& link = links_[group.link];
        out_[g].link = link.link->name;
        for (const std::size_t e : group.elements) {
            out_[g].geometries.push_back(link.elements[e].geometry);
        }
        if (!group.solid) {
            group.solid = solid_of(link, group.elements);
        }
        reports[g][0].input = reports[g][1].input = out_[g].geometries.front();
        if (group.in_haste) {
            cover_by(g, group.tree, workspace_);
        } else if (!done_in_time(workspace_, [&] { cover_by(g, group.tree, workspace_.in(Phase::covering)); })) {
            cover_by_one(g);
        }
    }

    void measure(std::size_t g) {
        if (groups_[g].in_haste || !done_in_time(workspace_, [&] { measure(g, workspace_.in(Phase::covering)); })) {
            if (!groups_[g].in_haste && workspace_.recipe.guarantee == Guarantee::fitted) {
                cover_by_one(g); // bounds are of covering elements
            }
            groups_[g].in_haste = true;
            measure(g, workspace_);
        }
        reports[g][0].output = digest_of_content(out_[g].tree);
        reports[g][1].output = digest_of_content(out_[g].measures);
    }

    /// Adds the recipe's padding to the radii and measures them again.
    void pad(std::size_t g) {
        const double length = links_[groups_[g].link].recipe.pad;
        if (length > 0) {
            out_[g].tree = padded(*groups_[g].solid, std::move(out_[g].tree), length);
            unpadded[g] = out_[g].measures;
            measure(g, workspace_);
            reports[g][0].output = digest_of_content(out_[g].tree);
            reports[g][1].output = digest_of_content(out_[g].measures);
        }
    }

    std::vector<double> growth;                      ///< m
    std::vector<std::array<StageReport, 2>> reports; ///< of growth and measures
    std::vector<Measures> unpadded;                  ///< of groups with padding
    std::vector<double> filled;                      ///< m³; of hollow insides that count as geometry

private:
    void cover_by(std::size_t g, const SphereTree& tree, const Workspace& in_time) {
        SphereGroup& out = out_[g];
        const bool one_may_do = one_may_stand_in(workspace_, links_[groups_[g].link]);
        FinishedTree finished = run_stage(in_time, "cover", out.link, out.geometries.front(), "", reports[g][0],
                                          [&](Context&) { return finished_group(g, tree, one_may_do); });
        if (finished.one_instead) {
            workspace_.journal.finding({Severity::warning, out.link, "cover",
                                        "one enclosing sphere is written, because the spheres of the spherizer have "
                                        "more excess volume; remedy: more spheres, or another spherizer"});
        }
        out.tree = std::move(finished.tree);
        growth[g] = finished.growth;
    }

    /// Returns the finished tree of a group, with the spheres that its link keeps.
    FinishedTree finished_group(std::size_t g, const SphereTree& tree, bool one_may_do) const {
        const Group& group = groups_[g];
        const std::vector<Sphere>& kept = links_[group.link].recipe.keep;
        const auto finished = [&](const Solid& solid) {
            return finished_tree(solid, tree, workspace_.recipe.guarantee, one_may_do,
                                 workspace_.recipe.proved_numbers(workspace_.registry));
        };
        if (kept.empty()) {
            return finished(*group.solid);
        }
        if (!group.uncovered) {
            return {.tree = flat_tree(kept), .growth = 0, .one_instead = false};
        }
        const auto beside = [&](const Solid& solid) {
            FinishedTree result = finished(solid);
            result.tree = with_kept(kept, beside_kept(*group.solid, std::move(result.tree)));
            return result;
        };
        FinishedTree result = beside(*group.uncovered);
        const bool outer = workspace_.recipe.guarantee == Guarantee::outer;
        return !outer || covers(*group.solid, result.tree.elements()) ? result : beside(*group.solid); // with a cavity
    }

    void cover_by_one(std::size_t g) {
        workspace_.journal.finding({Severity::warning, out_[g].link, "",
                                    fmt::format("the time limit of {} s is too short to make its {} cover the "
                                                "link and to measure them; one enclosing sphere replaces them",
                                                *workspace_.time_limit(), counts_text(kinds_of(groups_[g].tree.elements())))});
        const Solid& solid = groups_[g].uncovered ? *groups_[g].uncovered : *groups_[g].solid;
        cover_by(g, flat_tree({enclosing_ball(solid)}), workspace_);
    }

    void measure(std::size_t g, const Workspace& in_time) {
        SphereGroup& out = out_[g];
        const bool fill = links_[groups_[g].link].recipe.hollow == Hollow::fill;
        Group& group = groups_[g];
        out.measures =
            run_stage(in_time, "measure", out.link, out.geometries.front(), "", reports[g][1], [&](Context&) {
                if (group.in_haste) {
                    return bounded(workspace_, *group.solid, out.tree.elements());
                }
                if (!fill) {
                    return measured(workspace_, *group.solid, out.tree.elements());
                }
                if (!group.filled) {
                    group.filled = geometry::filled(group.solid);
                }
                return measured_filled(workspace_, group.solid, group.filled, out.tree.elements(), filled[g]);
            });
    }

    const Workspace& workspace_;
    const std::vector<LinkWork>& links_;
    std::vector<Group>& groups_;
    std::vector<SphereGroup>& out_;
};

/// Measures the elements of all groups of a link.
void measure_whole(const Workspace& workspace, const FinishedLink& link, LinkWork& work) {
    const Elements& elements = link.elements;
    const auto measure = [&] {
        const StopScope scope(workspace.in(Phase::covering).request());
        work.report.measures = work.recipe.hollow == Hollow::fill
                                   ? measured_filled(workspace, link.solid, geometry::filled(link.solid), elements,
                                                     work.report.filled)
                                   : measured(workspace, *link.solid, elements);
    };
    if (work.bounds_only || !done_in_time(workspace, measure)) {
        work.bounds_only = true;
        work.report.measures = bounded(workspace, *link.solid, elements);
    }
}

} // namespace

std::shared_ptr<const Solid> solid_of(const LoadedLink& link) {
    return solid_of(link, all_elements(link));
}

Sphere enclosing_ball(const Solid& solid) {
    constexpr double margin = 1e-5; // above that of decimal numbers, a millionth of the size
    Sphere ball = minimum_enclosing_sphere(solid.surface().vertices);
    ball.radius += margin * solid.bounds().diagonal();
    return ball;
}

std::shared_ptr<const Solid> quick_solid_of(const LoadedLink& link) {
    return geometry::quick_solid(parts_of(link, all_elements(link)));
}

FinishedModel finish_links(const Workspace& workspace, std::shared_ptr<const Robot> robot, std::vector<LinkWork>& links,
                           std::vector<Group> groups) {
    FinishedModel result;
    result.model.name = workspace.recipe.name;
    result.model.guarantee = workspace.recipe.guarantee;
    result.model.robot = std::move(robot);
    Finishing finishing(workspace, links, groups, result.model.groups);
    workspace.journal.begin("growth");
    workspace.journal.expect(groups.size());
    parallel_for(groups.size(), [&](std::size_t g) { finishing.cover(g); });
    workspace.journal.begin("measures");
    workspace.journal.expect(groups.size());
    parallel_for(groups.size(), [&](std::size_t g) {
        finishing.measure(g);
        finishing.pad(g);
    });
    for (std::size_t l = 0; l < links.size(); ++l) {
        FinishedLink link;
        link.work = &links[l];
        std::size_t parts = 0;
        links[l].bounds_only = false;
        std::vector<Measures> unpadded;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            if (groups[g].link == l) {
                link.elements.add(result.model.groups[g].tree.elements());
                links[l].report.growth = std::max(links[l].report.growth, finishing.growth[g]);
                links[l].report.measures = result.model.groups[g].measures;
                unpadded.push_back(finishing.unpadded[g]);
                links[l].report.filled += finishing.filled[g];
                links[l].report.stages.insert(links[l].report.stages.end(), finishing.reports[g].begin(),
                                              finishing.reports[g].end());
                link.solid = groups[g].solid;
                links[l].bounds_only = links[l].bounds_only || groups[g].in_haste;
                ++parts;
            }
        }
        if (parts > 0) {
            if (parts > 1) {
                link.solid = solid_of(links[l]);
                measure_whole(workspace, link, links[l]);
                require_proof(workspace, links[l]);
            }
            if (links[l].bounds_only) {
                tell_bounds(workspace, links[l]);
            }
            if (links[l].recipe.pad > 0) {
                links[l].report.pad = links[l].recipe.pad;
                links[l].report.unpadded = total(unpadded);
            }
            links[l].report.kinds = kinds_of(link.elements);
            report_planes(workspace, links[l], link.elements);
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
            {Severity::warning, links[l].link->name, "", "one enclosing sphere replaces the link: " + message});
        Group group;
        group.link = l;
        group.elements = all_elements(links[l]);
        group.tree.levels.resize(1);
        group.tree.levels[0].elements.spheres() = {minimum_enclosing_sphere(points)};
        groups.push_back(std::move(group));
    }
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.link < b.link; });
    return lost;
}

} // namespace foam::runtime
