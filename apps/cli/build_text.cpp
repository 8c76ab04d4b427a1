#include "program.hpp"

#include "commit.hpp" // made by commit.cmake

#include <fmt/format.h>

namespace foam::cli {

std::string build_text() {
    const std::string commit = FOAM_COMMIT;
#ifdef __clang__
    const std::string compiler = fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
    const std::string compiler = "g++ " __VERSION__;
#endif
    return fmt::format("{}{}{}, {}", commit, commit.empty() ? "" : ", ", FOAM_BUILD, compiler);
}

} // namespace foam::cli
