// Tables of numbers without a header: GPMP2's "link_id x y z r", and plain "x y z r".
#pragma once

#include <foam/geometry/vector.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/model.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace foam::rows {

/// A link of a URDF on a DH link.
struct DhFrame {
    std::string link;
    std::int64_t id = 0; ///< of the DH link, from 0
    Pose pose;           ///< of the link's frame in the frame after DH link `id`
    std::string text;    ///< as it was read
};

/// Reads "LINK ID x y z roll pitch yaw", m and rad. Throws Error(usage) with the reason.
DhFrame dh_frame(std::string_view text);
/// Reads such entries with line ends or semicolons between them. Throws Error(usage) with the reason, also for a link
/// that is given twice.
std::vector<DhFrame> dh_frames(std::string_view text);

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
