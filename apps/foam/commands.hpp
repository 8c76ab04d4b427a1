// The commands; each adds itself to the program.
#pragma once

#include "cli/program.hpp"

namespace foam::cli {

void add_run(Program& program);
void add_check(Program& program);
void add_plan(Program& program);
void add_spherize(Program& program);
void add_approximate(Program& program);
void add_batch(Program& program);
void add_verify(Program& program);
void add_bench(Program& program);
void add_evaluate(Program& program);
void add_certify(Program& program);
void add_compare(Program& program);
void add_view(Program& program);
void add_gallery(Program& program);
void add_convert(Program& program);
void add_formats(Program& program);
void add_self_collision(Program& program);
void add_stages(Program& program);
void add_describe(Program& program);
void add_plugins(Program& program);
void add_cache(Program& program);
void add_schema(Program& program);
void add_sdk(Program& program);
void add_new_plugin(Program& program);
void add_test_plugin(Program& program);
void add_version(Program& program);
void add_info(Program& program);
void add_help(Program& program);
void add_completion(Program& program);
void add_manual(Program& program);

} // namespace foam::cli
