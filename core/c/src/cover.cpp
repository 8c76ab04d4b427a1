// The search for covers.
#include "call.hpp"
#include "handles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace foam::c {

std::vector<Element::Kind> kinds_in(unsigned sum) {
    std::vector<Element::Kind> kinds;
    for (const Element::Kind kind : every_kind()) {
        if ((sum >> static_cast<unsigned>(kind) & 1U) != 0) {
            kinds.push_back(kind);
        }
    }
    if (kinds.empty() || sum >> element_kinds != 0) {
        throw usage(fmt::format("kinds is {}; remedy: the sum of some of FOAM_SPHERE, FOAM_CAPSULE, …", sum));
    }
    return kinds;
}

/// Returns the cover that search(settings) returns, and reports it.
template <class Search>
static Cover covered(Search search, std::size_t count, std::vector<Element::Kind> kinds, const foam_options* given,
                     foam_report& report) {
    Call call(given, Call::Kind::search);
    if (count == 0 || count > FOAM_MAX_SPHERES) {
        throw usage(fmt::format("count is {}; remedy: 1 to {} {}", count, FOAM_MAX_SPHERES,
                                kinds == std::vector{Element::Kind::sphere} ? "spheres" : "elements"));
    }
    const CoverOptions settings = call.search(std::move(kinds));
    Cover cover;
    call.run([&] { cover = search(settings); });
    report.spheres = cover.elements.size();
    report.volume = cover.volume;
    report.certified = cover.certificate.holds ? 1 : 0;
    report.finished_early = call.ended_search() ? 1 : 0;
    return cover;
}

} // namespace foam::c

using namespace foam::c;

extern "C" {

int foam_spherize(const double* vertices, size_t vertex_count, const uint32_t* triangles, size_t triangle_count,
                  size_t count, const foam_options* options, double* spheres, foam_report* report) {
    return reported(report, [&] {
        require_given(spheres, "spheres", "an array of 4 * count numbers");
        const auto search = [&](const foam::CoverOptions& settings) {
            return foam::cover(mesh_of(vertices, vertex_count, triangles, triangle_count), count, settings);
        };
        const foam::Cover cover = covered(search, count, {foam::Element::Kind::sphere}, options, *report);
        for (const foam::Sphere& sphere : cover.elements.spheres()) {
            const double row[] = {sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius};
            spheres = std::copy(std::begin(row), std::end(row), spheres);
        }
    });
}

int foam_cover(const foam_region* region, size_t count, unsigned kinds, const foam_options* options,
               foam_elements** elements, foam_report* report) {
    return reported(report, [&] {
        require_place(elements, "elements");
        require_given(region, "region", "one of foam_region_of_mesh() or foam_region_of_points()");
        const auto search = [&](const foam::CoverOptions& settings) {
            return region->balls.empty() ? foam::cover(*region->solid(), count, settings)
                                         : foam::cover(region->balls, count, settings);
        };
        const foam::Cover cover = covered(search, count, kinds_in(kinds), options, *report);
        *elements = handle_of({cover.elements.begin(), cover.elements.end()});
    });
}
}
