// Scripts that work on the shards of a folder: Slurm, Snakemake.
#include <foam/batch/batch.hpp>

#include "plan.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace foam::inline batch {
namespace {

namespace fs = std::filesystem;

/// Returns an argument as a word of a shell.
std::string shell_word(const std::string& text) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) {
        return text;
    }
    std::string word = "'";
    for (const char c : text) {
        word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return word + "'";
}

std::string shell_words(const std::vector<std::string>& arguments) {
    std::vector<std::string> words(arguments.size());
    std::transform(arguments.begin(), arguments.end(), words.begin(), shell_word);
    return fmt::format("{}", fmt::join(words, " "));
}

std::string sbatch_text(const Plan& plan, const BatchOptions& options, const std::vector<std::string>& command) {
    constexpr std::size_t slurm_default_most = 1000; // MaxArraySize is 1001
    const std::size_t tasks = std::min(plan.shards, slurm_default_most);
    const std::string logs = fs::absolute(plan.folder).string();
    return fmt::format(
        "#!/bin/sh\n"
        "# Works on the shards of a data set as a Slurm job array. Task i takes the shards i, i + number of tasks, …\n"
        "# A task that was preempted or killed goes on after its last written line; sbatch again does what is left.\n"
        "#SBATCH --job-name=foam\n"
        "#SBATCH --array=0-{}\n"
        "#SBATCH --cpus-per-task=1\n"
        "#SBATCH --mem={}M\n"
        "#SBATCH --requeue\n"
        "#SBATCH --signal=B:TERM@60\n" // B: to this shell, which is foam by then
        "#SBATCH --open-mode=append\n"
        "#SBATCH --output=\"{}/log-%a.txt\"\n"
        "exec {} -j 1\n",
        tasks - 1, options.memory_limit.value_or(default_memory_limit) + 1024, logs, shell_words(command));
}

std::string snakefile_text(const Plan& plan, const std::vector<std::string>& command) {
    // Braces and quotes belong to Snakemake within the text of a command.
    std::string words = shell_words(command);
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{"\\", "\\\\"}, {"\"", "\\\""}, {"{", "{{"}, {"}", "}}"}}) {
        for (std::size_t at = 0; (at = words.find(from, at)) != std::string::npos; at += to.size()) {
            words.replace(at, from.size(), to);
        }
    }
    return fmt::format("# One rule a shard: snakemake -s Snakefile --cores all\n"
                       "SHARDS = [f\"{{i:05}}\" for i in range({})]\n\n"
                       "rule all:\n"
                       "    input: expand(\"shard-{{i}}.jsonl.zst\", i=SHARDS)\n\n"
                       "rule shard:\n"
                       "    output: \"shard-{{i}}.jsonl.zst\"\n"
                       "    # 4: complete, with failures, which are in the results\n"
                       "    shell: \"{} -j 1 --shard $((10#{{wildcards.i}})) || [ $? -eq 4 ]\"\n",
                       plan.shards, words);
}

std::string readme_text(const Plan& plan, const std::vector<std::string>& command) {
    const std::string words = shell_words(command), folder = shell_word(fs::absolute(plan.folder).string());
    return fmt::format("# Spheres of {} meshes in {} shards\n\nMade by\n\n    {}\n\n"
                       "Work on it with one of\n\n"
                       "    {}\n"
                       "    sbatch {}/foam.sbatch\n"
                       "    seq 0 {} | parallel -q {} -j 1 --shard {{}}\n"
                       "    snakemake -s Snakefile --cores all      # in this folder\n\n"
                       "and look at it with\n\n"
                       "    {} batch status {}\n"
                       "    {} batch collect {} -o spheres.jsonl.zst\n",
                       plan.items.size(), plan.shards, words, words, folder, plan.shards - 1, words,
                       shell_word(command.front()), folder, shell_word(command.front()), folder);
}

} // namespace

void prepare_batch(std::vector<BatchItem> items, const Recipe& recipe, const Registry& registry,
                   const BatchOptions& options, const std::vector<std::string>& command) {
    const Plan plan = plan_for(std::move(items), recipe, registry, options);
    write_file(plan.folder / "foam.sbatch", sbatch_text(plan, options, command));
    write_file(plan.folder / "Snakefile", snakefile_text(plan, command));
    write_file(plan.folder / "README.md", readme_text(plan, command));
}

} // namespace foam::batch
