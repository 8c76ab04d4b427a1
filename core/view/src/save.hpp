// Files that a session writes.
#pragma once

#include <foam/view/session.hpp>

#include <atomic>

namespace foam::inline view {

/// Returns the formats of all writers, and "recipe".
std::vector<SaveFormat> save_formats(const Registry& registry);

/// Returns the file of that name in the folder. Throws Error(usage) for a name that leads elsewhere or is hidden.
std::filesystem::path target_of(const std::filesystem::path& folder, const std::string& name);

/// Throws Error(usage) if a file that the format writes is one of the inputs, or exists, unless `replace`, or if there
/// is no such format.
void require_free(const Registry& registry, const std::string& format, const std::filesystem::path& target,
                  const std::vector<std::filesystem::path>& inputs, bool replace);

/// Writes the model in the format of a writer. `original`: null if it is not known. Throws as Session::save().
Saved save_model(const ViewedRobot& robot, const Original* original, const Registry& registry, const ModelState& state,
                 const std::string& format, const std::filesystem::path& target, const std::atomic<bool>& cancel);

/// Writes a recipe that gives the model again. Throws as Session::save().
Saved save_recipe(const ViewedRobot& robot, const Original* original, const SubjectOptions& options, Registry& registry,
                  const ModelState& state, const std::filesystem::path& target);

} // namespace foam::inline view
