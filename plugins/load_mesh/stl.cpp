#include "readers.hpp"

#include <foam/base/text.hpp>
#include <foam/base/cancellation.hpp>

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies in memory");

namespace foam::load_mesh {
namespace {

constexpr std::size_t header_size = 84, facet_size = 50;

/// Returns whether the file is text. A binary header may begin with "solid" too, so the first word is not enough.
bool is_text(std::string_view bytes) {
    const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
    if (begin == bytes.npos || lower_case(bytes.substr(begin, 5)) != "solid") {
        return false;
    }
    const std::string start = lower_case(bytes.substr(begin, 1024));
    return start.find('\0') == start.npos &&
           (start.find("facet") != start.npos || start.find("endsolid") != start.npos);
}

void read_binary(const Source& source, std::uint32_t promised, MeshBuilder& builder, Context& context) {
    const std::string& bytes = source.bytes;
    const std::uint64_t needed = header_size + std::uint64_t{facet_size} * promised;
    if (bytes.size() < needed) {
        throw source.error(
            fmt::format("the binary STL promises {} triangles ({} bytes), but the file has {} bytes; remedy: "
                        "export or copy it again",
                        promised, needed, bytes.size()));
    }
    builder.expect_triangles(promised);
    builder.reserve_triangles(promised);
    if (bytes.size() > needed) {
        context.log(Severity::warning,
                    fmt::format("{}: {} bytes after the {} triangles that the binary STL promises are ignored",
                                source.file.string(), bytes.size() - needed, promised));
    }
    CancellationCounter asking(4096);
    for (std::size_t t = 0; t < promised; ++t) {
        asking.check();
        std::array<float, 12> values; // normal, three corners
        std::memcpy(values.data(), bytes.data() + header_size + facet_size * t, sizeof values);
        Triangle triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p{values[3 + 3 * k], values[4 + 3 * k], values[5 + 3 * k]};
            if (!is_finite(p)) {
                throw source.error(
                    fmt::format("corner {} of triangle {} is not finite: {}; remedy: export the mesh again "
                                "without it",
                                k + 1, t + 1, text_of(p)));
            }
            triangle[k] = builder.vertex(p);
        }
        builder.triangle(triangle[0], triangle[1], triangle[2]);
    }
}

class TextReader {
public:
    TextReader(const Source& source, MeshBuilder& builder)
        : source_(source), builder_(builder), words_(source, 0, source.bytes.size(), 1, 0) {}

    void read(Context& context) {
        bool open = false;
        CancellationCounter asking(4096);
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            asking.check();
            const std::string keyword = lower_case(word);
            if (keyword == "facet" && open) {
                facet();
            } else if (keyword == "solid" || keyword == "endsolid") {
                open = keyword == "solid";
                words_.skip_line(); // the name
            } else {
                throw source_.error_at(
                    words_.line(),
                    fmt::format("expected '{}', got {}", open ? "facet' or 'endsolid" : "solid", printable(word)));
            }
        }
        if (open) {
            context.log(Severity::warning, fmt::format("{}: the last solid has no 'endsolid'; triangles may be missing",
                                                       source_.file.string()));
        }
    }

private:
    void expect(std::string_view keyword) {
        const std::string_view word = words_.next();
        if (word.empty()) {
            throw source_.error_at(words_.line(),
                                   fmt::format("the file ends inside a facet, before '{}'; remedy: export or copy "
                                               "it again",
                                               keyword));
        }
        if (lower_case(word) != keyword) {
            throw source_.error_at(words_.line(), fmt::format("expected '{}', got {}", keyword, printable(word)));
        }
    }

    void facet() {
        expect("normal");
        for (int k = 0; k < 3; ++k) {
            words_.next(); // normals are not used; some programs write nan for thin triangles
        }
        expect("outer");
        expect("loop");
        Triangle triangle{};
        for (std::uint32_t& corner : triangle) {
            expect("vertex");
            Vec3 p;
            p.x = words_.number("a coordinate");
            p.y = words_.number("a coordinate");
            p.z = words_.number("a coordinate");
            if (!is_finite(p)) {
                throw source_.error_at(words_.line(),
                                       fmt::format("the vertex is not finite: {}; remedy: export the mesh again "
                                                   "without it",
                                                   text_of(p)));
            }
            corner = builder_.vertex(p);
        }
        expect("endloop");
        expect("endfacet");
        builder_.triangle(triangle[0], triangle[1], triangle[2]);
    }

    const Source& source_;
    MeshBuilder& builder_;
    Words words_;
};

} // namespace

void read_stl(const Source& source, MeshBuilder& builder, Context& context) {
    const std::string& bytes = source.bytes;
    std::uint32_t promised = 0;
    if (bytes.size() >= header_size) {
        std::memcpy(&promised, bytes.data() + header_size - sizeof promised, sizeof promised);
    }
    const bool exact =
        bytes.size() >= header_size && bytes.size() == header_size + std::uint64_t{facet_size} * promised;
    if (!exact && is_text(bytes)) {
        TextReader(source, builder).read(context);
    } else if (bytes.size() < header_size) {
        throw source.error(
            fmt::format("it is no STL: no text that starts with 'solid', and its {} bytes are fewer than the {} of "
                        "a binary header",
                        bytes.size(), header_size));
    } else {
        read_binary(source, promised, builder, context);
    }
}

} // namespace foam::load_mesh
