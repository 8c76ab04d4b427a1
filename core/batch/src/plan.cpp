#include "plan.hpp"

#include "archive.hpp"
#include "messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/runtime/version.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <tuple>

namespace foam::inline batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* head_name = "batch.json";
constexpr std::size_t frame_bytes = 4 << 20; // of the list's text
constexpr std::size_t meshes_of_a_shard = 1000, most_shards = 1'000'000;

/// Returns the sizes of an archive's files; none if it cannot be read, which its meshes then tell.
std::map<std::string, std::uintmax_t> sizes_in(const fs::path& archive) {
    std::map<std::string, std::uintmax_t> sizes;
    try {
        for (const ArchiveMember& member : open_archive(archive)->members()) {
            sizes[member.name] = member.bytes;
        }
    } catch (const Error&) {
        sizes.clear();
    }
    return sizes;
}

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
        if (is_new) {
            known->second = sizes_in(inside->archive);
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
        throw Error(
            ErrorCode::usage,
            fmt::format("{}: its results are of another {} ({}, not {}); remedy: another folder for --run-dir, or "
                        "delete this one",
                        folder.string(), what, there, here));
    }
}

/// What a folder of results says about itself.
struct Head {
    std::string foam, recipe;
    Digest recipe_digest, list_digest;
    std::size_t meshes = 0, shards = 0;
};

Head head_of_folder(const fs::path& folder) {
    const fs::path file = folder / head_name;
    const std::string text = read_file(file);
    try {
        const Json json = Json::parse(text);
        Head head{json.at("foam"),        json.at("recipe"), json.at("recipe_digest"),
                  json.at("list_digest"), json.at("meshes"), json.at("shards")};
        if (json.at("format") == "foam batch 1" && head.shards > 0) {
            return head;
        }
    } catch (const Json::exception&) { // the same as another format
    }
    throw Error(ErrorCode::input,
                fmt::format("{}: not foam's record of a batch; remedy: another folder", file.string()));
}

/// Returns the file of a list. Its name has the digest, so that processes with different lists do not meet.
fs::path list_file(const fs::path& folder, const Digest& list) {
    return folder / fmt::format("list-{}.jsonl.zst", list.substr(0, 16));
}

std::string frames_of(const std::vector<BatchItem>& items) {
    std::string frames, lines;
    for (const BatchItem& item : items) {
        lines += line_of(item);
        if (lines.size() > frame_bytes) {
            frames += frame_of(lines);
            lines.clear();
        }
    }
    return lines.empty() ? frames : frames + frame_of(lines);
}

/// Writes list and head, unless another process has done so.
void make_plan(const Plan& plan, const Digest& list) {
    // The list first: a folder with a head is complete. The first process decides its order.
    const fs::path items = list_file(plan.folder, list);
    const bool made = write_new_file(items, frames_of(plan.items));
    const Json head{{"format", "foam batch 1"}, {"foam", version()},           {"recipe_digest", plan.recipe_digest},
                    {"list_digest", list},      {"meshes", plan.items.size()}, {"shards", plan.shards},
                    {"recipe", plan.recipe}};
    if (!write_new_file(plan.folder / head_name, head.dump(2) + '\n') && made &&
        head_of_folder(plan.folder).list_digest != list) {
        fs::remove(items);
    }
}

/// Whether two items differ in nothing but id and scale.
bool same_but_scale(const BatchItem& a, const BatchItem& b) {
    return a.path == b.path && a.unit.unit == b.unit.unit && a.spheres == b.spheres;
}

/// Sorts into the order of the work: large files first, and the scales of one mesh together.
void sort_for_work(std::vector<BatchItem>& items) {
    const auto key = [](const BatchItem& item) { return std::tie(item.path, item.unit.unit, item.spheres, item.id); };
    std::sort(items.begin(), items.end(), [&](const BatchItem& a, const BatchItem& b) {
        return a.bytes != b.bytes ? a.bytes > b.bytes : key(a) < key(b);
    });
}

/// Finds the groups of items in the order of the work.
void find_groups(Plan& plan) {
    plan.groups.clear();
    for (std::size_t i = 0; i < plan.items.size(); ++i) {
        if (i == 0 || !same_but_scale(plan.items[i - 1], plan.items[i])) {
            plan.groups.push_back(i);
        }
    }
    plan.groups.push_back(plan.items.size());
}

} // namespace

std::vector<const BatchItem*> Plan::items_of(std::size_t shard) const {
    std::vector<const BatchItem*> result;
    for (std::size_t group = shard; group + 1 < groups.size(); group += shards) {
        for (std::size_t i = groups[group]; i < groups[group + 1]; ++i) {
            result.push_back(&items[i]);
        }
    }
    return result;
}

std::span<const BatchItem> Plan::group_of(const BatchItem& item) const {
    const auto index = static_cast<std::size_t>(&item - items.data());
    const auto end = std::upper_bound(groups.begin(), groups.end(), index);
    return std::span(items).subspan(*(end - 1), *end - *(end - 1));
}

bool Plan::has_scales(const BatchItem& item) const {
    const std::span<const BatchItem> group = group_of(item);
    return std::any_of(group.begin(), group.end(),
                       [&](const BatchItem& other) { return other.unit.scale != group.front().unit.scale; });
}

bool Plan::complete() const {
    for (std::size_t shard = 0; shard < shards; ++shard) {
        if (!fs::exists(shard_file(shard))) {
            return false;
        }
    }
    return true;
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
        sort_for_work(items);
        const std::size_t number = shards.value_or((items.size() + meshes_of_a_shard - 1) / meshes_of_a_shard);
        make_plan({folder, recipe, recipe_digest, std::min({number, items.size(), most_shards}), std::move(items), {}},
                  list);
    }
    std::vector<BatchItem>().swap(items); // the plan has them
    const Head head = head_of_folder(folder);
    require_same(folder, "version of foam", head.foam, version());
    require_same(folder, "list of meshes", head.list_digest, list);
    require_same(folder, "recipe", head.recipe_digest, recipe_digest);
    Plan plan = read_plan(folder);
    if (shards) {
        require_same(folder, "number of shards", fmt::format("{}", plan.shards),
                     fmt::format("{}", std::min(*shards, plan.items.size())));
    }
    return plan;
}

Plan read_plan(const fs::path& folder) {
    if (!fs::exists(folder / head_name)) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: no results of foam batch in it ({} is missing); remedy: the folder "
                                "that --run-dir named",
                                folder.string(), head_name));
    }
    const Head head = head_of_folder(folder);
    Plan plan{folder, head.recipe, head.recipe_digest, head.shards, {}, {}};
    const fs::path list = list_file(folder, head.list_digest);
    const Error not_the_list(ErrorCode::input, fmt::format("{}: not the list of this batch; remedy: delete {}",
                                                           list.string(), folder.string()));
    try {
        for_each_line_of(list, [&](std::string_view line) { plan.items.push_back(item_of_line(line)); });
    } catch (const Json::exception&) {
        throw not_the_list;
    }
    if (plan.items.size() != head.meshes) {
        throw not_the_list;
    }
    find_groups(plan);
    return plan;
}

namespace {

/// Returns the recipe with a mesh that plays no part, and nothing to write but spheres.
Recipe plain_recipe(Recipe recipe) {
    recipe.mesh = {"/mesh.stl"};
    recipe.name = "mesh";
    recipe.outputs.clear();
    recipe.snapshots = recipe.debug_meshes = recipe.debug_snapshots = false;
    recipe.variant.clear();
    return recipe;
}

} // namespace

Plan plan_for(std::vector<BatchItem> items, const Recipe& recipe, const Registry& registry,
              const BatchOptions& options) {
    if (!recipe.urdf.empty()) {
        throw Error(ErrorCode::usage,
                    "the recipe is for a robot; remedy: a recipe with `mesh:`, whose file plays no part");
    }
    const StageInfo& spherizer = registry.find(recipe.spherizer.stage)->info;
    if (!spheres_alone(spherizer.kinds)) {
        throw Error(ErrorCode::usage,
                    fmt::format("the results of a batch hold spheres, and {} makes {}; remedy: a stage spherize.*, or "
                                "foam approximate for each mesh",
                                spherizer.name, words_of(spherizer.kinds)));
    }
    return open_plan(options.folder, to_yaml(plain_recipe(recipe), registry), std::move(items), options.shards);
}

std::string worker_recipe(const Recipe& recipe, const Registry& registry) {
    return to_yaml(plain_recipe(recipe), registry, true);
}

} // namespace foam::inline batch
