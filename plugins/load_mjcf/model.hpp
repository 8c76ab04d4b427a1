// A model: its settings, classes, assets, and the models that it attaches.
#pragma once

#include "attributes.hpp"
#include "document.hpp"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace foam::mjcf {

/// What the <compiler> elements state; a later one replaces what an earlier one states.
struct Settings {
    bool degrees = true, autolimits = true, fitaabb = false, strippath = false;
    std::string eulerseq = "xyz", meshdir;
};

struct Model {
    /// Throws Error(input) naming file and line. `depth`: of models that attach models.
    Model(const std::string& text, const std::filesystem::path& file, int depth = 0);

    Document document;
    Settings settings;
    Classes classes;
    std::map<std::string, const Node*> meshes, materials;
    std::vector<std::pair<std::string, std::string>> pairs; ///< geoms of <pair>
    std::map<std::string, std::unique_ptr<const Model>> models;

    /// A body or a frame, and the class that holds for it.
    struct Found {
        const Node* node = nullptr;
        std::string childclass;
    };
    /// Returns the body or frame of that name; nothing if there is none.
    std::optional<Found> find(std::string_view element, const std::string& name) const;
    /// Returns its files, and those of models that it attaches.
    std::set<std::filesystem::path> files() const;

private:
    void read_settings();
    void read_assets(int depth);
};

} // namespace foam::mjcf
