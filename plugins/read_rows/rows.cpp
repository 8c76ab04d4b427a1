#include "rows.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace foam::rows {
namespace {

/// Reads the rows of a file, line by line.
class RowFile {
public:
    explicit RowFile(const std::filesystem::path& file) { result.file = file; }

    void read_line(std::string_view line) {
        ++line_;
        if (line.starts_with(frame_comment)) {
            read_frame(line.substr(frame_comment.size()));
            return;
        }
        const std::string row = row_of(line);
        if (const std::vector<std::string_view> fields = words(row); !fields.empty()) {
            read_row(fields);
        }
    }

    void finish() {
        if (columns_ == 0) {
            throw Error(ErrorCode::input, fmt::format("{}: there is no row of numbers", result.file.string()));
        }
        result.format = columns_ == 5 ? "GPMP2 rows" : "rows of numbers";
        if (numbered_ && !frame_) {
            result.notes.push_back(
                "links are numbers: centers of GPMP2 are in the frames of DH links, which the file does "
                "not state; they are taken as they stand");
        }
    }

    SphereFile result;

private:
    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorCode::input, fmt::format("{}:{}: {}", result.file.string(), line_, shown(why)));
    }

    void read_frame(std::string_view text) {
        try {
            frame_ = dh_frame(text);
        } catch (const Error& error) {
            fail(fmt::format("the frame {}", error.what()));
        }
    }

    void read_row(const std::vector<std::string_view>& fields) {
        if (fields.size() != 4 && fields.size() != 5) {
            fail(fmt::format("a row of {} fields; expected are x y z radius, or link x y z radius", fields.size()));
        }
        if (columns_ != 0 && fields.size() != columns_) {
            fail(fmt::format("a row of {} fields after rows of {}; remedy: give all rows the same", fields.size(),
                             columns_));
        }
        columns_ = fields.size();
        std::array<double, 4> numbers{};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::string_view field = fields[columns_ - 4 + i];
            const std::optional<double> value = parse_number(field);
            if (!value) {
                fail(fmt::format("'{}' is not a finite number", field));
            }
            numbers[i] = *value;
        }
        add(columns_ == 5 ? std::string(fields[0]) : "", {{numbers[0], numbers[1], numbers[2]}, numbers[3]});
    }

    void add(const std::string& link, const Sphere& sphere) {
        if (!frame_) {
            numbered_ = numbered_ && parse_number(link);
            spheres_of(result, link).push_back(sphere);
            return;
        }
        if (link != std::to_string(frame_->id)) {
            fail(fmt::format("a row of link {} below the frame of '{}' on link {}; remedy: write the file again with "
                             "write.gpmp2",
                             link.empty() ? "without number" : link, frame_->link, frame_->id));
        }
        const Vec3 center = frame_->pose.inverse() * sphere.center;
        if (!is_finite(center)) {
            fail(fmt::format("the center is no finite point in the frame of '{}'; remedy: correct the frame or the row",
                             frame_->link));
        }
        spheres_of(result, frame_->link).push_back({center, sphere.radius});
    }

    std::size_t columns_ = 0;
    int line_ = 0;
    std::optional<DhFrame> frame_;
    bool numbered_ = true; ///< so far, all links are numbers
};

/// Returns the sphere in the DH frame, so large that it contains the sphere of the link when it is read back.
Sphere sphere_in(const DhFrame& frame, const Sphere& sphere) {
    const Vec3 center = frame.pose * sphere.center;
    const double moved = distance(frame.pose.inverse() * center, sphere.center);
    constexpr double most = 1e-6; // of the radius
    if (!(moved <= most * sphere.radius)) {
        throw Error(
            ErrorCode::output,
            fmt::format("write.gpmp2: the frame of link '{}' is so far away that a center of it moves by {} m in "
                        "rounding; remedy: correct '{}'",
                        shown(frame.link), moved, shown(frame.text)));
    }
    double radius = sphere.radius;
    if (moved > 0) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        radius = std::nextafter(sphere.radius + std::nextafter(moved * (1 + 1e-15), infinity), infinity);
    }
    return {center, radius};
}

const DhFrame& frame_of(const std::string& link, const std::vector<DhFrame>& frames) {
    const auto frame = std::find_if(frames.begin(), frames.end(), [&](const DhFrame& f) { return f.link == link; });
    if (frame == frames.end()) {
        std::vector<std::string> known;
        for (const DhFrame& f : frames) {
            known.push_back(f.link);
        }
        const std::string near = nearest_word(link, known);
        throw Error(
            ErrorCode::output,
            fmt::format("write.gpmp2: link '{}' has spheres, but 'frames' does not name it{}; remedy: add '{} ID x "
                        "y z roll pitch yaw', its pose in the frame of DH link ID, or leave the link out",
                        shown(link), near.empty() ? "" : fmt::format("; did you mean '{}'?", near), shown(link)));
    }
    return *frame;
}

} // namespace

std::string row_of(std::string_view line) {
    std::string row(line.substr(0, line.find_first_of("#%")));
    std::replace(row.begin(), row.end(), ',', ' ');
    return row;
}

std::string_view first_row(std::string_view text) {
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        const std::string_view line = text.substr(0, text.find('\n'));
        if (line.empty() || (line.front() != '%' && line.front() != '#')) {
            return line;
        }
        text.remove_prefix(line.size());
    }
}

SphereFile read_rows(std::string_view text, const std::filesystem::path& file) {
    text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    RowFile rows(file);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        rows.read_line(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    rows.finish();
    return rows.result;
}

std::string rows_text(const SphereModel& model, const std::vector<DhFrame>& frames, Context& context) {
    if (frames.empty()) {
        throw Error(
            ErrorCode::output,
            "write.gpmp2 needs the frames of the DH links, which a URDF does not state; remedy: in the recipe, "
            "write.gpmp2: {frames: \"LINK ID x y z roll pitch yaw; …\"}, for each link with spheres its pose in the "
            "frame of DH link ID");
    }
    std::string text = model.provenance.empty() ? "" : "% " + model.provenance + "\n";
    text += "% link_id x y z r, in the frames of the DH links\n";
    CancellationCounter asking(1024);
    for (const LinkSpheres& link : spheres_by_link(model)) {
        const DhFrame& frame = frame_of(link.link, frames);
        text += fmt::format("{}{}\n", frame_comment, frame.text);
        for (const Sphere& sphere : link.elements.spheres()) {
            asking.check();
            const Sphere s = sphere_in(frame, sphere);
            text += fmt::format("{} {} {} {} {}\n", frame.id, number_text(s.center.x), number_text(s.center.y),
                                number_text(s.center.z), number_text(s.radius));
        }
    }
    context.check_cancelled();
    return text;
}

} // namespace foam::rows
