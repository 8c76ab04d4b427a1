#include <foam/batch/batch.hpp>

#include "plan.hpp"
#include "shard.hpp"
#include "thumbnail.hpp"

#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/report/html_page.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace foam::inline batch {
namespace {

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

} // namespace foam::batch
