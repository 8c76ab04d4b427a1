// Resolves a reference of a URDF or recipe (package:// and others) to a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// The file that a reference resolves to, or the places that were searched.
struct ResolvedResource {
    std::filesystem::path path;               ///< empty: not found
    std::vector<std::filesystem::path> tried; ///< in order; for the error message
    bool found() const { return !path.empty(); }
};

/// Resolves references to files.
class ResourceResolver {
public:
    /// `package_path`: folders that hold packages, or are packages themselves.
    explicit ResourceResolver(std::vector<std::filesystem::path> package_path = {});
    /// Returns a resolver for FOAM_PACKAGE_PATH, ROS_PACKAGE_PATH, AMENT_PREFIX_PATH (its share/ folders), in that
    /// order.
    static ResourceResolver from_environment();
    ~ResourceResolver();
    ResourceResolver(const ResourceResolver&);
    ResourceResolver& operator=(const ResourceResolver&);

    /// Returns this resolver with `folders` searched before its own.
    ResourceResolver preceded_by(std::vector<std::filesystem::path> folders) const {
        folders.insert(folders.end(), package_path_.begin(), package_path_.end());
        return ResourceResolver(std::move(folders));
    }

    /// Resolves `reference`: `package://PKG/rest`, `model://PKG/rest`, `file:///path`, a relative or absolute path. A
    /// package is searched on the package path, then in `base` and its ancestors: as DIR/PKG/rest, and as DIR/rest when
    /// DIR is called PKG or its package.xml names it so; last in the folders one and two levels below the package path
    /// (DIR/*/PKG/rest), where catkin workspaces have them. Relative paths start at `base`. In URIs, percent escapes
    /// are decoded; a name that contains the escape literally is found too. The file system resolves `..`, which may
    /// lead out of a package, as in ROS: a reference can name any file that the user can read. Only regular files are
    /// found.
    ResolvedResource resolve(const std::string& reference, const std::filesystem::path& base) const;

private:
    std::vector<std::filesystem::path> package_path_;
};

} // namespace sdk
} // namespace foam
