#include "build_identity.hpp"

#include "elf_note.hpp"

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

/// Adds the file of a loaded library. For dl_iterate_phdr().
int add_library(dl_phdr_info* info, std::size_t, void* files) {
    const std::filesystem::path file = info->dlpi_name;
    if (is_computing(file.filename().string())) {
        static_cast<std::vector<std::filesystem::path>*>(files)->push_back(file);
    }
    return 0;
}

} // namespace

std::string build_identity(const std::filesystem::path& file) {
    if (std::string id = read_build_id(file); !id.empty()) {
        return id;
    }
    try {
        return digest_of(read_file(file));
    } catch (const Error&) {
        return "";
    }
}

std::string build_of_libraries() {
    std::vector<std::filesystem::path> files;
    dl_iterate_phdr(add_library, &files);
    std::vector<std::string> builds;
    for (const auto& file : files) {
        builds.push_back(fmt::format("{} {}", file.filename().string(), build_identity(file)));
    }
    std::sort(builds.begin(), builds.end());
    return fmt::format("{}", fmt::join(builds, ", "));
}

} // namespace foam::sdk
