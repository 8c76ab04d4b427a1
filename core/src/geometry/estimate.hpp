#pragma once

namespace foam::geometry {

/// A quantity and its standard error.
struct Estimate {
    double value = 0, error = 0;
};

} // namespace foam::geometry
