#include "verdict.hpp"

namespace foam::report {

std::string guarantee_of(const Report& report) {
    return report.manifest["settings"]["guarantee"].get<std::string>();
}

bool certified(const Report& report) {
    return report.manifest["certified"].get<bool>();
}

std::string verdict(const Report& report) {
    const std::string guarantee = guarantee_of(report);
    if (guarantee == "fitted") {
        return "No guarantee was asked for: the figures say how well the spheres fit.";
    }
    if (guarantee == "inner") {
        return certified(report) ? "Proved: the spheres of every link lie inside its geometry."
                                 : "Not proved for every link: spheres may stick out of the geometry.";
    }
    return certified(report) ? "Proved: the geometry of every link lies inside its spheres."
                             : "Not proved for every link: geometry may stick out of the spheres.";
}

std::string verdict_class(const Report& report) {
    return guarantee_of(report) == "fitted" ? "plain" : certified(report) ? "yes" : "no";
}

} // namespace foam::report
