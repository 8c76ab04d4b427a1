// Geomview's Object File Format: http://www.geomview.org/docs/html/OFF.html
#include "readers.hpp"

#include <foam/base/cancellation.hpp>

#include <fmt/format.h>

namespace foam::load_mesh {
namespace {

class OffReader {
public:
    OffReader(const Source& source, MeshBuilder& builder)
        : source_(source), builder_(builder), lines_(source, '#', false), points_(builder) {}

    void read(Context& context) {
        counts();
        points_.reserve(vertex_count_);
        CancellationCounter asking(4096);
        for (std::size_t i = 0; i < vertex_count_; ++i) {
            asking.check();
            need_line(fmt::format("vertex {} of {}", i + 1, vertex_count_));
            const Vec3 p = point();
            points_.add(p, [&] {
                return source_.error_at(lines_.line(),
                                        fmt::format("the vertex is not finite: {}; remedy: export the mesh "
                                                    "again without it",
                                                    text_of(p)));
            });
        }
        std::size_t thin = 0;
        for (std::size_t i = 0; i < face_count_; ++i) {
            asking.check();
            need_line(fmt::format("face {} of {}", i + 1, face_count_));
            thin += face() ? 0 : 1;
        }
        if (thin > 0) {
            context.log(Severity::warning, fmt::format("{}: {} faces of fewer than three corners are left out",
                                                       source_.file.string(), thin));
        }
    }

private:
    /// Moves to the next line with a word.
    void need_line(std::string_view what) {
        CancellationCounter asking(4096);
        while (lines_.next()) {
            asking.check();
            first_ = lines_.word();
            if (!first_.empty()) {
                return;
            }
        }
        throw source_.error_at(lines_.line(),
                               fmt::format("the file ends before {}; remedy: export or copy it again", what));
    }

    /// Returns the word that need_line() found, then those after it.
    std::string_view word() {
        const std::string_view result = first_.empty() ? lines_.word() : first_;
        first_ = {};
        return result;
    }

    std::int64_t integer(std::string_view what) {
        const std::string_view text = word();
        const auto value = to_integer(text);
        if (!value) {
            throw source_.error_at(lines_.line(),
                                   text.empty() ? fmt::format("{} is missing", what)
                                                : fmt::format("{} is to be an integer, got {}", what, printable(text)));
        }
        return *value;
    }

    /// Reads "OFF" with its prefixes, and the three counts, on one line or two.
    void counts() {
        need_line("the word OFF");
        std::string keyword(first_);
        if (keyword.ends_with("OFF")) {
            word();
            const std::string prefix = keyword.substr(0, keyword.size() - 3);
            if (prefix.find_first_not_of("STCN") != prefix.npos) {
                throw source_.error_at(lines_.line(),
                                       fmt::format("{} files are not read (only OFF, with the prefixes C, N and ST); "
                                                   "remedy: export OFF, PLY or STL",
                                                   keyword));
            }
            first_ = lines_.word();
            if (first_ == "BINARY") {
                throw source_.error_at(lines_.line(),
                                       "binary OFF is not read; remedy: export text OFF, or binary PLY or STL");
            }
            if (first_.empty()) {
                need_line("the counts of vertices and faces");
            }
        } else if (!to_integer(keyword)) {
            throw source_.error_at(lines_.line(), fmt::format("expected 'OFF', got {}", printable(keyword)));
        }
        vertex_count_ = count("vertices", 6); // "0 0 0\n"
        face_count_ = count("faces", 2);      // "0\n"
    }

    std::size_t count(std::string_view what, std::size_t bytes_each) {
        const std::int64_t value = integer(fmt::format("the count of {}", what));
        if (value < 0 || static_cast<std::uint64_t>(value) > lines_.bytes_left() / bytes_each + 1) {
            throw source_.error_at(lines_.line(),
                                   fmt::format("the file promises {} {}, but only {} bytes follow; remedy: export or "
                                               "copy it again",
                                               value, what, lines_.bytes_left()));
        }
        return static_cast<std::size_t>(value);
    }

    Vec3 point() {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view text = word();
            const auto value = to_number(text);
            if (!value) {
                throw source_.error_at(lines_.line(),
                                       fmt::format("a vertex is to be three numbers, got {}", printable(text)));
            }
            p[axis] = *value;
        }
        return p;
    }

    /// Reads a face. Returns false if it has fewer than three corners. A colour may follow the corners.
    bool face() {
        const std::int64_t size = integer("the number of corners of the face");
        if (size < 0) {
            throw source_.error_at(lines_.line(), fmt::format("the face has {} corners", size));
        }
        polygon_.clear();
        for (std::int64_t k = 0; k < size; ++k) {
            const std::int64_t index = integer("a corner of the face");
            if (index < 0 || index >= static_cast<std::int64_t>(points_.size())) {
                throw source_.error_at(
                    lines_.line(), fmt::format("the face refers to vertex {}, but the file has {} (the first is 0); "
                                               "remedy: export the mesh again",
                                               index, points_.size()));
            }
            polygon_.push_back(points_[static_cast<std::size_t>(index)]);
        }
        if (size < 3) {
            return false;
        }
        builder_.polygon(polygon_);
        return true;
    }

    const Source& source_;
    MeshBuilder& builder_;
    Lines lines_;
    std::string_view first_;
    std::size_t vertex_count_ = 0, face_count_ = 0;
    FileVertices points_;
    std::vector<std::uint32_t> polygon_;
};

} // namespace

void read_off(const Source& source, MeshBuilder& builder, Context& context) {
    OffReader(source, builder).read(context);
}

} // namespace foam::load_mesh
