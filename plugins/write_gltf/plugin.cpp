// Spheres as a glTF file to look at: write.gltf and read.gltf.
#include "picture.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/plugin.hpp>

namespace foam::gltf {
namespace {

class GltfWriter final : public Writer {
public:
    std::string write(const SphereModel& model, Context&) const override { return picture_text(model); }

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>&) const override {
        try {
            return elements_of(read_picture(bytes, "glTF"));
        } catch (const Error& error) {
            throw Error(ErrorCode::output, error.what());
        }
    }
};

class GltfReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return is_picture(text); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_picture(text, file);
    }
};

} // namespace
} // namespace foam::gltf

FOAM_PLUGIN("write_gltf", "1.0", "Apache-2.0") {
    using namespace foam::gltf;
    const std::string reference = "https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html";
    enrol.add<GltfWriter>(
        {.name = "write.gltf",
         .summary = "Writes a glTF file to look at: the links at the robot's default pose, y up; pictures only.",
         .reference = reference,
         .extensions = {"gltf"},
         .kinds = foam::every_kind(),
         .consumer = {.name = "glTF 2.0", .rest_pose = true}});
    enrol.add<GltfReader>({.name = "read.gltf",
                           .summary = "Reads the file of write.gltf: elements by link, from extras of nodes.",
                           .reference = reference,
                           .extensions = {"gltf"}});
}
