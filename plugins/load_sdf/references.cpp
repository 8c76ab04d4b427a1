#include "references.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <cstdlib>

namespace foam::load_sdf {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> folders_of_environment() {
    std::vector<fs::path> folders;
    for (const char* variable : {"SDF_PATH", "IGN_GAZEBO_RESOURCE_PATH"}) {
        const char* value = std::getenv(variable);
        std::string_view rest = value ? value : "";
        while (!rest.empty()) {
            const std::string_view folder = rest.substr(0, rest.find(':'));
            rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
            if (!folder.empty()) {
                folders.emplace_back(folder);
            }
        }
    }
    return folders;
}

/// Puts a second search behind one that found nothing.
void continue_with(ResolvedResource& found, ResolvedResource next) {
    next.tried.insert(next.tried.begin(), found.tried.begin(), found.tried.end());
    found = std::move(next);
}

} // namespace

References::References(const ResourceResolver& resources, fs::path folder)
    : resources_(resources), folder_(std::move(folder)), paths_(folders_of_environment()), own_(paths_) {}

ResolvedResource References::file(const std::string& uri, const fs::path& folder) const {
    ResolvedResource found = resources_.resolve(uri, folder);
    const bool relative = uri.find("://") == uri.npos;
    if (!found.found() && !relative && !paths_.empty()) {
        found = own_.resolve(uri, folder);
    }
    for (const fs::path& path : paths_) {
        if (!found.found() && relative) {
            continue_with(found, resources_.resolve(uri, path));
        }
    }
    return found;
}

ResolvedResource References::mesh(const std::string& uri, const fs::path& folder) const {
    ResolvedResource found = file(uri, folder);
    return found.found() ? found : resources_.resolve_leniently(uri, folder);
}

ResolvedResource References::model(const std::string& uri, const fs::path& folder) const {
    const std::string plain = uri.substr(0, uri.find_last_not_of('/') + 1);
    ResolvedResource found = file(plain + "/model.config", folder);
    if (found.found()) {
        found.path = found.path.parent_path();
        return found;
    }
    for (const std::string& other : {plain, plain + "/model.sdf"}) {
        if (!found.found()) {
            continue_with(found, file(other, folder));
        }
    }
    return found;
}

std::string References::nested(const std::string& uri) {
    std::vector<fs::path> folders{folder_};
    folders.insert(folders.end(), included_.rbegin(), included_.rend());
    for (const fs::path& folder : folders) {
        const ResolvedResource found = model(uri, folder);
        if (found.found()) {
            included_.push_back(fs::is_directory(found.path) ? found.path : found.path.parent_path());
            return found.path.string();
        }
    }
    return {};
}

std::string places_text(const ResolvedResource& resource) {
    std::string text = resource.tried.empty() ? "" : "; tried:";
    for (const fs::path& path : resource.tried) {
        text += "\n  " + shown(path.string());
    }
    return text;
}

std::string remedy_for(const std::string& uri) {
    if (const std::string package = package_of(uri); !package.empty()) {
        return fmt::format("remedy: --package {0}=FOLDER, where FOLDER is the model, or GZ_SIM_RESOURCE_PATH=FOLDER, "
                           "where FOLDER/{0} is it",
                           shown(package));
    }
    return uri.find("://") == uri.npos ? "remedy: correct the path"
                                       : "remedy: download it, and write model://NAME, package://NAME/FILE or a path";
}

} // namespace foam::load_sdf
