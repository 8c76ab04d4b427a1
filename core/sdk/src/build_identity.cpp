#include "plugin_file.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/digest.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/sdk/registry.hpp>

#include <fmt/format.h>

#include <link.h>

#include <algorithm>
#include <array>
#include <vector>

namespace foam::inline sdk {
namespace {

/// Those whose code determines the results of stages.
constexpr std::array computing{"base", "geometry", "robot", "search", "sdk", "runtime"};

bool is_computing(const std::string& file_name) {
    return std::any_of(computing.begin(), computing.end(), [&](const char* name) {
        return file_name.starts_with(fmt::format("libfoam-{}.so", name));
    });
}

/// Adds the name and the build of a loaded library, from its image in memory: the file may be another by now. For
/// dl_iterate_phdr().
int add_build(dl_phdr_info* info, std::size_t, void* builds) {
    const std::filesystem::path file = info->dlpi_name;
    if (!is_computing(file.filename().string())) {
        return 0;
    }
    std::string id;
    for (std::size_t i = 0; i < info->dlpi_phnum && id.empty(); ++i) {
        const auto& segment = info->dlpi_phdr[i];
        if (segment.p_type == PT_NOTE) {
            id = build_id_in({reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr), segment.p_memsz});
        }
    }
    static_cast<std::vector<std::string>*>(builds)->push_back(
        fmt::format("{} {}", file.filename().string(), build_identity(id, file)));
    return 0;
}

} // namespace

std::string build_identity(const std::string& build_id, const std::filesystem::path& file) {
    if (!build_id.empty()) {
        return build_id;
    }
    try {
        return digest_of(read_file(file));
    } catch (const Error&) {
        return "";
    }
}

std::string build_of_libraries() {
    static const std::string builds = [] { // the program's libraries stay the same
        std::vector<std::string> found;
        dl_iterate_phdr(add_build, &found);
        std::sort(found.begin(), found.end());
        return fmt::format("{}", fmt::join(found, ", "));
    }();
    return builds;
}

} // namespace foam::sdk
