#include "run_directory.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

namespace foam::cli {

void add_run_directory(CLI::App& command, std::string& directory, const std::string& description) {
    CLI::Option* option = command.add_option("--run-dir", directory, description)->type_name("DIR");
    command
        .add_option_function<std::string>("--out",
                                          [option, &directory](const std::string& given) {
                                              if (option->count() > 0) {
                                                  throw Error(ErrorCode::usage,
                                                              "--out is the old spelling of --run-dir; remedy: one of "
                                                              "the two");
                                              }
                                              directory = given;
                                          })
        ->group("");
}

void refuse_output_file(CLI::App& command) {
    command
        .add_option_function<std::string>(
            "-o,--output",
            [&command](const std::string& given) {
                throw Error(ErrorCode::usage,
                            fmt::format("-o names an output file, and foam {} writes a folder; remedy: --run-dir {}",
                                        command.get_name(), given.empty() ? "DIR" : given));
            })
        ->expected(0, 1)
        ->group("");
}

} // namespace foam::cli
