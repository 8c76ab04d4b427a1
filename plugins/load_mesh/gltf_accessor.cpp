#include "gltf.hpp"

#include "builder.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace foam::load_mesh {
namespace {

template <class T> T read(const char* bytes) {
    T value{};
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

} // namespace

GltfAccessors::GltfAccessors(const Source& source, const JsonPlace& root, std::string_view binary,
                             std::uintmax_t max_bytes, std::uint64_t max_count)
    : source_(source), root_(root), binary_(binary), bytes_left_(max_bytes), max_count_(max_count) {}

std::vector<Vec3> GltfAccessors::points(const JsonPlace& index) {
    const std::vector<double> numbers = vectors(index, 3);
    std::vector<Vec3> result(numbers.size() / 3);
    CancellationCounter asking(8192);
    for (std::size_t i = 0; i < result.size(); ++i) {
        asking.check();
        result[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    }
    return result;
}

std::vector<double> GltfAccessors::vectors(const JsonPlace& index, std::uint64_t width) {
    const JsonPlace accessor = index.target(root_, "accessors");
    const Shape shape{count_of(accessor), width, component_of(accessor), accessor.flag("normalized")};
    if (accessor.at("type").text() != fmt::format("VEC{}", width) || shape.component == Component::uint32) {
        throw index.error(fmt::format("is to be an accessor of {} floats, or integers of 8 or 16 bits",
                                      width == 3 ? "three" : "four"));
    }
    return values(accessor, shape);
}

std::vector<std::uint32_t> GltfAccessors::indices(const JsonPlace& index) {
    const JsonPlace accessor = index.target(root_, "accessors");
    const Shape shape{count_of(accessor), 1, component_of(accessor), false};
    const bool natural = shape.component == Component::uint8 || shape.component == Component::uint16 ||
                         shape.component == Component::uint32;
    if (accessor.at("type").text() != "SCALAR" || !natural) {
        throw index.error("is no accessor of unsigned scalars");
    }
    const std::vector<double> numbers = values(accessor, shape);
    return {numbers.begin(), numbers.end()};
}

std::vector<double> GltfAccessors::values(const JsonPlace& accessor, const Shape& shape) {
    std::vector<double> result =
        accessor.find("bufferView") ? dense(accessor, shape) : std::vector<double>(shape.count * shape.width, 0);
    if (const auto sparse = accessor.find("sparse")) {
        put_sparse(*sparse, shape, result);
    }
    return result;
}

/// Reads dense elements. `item`: the object with bufferView and byteOffset.
std::vector<double> GltfAccessors::dense(const JsonPlace& item, const Shape& shape) {
    const JsonPlace view = item.at("bufferView").target(root_, "bufferViews");
    const std::string_view whole = buffer(view.at("buffer").target(root_, "buffers"));
    const std::uint64_t offset = view.natural("byteOffset", 0), length = view.at("byteLength").natural();
    if (offset + length > whole.size()) {
        throw view.error(fmt::format("ends at byte {} of a buffer of {}", offset + length, whole.size()));
    }
    const std::string_view bytes = whole.substr(offset, length);
    const std::uint64_t size = shape.width * size_of(shape.component), given = view.natural("byteStride", 0),
                        step = given == 0 ? size : given, start = item.natural("byteOffset", 0);
    if (step < size || step > 65536) {
        throw item.error(fmt::format("has a byte stride of {} for elements of {} bytes", step, size));
    }
    const std::uint64_t end = start + (shape.count > 0 ? step * (shape.count - 1) + size : 0);
    if (end > bytes.size()) {
        throw item.error(fmt::format("needs {} bytes of {}, which has {}", end, view.path(), bytes.size()));
    }
    std::vector<double> result;
    result.reserve(shape.count * shape.width);
    CancellationCounter asking(8192);
    for (std::uint64_t i = 0; i < shape.count; ++i) {
        asking.check();
        for (std::uint64_t k = 0; k < shape.width; ++k) {
            result.push_back(value_at(bytes.data() + start + i * step + k * size_of(shape.component), shape.component,
                                      shape.normalized));
        }
    }
    return result;
}

/// Replaces the values of sparse elements.
void GltfAccessors::put_sparse(const JsonPlace& sparse, const Shape& shape, std::vector<double>& values) {
    Shape replaced = shape;
    replaced.count = count_of(sparse);
    const JsonPlace places = sparse.at("indices");
    const std::vector<double> indices = dense(places, {replaced.count, 1, component_of(places), false});
    const std::vector<double> others = dense(sparse.at("values"), replaced);
    CancellationCounter asking(8192);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        asking.check();
        if (!(indices[i] >= 0 && indices[i] < static_cast<double>(shape.count))) {
            throw places.error(fmt::format("refers to element {} of {}", indices[i], shape.count));
        }
        std::copy_n(others.begin() + static_cast<std::ptrdiff_t>(i * shape.width), shape.width,
                    values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::uint64_t>(indices[i]) * shape.width));
    }
}

std::string_view GltfAccessors::buffer(const JsonPlace& item) {
    std::string_view bytes = binary_;
    if (const auto uri = item.find("uri")) {
        const auto it = buffers_.find(item.path());
        bytes = it != buffers_.end() ? it->second : buffers_[item.path()] = open(*uri);
    }
    const std::uint64_t promised = item.at("byteLength").natural();
    if (promised > bytes.size()) {
        throw item.error(fmt::format("promises {} bytes, but there are {}", promised, bytes.size()));
    }
    return bytes.substr(0, promised);
}

std::string GltfAccessors::open(const JsonPlace& uri) {
    const std::string text = uri.text();
    if (text.starts_with("data:")) {
        const std::size_t comma = text.find(',');
        auto bytes = comma == text.npos || !text.substr(0, comma).ends_with(";base64")
                         ? std::nullopt
                         : from_base64(std::string_view(text).substr(comma + 1));
        if (!bytes) {
            throw uri.error("is no data in base64");
        }
        return std::move(*bytes);
    }
    const auto file = source_.file.parent_path() / percent_decoded(text);
    FileContents contents = read_regular_file(file, bytes_left_, too_large_remedy);
    if (!contents.problem.empty()) {
        std::error_code error;
        const bool there = std::filesystem::exists(file, error);
        throw source_.error(fmt::format("{} is the file {}, which cannot be read ({}); remedy: {}", uri.path(),
                                        file.string(), contents.problem,
                                        there ? contents.remedy : "copy it beside this file"));
    }
    bytes_left_ -= contents.bytes.size();
    return std::move(contents.bytes);
}

std::uint64_t GltfAccessors::count_of(const JsonPlace& item) const {
    const std::uint64_t count = item.at("count").natural();
    if (count > max_count_) {
        throw item.error(fmt::format("has {} elements, more than {} triangles can use", count, max_count_ / 3));
    }
    return count;
}

GltfAccessors::Component GltfAccessors::component_of(const JsonPlace& item) {
    const std::uint64_t code = item.at("componentType").natural();
    if (code < 5120 || code > 5126 || code == 5124) {
        throw item.error(fmt::format("has the unknown component type {}", code));
    }
    return Component{code};
}

std::uint64_t GltfAccessors::size_of(Component component) {
    switch (component) {
    case Component::int8:
    case Component::uint8:
        return 1;
    case Component::int16:
    case Component::uint16:
        return 2;
    case Component::uint32:
    case Component::float32:
        return 4;
    }
    return 0;
}

double GltfAccessors::value_at(const char* bytes, Component component, bool normalized) {
    switch (component) {
    case Component::int8:
        return normalized ? std::max(read<std::int8_t>(bytes) / 127.0, -1.0) : read<std::int8_t>(bytes);
    case Component::uint8:
        return read<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
    case Component::int16:
        return normalized ? std::max(read<std::int16_t>(bytes) / 32767.0, -1.0) : read<std::int16_t>(bytes);
    case Component::uint16:
        return read<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
    case Component::uint32:
        return read<std::uint32_t>(bytes);
    case Component::float32:
        return read<float>(bytes);
    }
    return 0;
}

} // namespace foam::load_mesh
