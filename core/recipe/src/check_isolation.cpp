// isolate, time_limit, memory_limit: which stages run in child processes.
#include "format.hpp"

#include <foam/recipe/internal/check.hpp>

#include <fmt/format.h>

namespace foam::inline recipe::reading {

Isolation read_isolation(const Value& map, std::string_view owner, Findings& findings) {
    Isolation isolation;
    for (const Parameter& p : isolation_values()) {
        const Value* value = map.find(p.name);
        const auto read = value ? read_value(*value, p, owner, findings) : std::nullopt;
        if (!read) {
            continue;
        }
        if (p.name == "isolate") {
            isolation.process = std::get<std::string>(*read) == "process";
        } else if (p.name == "time_limit") {
            isolation.time_limit = std::get<double>(*read);
        } else {
            isolation.memory_limit = static_cast<std::size_t>(std::get<std::int64_t>(*read));
        }
    }
    return isolation;
}

void refuse_idle_limits(const Value& map, const Isolation& effective, std::string_view owner, Findings& findings) {
    const Value* isolate = map.find("isolate");
    const bool wrong = isolate && !effective.process; // has a finding already
    if (effective.process.value_or(false) || wrong || !map.is(Value::Kind::map)) {
        return;
    }
    for (const char* limit : {"time_limit", "memory_limit"}) {
        if (const Key* key = map.find_key(limit)) {
            findings.error(key->where, "conflict",
                           fmt::format("'{}'{} needs process isolation; remedy: also write isolate: process", limit,
                                       owner.empty() ? "" : fmt::format(" of {}", owner)));
        }
    }
}

void refuse_idle_limits(const StageItem& item, const Isolation& base, Findings& findings) {
    if (item.parameters && item.stage) {
        refuse_idle_limits(*item.parameters, item.call.isolation.over(base).over(item.stage->info.isolation),
                           item.call.stage, findings);
    }
}

} // namespace foam::recipe::reading
