// read.urdf: the spheres and other convex elements of a URDF's collision elements; a mesh is one if it is convex.
#pragma once

#include <foam/sdk/plugin.hpp>

namespace foam::urdf {

class SphereReader final : public ModelReader {
public:
    SphereReader(const Parameters& parameters, const StageMaker& maker);
    bool recognises(std::string_view text) const override;
    SphereFile read(const std::string& text, const std::filesystem::path& file, Context& context) const override;

private:
    void read_link(const Link& link, SphereFile& result, Context& context) const;
    std::optional<Element> read_hull(const MeshReference& mesh, std::string& why, Context& context) const;

    std::unique_ptr<RobotLoader> loader_;
    std::unique_ptr<MeshLoader> meshes_; ///< null if no plugin has it
};

} // namespace foam::urdf
