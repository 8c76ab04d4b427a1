#include "module.hpp"

#include "robot.hpp"
#include "work.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/search/least_element.hpp>
#include <foam/search/spherize.hpp>

#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::python {
namespace {

Effort effort_of(const std::string& word) {
    const std::optional<Effort> known = effort_named(word);
    if (!known) {
        throw Error(ErrorCode::usage, fmt::format("unknown effort '{}'; there are: fast, normal, best", word));
    }
    return *known;
}

Objective objective_of(const std::string& word) {
    const std::optional<Objective> known = objective_named(word);
    if (!known) {
        throw Error(
            ErrorCode::usage,
            fmt::format("unknown objective '{}'; there are: excess, mean_protrusion, protrusion, radius", word));
    }
    return *known;
}

using Clock = std::chrono::steady_clock;

/// Returns what ends a search: the time limit, or a request.
std::function<bool()> stop_of(const StopRequest& request, std::optional<double> time_limit) {
    if (!time_limit || *time_limit > 1e9) { // longer than anything runs
        return [&request] { return request.asked(); };
    }
    const auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*time_limit));
    return [&request, end] { return request.asked() || Clock::now() > end; };
}

/// Returns (rows of spheres, [dictionary of each other element, …], certified, volume).
py::tuple tuple_of(Cover cover) {
    py::list others;
    for (const Element& element : cover.elements.shaped()) {
        others.append(dict_of(element));
    }
    return py::make_tuple(rows_of(std::move(cover.elements.spheres())), others, cover.certificate.holds, cover.volume);
}

/// What a search is to find, and how much of it there is.
struct Counts {
    std::vector<std::size_t> counts;
    bool alone = false; ///< the one count is searched for itself, which is quicker where the effort is fast
    std::atomic<std::size_t> found{0};
};

/// Returns the covers for each count, by one search.
std::vector<Cover> found_each(const HeldMesh& mesh, Counts& wanted, const CoverOptions& options, bool surface) {
    if (wanted.alone && !mesh.seen().empty()) { // without a solid: points have no inside
        return {cover(mesh.seen(), wanted.counts.front(), options)};
    }
    const std::shared_ptr<const Solid> solid = surface ? as_surface(*mesh.solid()) : mesh.solid();
    if (wanted.alone) {
        return {cover(*solid, wanted.counts.front(), options)};
    }
    CoverSearch search(*solid, options);
    std::vector<Cover> found;
    for (const std::size_t count : wanted.counts) {
        found.push_back(search.cover(count));
        wanted.found = found.size();
    }
    return found;
}

/// Calls work(request) aside, and `progress` with an event ten times a second and at the end. What is found of the
/// counts, or what is over of the time limit, is done.
template <class Work>
void work_with_progress(const Counts& wanted, std::optional<double> time_limit, const py::object& progress, Work work) {
    Pulse pulse;
    std::atomic<bool> ended = false;
    const auto tell = [&] {
        if (!ended && !pulse.due()) {
            return;
        }
        double done = ended ? 1 : static_cast<double>(wanted.found) / static_cast<double>(wanted.counts.size());
        std::optional<double> left;
        if (time_limit && !ended) {
            done = std::max(done, std::min(pulse.seconds() / *time_limit, 1.0));
            left = std::max(*time_limit - pulse.seconds(), 0.0);
        }
        pulse.called();
        progress(ended ? "run_finished" : "progress", "", "", done, pulse.seconds(), left, "", "info", false);
    };
    work_aside(
        [&](const std::atomic<bool>& cancel) {
            work(CancelFlag(cancel));
            ended = true;
        },
        tell);
}

/// `progress`: a function of an event's values, or None.
py::list covered(const HeldMesh& mesh, const std::vector<std::size_t>& counts, bool alone,
                 const std::vector<std::string>& kinds, const std::string& effort, const std::string& objective,
                 std::uint64_t seed, std::size_t max_vertices, bool axis_aligned, std::optional<double> time_limit,
                 const std::string& covers, const py::object& progress) {
    if (covers != to_string(Covers::solid) && covers != to_string(Covers::surface)) {
        throw Error(ErrorCode::usage, fmt::format("unknown covers '{}'; there are: solid, surface", covers));
    }
    CoverOptions options{.kinds = kinds_named(kinds, "kinds"),
                         .effort = effort_of(effort),
                         .objective = objective_of(objective),
                         .seed = seed,
                         .max_vertices = max_vertices,
                         .axis_aligned = axis_aligned};
    Counts wanted{counts, alone};
    const auto search = [&](const StopRequest& request) {
        options.stop = stop_of(request, time_limit);
        return found_each(mesh, wanted, options, covers == to_string(Covers::surface));
    };
    std::vector<Cover> found;
    if (progress.is_none()) {
        found = worked(search); // in this thread, which takes less time
    } else if (!counts.empty()) {
        work_with_progress(wanted, time_limit, progress, [&](const StopRequest& request) { found = search(request); });
    }
    py::list list;
    for (Cover& cover : found) {
        list.append(tuple_of(std::move(cover)));
    }
    return list;
}

py::tuple proved(const HeldMesh& mesh, const std::string& word, double tolerance) {
    const std::vector<Element::Kind> kinds = kinds_named({word}, "kind");
    const ProvedElement found = worked(
        [&](const Signals&) { return proved_least(kinds.front(), mesh.solid()->surface().vertices, tolerance); });
    return py::make_tuple(dict_of(found.element), found.volume, found.lower_bound);
}

/// Returns one mesh around elements, for pictures.
std::shared_ptr<HeldMesh> mesh_of_elements(const std::vector<py::dict>& elements) {
    Mesh all;
    for (const py::dict& element : elements) {
        append(all, enclosing_mesh(element_of_dict(element)));
    }
    return std::make_shared<HeldMesh>(std::move(all));
}

/// Excess and missing of a mesh without inside.
constexpr std::pair<double, double> nothing_inside{std::numeric_limits<double>::infinity(), 0};

/// Returns excess vol(U \ S) / vol(S) and missing vol(S \ U) / vol(S) of covering elements.
std::pair<double, double> volumes_of_elements(const HeldMesh& mesh, const std::vector<py::dict>& dicts) {
    Elements level;
    for (const py::dict& dict : dicts) {
        level.add(element_of_dict(dict));
    }
    return worked([&](const Signals&) {
        const auto solid = mesh.solid();
        const double own = solid->volume();
        if (!(own > 0)) {
            return nothing_inside;
        }
        const auto [excess, missing] = excess_and_missing_volume(*solid, level);
        return std::pair(excess / own, missing_share(missing, own));
    });
}

/// Returns the same of covering spheres with the union's volume.
std::pair<double, double> volumes_of_spheres(const HeldMesh& mesh, const py::buffer& rows, double volume) {
    const std::vector<Sphere> spheres = spheres_of(rows);
    return worked([&](const Signals&) {
        const auto solid = mesh.solid();
        const double own = solid->volume();
        if (!(own > 0)) {
            return nothing_inside;
        }
        const double missing = solid->missing_volume(spheres);
        return std::pair((volume - own + missing) / own, missing_share(missing, own));
    });
}

} // namespace

void add_search(py::module_& module) {
    module.def("cover", &covered, py::arg("mesh"), py::arg("counts"), py::arg("alone"), py::arg("kinds"),
               py::arg("effort"), py::arg("objective"), py::arg("seed"), py::arg("max_vertices"),
               py::arg("axis_aligned"), py::arg("time_limit"), py::arg("covers"), py::arg("progress"));
    module.def(
        "mesh_of_balls",
        [](const py::buffer& rows) {
            return std::make_shared<HeldMesh>(spheres_of(rows));
        },
        py::arg("rows"));
    module.def("proved_least", &proved, py::arg("mesh"), py::arg("kind"), py::arg("tolerance"));
    module.def("mesh_of_elements", &mesh_of_elements, py::arg("elements"));
    module.def(
        "spheres_inside",
        [](const HeldMesh& mesh, std::size_t count, std::optional<double> time_limit) {
            return rows_of(worked([&](const Signals& signals) {
                return spheres_inside(*mesh.solid(), count, stop_of(signals, time_limit));
            }));
        },
        py::arg("mesh"), py::arg("spheres"), py::arg("time_limit"));
    module.def("volumes_of_elements", &volumes_of_elements, py::arg("mesh"), py::arg("elements"));
    module.def("volumes_of_spheres", &volumes_of_spheres, py::arg("mesh"), py::arg("spheres"), py::arg("volume"));
}

} // namespace foam::python
