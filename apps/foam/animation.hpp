// Pictures one after another as one file.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace foam::cli {

/// Returns an animated WebP that repeats for ever. `frames`: PNG files of one size, at least one; each is shown for
/// `each`. Equal frames give equal bytes. Throws Error(internal) for frames that are no such files.
std::string animated_webp(const std::vector<std::string>& frames, std::chrono::milliseconds each);

} // namespace foam::cli
