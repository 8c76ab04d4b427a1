#include <foam/batch/batch.hpp>

#include "plan.hpp"
#include "shard.hpp"

#include <nlohmann/json.hpp>

#include <cctype>

namespace foam::inline batch {
namespace {

using Json = nlohmann::ordered_json;

/// Returns a reason without what differs from mesh to mesh: its id in front, names in quotes, numbers, the remedy.
std::string kind_of_reason(const std::string& id, std::string reason) {
    for (std::size_t at = 0; (at = reason.find(id, at)) != std::string::npos;) {
        reason.replace(at, id.size(), "…");
        at += std::string_view("…").size();
    }
    reason = reason.substr(0, reason.find("; remedy"));
    std::string kind;
    bool quoted = false;
    for (const char c : reason) {
        const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
        if (c == '\'') {
            quoted = !quoted;
            kind += quoted ? "'…" : "'";
        } else if (!quoted && !(digit && kind.ends_with('N'))) {
            kind += digit ? 'N' : c;
        }
    }
    return kind;
}

} // namespace

double BatchStatus::cpu_seconds_left() const {
    return done == 0 ? 0 : cpu_seconds / static_cast<double>(done) * static_cast<double>(meshes - done);
}

BatchStatus batch_status(const std::filesystem::path& folder) {
    const Plan plan = read_plan(folder);
    BatchStatus status;
    status.meshes = plan.items.size();
    status.shards = plan.shards;
    for (std::size_t shard = 0; shard < plan.shards; ++shard) {
        const bool finished = for_each_result(plan, shard, [&](std::string_view line) {
            const Json json = Json::parse(line);
            ++status.done;
            status.cpu_seconds += json.at("cpu_seconds").get<double>();
            if (const auto error = json.find("error"); error != json.end()) {
                ++status.failed;
                const std::string reason = kind_of_reason(json.at("id"), error->at("reason"));
                ++status.reasons[error->at("code").get<std::string>() + ": " + reason];
            }
        });
        status.finished_shards += finished ? 1 : 0;
    }
    return status;
}

} // namespace foam::batch
