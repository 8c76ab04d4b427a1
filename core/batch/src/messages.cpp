#include "messages.hpp"

#include <foam/runtime/version.hpp>

#include <nlohmann/json.hpp>

namespace foam::inline batch {
namespace {

using Json = nlohmann::ordered_json;

/// As lines of texts that may hold anything: messages of stages.
std::string dumped(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string line_of(const WorkerTask& task) {
    return dumped({{"parent", task.parent},
                   {"memory_limit", task.memory_limit},
                   {"plugins", task.plugins},
                   {"recipe", task.recipe},
                   {"recipe_digest", task.recipe_digest}});
}

WorkerTask worker_task_of(const std::string& line) {
    const Json json = Json::parse(line);
    return {json.at("parent"), json.at("memory_limit"), json.at("plugins"), json.at("recipe"),
            json.at("recipe_digest")};
}

std::string request_line(const BatchItem& item, bool one_search) {
    return dumped({{"id", item.id},
                   {"path", item.path},
                   {"unit", item.unit.unit.value_or("")},
                   {"scale", item.unit.scale},
                   {"spheres", item.spheres.value_or(0)},
                   {"one_search", one_search}});
}

Request request_of(const std::string& line) {
    const Json json = Json::parse(line);
    BatchItem item{.id = json.at("id"), .path = json.at("path"), .unit = {}, .spheres = {}, .bytes = 0};
    if (const std::string unit = json.at("unit"); !unit.empty()) {
        item.unit.unit = unit;
    }
    item.unit.scale = json.at("scale");
    if (const std::size_t spheres = json.at("spheres"); spheres > 0) {
        item.spheres = spheres;
    }
    return {std::move(item), json.at("one_search")};
}

std::string failure_line(const BatchItem& item, const Digest& recipe, const Digest& input, const std::string& code,
                         const std::string& reason, double cpu_seconds) {
    return dumped({{"id", item.id},
                   {"digest", input.empty() ? Json(nullptr) : Json(input)},
                   {"error", {{"code", code}, {"reason", reason}}},
                   {"foam", version()},
                   {"recipe", recipe},
                   {"cpu_seconds", cpu_seconds}});
}

} // namespace foam::batch
