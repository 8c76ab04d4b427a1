// From the spheres of a file or of a caller to the files of a writer.
#pragma once

#include <foam/judge/evaluate.hpp>
#include <foam/robot/robot.hpp>
#include <foam/sdk/stage.hpp>

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

/// Returns a robot that is only the names of the file's links.
std::shared_ptr<const Robot> links_alone(const SphereFile& file);
/// Names the link of a format without link names: after the only link of the original, or the file. Throws Error(input)
/// if the original has several.
void name_only_link(SphereFile& file, const Original* original);
/// Throws Error(input) for a link of the file that the robot does not have.
void require_links(const SphereFile& file, const Robot& robot);
/// Returns the file's spheres as the input of writers, in the order of the robot's links; nothing is measured or proved
/// of them. Throws Error(input) if there are none.
SphereModel sphere_model_of(const SphereFile& file, std::shared_ptr<const Robot> robot);
/// Returns the pairs of links that need no collision check, of the model's elements and the original geometry in
/// SphereModel::geometry.
std::vector<IgnoredPair> ignored_pairs_of(const SphereModel& model, const std::atomic<bool>* cancel);
/// Gives a model the pose in which no links of its original geometry touch as its rest pose, unless it has one.
/// `named`: poses that are tried first. Returns a sentence about it; "" if nothing was to be found out.
std::string give_rest_pose(SphereModel& model, const std::vector<GroupState>& named = {});

struct WrittenFile {
    std::filesystem::path file;
    std::string bytes;
    bool beside = false; ///< of Writer::files_beside()
};

/// Returns the files that an output consists of, without those of Writer::files_beside(), which depend on the model.
/// Throws Error(usage) if two of them have one name.
std::vector<std::filesystem::path> files_of(const StageInfo& writer, const std::filesystem::path& target);
/// Returns these files with their bytes, that of Writer::write() first; nothing is written. `target`: where they are to
/// lie; empty: the standard output. Throws Error(output) if the writer's files do not hold the model's elements,
/// Error(usage) if there are files beside the standard output.
std::vector<WrittenFile> written_files(const Writer& writer, const StageInfo& info, SphereModel model,
                                       const std::filesystem::path& target, Context& context);
/// The files of an output, with the verdict on them.
struct JudgedFiles {
    std::vector<WrittenFile> files;
    std::string statement; ///< the verdict as a sentence without a period; in the files' headers, too
};
/// Returns the files of a model that was read from `given`, or made elsewhere, with what is proved of the elements that
/// they hold beside the original: of their numbers as the files give them, in single precision too where the consumer
/// uses that. The verdict follows what SphereModel::provenance says. `original`: null where it is not known: nothing is
/// proved then. Throws as written_files() and require_written().
JudgedFiles judged_files(const Writer& writer, const StageInfo& info, SphereModel model, const Original* original,
                         const SphereFile& given, const std::filesystem::path& target, Context& context);
/// Returns the elements of each link, as they are read back from the files.
std::map<std::string, Elements> read_back(const Writer& writer, const std::vector<WrittenFile>& files);
/// Of links with other elements nothing is required where Consumer::elements_optional.
/// Throws Error(internal) if the writer's files give other spheres than the model, or no other elements where it has
/// some. Numbers of other elements may differ in the last places, as their orientations do: proofs are on the numbers
/// that are read. The file may lack the other elements if `info` says that elements are optional.
void require_written(const SphereModel& model, const Writer& writer, const StageInfo& info,
                     const std::vector<WrittenFile>& files);

} // namespace judge
} // namespace foam
