// --for ENGINE: the program that a file is for.
#pragma once

#include "cli/program.hpp"

#include <foam/sdk/engines.hpp>
#include <foam/sdk/registry.hpp>

#include <map>
#include <string>
#include <vector>

namespace foam::cli {

/// Adds --for to a command.
void add_engine(CLI::App& command, std::string& engine);

/// Returns the word of a format that the engine reads: the one that is asked for, the one with the ending of the
/// output, or the best. `format`, `output`: as given; may be empty. Throws Error(usage), naming those that there are,
/// for another.
std::string format_for(const Engine& engine, const std::string& format, const std::string& output,
                       const Registry& registry);

/// Returns whether the writer has a parameter for the engine: others write for one program alone.
bool asks_for_engine(const StageInfo& writer, const Engine& engine);

/// Throws Error(usage) for a kind that does not collide in the engine.
void require_kinds(const Engine& engine, const std::vector<Element::Kind>& kinds);

/// Returns lines for people: what the engine takes away, and what it needs.
std::string text_about(const Engine& engine);

/// Returns the same of a file that was written: for the engine among the writer's parameters, or else the one that was
/// asked for; empty for none. `asked`: as given; may be empty.
std::string text_about_written(const std::map<std::string, ParameterValue>& given, const std::string& asked);

} // namespace foam::cli
