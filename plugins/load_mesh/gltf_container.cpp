#include "gltf_container.hpp"

#include <fmt/format.h>

#include <bit>
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

} // namespace foam::load_mesh
