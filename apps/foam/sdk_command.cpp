// For authors of plugins: where the SDK is.
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/sdk/sdk.hpp>

namespace foam::cli {

void add_sdk(Program& program) {
    CLI::App* command = add_command(program, "sdk", "Print the folder of the SDK for CMake",
                                    "  cmake -S mine -B mine/build -DCMAKE_PREFIX_PATH=\"$(foam sdk)\"");
    command->callback([&program] {
        program.action = [] {
            print_data(sdk_prefix().string() + "\n");
            return 0;
        };
    });
}

} // namespace foam::cli
