#include "plan.hpp"

#include "archive.hpp"
#include "lines.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/runtime/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <unistd.h>

namespace foam::inline batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* head_name = "batch.json";
constexpr const char* list_name = "list.jsonl.zst";
constexpr std::size_t meshes_of_a_shard = 1000, most_shards = 1'000'000;

/// Sets the sizes of the files. O(items) system calls; tables of contents of archives are read once.
void find_sizes(std::vector<BatchItem>& items) {
    std::map<fs::path, std::map<std::string, std::uintmax_t>> archives;
    for (BatchItem& item : items) {
        std::error_code error;
        const auto inside = archive_path(item.path);
        if (!inside) {
            const std::uintmax_t bytes = fs::file_size(item.path, error);
            item.bytes = error ? 0 : bytes;
            continue;
        }
        const auto [known, is_new] = archives.try_emplace(inside->archive);
        if (is_new && fs::is_regular_file(inside->archive, error)) {
            for (const ArchiveMember& member : open_archive(inside->archive)->members()) {
                known->second[member.name] = member.bytes;
            }
        }
        const auto member = known->second.find(inside->member);
        item.bytes = member == known->second.end() ? 0 : member->second;
    }
}

std::string line_of(const BatchItem& item) {
    Json json{{"id", item.id}, {"path", item.path}};
    if (item.unit.unit) {
        json["unit"] = *item.unit.unit;
    }
    if (item.unit.scale != 1) {
        json["scale"] = item.unit.scale;
    }
    if (item.spheres) {
        json["spheres"] = *item.spheres;
    }
    json["bytes"] = item.bytes;
    return json.dump() + '\n';
}

BatchItem item_of_line(std::string_view line) {
    const Json json = Json::parse(line);
    BatchItem item{.id = json.at("id"), .path = json.at("path"), .unit = {}, .spheres = {}, .bytes = json.at("bytes")};
    if (json.contains("unit")) {
        item.unit.unit = json.at("unit").get<std::string>();
    }
    item.unit.scale = json.value("scale", 1.0);
    if (json.contains("spheres")) {
        item.spheres = json.at("spheres").get<std::size_t>();
    }
    return item;
}

/// Returns the digest of a list sorted by id: of everything that decides a result, but not of where the list lies.
Digest digest_of_list(const std::vector<BatchItem>& sorted) {
    Hasher hasher;
    for (const BatchItem& item : sorted) {
        hasher.add(item.id).add(item.path).add(item.unit.unit.value_or("")).add(item.unit.scale);
        hasher.add(static_cast<std::uint64_t>(item.spheres.value_or(0)));
    }
    return hasher.finish();
}

/// Writes the file unless another process has done so. Returns whether it did.
bool write_new_file(const fs::path& file, const std::string& bytes) {
    const fs::path staged = file.string() + fmt::format(".{}.new", ::getpid());
    write_file(staged, bytes);
    std::error_code error, ignored;
    fs::create_hard_link(staged, file, error);
    fs::remove(staged, ignored);
    if (error && error != std::errc::file_exists) {
        throw Error(ErrorCode::output, fmt::format("{}: it cannot be written ({})", file.string(), error.message()));
    }
    return !error;
}

void require_same(const fs::path& folder, const char* what, const std::string& there, const std::string& here) {
    if (there != here) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: its results are of another {} ({}, not {}); remedy: another folder for --out, or "
                                "delete this one",
                                folder.string(), what, there, here));
    }
}

Json head_of(const fs::path& folder) {
    const fs::path file = folder / head_name;
    const Json json = Json::parse(read_file(file), nullptr, false);
    if (!json.is_object() || json.value("format", "") != "foam batch 1") {
        throw Error(ErrorCode::input, fmt::format("{}: not foam's record of a batch", file.string()));
    }
    return json;
}

void make_plan(const Plan& plan, const Digest& list) {
    std::string lines;
    for (const BatchItem& item : plan.items) {
        lines += line_of(item);
    }
    // The list first: a folder with a head is complete. Another process writes the same list.
    write_file(plan.folder / list_name, frame_of(lines));
    const Json head{{"format", "foam batch 1"},   {"foam", version()},   {"recipe_digest", plan.recipe_digest},
                    {"list_digest", list},        {"meshes", plan.items.size()}, {"shards", plan.shards},
                    {"recipe", plan.recipe}};
    write_new_file(plan.folder / head_name, head.dump(2) + '\n');
}

} // namespace

std::vector<const BatchItem*> Plan::items_of(std::size_t shard) const {
    std::vector<const BatchItem*> result;
    for (std::size_t i = shard; i < items.size(); i += shards) {
        result.push_back(&items[i]);
    }
    return result;
}

fs::path Plan::shard_file(std::size_t shard) const {
    return folder / fmt::format("shard-{:05}.jsonl.zst", shard);
}

fs::path part_of(const fs::path& shard_file) {
    return shard_file.string() + ".part";
}

Plan open_plan(const fs::path& folder, const std::string& recipe, std::vector<BatchItem> items,
               std::optional<std::size_t> shards) {
    const Digest list = digest_of_list(items);
    const Digest recipe_digest = Hasher().add(recipe).add(version()).finish();
    if (!fs::exists(folder / head_name)) {
        find_sizes(items);
        std::stable_sort(items.begin(), items.end(),
                         [](const BatchItem& a, const BatchItem& b) { return a.bytes > b.bytes; });
        const std::size_t number = shards.value_or((items.size() + meshes_of_a_shard - 1) / meshes_of_a_shard);
        make_plan({folder, recipe, recipe_digest, std::min({number, items.size(), most_shards}), items}, list);
    }
    const Json head = head_of(folder);
    require_same(folder, "version of foam", head.at("foam"), version());
    require_same(folder, "list of meshes", head.at("list_digest"), list);
    require_same(folder, "recipe", head.at("recipe_digest"), recipe_digest);
    Plan plan = read_plan(folder);
    if (shards) {
        require_same(folder, "number of shards", fmt::format("{}", plan.shards),
                     fmt::format("{}", std::min(*shards, plan.items.size())));
    }
    return plan;
}

Plan read_plan(const fs::path& folder) {
    if (!fs::exists(folder / head_name)) {
        throw Error(ErrorCode::input, fmt::format("{}: no results of foam batch in it ({} is missing); remedy: the folder "
                                                  "that --out named",
                                                  folder.string(), head_name));
    }
    const Json head = head_of(folder);
    Plan plan{folder, head.at("recipe"), head.at("recipe_digest"), head.at("shards"), {}};
    for_each_line_of(folder / list_name, [&](std::string_view line) { plan.items.push_back(item_of_line(line)); });
    if (plan.items.size() != head.at("meshes").get<std::size_t>() || plan.shards == 0) {
        throw Error(ErrorCode::input, fmt::format("{}: not the list of this batch; remedy: delete {}",
                                                  (folder / list_name).string(), folder.string()));
    }
    return plan;
}

} // namespace foam::batch
