// @stage@: a first line "spheres @method@", then one sphere a line: x y z radius link; metres, frames of the links. A start: the format
// is to be yours.
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/plugin.hpp>

#include <array>
#include <sstream>

namespace {

using namespace foam;

constexpr std::string_view first_line = "spheres @method@";

class @class@ final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return text.starts_with(first_line); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context& context) const override {
        SphereFile result;
        result.format = "@method@";
        std::istringstream stream(text);
        std::string line;
        if (!std::getline(stream, line) || line != first_line) {
            throw Error(ErrorCode::input, file.string() + ":1: expected '" + std::string(first_line) + "'");
        }
        for (int number = 2; std::getline(stream, line); ++number) {
            context.check_cancelled();
            const std::string place = file.string() + ":" + std::to_string(number);
            const std::vector<std::string_view> fields = words(line);
            if (fields.size() != 5) {
                throw Error(ErrorCode::input, place + ": expected x y z radius link");
            }
            std::array<double, 4> values{};
            for (std::size_t i = 0; i < values.size(); ++i) {
                const std::optional<double> value = parse_number(fields[i]); // the same in every locale; no nan, no inf
                if (!value) {
                    throw Error(ErrorCode::input, place + ": '" + shown(fields[i]) + "' is not a finite number");
                }
                values[i] = *value;
            }
            spheres_of(result, std::string(fields[4])).push_back({{values[0], values[1], values[2]}, values[3]});
        }
        return result;
    }
};

} // namespace

FOAM_PLUGIN("@plugin@", "0.1", "Apache-2.0") {
    enrol.add<@class@>({
        .name = "@stage@",
        .summary = "Reads one sphere a line: x y z radius link",
        .reference = "",
        .extensions = {"@method@"},
    });
}
