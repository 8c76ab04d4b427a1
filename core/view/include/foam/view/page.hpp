// The page of `foam view`.
#pragma once

#include <foam/view/scene.hpp>

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] view {

/// Returns one HTML file that needs no other: it shows the models, and edits nothing. Its security policy lets browsers
/// run only foam's own script.
std::string static_page(const Subject& subject, const std::vector<SceneModel>& models);

/// A file that the server of a session offers: text and kind.
struct PageFile {
    std::string content, type;
};
/// Returns "", "view.css" or "view.js" of the served page; throws Error(internal) for another name.
PageFile served_file(const std::string& name);

} // namespace view
} // namespace foam
