// The result of a run for people and for programs.
#pragma once

#include <foam/runtime/run.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace foam::cli {

/// A table: a line a link, the total, and whether cover is proved.
std::string table_of(const RunResult& result, Guarantee guarantee);
nlohmann::ordered_json json_of(const RunResult& result, const Recipe& recipe, const std::filesystem::path& directory);

} // namespace foam::cli
