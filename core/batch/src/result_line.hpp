// What is read of the line of a result, without building its spheres.
#pragma once

#include <foam/base/internal/digest.hpp>

#include <string>
#include <string_view>

namespace foam::inline batch {

/// The first keys of a line.
struct ResultHead {
    std::string id;
    Digest digest; ///< of the file; empty if it was not read
    bool failed = false;
};

/// Returns them; reads no further. Throws Error(input) for a line that is no result.
ResultHead head_of(std::string_view line);

/// All but the spheres and their figures.
struct ResultSummary : ResultHead {
    std::string code, reason; ///< of the failure
    double cpu_seconds = 0;
};

/// Returns it. O(length of the line). Throws Error(input) for a line that is no result.
ResultSummary summary_of(std::string_view line);

} // namespace foam::batch
