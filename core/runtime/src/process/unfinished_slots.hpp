// Folders that a crash handler removes.
#pragma once

#include <filesystem>

namespace foam::inline runtime {

/// Registers a folder that remove_unfinished_runs() removes. Returns its slot; -1: there is none left.
int keep_for_crash(const std::filesystem::path& folder);
/// Takes the folder back.
void forget_for_crash(int slot);

} // namespace foam::inline runtime
