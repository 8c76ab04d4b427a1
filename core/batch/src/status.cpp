#include <foam/batch/batch.hpp>

#include "messages.hpp"
#include "plan.hpp"
#include "shard.hpp"

#include <cctype>

namespace foam::inline batch {
namespace {

bool is_letter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/// Replaces `id` where it stands as a word of its own: it may be a single letter.
void leave_out(const std::string& id, std::string& text) {
    constexpr std::string_view instead = "…";
    for (std::size_t at = 0; (at = text.find(id, at)) != std::string::npos;) {
        const std::size_t end = at + id.size();
        const bool word = (at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]));
        text.replace(at, word ? id.size() : 0, word ? instead : "");
        at += word ? instead.size() : 1;
    }
}

/// Returns a reason without what differs from mesh to mesh: its id in front, names in quotes, numbers, the remedy.
std::string kind_of_reason(const std::string& id, std::string reason) {
    leave_out(id, reason);
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

double BatchStatus::rate_of_core() const {
    return cpu_seconds > 0 ? static_cast<double>(done) / cpu_seconds : 0;
}

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
            const ResultSummary result = summary_of(line);
            ++status.done;
            status.cpu_seconds += result.cpu_seconds;
            if (result.failed) {
                ++status.failed;
                ++status.reasons[result.code + ": " + kind_of_reason(result.id, result.reason)];
            }
        });
        status.finished_shards += finished ? 1 : 0;
        status.worked_on += !finished && is_worked_on(plan, shard) ? 1 : 0;
    }
    return status;
}

} // namespace foam::batch
