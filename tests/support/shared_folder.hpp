// The robots and meshes of others that tests read where they are present.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace foam {

/// FOAM_SHARED of the environment, or the CMake option of that name. It may not exist.
inline std::filesystem::path shared_folder() {
    const char* chosen = std::getenv("FOAM_SHARED");
    return chosen ? chosen : FOAM_TEST_SHARED;
}

} // namespace foam
