#include "commands.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace foam::cli {
namespace {

constexpr const char* bench_program = "foam-bench";

/// Replaces this program by foam-bench of the same folder, with the same command line.
int start_bench(const Program& program) {
    const auto file = std::filesystem::canonical(own_program).parent_path() / bench_program;
    ::execv(file.c_str(), program.arguments);
    if (errno != ENOENT) {
        throw Error(ErrorCode::usage, fmt::format("{}: cannot be started: {}", file.string(), std::strerror(errno)));
    }
    throw Error(ErrorCode::usage,
                fmt::format("{} is not there: the experiments are a program of their own; remedy: in a clone, run "
                            "`./foam bench` once, which builds it, or `ninja -C BUILD_FOLDER bench`; for an "
                            "installed foam, install the package foam-bench",
                            file.string()));
}

} // namespace

void add_bench(Program& program) {
    CLI::App* command = program.app.add_subcommand("bench", "Measure stages, write tables and plots");
    command->set_help_flag(); // all that follows is for foam-bench
    command->fallthrough(false);
    command->prefix_command();
    command->callback([&program] { program.action = [&program] { return start_bench(program); }; });
}

} // namespace foam::cli
