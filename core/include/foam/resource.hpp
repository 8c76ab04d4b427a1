// package:// and friends: from a reference in a URDF or recipe to a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace foam {

/// Where a reference leads, or where was looked.
struct ResolvedResource {
    std::filesystem::path path;                   ///< empty: not found
    std::vector<std::filesystem::path> tried;     ///< in order; for the error message
    bool found() const { return !path.empty(); }
};

/// Resolves references to files.
class ResourceResolver {
public:
    /// `package_path`: folders that hold packages, or are packages themselves.
    explicit ResourceResolver(std::vector<std::filesystem::path> package_path = {});
    /// FOAM_PACKAGE_PATH, ROS_PACKAGE_PATH, AMENT_PREFIX_PATH (its share/ folders), in that order.
    static ResourceResolver from_environment();
    ~ResourceResolver();
    ResourceResolver(const ResourceResolver&);
    ResourceResolver& operator=(const ResourceResolver&);

    /// This resolver with `folders` searched before its own.
    ResourceResolver preceded_by(std::vector<std::filesystem::path> folders) const {
        folders.insert(folders.end(), package_path_.begin(), package_path_.end());
        return ResourceResolver(std::move(folders));
    }

    /// `reference`: `package://PKG/rest`, `model://PKG/rest`, `file:///path`, a relative or absolute path.
    /// A package is looked for on the package path (DIR/PKG/rest; DIR/rest when DIR is called PKG or its package.xml names it
    /// so), then in `base` and its ancestors (DIR/PKG/rest). Relative paths start at `base`. Percent escapes are decoded.
    ResolvedResource resolve(const std::string& reference, const std::filesystem::path& base) const;

private:
    std::vector<std::filesystem::path> package_path_;
};

} // namespace foam
