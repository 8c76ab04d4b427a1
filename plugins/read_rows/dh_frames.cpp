#include "rows.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace foam::rows {
namespace {

/// Returns the pose with quarter turns exact: the cosine of a double near π/2 is not 0.
Pose with_exact_quarter_turns(Pose pose) {
    constexpr double rounding = 1e-15;
    for (Vec3& row : pose.rotation) {
        for (double* entry : {&row.x, &row.y, &row.z}) {
            const double whole = std::round(*entry);
            *entry = std::abs(*entry - whole) < rounding ? whole : *entry;
        }
    }
    return pose;
}

} // namespace

DhFrame dh_frame(std::string_view text) {
    constexpr double most_links = 1e6;
    const std::vector<std::string_view> fields = words(text);
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::usage,
                    fmt::format("'{}': {}; expected is LINK ID x y z roll pitch yaw", shown(text), why));
    };
    if (fields.size() != 8) {
        fail(fmt::format("{} words", fields.size()));
    }
    std::array<double, 7> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::optional<double> number = parse_number(fields[i + 1]);
        if (!number) {
            fail(fmt::format("'{}' is not a finite number", shown(fields[i + 1])));
        }
        numbers[i] = *number;
    }
    if (!(numbers[0] >= 0 && numbers[0] <= most_links && numbers[0] == std::floor(numbers[0]))) {
        fail(fmt::format("{} is not the number of a link, 0 or more", fields[1]));
    }
    const auto& [id, x, y, z, roll, pitch, yaw] = numbers;
    return {std::string(fields[0]), static_cast<std::int64_t>(id),
            with_exact_quarter_turns(Pose::from_xyz_rpy({x, y, z}, {roll, pitch, yaw})),
            fmt::format("{}", fmt::join(fields, " "))};
}

std::vector<DhFrame> dh_frames(std::string_view text) {
    std::vector<DhFrame> frames;
    while (!text.empty()) {
        const std::string_view entry = text.substr(0, text.find_first_of(";\n"));
        text.remove_prefix(std::min(entry.size() + 1, text.size()));
        if (words(entry).empty()) {
            continue;
        }
        DhFrame frame = dh_frame(entry);
        if (std::any_of(frames.begin(), frames.end(), [&](const DhFrame& f) { return f.link == frame.link; })) {
            throw Error(ErrorCode::usage,
                        fmt::format("link '{}' is given twice; remedy: delete one", shown(frame.link)));
        }
        frames.push_back(std::move(frame));
    }
    return frames;
}

} // namespace foam::rows
