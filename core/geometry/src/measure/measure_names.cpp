#include <foam/geometry/measure_names.hpp>

namespace foam::inline geometry {

std::vector<NamedFigure> named_figures(const Measures& m) {
    return {{"spheres", m.spheres},
            {"certified", m.certified},
            {"gap_m", m.gap},
            {"covered", m.covered},
            {"excess", m.excess},
            {"excess_standard_error", m.excess_error},
            {"excess_volume_m3", m.excess_volume},
            {"excess_volume_standard_error_m3", m.excess_volume_error},
            {"missing", m.missing},
            {"missing_standard_error", m.missing_error},
            {"missing_volume_m3", m.missing_volume},
            {"missing_volume_standard_error_m3", m.missing_volume_error},
            {"protrusion_max_m", m.protrusion_max},
            {"protrusion_mean_m", m.protrusion_mean},
            {"exposed_area_m2", m.exposed_area},
            {"volume_m3", m.volume},
            {"area_m2", m.area}};
}

} // namespace foam::geometry
