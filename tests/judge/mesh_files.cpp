#include "mesh_files.hpp"

#include "collada.hpp"
#include "polygon.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace judge {
namespace {

std::string lower_ending(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

double number_of(const std::string& word) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end == word.c_str() || *end != '\0') {
        throw std::runtime_error("'" + word + "' is no number");
    }
    return value;
}

Point point_of(const std::vector<std::string>& words) {
    if (words.size() < 4) {
        throw std::runtime_error("a vertex has fewer than three numbers");
    }
    return {number_of(words[1]), number_of(words[2]), number_of(words[3])};
}

std::vector<Corners> read_binary_stl(const std::string& bytes, std::uint32_t count) {
    std::vector<Corners> triangles;
    for (std::uint32_t t = 0; t < count; ++t) {
        float values[12];
        std::memcpy(values, bytes.data() + 84 + std::size_t{50} * t, sizeof values);
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = {values[3 + 3 * k], values[4 + 3 * k], values[5 + 3 * k]};
        }
        triangles.push_back(corners);
    }
    return triangles;
}

std::vector<Corners> read_ascii_stl(const std::string& bytes) {
    std::vector<Point> points;
    std::istringstream stream(bytes);
    for (std::string line; std::getline(stream, line);) {
        const std::vector<std::string> words = words_of(line);
        std::string first = words.empty() ? "" : words[0];
        std::transform(first.begin(), first.end(), first.begin(), [](unsigned char c) { return std::tolower(c); });
        if (first == "vertex") {
            points.push_back(point_of(words));
        }
    }
    std::vector<Corners> triangles;
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
        triangles.push_back({points[i], points[i + 1], points[i + 2]});
    }
    return triangles;
}

std::vector<Corners> read_stl(const std::string& bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= 84) {
        std::memcpy(&count, bytes.data() + 80, 4);
    }
    const bool binary = bytes.size() >= 84 && bytes.size() == 84 + std::size_t{50} * count;
    return binary ? read_binary_stl(bytes, count) : read_ascii_stl(bytes);
}

std::vector<Corners> read_obj(const std::string& bytes) {
    std::vector<Point> vertices;
    std::vector<Corners> triangles;
    std::istringstream stream(bytes);
    for (std::string line; std::getline(stream, line);) {
        const std::vector<std::string> words = words_of(line);
        if (!words.empty() && words[0] == "v") {
            vertices.push_back(point_of(words));
        }
        if (words.empty() || words[0] != "f") {
            continue;
        }
        std::vector<Point> corners;
        for (std::size_t k = 1; k < words.size(); ++k) {
            const long index = std::strtol(words[k].c_str(), nullptr, 10);
            corners.push_back(vertices.at(index > 0 ? static_cast<std::size_t>(index) - 1
                                                    : vertices.size() - static_cast<std::size_t>(-index)));
        }
        append_polygon(std::move(corners), triangles);
    }
    return triangles;
}

} // namespace

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<double> numbers_of(const std::string& text) {
    std::string spaced = text;
    std::replace(spaced.begin(), spaced.end(), ',', ' ');
    std::vector<double> numbers;
    for (const std::string& word : words_of(spaced)) {
        numbers.push_back(number_of(word));
    }
    return numbers;
}

bool is_mesh(const std::filesystem::path& file) {
    const std::string ending = lower_ending(file);
    return ending == ".stl" || ending == ".obj" || ending == ".dae";
}

std::vector<Corners> read_triangles(const std::filesystem::path& file) {
    const std::string ending = lower_ending(file), bytes = bytes_of(file);
    if (ending == ".stl") {
        return read_stl(bytes);
    }
    if (ending == ".obj") {
        return read_obj(bytes);
    }
    if (ending == ".dae") {
        return read_collada(bytes);
    }
    throw std::runtime_error(file.string() + ": the judge reads STL, OBJ and COLLADA only");
}

} // namespace judge
