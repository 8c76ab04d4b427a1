// Names of written files, and parameters of writers from the command line.
#pragma once

#include <foam/judge/written_model.hpp>

#include <map>
#include <string>
#include <vector>

namespace foam::cli {

std::vector<std::string> file_names(const std::vector<WrittenFile>& files);

/// Returns the parameters of a writer from texts like "version=0.7". Throws Error(usage) naming the text for an unknown
/// name or another type.
std::map<std::string, ParameterValue> parameters_of(const std::vector<std::string>& texts, const StageInfo& writer);

/// Throws Error(usage) unless `force`: for a file that is one of the inputs, by whatever name or link; and for a file
/// beside the first that exists and does not belong to an earlier result of that name. It belongs to one if it names
/// another of the files, or one of them names it.
void refuse_replacing(const std::vector<WrittenFile>& files, const std::vector<std::filesystem::path>& inputs,
                      bool force);

/// Makes the folder of a file that lies beside an output.
void make_folder_of(const WrittenFile& file);

} // namespace foam::cli
