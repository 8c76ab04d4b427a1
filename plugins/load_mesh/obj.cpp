// Wavefront OBJ, after the Advanced Visualizer manual, appendix B1.
#include "readers.hpp"

#include <foam/base/cancellation.hpp>

#include <fmt/format.h>

#include <limits>

namespace foam::load_mesh {
namespace {

class ObjReader {
public:
    ObjReader(const Source& source, MeshBuilder& builder)
        : source_(source), builder_(builder), lines_(source, '#', true), points_(builder) {}

    void read(Context& context) {
        CancellationCounter asking(4096);
        while (lines_.next()) {
            asking.check();
            const std::string_view keyword = lines_.word();
            if (keyword == "v") {
                vertex();
            } else if (keyword == "f" || keyword == "fo") {
                face();
            } else if (keyword == "usemtl") {
                colour_ = builder_.colour_named(lines_.word());
            } else if (keyword == "surf" || keyword == "curv" || keyword == "curv2") {
                ++free_forms_;
            }
        }
        emit();
        if (free_forms_ > 0) {
            context.log(Severity::warning,
                        fmt::format("{}: {} free-form curves or surfaces are left out; remedy: export polygons",
                                    source_.file.string(), free_forms_));
        }
        if (thin_faces_ > 0) {
            context.log(Severity::warning, fmt::format("{}: {} faces of fewer than three corners are left out",
                                                       source_.file.string(), thin_faces_));
        }
    }

private:
    void vertex() {
        const Vec3 point = lines_.point("a coordinate of the vertex");
        points_.add(point, [&] {
            return source_.error_at(lines_.line(), fmt::format("a coordinate of the vertex is not finite: {}; remedy: "
                                                               "export the mesh again without it",
                                                               text_of(point)));
        });
    }

    struct Face {
        std::size_t line, end; ///< end: one past its last corner in corners_
        std::uint32_t colour;
    };

    static constexpr std::int64_t zero = std::numeric_limits<std::int64_t>::min();

    /// Returns one corner "v", "v/vt", "v//vn" or "v/vt/vn": the vertex as a 0-based index. The vertex may follow later
    /// in the file, so its existence is checked at the end.
    std::int64_t corner(std::string_view word) const {
        const std::string_view index = word.substr(0, word.find('/'));
        const auto value = to_integer(index);
        if (!value) {
            throw source_.error_at(lines_.line(),
                                   fmt::format("a face's corner is to be a vertex index, got {}", printable(word)));
        }
        return *value > 0 ? *value - 1 : *value == 0 ? zero : static_cast<std::int64_t>(points_.size()) + *value;
    }

    void face() {
        const std::size_t begin = corners_.size();
        for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
            corners_.push_back(corner(word));
        }
        if (corners_.size() - begin < 3) {
            corners_.resize(begin);
            ++thin_faces_;
            return;
        }
        faces_.push_back({lines_.line(), corners_.size(), colour_});
    }

    void emit() {
        std::size_t begin = 0;
        std::vector<std::uint32_t> polygon;
        CancellationCounter asking(4096);
        for (const Face& face : faces_) {
            asking.check();
            polygon.clear();
            for (; begin < face.end; ++begin) {
                check(corners_[begin], face.line);
                polygon.push_back(points_[static_cast<std::size_t>(corners_[begin])]);
            }
            builder_.paint(face.colour);
            builder_.polygon(polygon);
        }
    }

    void check(std::int64_t index, std::size_t line) const {
        std::string why;
        if (index == zero) {
            why = "refers to vertex 0, but the first is 1";
        } else if (index < 0) {
            why = fmt::format("counts back to {} vertices before the first", -index);
        } else if (index >= static_cast<std::int64_t>(points_.size())) {
            why = fmt::format("refers to vertex {}, but the file has {}", index + 1, points_.size());
        } else {
            return;
        }
        throw source_.error_at(line, fmt::format("the face {}; remedy: export the mesh again", why));
    }

    const Source& source_;
    MeshBuilder& builder_;
    Lines lines_;
    FileVertices points_;
    std::vector<std::int64_t> corners_;
    std::vector<Face> faces_;
    std::size_t free_forms_ = 0, thin_faces_ = 0;
    std::uint32_t colour_ = 0; ///< of the faces that follow
};

} // namespace

void read_obj(const Source& source, MeshBuilder& builder, Context& context) {
    ObjReader(source, builder).read(context);
}

} // namespace foam::load_mesh
