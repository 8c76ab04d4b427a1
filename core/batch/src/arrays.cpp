#include "messages.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zip.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>

namespace foam::inline batch {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays say so");

/// Returns the bytes of an array in NumPy's format 1.0 (numpy.lib.format): magic, length of the header, the header as a
/// Python dictionary padded to 64 bytes, the numbers.
std::string npy(const std::string& type, const std::string& shape, const void* data, std::size_t bytes) {
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
    constexpr std::size_t before = 10, alignment = 64;
    header.append(alignment - 1 - (before + header.size()) % alignment, ' ');
    header += '\n';
    std::string result("\x93NUMPY\x01\x00", 8);
    result += static_cast<char>(header.size() & 0xFF);
    result += static_cast<char>(header.size() >> 8);
    result += header;
    result.append(static_cast<const char*>(data), bytes);
    return result;
}

template <class T> std::string npy(const std::string& type, const std::string& shape, const std::vector<T>& values) {
    return npy(type, shape, values.data(), values.size() * sizeof(T));
}

/// Returns UTF-8 text as code points.
std::u32string code_points(const std::string& text) {
    std::u32string result;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
        char32_t point = length == 1 ? lead : lead & (0xFFU >> (length + 1));
        for (std::size_t k = 1; k < length && i + k < text.size(); ++k) {
            point = point << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
        }
        result += point;
        i += length;
    }
    return result;
}

/// Returns texts as an array of NumPy's fixed-width Unicode.
std::string npy_of_texts(const std::vector<std::string>& texts) {
    std::vector<std::u32string> points;
    std::size_t width = 1;
    for (const std::string& text : texts) {
        points.push_back(code_points(text));
        width = std::max(width, points.back().size());
    }
    std::vector<char32_t> all;
    all.reserve(width * texts.size());
    for (const std::u32string& text : points) {
        all.insert(all.end(), text.begin(), text.end());
        all.insert(all.end(), width - text.size(), U'\0');
    }
    return npy(fmt::format("<U{}", width), fmt::format("({},)", texts.size()), all);
}

} // namespace

void Arrays::add(const nlohmann::ordered_json& result) {
    ids_.push_back(result.at("id"));
    if (const auto spheres = result.find("spheres"); spheres != result.end()) {
        for (const auto& sphere : *spheres) {
            for (const auto& number : sphere) {
                spheres_.push_back(number.get<double>());
            }
        }
    }
    starts_.push_back(static_cast<std::int64_t>(spheres_.size() / 4));
    certified_.push_back(result.value("certified", false) ? 1 : 0);
    const auto excess = result.find("excess");
    excess_.push_back(excess == result.end()  ? std::numeric_limits<double>::quiet_NaN()
                      : excess->is_number() ? excess->get<double>()
                                              : std::numeric_limits<double>::infinity());
}

void Arrays::write(const std::filesystem::path& file) const {
    const std::string count = fmt::format("({},)", ids_.size());
    const std::vector<std::pair<std::string, std::string>> arrays{
        {"id.npy", npy_of_texts(ids_)},
        {"start.npy", npy("<i8", fmt::format("({},)", starts_.size()), starts_)},
        {"spheres.npy", npy("<f8", fmt::format("({}, 4)", spheres_.size() / 4), spheres_)},
        {"certified.npy", npy("|b1", count, certified_)},
        {"excess.npy", npy("<f8", count, excess_)}};
    int code = 0;
    zip_t* zip = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    bool good = zip != nullptr;
    for (const auto& [name, bytes] : arrays) {
        if (good) {
            zip_source_t* source = zip_source_buffer(zip, bytes.data(), bytes.size(), 0);
            const zip_int64_t index = zip_file_add(zip, name.c_str(), source, ZIP_FL_ENC_UTF_8);
            constexpr time_t no_time = 315619200; // 1980-01-02, so that equal results give equal bytes
            good = index >= 0 && zip_file_set_mtime(zip, static_cast<zip_uint64_t>(index), no_time, 0) == 0 &&
                   zip_set_file_compression(zip, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0) == 0;
        }
    }
    if (!good || zip_close(zip) != 0) { // zip_close() writes a temporary file and renames it
        const std::string why = zip ? zip_strerror(zip) : "it cannot be opened";
        if (zip) {
            zip_discard(zip);
        }
        throw Error(ErrorCode::output, fmt::format("{}: it cannot be written ({})", file.string(), why));
    }
}

} // namespace foam::batch
