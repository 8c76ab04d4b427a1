// Where the links of a URDF are in the frames of GPMP2's arms, which are those of Denavit and Hartenberg.
#pragma once

#include <foam/geometry/vector.hpp>

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

} // namespace foam::rows
