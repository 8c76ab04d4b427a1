// What all writers of YAML and JSON do alike.
#pragma once

#include "formats.hpp"
#include "robot_values.hpp"

#include <foam/sdk/stage.hpp>
#include <foam/sdk/writing.hpp>
#include <foam/yaml/write.hpp>

namespace foam::tree {

/// Writes a tree of values, as a whole file or into a file of the user, and reads it back by the reader of the format.
class TreeWriter : public Writer {
public:
    using Reading = void (*)(const yaml::Value&, Tree&);

    TreeWriter(std::string name, Reading reading) : name_(std::move(name)), reading_(reading) {}

    std::string write(const SphereModel& model, Context& context) const override;
    std::map<std::string, Elements> read(const std::string& bytes, const std::map<std::string, std::string>&) const override;

protected:
    /// Returns the whole file.
    virtual yaml::Value document(const SphereModel& model, const std::vector<LinkSpheres>& links,
                                 Context& context) const = 0;
    /// Replaces the spheres of a file of the user.
    virtual void edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
                      Context& context) const;
    /// Returns the text of a whole file.
    virtual std::string text_of(const yaml::Value& document, const SphereModel& model) const;
    const std::string& name() const { return name_; }

private:
    std::string name_;
    Reading reading_;
};

/// Edits the map of pairs {link: [link, …]} at a path of keys in a file of the user.
void edit_ignored_links(yaml::Splice& file, const std::vector<std::string_view>& path, const SphereModel& model,
                        PairEdit edit, Context& context);

/// Throws Error(output): the file of the user has no such key.
[[noreturn]] void fail_without_key(const SphereModel& model, const std::string& key, const std::string& remedy);

} // namespace foam::tree
