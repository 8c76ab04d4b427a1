// Tables of numbers without a header: GPMP2's "link_id x y z r", and plain "x y z r".
#pragma once

#include "dh_frames.hpp"

#include <foam/sdk/context.hpp>
#include <foam/sdk/model.hpp>

#include <string_view>

namespace foam::rows {

/// A comment that begins so states the DhFrame of the rows below it.
inline constexpr std::string_view frame_comment = "% foam frame: ";

/// Returns the first line that is neither blank nor a comment.
std::string_view first_row(std::string_view text);
/// Returns the line without a comment, and with spaces instead of commas.
std::string row_of(std::string_view line);
/// Reads the rows. Those below a comment with a frame are of its link, in the link's frame.
SphereFile read_rows(std::string_view text, const std::filesystem::path& file);
/// Returns the spheres as rows. Radii grow by what the rounding of the transformation moves a centre. Throws
/// Error(output) for a link without a frame.
std::string rows_text(const SphereModel& model, const std::vector<DhFrame>& frames, Context& context);

} // namespace foam::rows
