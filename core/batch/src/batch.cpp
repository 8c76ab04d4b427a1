#include <foam/batch/batch.hpp>

#include "messages.hpp"
#include "plan.hpp"
#include "pool.hpp"
#include "shard.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/abi.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <thread>
#include <unistd.h>

namespace foam::inline batch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::vector<std::string> plugin_files(const Registry& registry) {
    std::vector<std::string> files;
    for (const PluginRecord& plugin : registry.plugins()) {
        if (plugin.loaded()) {
            files.push_back(fs::absolute(plugin.file).string());
        }
    }
    return files;
}

constexpr bool sanitized = std::string_view(FOAM_ABI_SANITIZER) != "none";

std::size_t memory_limit_of(const BatchOptions& options) {
    if (sanitized && options.memory_limit.value_or(0) > 0) {
        throw Error(ErrorCode::usage,
                    "a foam built with a sanitizer cannot enforce a memory limit; remedy: leave it out");
    }
    return sanitized ? 0 : options.memory_limit.value_or(default_memory_limit);
}

/// The work of one process on a folder.
class Batch {
public:
    Batch(const Plan& plan, const Recipe& recipe, const Registry& registry, const BatchOptions& options,
          std::vector<std::size_t> shards)
        : plan_(plan), options_(options), shards_(std::move(shards)),
          pool_(pool_options(plan, recipe, registry, options)) {
        for (const std::size_t shard : shards_) {
            outcome_.meshes += plan_.items_of(shard).size();
        }
    }

    BatchOutcome work() {
        while (!stop_asked()) {
            pool_.turn([this] { return next_job(); },
                       [this](const Job& job, const std::string& line) { keep(job, line); });
            for (auto& [shard, open] : open_) {
                if (open.file->flush_due()) {
                    open.file->flush();
                }
            }
            tell_progress(false);
            if (pool_.idle() && !current_ && next_shard_ == shards_.size()) {
                break;
            }
        }
        for (auto& [shard, open] : open_) {
            open.file->flush();
        }
        tell_progress(true);
        outcome_.added = done_here_;
        return outcome_;
    }

private:
    struct Open {
        std::unique_ptr<OpenShard> file;
        std::size_t given = 0;
    };

    static PoolOptions pool_options(const Plan& plan, const Recipe& recipe, const Registry& registry,
                                    const BatchOptions& options) {
        WorkerTask task{.parent = ::getpid(),
                        .memory_limit = memory_limit_of(options),
                        .plugins = plugin_files(registry),
                        .recipe = worker_recipe(recipe, registry),
                        .recipe_digest = plan.recipe_digest};
        const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
        return {options.program.empty() ? fs::path("/proc/self/exe") : options.program, std::move(task),
                options.time_limit, options.workers > 0 ? options.workers : cores};
    }

    bool stop_asked() {
        outcome_.stopped = options_.stop && options_.stop();
        return outcome_.stopped;
    }

    /// Opens the next shard that has work left. Returns whether there is one.
    bool open_next() {
        while (next_shard_ < shards_.size()) {
            const std::size_t shard = shards_[next_shard_++];
            bool busy = false;
            std::unique_ptr<OpenShard> file = OpenShard::open(plan_, shard, busy);
            if (!file) {
                outcome_.busy += busy ? 1 : 0;
                done_ += busy ? 0 : plan_.items_of(shard).size();
                continue;
            }
            done_ += file->done_before();
            failed_ += file->failed_before();
            if (file->complete()) { // all lines were there, but not the name
                file->finish();
                continue;
            }
            open_[shard].file = std::move(file);
            current_ = shard;
            return true;
        }
        return false;
    }

    std::optional<Job> next_job() {
        if (!current_ && !open_next()) {
            return {};
        }
        Open& open = open_.at(*current_);
        Job job = job_from(open.file->left(), open.given);
        job.owner = *current_;
        open.given += job.items.size();
        if (open.given == open.file->left().size()) {
            current_.reset();
        }
        return job;
    }

    /// Returns the job that begins with an item: several if they can share a search.
    Job job_from(const std::vector<const BatchItem*>& left, std::size_t begin) const {
        constexpr std::size_t most = 64; // so that one worker does not get a whole shard
        const std::span<const BatchItem> group = plan_.group_of(*left[begin]);
        Job job{{left[begin]}, 0, plan_.has_scales(*left[begin])};
        for (std::size_t i = begin + 1; job.one_search && i < left.size() && job.items.size() < most; ++i) {
            if (left[i] > &group.back()) {
                break;
            }
            job.items.push_back(left[i]);
        }
        return job;
    }

    void keep(const Job& job, const std::string& line) {
        OpenShard& file = *open_.at(job.owner).file;
        file.add(line);
        ++done_;
        ++done_here_;
        failed_ += head_of(line).failed ? 1 : 0;
        if (file.complete()) {
            file.finish();
            open_.erase(job.owner);
        }
    }

    void tell_progress(bool last) {
        const auto now = Clock::now();
        if (!options_.progress || (!last && now - told_ < std::chrono::milliseconds(200))) {
            return;
        }
        told_ = now;
        const double seconds = std::chrono::duration<double>(now - begin_).count();
        options_.progress({outcome_.meshes, done_, failed_, static_cast<double>(done_here_) / std::max(seconds, 1e-3)});
    }

    const Plan& plan_;
    const BatchOptions& options_;
    std::vector<std::size_t> shards_;
    Pool pool_;
    BatchOutcome outcome_;
    std::size_t next_shard_ = 0, done_ = 0, failed_ = 0, done_here_ = 0;
    std::optional<std::size_t> current_; ///< the shard whose meshes are given to workers
    std::map<std::size_t, Open> open_;
    Clock::time_point begin_ = Clock::now(), told_{};
};

/// Returns the numbers of the shards of this process.
std::vector<std::size_t> shards_of(const Plan& plan, const BatchOptions& options) {
    std::vector<std::size_t> shards = options.only;
    if (shards.empty() && options.tasks) {
        shards = options.tasks(plan.shards);
    } else if (shards.empty()) {
        shards.resize(plan.shards);
        std::iota(shards.begin(), shards.end(), std::size_t{0});
    }
    std::sort(shards.begin(), shards.end());
    shards.erase(std::unique(shards.begin(), shards.end()), shards.end());
    for (const std::size_t shard : shards) {
        if (shard >= plan.shards) {
            throw Error(ErrorCode::usage, fmt::format("there is no shard {}: {} has {}, numbered from 0", shard,
                                                      plan.folder.string(), plan.shards));
        }
    }
    return shards;
}

} // namespace

BatchOutcome run_batch(std::vector<BatchItem> items, const Recipe& recipe, const Registry& registry,
                       const BatchOptions& options) {
    const Plan plan = plan_for(std::move(items), recipe, registry, options);
    const std::vector<std::size_t> shards = shards_of(plan, options);
    BatchOutcome outcome = Batch(plan, recipe, registry, options, shards).work();
    std::size_t lines = 0;
    for (const std::size_t shard : shards) {
        for_each_result(plan, shard, [&](std::string_view line) {
            ++lines;
            outcome.failed += head_of(line).failed ? 1 : 0;
        });
    }
    outcome.missing = outcome.meshes - lines;
    outcome.complete = plan.complete();
    return outcome;
}

} // namespace foam::batch
