// Files of JSON lines, compressed as a sequence of Zstandard frames: what was cut off while a frame was written is lost
// alone.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace foam::inline batch {

/// Returns a frame that holds `text`. The same text gives the same bytes with the same version of libzstd.
std::string frame_of(std::string_view text);

/// Calls `on_line` for each line of whole frames, in order, without its line end. Returns the number of bytes up to the
/// end of the last whole frame. Bytes behind it that are no frame are ignored.
std::size_t for_each_line(std::string_view bytes, const std::function<void(std::string_view)>& on_line);

/// Reads a file whose frames must be whole. Throws Error(input) for one that is damaged or cut off.
void for_each_line_of(const std::filesystem::path& file, const std::function<void(std::string_view)>& on_line);

} // namespace foam::batch
