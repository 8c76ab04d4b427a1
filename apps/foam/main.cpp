#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/batch/batch.hpp>

int main(int count, char** arguments) {
    using namespace foam::cli;
    foam::serve_batch_worker(count, arguments);
    return run_main(count, arguments, [](Program& program) {
        add_run(program);
        add_spherize(program);
        add_approximate(program);
        add_batch(program);
        add_verify(program);
        add_bench(program);
        add_info(program);
        add_evaluate(program);
        add_certify(program);
        add_compare(program);
        add_view(program);
        add_gallery(program);
        add_convert(program);
        add_formats(program);
        add_self_collision(program);
        add_check(program);
        add_plan(program);
        add_stages(program);
        add_describe(program);
        add_plugins(program);
        add_cache(program);
        add_schema(program);
        add_sdk(program);
        add_new_plugin(program);
        add_test_plugin(program);
        add_help(program);
        add_completion(program);
        add_manual(program);
        add_version(program);
    });
}
