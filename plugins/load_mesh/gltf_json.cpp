// The JSON of glTF: where it lies in a container, values with their places, bytes within text.
#include "gltf.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

static_assert(std::endian::native == std::endian::little, "glTF is little-endian and read as it lies in memory");

namespace foam::load_mesh {

GltfContainer open_gltf(const Source& source) {
    const std::string_view bytes = source.bytes;
    if (!bytes.starts_with("glTF")) {
        return {bytes, {}};
    }
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        if (at + sizeof value > bytes.size()) {
            throw source.error(fmt::format(
                "the GLB ends after {} bytes, inside a header; remedy: export or copy it again", bytes.size()));
        }
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    if (word(4) != 2) {
        throw source.error(fmt::format("it is glTF {}; remedy: export glTF 2.0", word(4)));
    }
    if (word(8) > bytes.size()) {
        throw source.error(fmt::format(
            "the GLB promises {} bytes, but the file has {}; remedy: export or copy it again", word(8), bytes.size()));
    }
    GltfContainer result;
    for (std::size_t at = 12; at + 8 <= word(8);) {
        const std::uint64_t length = word(at);
        const std::uint32_t type = word(at + 4);
        if (length > bytes.size() - at - 8) {
            throw source.error(
                fmt::format("a chunk of the GLB promises {} bytes, but {} follow; remedy: export or copy it again",
                            length, bytes.size() - at - 8));
        }
        constexpr std::uint32_t json = 0x4E4F534A, bin = 0x004E4942;
        if (type == json) {
            result.text = bytes.substr(at + 8, length);
        } else if (type == bin) {
            result.binary = bytes.substr(at + 8, length);
        }
        at += 8 + length;
    }
    return result;
}

Error JsonPlace::error(std::string_view what) const {
    return source_->error(
        fmt::format("{} {}; remedy: export or copy it again", path_.empty() ? "the JSON" : path_, what));
}

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const {
    if (!value_->is_object()) {
        return std::nullopt;
    }
    const auto it = value_->find(key);
    if (it == value_->end()) {
        return std::nullopt;
    }
    JsonPlace result = *this;
    result.value_ = &*it;
    result.path_ = path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
    return result;
}

JsonPlace JsonPlace::at(std::string_view key) const {
    if (auto member = find(key)) {
        return *member;
    }
    throw error(fmt::format("has no '{}'", key));
}

JsonPlace JsonPlace::operator[](std::size_t index) const {
    JsonPlace result = *this;
    result.value_ = &(*value_)[index];
    result.path_ = fmt::format("{}[{}]", path_, index);
    return result;
}

JsonPlace JsonPlace::target(const JsonPlace& root, std::string_view key) const {
    const std::uint64_t index = natural();
    const auto list = root.find(key);
    const std::size_t count = list ? list->size() : 0;
    if (index >= count) {
        throw error(fmt::format("refers to {}[{}], but there are {}", key, index, count));
    }
    return (*list)[index];
}

std::uint64_t JsonPlace::natural() const {
    constexpr double largest = 0x1p48;
    if (value_->is_number()) { // some exporters write 12.0
        const double value = value_->get<double>();
        if (value >= 0 && value < largest && value == std::floor(value)) {
            return static_cast<std::uint64_t>(value);
        }
    }
    throw error("is to be a natural number");
}

double JsonPlace::number() const {
    if (!value_->is_number()) {
        throw error("is to be a number");
    }
    return value_->get<double>();
}

std::vector<double> JsonPlace::numbers(std::size_t count) const {
    if (size() != count) {
        throw error(fmt::format("is to be {} numbers", count));
    }
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) {
        result.push_back((*this)[i].number());
    }
    return result;
}

bool JsonPlace::flag(std::string_view key) const {
    const auto member = find(key);
    return member && member->value_->is_boolean() && member->value_->get<bool>();
}

std::uint64_t JsonPlace::natural(std::string_view key, std::uint64_t otherwise) const {
    const auto member = find(key);
    return member ? member->natural() : otherwise;
}

namespace {

constexpr std::uint8_t skipped = 64, wrong = 65;

constexpr std::array<std::uint8_t, 256> values() {
    std::array<std::uint8_t, 256> table{};
    table.fill(wrong);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i) {
        table[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
    }
    table['-'] = 62; // the URL-safe alphabet
    table['_'] = 63;
    for (const char c : {' ', '\t', '\r', '\n', '='}) {
        table[static_cast<unsigned char>(c)] = skipped;
    }
    return table;
}

} // namespace

std::optional<std::string> from_base64(std::string_view text) {
    static constexpr auto table = values();
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::uint8_t value = table[static_cast<unsigned char>(c)];
        if (value == wrong) {
            return std::nullopt;
        }
        if (value == skipped) {
            continue;
        }
        bits = bits << 6 | value;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<char>(bits >> count & 0xFF));
        }
    }
    return bytes;
}

} // namespace foam::load_mesh
