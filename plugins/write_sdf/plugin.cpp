// Objects of Gazebo: write.sdf and read.sdf.
#include "edit.hpp"
#include "object.hpp"
#include "robot.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/sdk/plugin.hpp>

namespace foam::sdf {
namespace {

class SdfWriter final : public Writer {
public:
    explicit SdfWriter(const Parameters& parameters) : static_(parameters.boolean("static")) {
        known_.ellipsoids = true;
        known_.segments = segments_of(parameters, "write.sdf");
    }

    std::string write(const SphereModel& model, Context& context) const override {
        if (has_sdf_text(model)) {
            return edited_sdf(model, in_known_kinds(elements_by_link(model), known_), context);
        }
        if (model.robot && !model.robot->joints.empty()) {
            return robot_text(model, known_, context);
        }
        std::string text = object_text(model, static_, known_);
        if (!static_) {
            context.log(Severity::warning,
                        "the link has no <inertial>, and Gazebo takes 1 kg; remedy: add it to the file");
        }
        return text;
    }

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>& beside) const override {
        try {
            return elements_of(read_sdf(bytes, "SDF", [&](const std::string& uri) {
                const std::string* text = text_beside(beside, uri);
                return text ? *text : std::string();
            }, true));
        } catch (const Error& error) {
            throw Error(ErrorCode::output, error.what());
        }
    }

    std::map<std::string, std::string> files_beside(const SphereModel& model, Context&) const override {
        return hull_files(in_known_kinds(elements_by_link(model), known_), file_name_of(model));
    }

private:
    KnownKinds known_;
    bool static_;
};

class SdfReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return is_sdf(text); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_sdf(text, file, [&](const std::string& uri) -> std::string {
            // A mesh is a hull if its folder says so, as those that write.sdf and write.urdf make.
            constexpr std::uintmax_t most_bytes = 64'000'000;
            const std::filesystem::path path(uri);
            const bool named =
                path.parent_path().filename().string().ends_with("_hulls") && uri.find("://") == uri.npos;
            return named ? read_regular_file(file.parent_path() / path, most_bytes, "leave it out").bytes : "";
        });
    }
};

} // namespace
} // namespace foam::sdf

FOAM_PLUGIN("write_sdf", "1.0", "Apache-2.0") {
    using namespace foam::sdf;
    using foam::Parameter;
    const std::string reference = "http://sdformat.org/spec?ver=1.9&elem=collision";
    enrol.add<SdfWriter>(
        {.name = "write.sdf",
         .summary = "Writes a robot of an SDF file back into its text, other robots and objects as SDF 1.9, for Gazebo.",
         .reference = reference,
         .parameters = {Parameter::boolean("static", true).doc("An object of one link does not move; else Gazebo needs its mass."),
                        foam::segments_parameter()},
         .extensions = {"sdf"},
         .kinds = foam::every_kind(),
         .consumer = {.name = "Gazebo (sdformat 12.3)"}});
    enrol.add<SdfReader>({.name = "read.sdf",
                          .summary = "Reads the collisions of an SDF file that are convex elements, by link.",
                          .reference = reference,
                          .extensions = {"sdf", "world"}});
}
