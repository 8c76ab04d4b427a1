#include "model.hpp"

#include <fmt/format.h>

namespace foam::mjcf {
namespace fs = std::filesystem;
namespace {

constexpr int deepest_models = 20;

std::optional<Model::Found> find_below(const Node& node, std::string_view element, const std::string& name,
                                       const std::string& childclass) {
    const std::string* stated = node.attribute("childclass");
    const std::string& inherited = stated && !stated->empty() ? *stated : childclass;
    for (const Node& child : node.children) {
        const std::string* own = child.attribute("name");
        if (child.name() == element && own && *own == name) {
            return Model::Found{&child, inherited};
        }
        if (auto found = find_below(child, element, name, inherited)) {
            return found;
        }
    }
    return {};
}

} // namespace

Model::Model(const std::string& text, const fs::path& file, int depth)
    : document(text, file), classes(document.root()) {
    read_settings();
    read_assets(depth);
    for (const Node* contact : document.root().children_named("contact")) {
        for (const Node* pair : contact->children_named("pair")) {
            pairs.emplace_back(pair->required("geom1"), pair->required("geom2"));
        }
    }
}

void Model::read_settings() {
    for (const Node* node : document.root().children_named("compiler")) {
        const Attributes compiler(*node);
        const std::string angle = compiler.word("angle", settings.degrees ? "degree" : "radian");
        if (angle != "degree" && angle != "radian") {
            compiler.fail("angle", "it is neither degree nor radian");
        }
        settings.degrees = angle == "degree";
        settings.autolimits = compiler.flag("autolimits", settings.autolimits);
        settings.fitaabb = compiler.flag("fitaabb", settings.fitaabb);
        settings.strippath = compiler.flag("strippath", settings.strippath);
        settings.eulerseq = compiler.word("eulerseq", settings.eulerseq);
        if (settings.eulerseq.size() != 3 || settings.eulerseq.find_first_not_of("xyzXYZ") != std::string::npos) {
            compiler.fail("eulerseq", "it expects three letters of x, y, z, X, Y, Z");
        }
        settings.meshdir = compiler.word("assetdir", settings.meshdir);
        settings.meshdir = compiler.word("meshdir", settings.meshdir);
        if (compiler.word("coordinate", "local") != "local") {
            compiler.fail("coordinate", "MuJoCo reads no global coordinates any more; remedy: load and save the file "
                                        "with MuJoCo 2.3.3");
        }
    }
}

void Model::read_assets(int depth) {
    for (const Node* asset : document.root().children_named("asset")) {
        for (const Node* mesh : asset->children_named("mesh")) {
            const std::string *name = mesh->attribute("name"), *file = mesh->attribute("file");
            const std::string key = name ? *name : file ? path_of(*file).stem().string() : "";
            if (key.empty()) {
                mesh->fail("<mesh> has neither name nor file; remedy: add name=\"…\"");
            }
            if (!meshes.emplace(key, mesh).second) {
                mesh->fail(fmt::format("a second mesh '{}'; remedy: another name", key));
            }
        }
        for (const Node* material : asset->children_named("material")) {
            materials[material->required("name")] = material;
        }
        for (const Node* node : asset->children_named("model")) {
            if (depth == deepest_models) {
                node->fail(fmt::format("models attach models more than {} deep", deepest_models));
            }
            const fs::path file = document.folder() / path_of(node->required("file"));
            std::error_code error;
            if (!fs::is_regular_file(file, error)) {
                node->fail(fmt::format("the model '{}' is not found; remedy: correct its path", file.string()));
            }
            auto model = std::make_unique<const Model>(text_of(file), file, depth + 1);
            const std::string *own = node->attribute("name"), *stated = model->document.root().attribute("model");
            models[own ? *own : stated ? *stated : "MuJoCo Model"] = std::move(model);
        }
    }
}

std::optional<Model::Found> Model::find(std::string_view element, const std::string& name) const {
    for (const Node* world : document.root().children_named("worldbody")) {
        if (auto found = find_below(*world, element, name, "")) {
            return found;
        }
    }
    return {};
}

std::set<fs::path> Model::files() const {
    const std::vector<fs::path> own = document.files();
    std::set<fs::path> files(own.begin(), own.end());
    for (const auto& [name, model] : models) {
        files.merge(model->files());
    }
    return files;
}

} // namespace foam::mjcf
