// Published numbers of other programs, drawn beside ours.
#pragma once

#include "chain.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace foam::inline bench::experiment {

/// Columns of a CSV file.
struct Reference {
    std::string label;
    std::vector<std::string> files; ///< candidates; a relative one starts beside the experiment, then in FOAM_SHARED
    std::map<std::string, std::string> where; ///< rows to take: column and its text; none: all
    std::string x, y;                         ///< columns
};

std::vector<Reference> read_reference_list(const reading::Value& value, reading::Findings& findings);

/// The first candidate that exists; empty if none does.
std::filesystem::path find_reference(const Reference& reference, const std::filesystem::path& experiment);
/// The points in the order of x. Throws Error(input) naming the file for a column that is missing and for a cell that
/// is no number.
std::vector<std::pair<double, double>> load_reference(const Reference& reference, const std::filesystem::path& file);

} // namespace foam::bench::experiment
