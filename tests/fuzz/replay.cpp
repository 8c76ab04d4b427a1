// fuzz_replay TARGET FOLDER...: reads each file as the fuzzer would, with any compiler. Exit code 1 if one breaks a
// promise; the names go to the terminal before each file, since it may crash.
#include "targets.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

bool keeps_its_promises(foam::fuzz::Target target, const fs::path& file) {
    std::fprintf(stderr, "%s\n", file.c_str());
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    try {
        target(bytes);
        return true;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "  %s\n", error.what());
        return false;
    }
}

} // namespace

int main(int count, char** arguments) {
    const foam::fuzz::Target target = count > 1 ? foam::fuzz::find_target(arguments[1]) : nullptr;
    if (!target) {
        std::fprintf(stderr, "usage: fuzz_replay TARGET FOLDER...\n");
        return 2;
    }
    std::size_t files = 0, broken = 0;
    for (int i = 2; i < count; ++i) {
        for (const fs::path& file : files_in(arguments[i])) {
            ++files;
            broken += keeps_its_promises(target, file) ? 0 : 1;
        }
    }
    std::printf("%zu files, %zu broken promises\n", files, broken);
    return files > 0 && broken == 0 ? 0 : 1;
}
