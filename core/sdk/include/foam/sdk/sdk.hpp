// The SDK of this foam, for building plugins.
#pragma once

#include <filesystem>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// Returns the prefix for CMake (CMAKE_PREFIX_PATH) so that find_package(foam) finds this foam: the installation's, or
/// the build folder for a program run from there. Throws Error(usage) if the SDK is not installed.
std::filesystem::path sdk_prefix();

/// Returns the folder that this foam is installed in, which has lib and share; the build folder for a program run from
/// there.
std::filesystem::path installation_prefix();

/// Returns the folder of foam's libraries, symbolic links resolved.
std::filesystem::path library_folder();

} // namespace sdk
} // namespace foam
