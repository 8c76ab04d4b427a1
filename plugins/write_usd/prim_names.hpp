// Names and paths of prims.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace foam::usd {

/// Returns whether a prim can have that name: letters, digits and '_', no digit at the beginning.
bool is_identifier(std::string_view name);
/// Returns the name with '_' in place of what an identifier cannot hold, as TfMakeValidIdentifier() and importers do.
std::string identifier(std::string_view name);

/// Names of prims for links: the links' own where these are identifiers, else similar ones; no two are equal.
std::map<std::string, std::string> prim_names(const std::vector<std::string>& links);

/// A pattern of prim paths such as "/World/{robot}/{link}".
class PathPattern {
public:
    /// Throws Error(output) naming the pattern, for what gives no paths or not one for each link.
    PathPattern(const std::string& pattern, const std::string& robot, bool many_links);

    /// Returns the parts of the path above the first that depends on the link.
    const std::vector<std::string>& above() const { return above_; }
    /// Returns the other parts. `prim_name`: of prim_names().
    std::vector<std::string> below(const std::string& prim_name) const;
    /// Returns "/World/panda/link0".
    std::string path(const std::string& prim_name) const;

private:
    std::vector<std::string> above_, below_;
};

} // namespace foam::usd
