#include <foam/batch/batch.hpp>

#include "archive.hpp"
#include "messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/runtime/internal/child.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/runtime/process.hpp>
#include <foam/runtime/run.hpp>
#include <foam/runtime/scratch_folder.hpp>
#include <foam/runtime/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <deque>
#include <iostream>
#include <map>
#include <optional>
#include <vector>

namespace foam::inline batch {

namespace {

/// Whether a stage has a parameter in metres that is not zero.
bool has_length(const StageCall& call, const Registry& registry) {
    const RegisteredStage* stage = registry.find(call.stage);
    if (!stage) {
        return true;
    }
    const Parameters values(stage->info.parameters, call.given);
    return std::any_of(stage->info.parameters.begin(), stage->info.parameters.end(), [&](const Parameter& parameter) {
        return parameter.unit_text.starts_with("m") && values.number(parameter.name) != 0;
    });
}

/// Returns whether the spheres of a scaled mesh are the scaled spheres, as far as the recipe says: it has no length in
/// metres, overrides no link, and its guarantee is outer. Some stages have parameters in metres.
bool scales_freely(const Recipe& recipe, const Registry& registry) {
    const std::vector<const StageCall*> stages = recipe.stages();
    return recipe.guarantee == Guarantee::outer && recipe.links.empty() && recipe.pad.value_or(0) == 0 &&
           !recipe.budget_max_protrusion && !recipe.budget_time_limit &&
           std::none_of(stages.begin(), stages.end(),
                        [&](const StageCall* call) { return has_length(*call, registry); });
}

/// Returns the recipe of a scaled mesh that keeps the scaled spheres, if they cover it. `spheres`: of the mesh without
/// that scale. `size`: diagonal of the scaled mesh's box, m. Centres move to a decimal grid of about a millionth of the
/// size, and radii grow by as much, so that rounding leaves the proof as it is.
Recipe with_scaled_spheres(Recipe recipe, const std::vector<Sphere>& spheres, double scale, double size) {
    const DecimalGrid grid(size);
    constexpr double rounding = 1e-12; // of the size: far above that of doubles
    LinkOverride link;
    link.glob = "*";
    link.keep.emplace();
    for (const Sphere& sphere : spheres) {
        const Vec3 center = sphere.center * scale, moved = grid.nearest(center);
        link.keep->push_back({moved, grid.up(sphere.radius * scale + distance(center, moved) + rounding * size)});
    }
    recipe.links.push_back(std::move(link));
    return recipe;
}

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

double cpu_now() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The last results by the digest of what decides them.
template <class Result, std::size_t most> class KnownResults {
public:
    const Result* find(const Digest& key) const {
        const auto known = results_.find(key);
        return known == results_.end() ? nullptr : &known->second;
    }
    const Result& add(const Digest& key, Result result) {
        if (order_.size() == most) {
            results_.erase(order_.front());
            order_.pop_front();
        }
        order_.push_back(key);
        return results_[key] = std::move(result);
    }

private:
    std::map<Digest, Result> results_;
    std::deque<Digest> order_;
};

/// The spheres of a mesh without the scale of its item; none if other scales need a search of their own.
struct Unscaled {
    std::vector<Sphere> spheres;
    double size = 0; ///< diagonal of the mesh's box, m
};

void replace_all(std::string& text, const std::string& old, const std::string& now) {
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += now.size()) {
        text.replace(at, old.size(), now);
    }
}

/// Replaces the place where a member of an archive was unpacked by its path, and the absolute path by the id, as they
/// are and as messages show them: the same text in every process.
std::string portable(std::string text, const std::string& real, const BatchItem& item) {
    replace_all(text, real, item.id);
    if (const std::string escaped = shown(real); escaped != real) {
        replace_all(text, escaped, shown(item.id));
    }
    return text;
}

Json spheres_of(const SphereModel& model) {
    Json spheres = Json::array();
    for (const LinkSpheres& link : spheres_by_link(model)) {
        for (const Sphere& s : link.elements.spheres()) {
            spheres.push_back({s.center.x, s.center.y, s.center.z, s.radius});
        }
    }
    return spheres;
}

Json result_of(const RunResult& run, const std::string& real, const BatchItem& item) {
    const Vec3 size = run.input_size.box.size();
    const Measures& total = run.total;
    Json result{{"triangles", run.input_size.triangles},
                {"size_m", {size.x, size.y, size.z}},
                {"spheres", spheres_of(run.model)},
                {"certified", run.certified},
                {"excess", total.excess}, // JSON has no infinity: null
                {"missing", total.missing},
                {"gap_m", total.gap},
                {"protrusion_max_m", total.protrusion_max},
                {"protrusion_mean_m", total.protrusion_mean}};
    // The proof holds for the numbers that others read here.
    if (Json::parse(result.at("spheres").dump()) != result.at("spheres")) {
        throw Error(ErrorCode::internal, "the numbers of the spheres change when they are written");
    }
    for (const Finding& finding : run.findings) {
        if (finding.severity >= Severity::warning) {
            result["warnings"].push_back(
                portable(finding.stage.empty() ? finding.message : finding.stage + ": " + finding.message, real, item));
        }
    }
    return result;
}

class Worker {
public:
    explicit Worker(const WorkerTask& task) : recipe_digest_(task.recipe_digest) {
        for (const std::string& plugin : task.plugins) {
            if (const PluginRecord& record = registry_.load(plugin); !record.loaded()) {
                throw Error(ErrorCode::plugin, "plugin " + plugin + " is refused: " + record.rejection);
            }
        }
        RecipeResult read = parse_recipe(task.recipe, "recipe.yaml", registry_);
        if (!read.ok() || read.recipes.size() != 1) {
            throw Error(ErrorCode::recipe, "the recipe of the batch cannot be read");
        }
        recipe_ = std::move(read.recipes.front());
        scales_freely_ = scales_freely(recipe_, registry_);
    }

    /// Returns the line of a mesh: its spheres, or why it has none.
    std::string answer(const Request& request) {
        const BatchItem& item = request.item;
        const double begin = cpu_now();
        Digest input;
        std::string real = item.path;
        try {
            Json line{{"id", item.id}};
            const Json result = result_for(request, input, real);
            line["digest"] = input;
            line.update(result);
            line["foam"] = version();
            line["recipe"] = recipe_digest_;
            line["cpu_seconds"] = cpu_now() - begin;
            return line.dump(-1, ' ', false, Json::error_handler_t::replace);
        } catch (const Error& error) {
            return failure_line(item, recipe_digest_, input, to_string(error.code()),
                                portable(error.what(), real, item), cpu_now() - begin);
        } catch (const std::bad_alloc&) {
            return failure_line(item, recipe_digest_, input, "memory limit",
                                "the memory limit of the batch is too low for this mesh", cpu_now() - begin);
        } catch (const std::exception& error) {
            return failure_line(item, recipe_digest_, input, "internal", portable(error.what(), real, item),
                                cpu_now() - begin);
        }
    }

private:
    Json result_for(const Request& request, Digest& input, std::string& real) {
        const BatchItem& item = request.item;
        std::optional<ScratchFolder> unpacked;
        std::string bytes;
        if (const auto inside = archive_path(item.path)) {
            bytes = archives_.at(inside->archive).read(inside->member);
            const fs::path file = unpacked.emplace().path() / fs::path(inside->member).filename();
            write_file(file, bytes);
            real = file.string();
        } else {
            bytes = read_file(item.path);
        }
        input = digest_of(bytes);
        Hasher hasher;
        hasher.add(input).add(fs::path(real).extension().string());
        hasher.add(item.unit.unit.value_or(""));
        const Digest unscaled = hasher.add(static_cast<std::uint64_t>(item.spheres.value_or(0))).finish();
        const bool one_search = request.one_search && scales_freely_;
        const Digest key = Hasher().add(unscaled).add(item.unit.scale).add(std::uint64_t{one_search}).finish();
        if (const Json* known = results_.find(key)) { // data sets hold many duplicates
            return *known;
        }
        std::string().swap(bytes);
        std::optional<RunResult> done = one_search ? scaled_run(item, real, unscaled) : std::nullopt;
        if (!done) {
            done = run(recipe_for(item, real), registry_, options());
        }
        const Json result = result_of(*done, real, item);
        if (!result.contains("warnings")) { // which may name this file
            results_.add(key, result);
        }
        return result;
    }

    /// Returns the scaled spheres of the mesh without its item's scale, proved on the scaled mesh; nothing if it needs
    /// a search of its own.
    std::optional<RunResult> scaled_run(const BatchItem& item, const std::string& real, const Digest& key) {
        const Unscaled* known = unscaled_.find(key);
        const Unscaled& unscaled = known ? *known : unscaled_.add(key, unscaled_spheres(item, real));
        if (unscaled.spheres.empty()) {
            return {};
        }
        const double scale = item.unit.scale;
        const Recipe scaled =
            with_scaled_spheres(recipe_for(item, real), unscaled.spheres, scale, scale * unscaled.size);
        try {
            RunResult result = run(scaled, registry_, options());
            const bool same =
                result.certified && spheres_by_link(result.model).front().elements.spheres() == scaled.links.front().keep;
            return same ? std::optional(std::move(result)) : std::nullopt;
        } catch (const Error&) { // the rounding of coordinates far from the origin: the kept spheres do not cover
            return {};
        }
    }

    Unscaled unscaled_spheres(BatchItem item, const std::string& real) {
        item.unit.scale = 1;
        try {
            const RunResult result = run(recipe_for(item, real), registry_, options());
            const bool warned = std::any_of(result.findings.begin(), result.findings.end(), [](const Finding& finding) {
                return finding.severity >= Severity::warning;
            });
            if (!warned && result.certified) {
                return {spheres_by_link(result.model).front().elements.spheres(), norm(result.input_size.box.size())};
            }
        } catch (const Error&) { // the run with the scale tells why
        }
        return {};
    }

    Recipe recipe_for(const BatchItem& item, const std::string& real) const {
        Recipe recipe = recipe_;
        recipe.mesh = {real};
        if (item.unit.unit) {
            recipe.mesh_unit.unit = item.unit.unit;
        }
        recipe.mesh_unit.scale *= item.unit.scale;
        recipe.budget_spheres = item.spheres ? item.spheres : recipe.budget_spheres;
        return recipe;
    }

    static RunOptions options() {
        RunOptions options;
        options.fresh = true; // a data set would fill the cache
        options.report = false;
        options.threads = 1; // a mesh a process: better than threads within a mesh at this size
        options.program = "/proc/self/exe";
        return options;
    }

    Registry registry_;
    Recipe recipe_;
    Digest recipe_digest_;
    Archives archives_;
    bool scales_freely_ = false;
    KnownResults<Json, 4096> results_;
    KnownResults<Unscaled, 16> unscaled_;
};

void send_line(const std::string& line) {
    const std::string bytes = line + '\n';
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t n = write(answer_descriptor, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno != EINTR) {
            _exit(1);
        }
        done += n > 0 ? static_cast<std::size_t>(n) : 0;
    }
}

/// Makes free() keep memory for the next mesh: giving it back and getting it again took a third of a tiny mesh's time.
void keep_freed_memory() {
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
    mallopt(M_MMAP_THRESHOLD, 16 << 20);
}

[[noreturn]] void serve_batch() {
    try {
        std::string line;
        if (!std::getline(std::cin, line)) {
            throw Error(ErrorCode::usage, "this command is for foam itself");
        }
        const WorkerTask task = worker_task_of(line);
        begin_child(task.parent, task.memory_limit);
        keep_freed_memory();
        report_crashes();
        Worker worker(task);
        send_line(""); // ready
        while (std::getline(std::cin, line)) {
            send_line(worker.answer(request_of(line)));
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "foam: {}\n", error.what());
        std::fflush(stderr);
        _exit(exit_code(ErrorCode::usage));
    }
    _exit(0);
}

} // namespace

void serve_batch_worker(int count, char** arguments) {
    if (count == 2 && std::string_view(arguments[1]) == worker_command) {
        serve_batch();
    }
}

} // namespace foam::inline batch
