#include "base64.hpp"

#include <array>
#include <cstdint>

namespace foam::load_mesh {
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
