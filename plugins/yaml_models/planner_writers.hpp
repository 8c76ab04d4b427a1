// Robot files of planners: cuRobo, XRDF, Lula.
#pragma once

#include "tree_writer.hpp"

namespace foam::tree {

/// cuRobo 0.7 and 0.8: one dataclass takes the keys of `kinematics`, so that an unknown key is an error there.
class CuroboWriter final : public TreeWriter {
public:
    explicit CuroboWriter(const Parameters& parameters);

private:
    yaml::Value document(const SphereModel& model, const std::vector<LinkSpheres>& links,
                         Context& context) const override;
    void edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
              Context& context) const override;
    yaml::Value cspace(const SphereModel& model, const PlannedJoints& joints) const;

    bool old_;
    PairEdit pairs_; ///< in a file of the user
    double buffer_;  ///< m
    std::string urdf_path_, asset_root_path_;
};

/// XRDF 1.0 and 2.0. cuRobo reads 1.0 only.
class XrdfWriter final : public TreeWriter {
public:
    explicit XrdfWriter(const Parameters& parameters);

private:
    yaml::Value document(const SphereModel& model, const std::vector<LinkSpheres>& links,
                         Context& context) const override;
    void edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
              Context& context) const override;

    bool new_;
    PairEdit pairs_; ///< in a file of the user
};

class LulaWriter final : public TreeWriter {
public:
    explicit LulaWriter(const Parameters& parameters);

private:
    yaml::Value document(const SphereModel& model, const std::vector<LinkSpheres>& links,
                         Context& context) const override;
    void edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
              Context& context) const override;
    /// Returns a list of maps with one link each.
    static yaml::Value spheres(const std::vector<LinkSpheres>& links);
};

} // namespace foam::tree
