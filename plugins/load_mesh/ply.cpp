// The Polygon File Format, version 1.0 (Turk 1994).
#include "readers.hpp"

#include <foam/base/cancellation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>

static_assert(std::endian::native == std::endian::little, "little-endian values are read as they lie in memory");

namespace foam::load_mesh {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Type> type_of(std::string_view word) {
    static const std::map<std::string_view, Type> types{
        {"char", Type::int8},     {"int8", Type::int8},       {"uchar", Type::uint8},    {"uint8", Type::uint8},
        {"short", Type::int16},   {"int16", Type::int16},     {"ushort", Type::uint16},  {"uint16", Type::uint16},
        {"int", Type::int32},     {"int32", Type::int32},     {"uint", Type::uint32},    {"uint32", Type::uint32},
        {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64}};
    const auto it = types.find(word);
    return it == types.end() ? std::nullopt : std::optional(it->second);
}

std::size_t size_of(Type type) {
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

struct Property {
    std::string name;
    Type type = Type::float32;
    std::optional<Type> count; ///< of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    enum class Format { text, little, big } format = Format::text;
    std::vector<PlyElement> elements;
    std::size_t size = 0, lines = 0; ///< of the header
};

class HeaderReader {
public:
    explicit HeaderReader(const Source& source) : source_(source) {}

    Header read() {
        std::string_view line = next_line();
        if (line != "ply") {
            throw source_.error_at(1, fmt::format("it is no PLY: expected 'ply', got {}", printable(line)));
        }
        bool has_format = false;
        for (line = next_line(); line != "end_header"; line = next_line()) {
            words_.clear();
            for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != line.npos;) {
                const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
                words_.push_back(line.substr(at, end - at));
                at = end;
            }
            if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") {
                continue;
            }
            if (words_[0] == "format" && words_.size() >= 2) {
                header_.format = format(words_[1]);
                has_format = true;
            } else if (words_[0] == "element" && words_.size() == 3) {
                element();
            } else if (words_[0] == "property" && words_.size() >= 3 && !header_.elements.empty()) {
                property();
            } else {
                throw source_.error_at(header_.lines, fmt::format("the PLY header does not allow {}", printable(line)));
            }
        }
        if (!has_format) {
            throw source_.error("the PLY header has no 'format' line");
        }
        header_.size = at_;
        return header_;
    }

private:
    std::string_view next_line() {
        const std::string_view text = source_.bytes;
        const std::size_t end = text.find('\n', at_);
        if (end == text.npos) {
            throw source_.error_at(header_.lines + 1,
                                   "the file ends inside the PLY header; remedy: export or copy it again");
        }
        std::string_view line = text.substr(at_, end - at_);
        at_ = end + 1;
        ++header_.lines;
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) {
            line.remove_suffix(1);
        }
        return line;
    }

    Header::Format format(std::string_view word) const {
        if (word == "ascii") {
            return Header::Format::text;
        }
        if (word == "binary_little_endian") {
            return Header::Format::little;
        }
        if (word == "binary_big_endian") {
            return Header::Format::big;
        }
        throw source_.error_at(header_.lines, fmt::format("unknown PLY format {}", printable(word)));
    }

    void element() {
        const auto count = to_integer(words_[2]);
        if (!count || *count < 0) {
            throw source_.error_at(header_.lines,
                                   fmt::format("the count of element '{}' is to be a natural number, got {}", words_[1],
                                               printable(words_[2])));
        }
        header_.elements.push_back({std::string(words_[1]), static_cast<std::uint64_t>(*count), {}});
    }

    void property() {
        Property result;
        const bool list = words_[1] == "list";
        if (list && words_.size() != 5) {
            throw source_.error_at(header_.lines, "a list property is 'property list COUNT-TYPE TYPE NAME'");
        }
        result.name = words_.back();
        result.type = checked_type(words_[words_.size() - 2]);
        if (list) {
            result.count = checked_type(words_[2]);
        }
        header_.elements.back().properties.push_back(std::move(result));
    }

    Type checked_type(std::string_view word) const {
        if (const auto type = type_of(word)) {
            return *type;
        }
        throw source_.error_at(header_.lines, fmt::format("unknown PLY type {}", printable(word)));
    }

    const Source& source_;
    std::size_t at_ = 0;
    Header header_;
    std::vector<std::string_view> words_;
};

/// The values after the header in order, from text or binary; every type fits a double.
class Values {
public:
    Values(const Source& source, const Header& header)
        : source_(source), format_(header.format), at_(header.size),
          words_(source, header.size, source.bytes.size(), header.lines + 1, 0) {}

    double next(Type type) {
        if (format_ == Header::Format::text) {
            return words_.number("a value");
        }
        const std::size_t size = size_of(type);
        if (source_.bytes.size() - at_ < size) {
            throw source_.error(
                fmt::format("the file ends after {} bytes, inside {} {}; remedy: export or copy it again",
                            source_.bytes.size(), element_, index_));
        }
        std::array<char, 8> raw{};
        std::memcpy(raw.data(), source_.bytes.data() + at_, size);
        at_ += size;
        if (format_ == Header::Format::big) {
            std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
        }
        switch (type) {
        case Type::int8:
            return as<std::int8_t>(raw);
        case Type::uint8:
            return as<std::uint8_t>(raw);
        case Type::int16:
            return as<std::int16_t>(raw);
        case Type::uint16:
            return as<std::uint16_t>(raw);
        case Type::int32:
            return as<std::int32_t>(raw);
        case Type::uint32:
            return as<std::uint32_t>(raw);
        case Type::float32:
            return as<float>(raw);
        case Type::float64:
            return as<double>(raw);
        }
        return 0;
    }

    /// Returns a list's length or an index: an integer of at least `low` and at most 2^32.
    std::int64_t whole(Type type, std::string_view what, double low) {
        const double value = next(type);
        if (!(value >= low && value <= 4294967296.0 && value == std::floor(value))) {
            throw error(fmt::format("{} is {}", what, value));
        }
        return static_cast<std::int64_t>(value);
    }

    std::uint64_t bytes_left() const {
        return format_ == Header::Format::text ? words_.bytes_left() : source_.bytes.size() - at_;
    }
    bool text() const { return format_ == Header::Format::text; }
    /// Sets the current item for messages: "vertex 12".
    void at(std::string_view element, std::uint64_t index) {
        element_ = element;
        index_ = index;
    }
    Error error(std::string_view what) const {
        const std::string message = fmt::format("{} {} (counted from 0): {}", element_, index_, what);
        return text() ? source_.error_at(words_.line(), message) : source_.error(message);
    }

private:
    template <class T> static double as(const std::array<char, 8>& raw) {
        T value{};
        std::memcpy(&value, raw.data(), sizeof value);
        return static_cast<double>(value);
    }

    const Source& source_;
    Header::Format format_;
    std::size_t at_;
    Words words_;
    std::string_view element_;
    std::uint64_t index_ = 0;
};

class BodyReader {
public:
    BodyReader(const Source& source, const Header& header, MeshBuilder& builder)
        : source_(source), values_(source, header), builder_(builder), points_(builder) {}

    void read(const Header& header, Context& context) {
        for (const PlyElement& element : header.elements) {
            check_count(element);
            CancellationCounter asking(4096);
            for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
                asking.check();
                values_.at(element.name, i);
                row(element);
            }
        }
        if (thin_ > 0) {
            context.log(Severity::warning, fmt::format("{}: {} faces of fewer than three corners are left out",
                                                       source_.file.string(), thin_));
        }
    }

private:
    /// Refuses a count for which the rest of the file is too short, before anything is allocated.
    void check_count(const PlyElement& element) const {
        std::uint64_t least = 0;
        for (const Property& p : element.properties) {
            least += values_.text() ? 2 : size_of(p.count.value_or(p.type));
        }
        if (least > 0 && element.count > values_.bytes_left() / least + 1) {
            throw source_.error(
                fmt::format("the PLY promises {} elements '{}' of at least {} bytes, but only {} bytes follow; remedy: "
                            "export or copy it again",
                            element.count, element.name, least, values_.bytes_left()));
        }
    }

    void row(const PlyElement& element) {
        const bool vertex = element.name == "vertex";
        Vec3 point;
        int coordinates = 0;
        for (const Property& p : element.properties) {
            if (p.count) {
                list(element, p);
                continue;
            }
            const double value = values_.next(p.type);
            if (vertex && p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z') {
                point[p.name[0] - 'x'] = value;
                coordinates |= 1 << (p.name[0] - 'x');
            }
        }
        if (!vertex) {
            return;
        }
        if (coordinates != 7) {
            throw source_.error("the PLY's vertices lack a property x, y or z");
        }
        points_.add(point, [&] {
            return values_.error(
                fmt::format("the vertex is not finite: {}; remedy: export the mesh again without it", text_of(point)));
        });
    }

    void list(const PlyElement& element, const Property& p) {
        const bool indices = p.name == "vertex_indices" || p.name == "vertex_index";
        const bool face = indices && element.name == "face", strip = indices && element.name == "tristrips";
        const std::int64_t size = values_.whole(*p.count, "the length of the list", 0);
        corners_.clear();
        for (std::int64_t k = 0; k < size; ++k) {
            if (!face && !strip) {
                values_.next(p.type);
                continue;
            }
            const std::int64_t index = values_.whole(p.type, "the vertex index", strip ? -1 : 0);
            if (index >= static_cast<std::int64_t>(points_.size())) {
                throw values_.error(
                    fmt::format("it refers to vertex {}, but {} are defined before it (the first is 0); remedy: export "
                                "the mesh again",
                                index, points_.size()));
            }
            corners_.push_back(index < 0 ? restart : points_[static_cast<std::size_t>(index)]);
        }
        if (strip) {
            triangle_strips();
        } else if (face && corners_.size() < 3) {
            ++thin_;
        } else if (face) {
            builder_.polygon(corners_);
        }
    }

    /// Adds triangle strips: every second triangle of a strip has the opposite orientation; -1 begins the next strip.
    void triangle_strips() {
        std::size_t start = 0;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            if (corners_[i] == restart) {
                start = i + 1;
            } else if (i >= start + 2) {
                const std::size_t odd = (i - start) % 2;
                builder_.triangle(corners_[i - 2 + odd], corners_[i - 1 - odd], corners_[i]);
            }
        }
    }

    static constexpr std::uint32_t restart = 0xFFFFFFFFu;
    const Source& source_;
    Values values_;
    MeshBuilder& builder_;
    FileVertices points_;
    std::vector<std::uint32_t> corners_;
    std::size_t thin_ = 0;
};

} // namespace

void read_ply(const Source& source, MeshBuilder& builder, Context& context) {
    const Header header = HeaderReader(source).read();
    BodyReader(source, header, builder).read(header, context);
}

} // namespace foam::load_mesh
