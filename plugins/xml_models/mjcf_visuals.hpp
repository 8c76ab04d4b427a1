// The visual geometry of a robot in an MJCF: geoms without contact and mass, and the meshes that they show.
#pragma once

#include "mjcf.hpp"

#include <foam/sdk/context.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/stage.hpp>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace foam::xml_models {

/// Makes the geoms of all visuals of a robot. MuJoCo reads STL and OBJ files where they are; other meshes become OBJ
/// files beside the MJCF.
class MjcfVisuals {
public:
    /// `meshes`: reads what MuJoCo does not; null if no plugin has it. `shown`: false: there are no visuals.
    MjcfVisuals(const SphereModel& model, bool shown, const MeshLoader* meshes, Context& context);

    /// Returns the attributes of the geoms of a link, in its order; nothing for a link of which nothing is shown.
    std::vector<std::string> of(const std::string& link) const;
    /// Returns the <mesh> elements, one for each mesh at each scale.
    const std::vector<std::string>& assets() const { return assets_; }
    /// Returns the mesh files that belong to the MJCF, by their names relative to its folder.
    const std::map<std::string, std::string>& files() const { return files_; }
    bool empty() const { return geoms_.empty(); }
    /// Logs which visuals are left out, and why.
    void report(Context& context) const;

private:
    std::optional<std::string> geom(const GeometryElement& visual, std::string& why);
    /// Returns the name of the asset; nothing with a reason for a mesh that cannot be shown.
    std::optional<std::string> asset(const MeshReference& reference, std::string& why);
    /// Returns the path of a file that MuJoCo reads, as seen from the output.
    std::optional<std::string> file_of(const MeshReference& reference, std::string& why);
    std::string file_beside(const std::string& stem, const Mesh& mesh);

    const SphereModel& model_;
    const MeshLoader* meshes_;
    Context& context_;
    MjcfShapes shapes_;
    std::map<std::string, std::vector<std::string>> geoms_; ///< by link
    std::vector<std::string> assets_;
    std::map<std::string, std::string> files_;
    std::map<std::string, std::string> names_;   ///< of assets, by mesh and scale
    std::map<std::string, std::string> sources_; ///< names of the files, by mesh
    std::vector<std::shared_ptr<const Mesh>> kept_; ///< those of names_: no other may get their address
    std::set<std::string> taken_;                   ///< names of assets and files
    std::map<std::string, std::vector<std::string>> left_out_; ///< links by the reason
};

} // namespace foam::xml_models
