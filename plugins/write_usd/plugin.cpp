// Spheres as an overlay layer of USD: write.usd and read.usd.
#include "layer.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/engines.hpp>
#include <foam/sdk/plugin.hpp>

namespace foam::usd {
namespace {

class UsdWriter final : public Writer {
public:
    explicit UsdWriter(const Parameters& parameters)
        : options_{.prim = parameters.text("prim"),
                   .sublayer = parameters.text("sublayer"),
                   .inactive = parameters.text("inactive"),
                   .pairs = parameters.boolean("pairs"),
                   .known = {.segments = segments_of(parameters, "write.usd"), .engine = engine_of(parameters)}} {}

    std::string write(const SphereModel& model, Context&) const override { return layer_text(model, options_); }

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>&) const override {
        try {
            return held_by(options_.known.engine, elements_of(read_layer(bytes, "USD layer")));
        } catch (const Error& error) {
            throw Error(ErrorCode::output, error.what());
        }
    }

private:
    LayerOptions options_;
};

class UsdReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return is_layer(text); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_layer(text, file);
    }
};

} // namespace
} // namespace foam::usd

FOAM_PLUGIN("write_usd", "1.0", "Apache-2.0") {
    using namespace foam::usd;
    using foam::Parameter;
    const std::string reference = "https://openusd.org/release/api/usd_physics_page_front.html";
    enrol.add<UsdWriter>(
        {.name = "write.usd",
         .summary = "Writes a layer of USD that puts spheres and other collision elements over the links of a robot's "
                    "own layer; "
                    "in metres.",
         .reference = reference,
         .parameters =
             {foam::engine_parameter("write.usd"),
              Parameter::text("prim", usual_prim)
                  .doc("Path of a link's prim in the robot's layer; {robot} and {link} stand for the names. A robot that "
                       "was read from USD has its own paths.")
                  .source("The importer of Isaac Sim puts all links below the robot."),
              Parameter::text("sublayer", "")
                  .doc("File with the robot that this layer lies over, such as ./panda.usd, in metres; empty: the file "
                       "that the robot was read from if that is USD, else none."),
              Parameter::text("inactive", "")
                  .doc("Child of each link's prim that is switched off, such as collisions; empty: none."),
              Parameter::boolean("pairs", true).doc("Write the pairs of links that need no check."),
              foam::segments_parameter()},
         .extensions = {"usda"},
         .kinds = foam::every_kind(),
         .consumer = {.name = "USD physics: Newton (41a5392c13), Isaac Sim", .float32 = true, .pairs = true}});
    enrol.add<UsdReader>({.name = "read.usd",
                          .summary = "Reads the layer of write.usd: elements by link.",
                          .reference = reference,
                          .extensions = {"usda"}});
}
