#include <foam/batch/batch.hpp>

#include "messages.hpp"
#include "plan.hpp"
#include "shard.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/internal/files.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

namespace foam::inline batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Ids of one pass over the shards: the lines of these are in memory at the same time.
constexpr std::size_t ids_of_a_pass = 1'000'000;

/// Where the table goes: into a new file that gets its name at the end, or to the standard output.
class Table {
public:
    explicit Table(const fs::path& file) : file_(file), staged_(file), compressed_(extension_of(file) == "zst") {
        if (!file.empty()) {
            std::error_code error;
            if (!is_special_file(file)) {
                file_ = followed(file, error);
                staged_ = file_.string() + ".new";
            }
            if (error) {
                fail();
            }
            stream_.open(staged_, std::ios::binary | std::ios::trunc);
            if (!stream_) {
                fail();
            }
        }
    }
    ~Table() {
        std::error_code ignored;
        if (staged_ != file_) {
            fs::remove(staged_, ignored);
        }
    }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    void add(const std::string& line) {
        pending_ += line + '\n';
        if (pending_.size() > 4 << 20) {
            write();
        }
    }
    void finish() {
        write();
        if (!file_.empty()) {
            stream_.close();
            std::error_code error;
            if (staged_ != file_) {
                fs::rename(staged_, file_, error);
            }
            if (!stream_ || error) {
                fail();
            }
        }
    }

private:
    void write() {
        std::ostream& out = file_.empty() ? std::cout : stream_;
        if (!pending_.empty()) {
            out << (compressed_ ? frame_of(pending_) : pending_) << std::flush;
            pending_.clear();
        }
        if (!out) {
            fail();
        }
    }
    [[noreturn]] void fail() const {
        throw Error(ErrorCode::output,
                    fmt::format("{}: it cannot be written", file_.empty() ? "standard output" : file_.string()));
    }

    fs::path file_, staged_;
    bool compressed_;
    std::ofstream stream_;
    std::string pending_;
};

std::string without_times(const std::string& line) {
    Json json = Json::parse(line);
    json.erase("cpu_seconds");
    return json.dump();
}

/// Returns the results of the ids from `first` to `last`, by id.
std::map<std::string, std::string> lines_between(const Plan& plan, const std::string& first, const std::string& last) {
    std::map<std::string, std::string> lines;
    for (std::size_t shard = 0; shard < plan.shards; ++shard) {
        for_each_result(plan, shard, [&](std::string_view line) {
            std::string id = head_of(line).id;
            if (first <= id && id <= last) {
                lines[std::move(id)] = line;
            }
        });
    }
    return lines;
}

/// Calls `on_line` for each result, sorted by id. Returns the number of meshes without one.
std::size_t for_each_sorted(const Plan& plan, const std::function<void(const std::string& line)>& on_line) {
    std::vector<std::string> ids;
    for (const BatchItem& item : plan.items) {
        ids.push_back(item.id);
    }
    std::sort(ids.begin(), ids.end());
    std::size_t lines = 0;
    for (std::size_t begin = 0; begin < ids.size(); begin += ids_of_a_pass) {
        const std::size_t end = std::min(ids.size(), begin + ids_of_a_pass);
        for (const auto& [id, line] : lines_between(plan, ids[begin], ids[end - 1])) {
            on_line(line);
            ++lines;
        }
    }
    return ids.size() - lines;
}

} // namespace

Collected collect_batch(const fs::path& folder, const fs::path& table, const CollectOptions& options) {
    const Plan plan = read_plan(folder);
    Collected collected;
    std::set<std::string> digests;
    const bool arrays = extension_of(table) == "npz";
    std::optional<Table> out;
    std::optional<Arrays> numbers;
    arrays ? void(numbers.emplace()) : void(out.emplace(table));
    collected.missing = for_each_sorted(plan, [&](const std::string& line) {
        ResultHead head = head_of(line);
        ++collected.lines;
        collected.failed += head.failed ? 1 : 0;
        if (!head.digest.empty() && !digests.insert(std::move(head.digest)).second) {
            ++collected.duplicates;
        }
        if (options.failures && !head.failed) {
            return;
        }
        if (numbers) {
            numbers->add(Json::parse(line));
        } else {
            out->add(options.times ? line : without_times(line));
        }
    });
    numbers ? numbers->write(table) : out->finish();
    return collected;
}

std::string read_batch_table(const fs::path& table) {
    if (extension_of(table) != "zst") {
        return read_file(table);
    }
    std::string text;
    for_each_line_of(table, [&](std::string_view line) { text.append(line) += '\n'; });
    return text;
}

} // namespace foam::batch
