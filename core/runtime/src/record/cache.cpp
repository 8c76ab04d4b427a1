#include <foam/runtime/internal/cache.hpp>

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/runtime/cache.hpp>
#include <foam/runtime/internal/bytes.hpp>

#include <cstdlib>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view magic = "foam cache 4\n";

void put_log(std::string& out, const StageLog& log) {
    put_text(out, log.call);
    put(out, static_cast<std::uint64_t>(log.findings.size()));
    for (const Finding& finding : log.findings) {
        put(out, finding.severity);
        put_text(out, finding.message);
    }
    put(out, static_cast<std::uint64_t>(log.metrics.size()));
    for (const StageReport::Metric& metric : log.metrics) {
        put_text(out, metric.name);
        put(out, metric.value);
        put_text(out, metric.unit);
    }
}

StageLog take_log(ByteReader& in) {
    StageLog log;
    log.call = in.take_text();
    for (auto count = in.take<std::uint64_t>(); count > 0 && in.good(); --count) {
        Finding& finding = log.findings.emplace_back();
        finding.severity = in.take<Severity>();
        finding.message = in.take_text();
    }
    for (auto count = in.take<std::uint64_t>(); count > 0 && in.good(); --count) {
        StageReport::Metric& metric = log.metrics.emplace_back();
        metric.name = in.take_text();
        metric.value = in.take<double>();
        metric.unit = in.take_text();
    }
    return log;
}

} // namespace

Cache::Cache(fs::path folder) : folder_(std::move(folder)) {}

fs::path Cache::file(const Digest& key) const {
    return folder_ / key.substr(0, 2) / key.substr(2);
}

std::optional<std::string> Cache::load(const Digest& key) const {
    std::error_code error;
    if (folder_.empty() || !fs::exists(file(key), error)) {
        return std::nullopt;
    }
    try {
        const std::string bytes = read_file(file(key));
        fs::last_write_time(file(key), fs::file_time_type::clock::now(), error); // keeps it from trim_cache()
        const std::size_t head = magic.size() + 32;
        if (bytes.size() < head || !bytes.starts_with(magic)) {
            return std::nullopt;
        }
        std::string payload = bytes.substr(head);
        if (digest_of(payload) != bytes.substr(magic.size(), 32)) {
            return std::nullopt;
        }
        return payload;
    } catch (const Error&) {
        return std::nullopt;
    }
}

void Cache::store(const Digest& key, std::string payload) const {
    if (folder_.empty()) {
        return;
    }
    try {
        write_file(file(key), std::string(magic) + digest_of(payload) + payload);
        grew_ = true;
    } catch (const Error&) {
        // A cache that cannot be written costs time, not results.
    }
}

std::optional<Cached<Mesh>> Cache::mesh(const Digest& key) const {
    const auto payload = load(key);
    if (!payload) {
        return std::nullopt;
    }
    ByteReader in(*payload);
    Cached<Mesh> entry;
    entry.result = take_mesh(in);
    entry.log = take_log(in);
    return in.good() && in.at_end() ? std::optional(std::move(entry)) : std::nullopt;
}

void Cache::put(const Digest& key, const Mesh& mesh, const StageLog& log) const {
    std::string payload;
    put_mesh(payload, mesh);
    put_log(payload, log);
    store(key, std::move(payload));
}

std::optional<Cached<SphereTree>> Cache::tree(const Digest& key) const {
    const auto payload = load(key);
    if (!payload) {
        return std::nullopt;
    }
    ByteReader in(*payload);
    Cached<SphereTree> entry;
    entry.result = take_tree(in);
    entry.log = take_log(in);
    const bool whole = in.good() && in.at_end() && !entry.result.levels.empty();
    return whole ? std::optional(std::move(entry)) : std::nullopt;
}

void Cache::put(const Digest& key, const SphereTree& tree, const StageLog& log) const {
    std::string payload;
    put_tree(payload, tree);
    put_log(payload, log);
    store(key, std::move(payload));
}

void Cache::keep_within(std::uintmax_t bytes) const {
    if (grew_ && bytes > 0) {
        trim_cache(folder_, bytes);
    }
}

fs::path Cache::default_folder() {
    const char* cache_home = std::getenv("XDG_CACHE_HOME");
    if (cache_home && *cache_home == '/') {
        return fs::path(cache_home) / "foam";
    }
    const char* home = std::getenv("HOME");
    return home && *home == '/' ? fs::path(home) / ".cache" / "foam" : fs::path();
}

void add_to(Hasher& hasher, const Robot& robot) {
    hasher.add(robot.name).add(robot.root).add(static_cast<std::uint64_t>(robot.links.size()));
    for (const Link& link : robot.links) {
        hasher.add(link.name).add(static_cast<std::uint64_t>(link.collisions.size()));
        for (const GeometryElement& element : link.collisions) {
            hasher.add(element.origin).add(element.name);
            if (const auto* mesh = std::get_if<MeshReference>(&element.geometry)) {
                hasher.add("mesh").add(mesh->uri).add(mesh->scale);
                if (mesh->mesh) {
                    hasher.add(digest_of_content(*mesh->mesh));
                }
            } else {
                add_primitive(hasher.add("primitive"), std::get<Element>(element.geometry));
            }
        }
    }
    hasher.add(static_cast<std::uint64_t>(robot.joints.size()));
    for (const Joint& joint : robot.joints) {
        hasher.add(joint.name).add(static_cast<std::uint64_t>(joint.kind)).add(joint.parent).add(joint.child);
        hasher.add(joint.origin).add(joint.axis).add(joint.lower).add(joint.upper);
    }
}

void add_call(Hasher& hasher, const StageCall& call, const Registry& registry) {
    const RegisteredStage* stage = registry.find(call.stage);
    hasher.add(call.stage);
    if (!stage) {
        return;
    }
    hasher.add(build_of_libraries()).add(stage->build).add(static_cast<std::uint64_t>(stage->info.revision));
    for (const std::string& used : stage->info.uses) {
        const RegisteredStage* other = registry.find(used);
        hasher.add(used).add(other ? other->build : "absent");
        hasher.add(static_cast<std::uint64_t>(other ? other->info.revision : 0));
    }
    const Parameters parameters(stage->info.parameters, call.given);
    for (const Parameter& declared : stage->info.parameters) {
        if (declared.affects_output) {
            hasher.add(declared.name).add(to_text(parameters.values().find(declared.name)->second));
        }
    }
}

} // namespace foam::inline runtime
