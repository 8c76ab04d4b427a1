// The built program, run as a user runs it.
#pragma once

#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/wait.h>

namespace foam::test {

inline std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct Outcome {
    int code = -1; ///< exit code; 128 + signal if the program was killed
    std::string out, err;
};

/// Every test has a folder of its own, which is the current one of the program and holds its cache.
class Cli : public ::testing::Test {
protected:
    /// `arguments` as in a shell.
    Outcome foam(const std::string& arguments) const { return shell("'" FOAM_TEST_BINARY "' " + arguments); }

    /// `command` in the test's folder, standard output and error caught apart.
    Outcome shell(const std::string& command) const {
        const std::string folder = path().string();
        std::string script =
            "cd '@' && unset FOAM_PACKAGE_PATH FOAM_PLUGIN_PATH && export XDG_CACHE_HOME='@/cache' && { ";
        script.append(command).append(" ; } >'@/.out' 2>'@/.err'");
        for (std::size_t at = 0; (at = script.find('@', at)) != script.npos; at += folder.size()) {
            script.replace(at, 1, folder);
        }
        const int status = std::system(script.c_str());
        Outcome outcome;
        outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        outcome.out = contents(path() / ".out");
        outcome.err = contents(path() / ".err");
        return outcome;
    }

    std::filesystem::path path() const { return folder_.path(); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path() / name, std::ios::binary) << text;
    }

private:
    TemporaryFolder folder_;
};

/// A box of 0.2 x 0.1 x 0.3 m.
inline constexpr const char* box_obj = "v -0.1 -0.05 -0.15\nv 0.1 -0.05 -0.15\nv 0.1 0.05 -0.15\nv -0.1 0.05 -0.15\n"
                                       "v -0.1 -0.05 0.15\nv 0.1 -0.05 0.15\nv 0.1 0.05 0.15\nv -0.1 0.05 0.15\n"
                                       "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

} // namespace foam::test
