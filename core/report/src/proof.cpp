// The certificate: what is proved of which file, the method, and the work for each link.
#include "sections.hpp"

#include <fmt/format.h>

namespace foam::inline report {
namespace {

/// Returns the names of the links for which the proof fails.
std::string open_links(const Report& report) {
    std::string list;
    for (const Json& link : report.manifest["links"]) {
        if (link.contains("measures") && !link["measures"]["certified"].get<bool>()) {
            list += fmt::format("<li>{}: gap {} mm</li>\n", escaped(link["link"]),
                                number(mm_per_m * value_of(link["measures"]["gap_m"]), 3));
        }
    }
    return list.empty() ? "" : "<ul>\n" + list + "</ul>\n";
}

std::string output_names(const Report& report) {
    std::string names;
    for (const Json& output : report.manifest["outputs"]) {
        names += fmt::format("{}<code>{}</code>", names.empty() ? "" : ", ", escaped(output["file"]));
    }
    return names;
}

std::size_t count_of(const Json& proof, const char* key) {
    return proof[key].get<std::size_t>();
}

std::string count_cell(std::size_t count) {
    return cell(static_cast<double>(count), std::to_string(count));
}

std::string proof_table(const Json& proofs, bool outer) {
    std::string rows;
    for (const Json& proof : proofs) {
        rows +=
            fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}</tr>\n", escaped(proof["link"]),
                        count_cell(count_of(proof, "spheres")), count_cell(count_of(proof, "triangles")),
                        outer ? count_cell(count_of(proof, "pieces")) + count_cell(count_of(proof, "halvings")) : "");
    }
    return fmt::format("<div class=\"wide\"><table class=\"sortable\">\n<thead><tr><th scope=\"col\">link</th>"
                       "<th scope=\"col\">spheres</th><th scope=\"col\">triangles</th>{}</tr></thead>\n<tbody>\n{}"
                       "</tbody>\n</table></div>\n",
                       outer ? "<th scope=\"col\">pieces</th><th scope=\"col\">halvings</th>" : "", rows);
}

/// Returns for each written file: links, triangles, pieces and the depth of the subdivision.
std::string took(const Report& report) {
    const bool outer = guarantee_of(report) == "outer";
    std::string html;
    for (const Json& output : report.manifest["outputs"]) {
        const Json& proofs = output["proofs"];
        std::size_t triangles = 0, pieces = 0, halvings = 0;
        for (const Json& proof : proofs) {
            triangles += count_of(proof, "triangles");
            pieces += count_of(proof, "pieces");
            halvings = std::max(halvings, count_of(proof, "halvings"));
        }
        html += fmt::format(
            "<details><summary><code>{}</code>: {}, {}{}</summary>\n{}</details>\n", escaped(output["file"]),
            counted(proofs.size(), "link"), counted(triangles, "triangle"),
            outer ? fmt::format(", {} examined, at most {}", counted(pieces, "piece"), counted(halvings, "halving"))
                  : "",
            proof_table(proofs, outer));
    }
    return html.empty() || !outer
               ? html
               : html + "<p class=\"note\">Triangles: of the geometry that is proved, round primitives as the "
                        "polyhedron that encloses them. Pieces: triangles and parts of them that were tested against "
                        "the spheres. Halvings: how often the smallest of these was halved.</p>\n";
}

} // namespace

std::string proof_section(const Report& report) {
    const std::string guarantee = guarantee_of(report);
    std::string html = fmt::format("<p class=\"verdict {}\">{}</p>\n", verdict_class(report), verdict(report));
    if (guarantee == "fitted") {
        html += "<p>With <code>guarantee: outer</code> spheres grow until they cover the geometry, and the file is "
                "proved; with <code>guarantee: inner</code> they shrink until they lie inside the geometry.</p>\n";
        return section("proof", "Certificate", html);
    }
    html += certified(report) ? "" : open_links(report);
    html += fmt::format("<p>The proof uses the numbers read back from {}, as another program reads them, and the "
                        "meshes and primitives as the input gives them, not the repaired or simplified ones.</p>\n",
                        output_names(report));
    html += has_other_elements(report)
                ? "<p>Method: the proof cuts every triangle along the elements and halves what is left, until one element "
                  "contains each part; a part that is still undecided at the end counts as not covered. Round primitives "
                  "are enclosed by polyhedra, unless one element contains them as they are. Rounding errors are on the "
                  "safe side: no point outside the elements passes.</p>\n"
            : guarantee == "outer"
                ? "<p>Method: a ball that contains the three corners of a triangle contains the triangle. If no single "
                  "ball contains a triangle, the proof splits it and examines its halves; a part that is still "
                  "undecided at the end counts as not covered. For round primitives, the proof uses a polyhedron that "
                  "encloses them. Rounding errors are on the safe side: no point outside the spheres passes.</p>\n"
                : "<p>Method: a ball lies inside if its centre does and no triangle is closer to the centre than the "
                  "radius. Rounding errors are on the safe side: no ball that protrudes passes.</p>\n";
    return section("proof", "Certificate", html + omissions(report) + took(report));
}

} // namespace foam::report
