// Resolves a reference of a URDF or recipe (package:// and others) to a file.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// The file that a reference resolves to, or the places that were searched.
struct ResolvedResource {
    std::filesystem::path path;               ///< empty: not found
    std::vector<std::filesystem::path> tried; ///< in order; for the error message
    std::string fault{};                      ///< of what resolve_leniently() found: why the reference is wrong
    bool found() const { return !path.empty(); }
};

/// Resolves references to files.
class ResourceResolver {
public:
    /// `package_path`: folders that hold packages, or are packages themselves; NAME=FOLDER is the package NAME.
    explicit ResourceResolver(std::vector<std::filesystem::path> package_path = {});
    /// Returns a resolver for FOAM_PACKAGE_PATH, ROS_PACKAGE_PATH, AMENT_PREFIX_PATH (its share/ folders),
    /// GZ_SIM_RESOURCE_PATH, in that order.
    static ResourceResolver from_environment();
    ~ResourceResolver();
    ResourceResolver(const ResourceResolver&);
    ResourceResolver& operator=(const ResourceResolver&);

    /// Returns this resolver with `folders` searched before its own.
    ResourceResolver preceded_by(std::vector<std::filesystem::path> folders) const {
        folders.insert(folders.end(), package_path_.begin(), package_path_.end());
        return ResourceResolver(std::move(folders));
    }

    /// Returns the packages that are given as NAME=FOLDER.
    std::vector<std::pair<std::string, std::filesystem::path>> named_packages() const;

    /// Resolves `reference`: `package://PKG/rest`, `model://PKG/rest`, `file:///path`, a relative or absolute path. A
    /// package is searched on the package path, then in `base` and its ancestors: as DIR/PKG/rest, and as DIR/rest when
    /// DIR is called PKG or its package.xml names it so; last in the folders one and two levels below the package path
    /// (DIR/*/PKG/rest), where catkin workspaces have them, and in folders beside those of `base` whose package.xml
    /// names PKG. Relative paths start at `base`. In URIs, percent escapes
    /// are decoded; a name that contains the escape literally is found too. The file system resolves `..`, which may
    /// lead out of a package, as in ROS: a reference can name any file that the user can read. Only regular files are
    /// found.
    ResolvedResource resolve(const std::string& reference, const std::filesystem::path& base) const;

    /// Resolves a reference of a robot as readers of the field do, where resolve() finds nothing: without regard to
    /// backslashes, blanks around it, a third slash, the case of letters and the name of the package, and from the
    /// folders above `base`. `fault` is then what is wrong with it.
    ResolvedResource resolve_leniently(const std::string& reference, const std::filesystem::path& base) const;

private:
    std::vector<std::filesystem::path> package_path_;
};

/// Returns the package in `package://PKG/rest` or `model://PKG/rest`; empty for other references.
std::string package_of(const std::string& reference);

/// Returns an entry of a package path, FOLDER or NAME=FOLDER, whose folder leads from `base`.
std::filesystem::path package_entry(const std::string& text, const std::filesystem::path& base);

} // namespace sdk
} // namespace foam
