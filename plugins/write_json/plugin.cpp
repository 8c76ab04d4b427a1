// write.json: sphere models as JSON.
#include "layout.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/plugin.hpp>

namespace foam {
namespace {

class JsonWriter final : public Writer {
public:
    explicit JsonWriter(const Parameters& parameters) : layout_(parameters.text("layout")) {}

    std::string write(const SphereModel& model, Context&) const override {
        return layout_ == "links"  ? write_links_layout(model)
               : layout_ == "foam" ? write_original_layout(model)
                                   : write_original_mesh_layout(model);
    }

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>&) const override {
        try {
            const Json document = Json::parse(bytes);
            return layout_ == "links" ? read_links_layout(document) : read_original_layout(document);
        } catch (const Json::exception& error) {
            throw Error(ErrorCode::output, fmt::format("JSON: {}", error.what()));
        } catch (const Error& error) {
            throw Error(ErrorCode::output, error.what());
        }
    }

private:
    std::string layout_;
};

} // namespace
} // namespace foam

FOAM_PLUGIN("write_json", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::JsonWriter>(
        {.name = "write.json",
         .summary = "Writes the sphere trees, other elements and measures of all links as JSON.",
         .reference = "schemas/spheres.schema.json; layout foam: Coumar et al. 2025",
         .parameters = {Parameter::choice("layout", {"links", "foam", "foam_mesh"}, "links")
                            .doc("links: schemas/spheres.schema.json; foam: the database of CoMMALab/foam, by link and "
                                 "mesh; foam_mesh: the same of a single mesh.")
                            .source("links is the one layout that holds all of a model.")},
         .extensions = {"json"},
         .kinds = foam::every_kind()});
}
