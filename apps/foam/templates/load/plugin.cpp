// @stage@: triangles as text, nine numbers a line: the three corners, counter-clockwise seen from outside, in metres. A start:
// the format is to be yours.
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/plugin.hpp>

#include <fstream>

namespace {

using namespace foam;

class @class@ final : public MeshLoader {
public:
    Mesh load(const std::filesystem::path& file, Context& context) const override {
        std::ifstream stream(file);
        if (!stream) {
            throw Error(ErrorCode::input, file.string() + ": it cannot be read");
        }
        Mesh mesh;
        std::string line;
        for (int number = 1; std::getline(stream, line); ++number) {
            context.check_cancelled();
            add_triangle(mesh, line, file.string() + ":" + std::to_string(number));
        }
        if (mesh.triangles.empty()) {
            throw Error(ErrorCode::input, file.string() + ": it holds no triangle");
        }
        return welded(mesh);
    }

private:
    static void add_triangle(Mesh& mesh, const std::string& line, const std::string& place) {
        const std::vector<std::string_view> numbers = words(line);
        if (numbers.size() != 9) {
            throw Error(ErrorCode::input, place + ": " + std::to_string(numbers.size()) + " numbers instead of 9");
        }
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (std::size_t corner = 0; corner < 3; ++corner) {
            Vec3 point;
            for (int axis = 0; axis < 3; ++axis) {
                const std::string_view text = numbers[3 * corner + static_cast<std::size_t>(axis)];
                const std::optional<double> value = parse_number(text);
                if (!value) {
                    throw Error(ErrorCode::input, place + ": '" + std::string(text) + "' is not a finite number");
                }
                point[axis] = *value;
            }
            mesh.vertices.push_back(point);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
};

} // namespace

FOAM_PLUGIN("@plugin@", "0.1", "Apache-2.0") {
    enrol.add<@class@>({
        .name = "@stage@",
        .summary = "Reads triangles from text, nine numbers a line",
        .reference = "",
        .extensions = {"@method@"},
    });
}
