#include "readers.hpp"

#include "part.hpp"

#include <foam/base/file.hpp>

namespace foam::load_mesh {
namespace {

using Colours = std::map<std::string, std::uint32_t, std::less<>>;

constexpr std::uintmax_t most_bytes = 16'000'000; ///< of an MTL file

void read_materials(const Source& file, Colours& colours) {
    Lines lines(file, '#', true);
    std::string name;
    std::array<double, 4> shares{0, 0, 0, 1};
    const auto close = [&] {
        if (!name.empty()) {
            colours[name] = colour_number(shares);
        }
    };
    while (lines.next()) {
        const std::string_view keyword = lines.word();
        if (keyword == "newmtl") {
            close();
            name = lines.word();
            shares = {0, 0, 0, 1};
        } else if (keyword == "Kd") {
            for (std::size_t i = 0; i < 3; ++i) {
                shares[i] = to_number(lines.word()).value_or(0);
            }
        } else if (keyword == "d") {
            shares[3] = to_number(lines.word()).value_or(1);
        } else if (keyword == "map_Kd") {
            name.clear(); // a texture, which is not drawn
        }
    }
    close();
}

} // namespace

Colours obj_colours(const Source& obj) {
    Colours colours;
    Lines lines(obj, '#', true);
    while (lines.next()) {
        if (lines.word() != "mtllib") {
            continue;
        }
        for (std::string_view name = lines.word(); !name.empty(); name = lines.word()) {
            const std::filesystem::path file = obj.file.parent_path() / std::filesystem::path(name);
            FileContents contents = read_regular_file(file, most_bytes, "give a smaller file");
            if (contents.problem.empty()) {
                read_materials({file, std::move(contents.bytes)}, colours);
            }
        }
    }
    return colours;
}

} // namespace foam::load_mesh
