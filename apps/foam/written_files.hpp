// The files of one output: that of the writer, and those that belong to it.
#pragma once

#include <foam/sdk/stage.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace foam::cli {

struct WrittenFile {
    std::filesystem::path file;
    std::string bytes;
};

/// Returns the files that an output consists of. Throws Error(usage) if two of them have one name.
std::vector<std::filesystem::path> files_of(const StageInfo& writer, const std::filesystem::path& target);
/// Returns these files with their bytes, that of Writer::write() first; nothing is written. `target`: where they are to
/// lie; empty: the standard output.
std::vector<WrittenFile> written_files(const Writer& writer, const StageInfo& info, SphereModel model,
                                       const std::filesystem::path& target, Context& context);
std::vector<std::string> file_names(const std::vector<WrittenFile>& files);

/// Returns the parameters of a writer from texts like "version=0.7". Throws Error(usage) naming the text for an unknown
/// name or another type.
std::map<std::string, ParameterValue> parameters_of(const std::vector<std::string>& texts, const StageInfo& writer);

} // namespace foam::cli
