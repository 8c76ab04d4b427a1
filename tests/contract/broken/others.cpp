// A filter, a loader, a writer and a reader that break what they promise.
#include <foam/base/error.hpp>
#include <foam/sdk/plugin.hpp>

namespace {

using namespace foam;

/// Opens what is closed and leaves indices that lead nowhere.
class Opens final : public MeshFilter {
public:
    Mesh apply(const Mesh& mesh, Context& context) const override {
        context.check_cancelled();
        Mesh result = mesh;
        result.triangles.pop_back();
        if (result.triangles.size() == 1) {
            result.triangles[0][0] = 99;
        }
        return result;
    }
};

/// Takes everything for a mesh.
class Gullible final : public MeshLoader {
public:
    Mesh load(const std::filesystem::path&, Context&) const override {
        return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    }
};

/// Rounds to the nearest, so that radii shrink.
class Rounds final : public Writer {
public:
    std::string write(const SphereModel&, Context&) const override { return "spheres"; }
    std::map<std::string, Elements> read(const std::string&, const std::map<std::string, std::string>&) const override {
        return {{"base", {{{0, 0, 0}, 0.9}}}, {"tool", {{{0.1, -0.2, 0.333}, 0.05}, {{0, 1234.5, 0}, 0.8}}}};
    }
};

/// Takes every text for a model, and forgets the file's name.
class Credulous final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return !text.starts_with("spheres"); }
    SphereFile read(const std::string& text, const std::filesystem::path&, Context&) const override {
        if (text.empty()) {
            throw Error(ErrorCode::input, "there is nothing");
        }
        return {};
    }
};

} // namespace

FOAM_PLUGIN("broken_others", "1.0", "Apache-2.0") {
    enrol.add<Opens>({.name = "smooth.opens", .summary = "Loses a triangle"});
    enrol.add<Gullible>({.name = "load.gullible", .summary = "Reads anything", .extensions = {"any"}});
    enrol.add<Rounds>({.name = "write.rounds", .summary = "Loses digits", .extensions = {"rounded"}});
    enrol.add<Credulous>({.name = "read.credulous", .summary = "Reads anything"});
}
