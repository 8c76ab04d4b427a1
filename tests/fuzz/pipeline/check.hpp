// Runs a case and says what did not hold.
#pragma once

#include "case.hpp"

#include <string>
#include <vector>

namespace foam::fuzz {

struct Outcome {
    std::vector<std::string> findings; ///< what did not hold; none: the case passed
    std::string end;                   ///< "proved", "fitted", "refused: MESSAGE"
    std::string spherizer;             ///< of the recipe
    double seconds = 0;                ///< of CPU
};

/// Writes the case into `folder`, which is made, runs it there, reads back what was written and judges it.
Outcome run_case(const Case& made, Registry& registry, const std::filesystem::path& folder);

} // namespace foam::fuzz
