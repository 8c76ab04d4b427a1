// What the figures of a run must keep.
#pragma once

#include <foam/judge/evaluate.hpp>
#include <foam/runtime/run.hpp>

#include <string>
#include <vector>

namespace foam::fuzz {

std::string text_of_number(double value);

/// Spheres that are not finite, figures that are no numbers, a guarantee without proof.
std::vector<std::string> odd_figures(const RunResult& result, const Recipe& recipe);

/// Links whose spheres claim more outside than one bounding sphere would. Not asked where the recipe wants other things
/// first: planes kept off, another objective than excess, elements on their own.
std::vector<std::string> excess_findings(const Original& original, const RunResult& result, const Recipe& recipe);

} // namespace foam::fuzz
