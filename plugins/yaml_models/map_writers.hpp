// Maps of spheres: bubblify, plainmp, pyroki and ballpark, MorphIt.
#pragma once

#include "tree_writer.hpp"

namespace foam::tree {

/// collision_spheres: {link: [{center, radius}]}; also the sphere file of cuRobo 0.7 and STORM.
class BubblifyWriter final : public TreeWriter {
public:
    explicit BubblifyWriter(const Parameters&);

private:
    yaml::Value document(const SphereModel& model, const std::vector<LinkSpheres>& links,
                         Context& context) const override;
    void edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
              Context& context) const override;
};

/// collision_spheres: {link: {spheres: [[x, y, z, r]]}}, with the pairs that are checked.
class PlainmpWriter final : public TreeWriter {
public:
    explicit PlainmpWriter(const Parameters& parameters);

private:
    yaml::Value document(const SphereModel& model, const std::vector<LinkSpheres>& links,
                         Context& context) const override;
    void edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
              Context& context) const override;

    PairEdit pairs_; ///< in a file of the user
};

/// {link: {centers: [[x, y, z]], radii: [r]}}: every key is a link.
class PyrokiWriter final : public TreeWriter {
public:
    explicit PyrokiWriter(const Parameters&);

private:
    yaml::Value document(const SphereModel& model, const std::vector<LinkSpheres>& links,
                         Context& context) const override;
    std::string text_of(const yaml::Value& document, const SphereModel& model) const override;
};

/// {centers: [[x, y, z]], radii: [r]} of one body.
class MorphitWriter final : public TreeWriter {
public:
    explicit MorphitWriter(const Parameters&);

private:
    yaml::Value document(const SphereModel& model, const std::vector<LinkSpheres>& links,
                         Context& context) const override;
    std::string text_of(const yaml::Value& document, const SphereModel& model) const override;
};

} // namespace foam::tree
