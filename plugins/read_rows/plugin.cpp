// read.rows and write.gpmp2: tables of numbers without a header.
#include "rows.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::rows {
namespace {

class RowReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override {
        const std::string_view line = first_row(text);
        if (line.find_first_of(":{[<\"") != std::string_view::npos) {
            return false;
        }
        const std::string row = row_of(line);
        const std::vector<std::string_view> fields = words(row);
        return std::count_if(fields.begin(), fields.end(), [](std::string_view word) { return parse_number(word); }) >=
               3;
    }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_rows(text, file);
    }
};

class Gpmp2Writer final : public Writer {
public:
    explicit Gpmp2Writer(const Parameters& parameters) {
        try {
            frames_ = dh_frames(parameters.text("frames"));
        } catch (const Error& error) {
            throw Error(ErrorCode::usage, fmt::format("frames: {}", error.what()));
        }
    }

    std::string write(const SphereModel& model, Context& context) const override {
        return rows_text(model, frames_, context);
    }

    std::map<std::string, Elements> read(const std::string& bytes, const std::map<std::string, std::string>&) const override {
        try {
            return elements_of(read_rows(bytes, "rows of GPMP2"));
        } catch (const Error& error) {
            throw Error(ErrorCode::output, error.what());
        }
    }

private:
    std::vector<DhFrame> frames_;
};

} // namespace
} // namespace foam::rows

FOAM_PLUGIN("read_rows", "1.0", "Apache-2.0") {
    using namespace foam::rows;
    const std::string reference = "https://github.com/borglab/gpmp2 (robot models, BodySphere)";
    enrol.add<RowReader>(
        {.name = "read.rows",
         .summary = "Reads rows of numbers, separated by blanks or commas: x y z radius, or link x y z radius (GPMP2).",
         .reference = reference,
         .extensions = {"txt"}});
    enrol.add<Gpmp2Writer>(
        {.name = "write.gpmp2",
         .summary = "Writes the spheres of an arm of GPMP2: rows link_id x y z r in the frames of its DH links.",
         .reference = reference,
         .parameters =
             {foam::Parameter::text("frames", "")
                  .doc("For each link with spheres, \"LINK ID x y z roll pitch yaw\": its pose, m and rad as in a "
                       "URDF, in the frame after DH link ID (from 0); semicolons or line ends between links. "
                       "Required.")},
         .extensions = {"txt"},
         .consumer = {.name = "GPMP2 (4289d9a5a7)"}});
}
