// The writers, one for each format, and the reader's outline of them.
#pragma once

#include "tree_writer.hpp"

#include <string>
#include <string_view>
#include <vector>

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

/// The outermost level of a text.
struct Outline {
    bool list = false;             ///< a list, not a map
    std::vector<std::string> keys; ///< of the map
    bool has(std::string_view key) const;
};

/// Returns the outline of the text, without checking its syntax. Linear time.
Outline outline_of(std::string_view text);

enum class Format { none, foam_json, xrdf, curobo, collision_spheres, columns, spheres_by_link, commalab };

/// Returns the format whose keys the text has.
Format format_of(std::string_view text);

} // namespace foam::tree
