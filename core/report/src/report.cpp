#include <foam/report/internal/report.hpp>

#include "embedded_resources.hpp"
#include "page.hpp"
#include "sections.hpp"
#include "text.hpp"

namespace foam::inline report {

std::string to_html(const Report& report) {
    std::string body = header_section(report) + "<main>\n";
    for (const auto section :
         {summary_section, viewer_section, links_section, radii_section, stages_section, proof_section,
          findings_section, recipe_section, files_section, reproduce_section, execution_section}) {
        body += section(report);
    }
    const auto name = report.manifest["settings"]["name"].get<std::string>();
    return page(name + " as spheres", body + "</main>\n",
                {resources::page_js, resources::renderer_js, resources::palette_js, resources::camera_js,
                 resources::viewer_js});
}

} // namespace foam::report
