// What to say of a word that is not known.
#pragma once

#include <string>
#include <vector>

namespace foam::cli {

/// Returns "; did you mean 'run'?" with the nearest of the known words; empty if none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);
/// Returns "unknown command 'rum'; did you mean 'run'?".
std::string unknown_command(const std::string& word, const std::vector<std::string>& known);

} // namespace foam::cli
