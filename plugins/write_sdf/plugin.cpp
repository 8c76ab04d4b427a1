// Objects of Gazebo: write.sdf and read.sdf.
#include "object.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/plugin.hpp>

namespace foam::sdf {
namespace {

class SdfWriter final : public Writer {
public:
    explicit SdfWriter(const Parameters& parameters) : static_(parameters.boolean("static")) {}

    std::string write(const SphereModel& model, Context& context) const override {
        std::string text = object_text(model, static_);
        if (!static_) {
            context.log(Severity::warning,
                        "the link has no <inertial>, and Gazebo takes 1 kg; remedy: add it to the file");
        }
        return text;
    }

    std::map<std::string, std::vector<Sphere>> read(const std::string& bytes) const override {
        std::map<std::string, std::vector<Sphere>> result;
        try {
            for (LinkSpheres& link : read_sdf(bytes, "SDF").links) {
                result[link.link] = std::move(link.spheres);
            }
        } catch (const Error& error) {
            throw Error(ErrorCode::output, error.what());
        }
        return result;
    }

private:
    bool static_;
};

class SdfReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return is_sdf(text); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_sdf(text, file);
    }
};

} // namespace
} // namespace foam::sdf

FOAM_PLUGIN("write_sdf", "1.0", "Apache-2.0") {
    using namespace foam::sdf;
    using foam::Parameter;
    const std::string reference = "http://sdformat.org/spec?ver=1.9&elem=collision";
    enrol.add<SdfWriter>({.name = "write.sdf",
                          .summary = "Writes an object of one link for Gazebo, SDF 1.9; robots go to Gazebo as URDF.",
                          .reference = reference,
                          .parameters = {Parameter::boolean("static", true)
                                             .doc("The object does not move; else Gazebo needs its mass.")},
                          .extensions = {"sdf"},
                          .consumer = {.name = "Gazebo (sdformat 12.3)"}});
    enrol.add<SdfReader>({.name = "read.sdf",
                          .summary = "Reads the sphere collisions of an SDF file, by link.",
                          .reference = reference,
                          .extensions = {"sdf", "world"}});
}
