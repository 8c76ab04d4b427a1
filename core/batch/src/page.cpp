#include "plan.hpp"
#include "shard.hpp"

#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/batch/batch.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/report/html_page.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace foam::inline batch {

namespace {

/// A sphere in the picture's frame: right, down, towards the eye.
struct Disc {
    double x, y, depth, radius;
};

std::vector<Disc> discs_of(std::span<const Sphere> spheres) {
    // The eye looks along -(2, 1, 1).
    const Vec3 towards = normalized({2, 1, 1}), right = normalized(cross({0, 0, 1}, towards)),
               up = cross(towards, right);
    std::vector<Disc> discs;
    for (const Sphere& s : spheres) {
        discs.push_back({dot(right, s.center), -dot(up, s.center), dot(towards, s.center), s.radius});
    }
    std::stable_sort(discs.begin(), discs.end(), [](const Disc& a, const Disc& b) { return a.depth < b.depth; });
    return discs;
}

constexpr double edge = 96; // of the picture, pixels

/// Removes discs that others cover, or that are too small to be seen: of a thousand spheres most lie behind or within
/// others. `discs`: in pixels, the farthest first.
void remove_hidden(std::vector<Disc>& discs) {
    constexpr int fine = 2, side = fine * static_cast<int>(edge); // places to look at
    std::vector<char> taken(static_cast<std::size_t>(side) * side, 0);
    const auto place = [&](double pixels) { return std::clamp(static_cast<int>(std::ceil(fine * pixels)), 0, side); };
    const auto takes_any = [&](const Disc& d) {
        bool any = false;
        for (int y = place(d.y - d.radius); y < place(d.y + d.radius); ++y) {
            for (int x = place(d.x - d.radius); x < place(d.x + d.radius); ++x) {
                char& one = taken[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
                const double dx = static_cast<double>(x) / fine - d.x, dy = static_cast<double>(y) / fine - d.y;
                if (one == 0 && dx * dx + dy * dy <= d.radius * d.radius) {
                    one = 1;
                    any = true;
                }
            }
        }
        return any;
    };
    std::vector<Disc> seen;
    std::copy_if(discs.rbegin(), discs.rend(), std::back_inserter(seen), takes_any);
    discs.assign(seen.rbegin(), seen.rend());
}

/// Returns the SVG element with the shading that all thumbnails of a page use.
std::string thumbnail_shading() {
    return "<svg width=\"0\" height=\"0\" aria-hidden=\"true\"><defs><radialGradient id=\"ball\" cx=\".35\" cy=\".3\" "
           "r=\".8\"><stop offset=\"0\" stop-color=\"#cfe3ff\"/><stop offset=\".6\" stop-color=\"#5b8def\"/><stop "
           "offset=\"1\" stop-color=\"#27408b\"/></radialGradient></defs></svg>\n";
}

/// Returns an SVG element that shows the spheres from an oblique direction, the z axis up: shaded discs, the nearest
/// last. "" without spheres. The sizes of pictures cannot be compared: each fills its frame.
std::string thumbnail_svg(std::span<const Sphere> spheres) {
    std::vector<Disc> discs = discs_of(spheres);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double left = infinity, right = -infinity, top = infinity, bottom = -infinity;
    for (const Disc& d : discs) {
        left = std::min(left, d.x - d.radius);
        right = std::max(right, d.x + d.radius);
        top = std::min(top, d.y - d.radius);
        bottom = std::max(bottom, d.y + d.radius);
    }
    const double scale = edge / std::max(right - left, bottom - top);
    if (!std::isfinite(scale)) {
        return "";
    }
    const double x = (edge - scale * (left + right)) / 2, y = (edge - scale * (top + bottom)) / 2;
    for (Disc& d : discs) {
        d = {x + scale * d.x, y + scale * d.y, d.depth, scale * d.radius};
    }
    remove_hidden(discs);
    std::string svg = "<svg width=\"96\" height=\"96\" viewBox=\"0 0 96 96\" role=\"img\" aria-label=\"spheres\">";
    for (const Disc& d : discs) {
        svg +=
            fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"url(#ball)\"/>", d.x, d.y, d.radius);
    }
    return svg + "</svg>";
}

using Json = nlohmann::ordered_json;

constexpr std::size_t most_rows = 1000;

/// Returns the results of the first ids.
std::map<std::string, Json> first_results(const Plan& plan) {
    std::vector<std::string> ids;
    for (const BatchItem& item : plan.items) {
        ids.push_back(item.id);
    }
    const std::size_t count = std::min(ids.size(), most_rows);
    std::nth_element(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count) - 1, ids.end());
    const std::string last = ids[count - 1];
    std::map<std::string, Json> results;
    for (std::size_t shard = 0; shard < plan.shards; ++shard) {
        for_each_result(plan, shard, [&](std::string_view line) {
            Json json = Json::parse(line);
            if (std::string id = json.at("id"); id <= last) {
                results[id] = std::move(json);
            }
        });
    }
    return results;
}

std::vector<Sphere> spheres_in(const Json& result) {
    std::vector<Sphere> spheres;
    for (const Json& s : result.at("spheres")) {
        spheres.push_back({{s.at(0), s.at(1), s.at(2)}, s.at(3)});
    }
    return spheres;
}

std::string number_or(const Json& value, int digits, double factor = 1) {
    return value.is_number() ? fmt::format("{:.{}f}", factor * value.get<double>(), digits) : "∞";
}

std::string row_of(const std::string& id, const Json& result) {
    if (const auto error = result.find("error"); error != result.end()) {
        return fmt::format("<tr><th scope=\"row\">{}</th><td class=\"why\" colspan=\"8\">{}</td></tr>\n",
                           markup_escaped(id), markup_escaped(error->at("reason").get<std::string>()));
    }
    const std::vector<Sphere> spheres = spheres_in(result);
    const Json& size = result.at("size_m");
    return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
                       "<td>{}</td>{}</tr>\n",
                       markup_escaped(id), thumbnail_svg(spheres), spheres.size(), result.at("triangles").dump(),
                       number_or(std::max({size.at(0), size.at(1), size.at(2)}), 4), number_or(result.at("excess"), 3),
                       number_or(result.value("missing", Json()), 3),
                       number_or(result.at("protrusion_max_m"), 2, 1000),
                       result.at("certified").get<bool>() ? "<td class=\"yes\">yes</td>" : "<td class=\"no\">no</td>");
}

std::string reasons_table(const BatchStatus& status) {
    if (status.reasons.empty()) {
        return "";
    }
    std::string html = "<h2>Failures</h2>\n<div class=\"wide\"><table class=\"sortable\"><thead><tr><th>meshes</th>"
                       "<th class=\"why\">reason</th></tr></thead><tbody>\n";
    for (const auto& [reason, count] : status.reasons) {
        html += fmt::format("<tr><td>{}</td><td class=\"why\">{}</td></tr>\n", count, markup_escaped(reason));
    }
    return html + "</tbody></table></div>\n";
}

} // namespace

void write_batch_page(const std::filesystem::path& folder) {
    const Plan plan = read_plan(folder);
    const BatchStatus status = batch_status(folder);
    std::string html = fmt::format("<h1>Spheres of {} meshes</h1>\n<p>{} done, {} of them failed; {} without a result "
                                   "yet. {:.0f} CPU seconds.</p>\n",
                                   status.meshes, status.done, status.failed, status.meshes - status.done,
                                   status.cpu_seconds);
    html += reasons_table(status);
    html += fmt::format("<h2>Meshes</h2>\n<p>The first {} by id. Each picture fills its frame.</p>\n{}"
                        "<div class=\"wide\"><table class=\"sortable\"><thead><tr><th>id</th><th>spheres</th><th>number"
                        "</th><th>triangles</th><th>longest edge m</th><th>excess</th><th>missing</th><th>out max mm</th><th>certified"
                        "</th></tr></thead><tbody>\n",
                        std::min(status.meshes, most_rows), thumbnail_shading());
    for (const auto& [id, result] : first_results(plan)) {
        html += row_of(id, result);
    }
    write_file(folder / "index.html", report::html_page("foam batch", html + "</tbody></table></div>\n"));
}

} // namespace foam::inline batch
