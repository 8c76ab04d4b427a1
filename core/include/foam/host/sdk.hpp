// The SDK that belongs to this foam: what plugins are built with.
#pragma once

#include <filesystem>

namespace foam {

/// The prefix to give to CMake (CMAKE_PREFIX_PATH) so that find_package(foam) finds this foam: the installation's, or
/// the build folder for a program run from there. Throws Error(usage) if the SDK is not installed.
std::filesystem::path sdk_prefix();

/// The folder of libfoam-core.so, links resolved.
std::filesystem::path library_folder();

} // namespace foam
