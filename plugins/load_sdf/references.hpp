// Where the URIs of an SDF lead.
#pragma once

#include <foam/sdk/resource.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace foam::load_sdf {

/// Finds meshes and models: as other robots' files, then in SDF_PATH and IGN_GAZEBO_RESOURCE_PATH.
class References {
public:
    References(const ResourceResolver& resources, std::filesystem::path folder);

    /// Returns the file of a URI that stands in a file of `folder`.
    ResolvedResource file(const std::string& uri, const std::filesystem::path& folder) const;
    /// Returns the same, and finds what readers of the field find: ResourceResolver::resolve_leniently().
    ResolvedResource mesh(const std::string& uri, const std::filesystem::path& folder) const;
    /// Returns the file of a model, or its folder if that has a model.config, which names the file.
    ResolvedResource model(const std::string& uri, const std::filesystem::path& folder) const;
    /// Returns the same for a URI of an included file. libsdformat does not say of which: it is looked for from the main
    /// file, then from the included ones, the latest first. Empty: not found.
    std::string nested(const std::string& uri);

    const std::filesystem::path& folder() const { return folder_; }

private:
    const ResourceResolver& resources_;
    std::filesystem::path folder_;             ///< of the main file
    std::vector<std::filesystem::path> paths_; ///< of the environment
    ResourceResolver own_;                     ///< of them
    std::vector<std::filesystem::path> included_;
};

/// Returns the places that were looked at, one a line, after "tried:"; empty if there are none.
std::string places_text(const ResolvedResource& resource);
/// Returns "remedy: …" for a URI that leads nowhere.
std::string remedy_for(const std::string& uri);

} // namespace foam::load_sdf
