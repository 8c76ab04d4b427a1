// @stage@: one sphere a line: x y z radius link; metres, frames of the links. A start: the format is to be yours.
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/plugin.hpp>

#include <sstream>

namespace {

using namespace foam;

constexpr const char* header = "# x y z radius link";

class @class@ final : public Writer {
public:
    std::string write(const SphereModel& model, Context&) const override {
        std::string text = header;
        text += '\n';
        for (const LinkSpheres& link : spheres_by_link(model)) { // refuses spheres that nobody could read
            for (const Sphere& s : link.elements.spheres()) {
                for (const double value : {s.center.x, s.center.y, s.center.z, s.radius}) {
                    text += number_text(value) + ' '; // all digits, whatever the locale
                }
                text += link.link + '\n';
            }
        }
        return text;
    }

    /// As another program would read it: the proof of cover runs on these elements.
    std::map<std::string, Elements> read(const std::string& bytes,
                                         const std::map<std::string, std::string>&) const override {
        std::istringstream stream(bytes);
        std::string line;
        if (!std::getline(stream, line) || line != header) {
            throw Error(ErrorCode::output, std::string("the first line is not '") + header + "'");
        }
        std::map<std::string, Elements> links;
        while (std::getline(stream, line)) {
            const std::vector<std::string_view> fields = words(line);
            if (fields.size() < 5) {
                throw Error(ErrorCode::output, "this line is no sphere: " + line);
            }
            std::array<double, 4> values{};
            for (std::size_t i = 0; i < values.size(); ++i) {
                const std::optional<double> value = parse_number(fields[i]);
                if (!value) {
                    throw Error(ErrorCode::output, "this line is no sphere: " + line);
                }
                values[i] = *value;
            }
            const std::string link = line.substr(static_cast<std::size_t>(fields[4].data() - line.data()));
            links[link].add(Sphere{{values[0], values[1], values[2]}, values[3]});
        }
        return links;
    }
};

} // namespace

FOAM_PLUGIN("@plugin@", "0.1", "Apache-2.0") {
    enrol.add<@class@>({
        .name = "@stage@",
        .summary = "Writes one sphere a line: x y z radius link",
        .reference = "",
        .extensions = {"@method@"},
    });
}
