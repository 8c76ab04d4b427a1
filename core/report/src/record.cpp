// Inputs and outputs with their digests; how to reproduce the run; its times.
#include "sections.hpp"

#include <foam/report/html_page.hpp>

#include <fmt/format.h>

#include <map>

namespace foam::inline report {
namespace {

std::string table(const std::string& label, const std::string& head, const std::string& rows) {
    return fmt::format("<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table class=\"text "
                       "sortable\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
                       label, head, rows);
}

std::string heads(std::initializer_list<const char*> names) {
    std::string html;
    for (const char* name : names) {
        html += fmt::format("<th scope=\"col\">{}</th>", name);
    }
    return html;
}

std::string file_row(const Json& file, const std::string& what) {
    const auto bytes = file["bytes"].get<std::size_t>();
    return fmt::format("<tr><td>{}</td><td>{}</td>{}<td><code>{}</code></td></tr>\n", escaped(file["file"]), what,
                       cell(static_cast<double>(bytes), fmt::format("{}", bytes)), escaped(file["digest"]));
}

std::string commands(const std::string& text) {
    return fmt::format("<pre tabindex=\"0\"><code>{}</code></pre>\n", text);
}

/// Returns the text quoted for a POSIX shell, as HTML.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return as_text(result + "'");
}

/// Returns a file that `foam certify` reads, if there is one.
std::string certifiable(const Report& report) {
    for (const Json& output : report.manifest["outputs"]) {
        const auto file = output["file"].get<std::string>();
        if (file.ends_with(".urdf") || file.ends_with(".json")) {
            return file;
        }
    }
    return {};
}

struct StageTime {
    std::size_t calls = 0, cached = 0;
    double seconds = 0;
};

/// Returns the times of stages in the order of their first occurrence.
std::vector<std::pair<std::string, StageTime>> stage_times(const Json& execution) {
    std::vector<std::pair<std::string, StageTime>> times;
    for (const Json& link : execution["links"]) {
        for (const Json& stage : link["stages"]) {
            const auto name = stage["stage"].get<std::string>();
            auto entry = std::find_if(times.begin(), times.end(), [&](const auto& t) { return t.first == name; });
            if (entry == times.end()) {
                entry = times.insert(times.end(), {name, {}});
            }
            ++entry->second.calls;
            entry->second.cached += stage["cached"].get<bool>() ? 1 : 0;
            entry->second.seconds += stage["wall_seconds"].get<double>();
        }
    }
    return times;
}

bool is_reported(const Json& finding, bool warnings) {
    const bool warning = finding["severity"] == "warning" || finding["severity"] == "error";
    return warnings ? warning : !warning && finding["severity"] != "debug";
}

std::string findings_list(const Json& findings, bool warnings, std::size_t& count) {
    std::string rows;
    for (const Json& finding : findings) {
        if (is_reported(finding, warnings)) {
            ++count;
            rows +=
                fmt::format("<tr><td class=\"{0}\">{0}</td><td>{1}</td><td>{2}</td><td class=\"why\">{3}</td></tr>\n",
                            escaped(finding["severity"]), escaped(finding["link"]), escaped(finding["stage"]),
                            escaped(finding["message"]));
        }
    }
    return rows.empty() ? "" : table("Findings", heads({"severity", "link", "stage", "message"}), rows);
}

} // namespace

std::string findings_section(const Report& report) {
    const Json& findings = report.manifest["execution"]["findings"];
    std::size_t warnings = 0, notes = 0;
    std::string html = findings_list(findings, true, warnings);
    if (warnings == 0) {
        html = "<p>No warnings.</p>\n";
    }
    if (const std::string list = findings_list(findings, false, notes); notes > 0) {
        html += fmt::format("<details><summary>{}</summary>\n{}</details>\n", counted(notes, "note"), list);
    }
    return section("findings", "Findings", execution_only(html));
}

std::string recipe_section(const Report& report) {
    return section(
        "recipe", "Recipe",
        "<p>As it ran, every default written out: <code>recipe.resolved.yaml</code> beside this file.</p>\n" +
            commands(as_lines(report.recipe)));
}

std::string files_section(const Report& report) {
    const Json& manifest = report.manifest;
    std::string inputs = file_row(manifest["input"], "input"), outputs;
    if (manifest.contains("further_files")) {
        for (const Json& file : manifest["further_files"]) {
            inputs += file_row(file, "read with it");
        }
    }
    for (const Json& mesh : manifest["mesh_files"]) {
        inputs += file_row(mesh, "mesh");
    }
    for (const Json& output : manifest["outputs"]) {
        outputs += file_row(output, escaped(output["stage"]));
    }
    std::string html = "<h3>Inputs</h3>\n" + table("Inputs", heads({"file", "what", "bytes", "digest"}), inputs) +
                       "<h3>Outputs</h3>\n" +
                       table("Outputs", heads({"file", "written by", "bytes", "digest"}), outputs);
    std::string plugins, libraries;
    for (const Json& plugin : manifest["plugins"]) {
        const std::string build = plugin["build"].is_null() ? "" : escaped(plugin["build"]);
        plugins +=
            fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td><code>{}</code></td></tr>\n",
                        escaped(plugin["plugin"]), escaped(plugin["version"]), escaped(plugin["license"]), build);
    }
    for (const auto& [name, version] : manifest["libraries"].items()) {
        libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", as_text(name), escaped(version));
    }
    html += "<h3>Versions</h3>\n" + fmt::format("<p>foam {}; {}.</p>\n", escaped(manifest["foam_version"]), libraries) +
            table("Plugins", heads({"plugin", "version", "licence", "build"}), plugins);
    std::string others;
    for (const std::string& file : report.files) {
        others += fmt::format("<li>{}</li>\n", as_text(file));
    }
    if (!others.empty()) {
        html += "<details><summary>Further files of the run</summary>\n<ul>\n" + others + "</ul>\n</details>\n";
    }
    return section("files", "Inputs, outputs, versions", html);
}

std::string reproduce_section(const Report& report) {
    std::string html =
        "<p>In the folder of this file, make the run again and compare every digest:</p>\n" +
        commands("foam verify .") +
        "<p>Make it again under the lock of its manifest, which refuses other inputs and versions:</p>\n" +
        commands("foam run --locked manifest.json --run-dir again");
    const std::string file = certifiable(report);
    const std::string guarantee = report.manifest["settings"]["guarantee"].get<std::string>();
    if (!file.empty() && guarantee != "fitted") {
        const std::string input = report.manifest["execution"]["input"]["file"].get<std::string>();
        const std::string geometry = report.manifest["proof"]["geometry"].get<std::string>();
        html += "<p>The proof alone, on the written file:</p>\n" +
                execution_only(commands(fmt::format("foam certify {} {}{}{}", quoted(input), quoted(file),
                                                    guarantee == "inner" ? " --guarantee inner" : "",
                                                    geometry == "collision" ? "" : " --geometry " + geometry)));
    }
    return section("reproduce", "Reproduce", html);
}

/// Returns the table of the times of phases, which add up to the time of the run.
static std::string phase_table(const Json& execution) {
    std::string rows;
    const auto row = [&rows](const std::string& name, double wall, double cpu) {
        rows += fmt::format("<tr><th scope=\"row\">{}</th>{}{}</tr>\n", name, cell(wall, number(wall, 3)),
                            cell(cpu, number(cpu, 3)));
    };
    for (const Json& phase : execution["phases"]) {
        row(escaped(phase["phase"]), phase["wall_seconds"].get<double>(), phase["cpu_seconds"].get<double>());
    }
    row("whole run", execution["wall_seconds"].get<double>(), execution["cpu_seconds"].get<double>());
    return fmt::format("<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"Time by phase\"><table>\n"
                       "<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
                       heads({"phase", "seconds", "CPU seconds"}), rows);
}

static std::string stage_table(const Json& execution) {
    const auto times = stage_times(execution);
    std::vector<double> all;
    for (const auto& [stage, time] : times) {
        all.push_back(time.seconds);
    }
    const BarScale scale(all, 0, true);
    std::string rows;
    for (const auto& [stage, time] : times) {
        rows += fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}</tr>\n", as_text(stage),
                            cell(static_cast<double>(time.calls), fmt::format("{}", time.calls)),
                            cell(static_cast<double>(time.cached), fmt::format("{}", time.cached)),
                            cell(time.seconds, number(time.seconds, 3) + scale.svg(time.seconds)));
    }
    return fmt::format("<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"Time by stage\"><table "
                       "class=\"sortable\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
                       heads({"stage", "calls", "from the cache", "seconds"}), rows);
}

std::string execution_section(const Report& report) {
    const Json& execution = report.manifest["execution"];
    const auto seconds = [&](const char* key) { return number(execution[key].get<double>(), 2); };
    return section(
        "execution", "Time",
        execution_only(fmt::format("<p>{} s on {}, CPU {} s, before this report. Input: <code>{}</code></p>\n"
                                   "{}<p class=\"note\">Of the stages that work on links, all calls "
                                   "together, several at once:</p>\n{}",
                                   seconds("wall_seconds"), counted(execution["threads"].get<std::size_t>(), "thread"),
                                   seconds("cpu_seconds"), escaped(execution["input"]["file"]), phase_table(execution),
                                   stage_table(execution))));
}

} // namespace foam::report
