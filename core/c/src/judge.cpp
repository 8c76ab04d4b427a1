// Proof, figures and growth of elements.
#include "call.hpp"
#include "handles.hpp"

#include <foam/geometry/measure.hpp>

using namespace foam::c;

namespace {

/// A region and elements, as arguments.
void require_both(const foam_region* region, const foam_elements* elements) {
    require_given(region, "region", "one of foam_region_of_mesh() or foam_region_of_points()");
    require_given(elements, "elements", "those of foam_cover() or foam_elements_make()");
}

foam::Elements elements_of(const foam_elements& handle) {
    return foam::Elements(handle.all);
}

void fill(foam_certificate& result, const foam::Certificate& proof) {
    result.holds = proof.holds ? 1 : 0;
    result.solid = proof.covers == foam::Covers::solid ? 1 : 0;
    result.growth = proof.growth;
    result.cavity = proof.cavity ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis) {
        result.witness[axis] = proof.witness[axis];
    }
}

void fill(foam_figures& result, const foam::Measures& figures) {
    result.elements = figures.spheres;
    result.certified = figures.certified ? 1 : 0;
    result.solid = figures.covers == foam::Covers::solid ? 1 : 0;
    result.area = figures.area;
    result.volume = figures.volume;
    result.covered = figures.covered;
    result.gap = figures.gap;
    result.excess = figures.excess;
    result.excess_error = figures.excess_error;
    result.missing = figures.missing;
    result.missing_error = figures.missing_error;
    result.protrusion_max = figures.protrusion_max;
    result.protrusion_mean = figures.protrusion_mean;
}

} // namespace

extern "C" {

int foam_certify(const foam_region* region, const foam_elements* elements, const foam_options* options,
                 foam_certificate* certificate, foam_report* report) {
    return reported(report, [&] {
        require_both(region, elements);
        require_given(certificate, "certificate", "the address of a foam_certificate");
        require_size(certificate->size, sizeof(foam_certificate), "certificate");
        *certificate = {};
        certificate->size = sizeof(foam_certificate);
        Call call(options, Call::Kind::whole);
        call.run([&] { fill(*certificate, foam::certify(*region->solid(), elements_of(*elements))); });
        report->spheres = elements->all.size();
        report->certified = certificate->holds;
    });
}

int foam_evaluate(const foam_region* region, const foam_elements* elements, const foam_options* options,
                  foam_figures* figures, foam_report* report) {
    return reported(report, [&] {
        require_both(region, elements);
        require_given(figures, "figures", "the address of a foam_figures");
        require_size(figures->size, sizeof(foam_figures), "figures");
        *figures = {};
        figures->size = sizeof(foam_figures);
        Call call(options, Call::Kind::whole);
        const foam::MeasureOptions settings{.seed = options ? options->seed : 0};
        call.run([&] { fill(*figures, foam::measure(*region->solid(), elements_of(*elements), settings)); });
        report->spheres = figures->elements;
        report->certified = figures->certified;
    });
}

int foam_grow(const foam_region* region, const foam_elements* elements, const foam_options* options,
              foam_elements** grown, foam_report* report) {
    return reported(report, [&] {
        require_place(grown, "grown");
        require_both(region, elements);
        Call call(options, Call::Kind::whole);
        foam::Elements found;
        call.run([&] {
            found = foam::grown_to_cover(*region->solid(), elements_of(*elements));
            report->certified = foam::covers(*region->solid(), found) ? 1 : 0;
        });
        report->spheres = found.size();
        report->volume = foam::union_volume(found);
        *grown = handle_of({found.begin(), found.end()});
    });
}

const char* foam_version(void) {
    return FOAM_VERSION;
}
}
