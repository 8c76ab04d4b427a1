#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/collision/reference_pose.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/judge/written_model.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace foam::inline judge {
namespace {

SphereFile in_single_precision(SphereFile file) {
    for (LinkSpheres& link : file.links) {
        link.elements = foam::in_single_precision(std::move(link.elements));
    }
    return file;
}

Measures not_measured(const Elements& elements) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return {.spheres = elements.size(),
            .area = unknown,
            .volume = unknown,
            .covered = unknown,
            .gap = unknown,
            .excess = unknown,
            .excess_error = unknown,
            .missing = unknown,
            .missing_error = unknown,
            .exposed_area = unknown,
            .protrusion_max = unknown,
            .protrusion_mean = unknown,
            .excess_volume = unknown,
            .missing_volume = unknown,
            .excess_volume_error = unknown,
            .missing_volume_error = unknown,
            .volume_error = unknown};
}

} // namespace

std::shared_ptr<const Robot> links_alone(const SphereFile& file) {
    auto robot = std::make_shared<Robot>();
    robot->name = file.file.stem().string();
    for (const LinkSpheres& link : file.links) {
        robot->links.push_back({link.link, {}, {}});
    }
    robot->root = robot->links.empty() ? "" : robot->links.front().name;
    return robot;
}

void name_only_link(SphereFile& file, const Original* original) {
    for (LinkSpheres& link : file.links) {
        if (!link.link.empty()) {
            continue;
        }
        if (original && original->links.size() != 1) {
            throw Error(
                ErrorCode::input,
                fmt::format("{}: its spheres name no link, and {} has {} links with collision geometry; remedy: "
                            "a model by link",
                            file.file.string(), original->file.string(), original->links.size()));
        }
        link.link = original ? original->links.front().link : file.file.stem().string();
    }
}

void require_links(const SphereFile& file, const Robot& robot) {
    std::vector<std::string> known;
    for (const Link& link : robot.links) {
        known.push_back(link.name);
    }
    for (const LinkSpheres& link : file.links) {
        if (!robot.find_link(link.link)) {
            const std::string near = nearest_word(link.link, known);
            throw Error(ErrorCode::input, fmt::format("{}: link '{}' is no link of {}{}", file.file.string(),
                                                      shown(link.link), robot.file.filename().string(),
                                                      near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
        }
    }
}

SphereModel sphere_model_of(const SphereFile& file, std::shared_ptr<const Robot> robot) {
    SphereModel model;
    model.name = file.file.stem().string();
    model.guarantee = Guarantee::fitted;
    model.robot = std::move(robot);
    for (const Link& link : model.robot->links) {
        for (const LinkSpheres& spheres : file.links) {
            if (spheres.link == link.name && !spheres.elements.empty()) {
                model.groups.push_back({link.name, {}, flat_tree(spheres.elements), not_measured(spheres.elements)});
            }
        }
    }
    if (model.groups.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: there are no spheres to write", file.file.string()));
    }
    return model;
}

static ProvedLinks verdict_on(const Original& original, const SphereFile& file, bool float32) {
    const MatchedModel model = match(original, file);
    std::vector<LinkProof> proofs = prove(original, model, Guarantee::outer);
    if (float32) {
        const std::vector<LinkProof> rounded =
            prove(original, match(original, in_single_precision(file)), Guarantee::outer);
        for (std::size_t i = 0; i < proofs.size(); ++i) {
            proofs[i] = proofs[i].holds ? rounded[i] : proofs[i];
        }
    }
    ProvedLinks verdict = proved_links(original, model, proofs, Guarantee::outer);
    verdict.float32 = float32;
    return verdict;
}

static LinkSolids solids_of(const SphereModel& model) {
    LinkSolids solids;
    for (const Link& link : model.robot->links) {
        const auto found = model.geometry.find(link.name);
        solids.push_back(found == model.geometry.end() ? nullptr : found->second);
    }
    return solids;
}

std::vector<IgnoredPair> ignored_pairs_of(const SphereModel& model, const std::atomic<bool>* cancel) {
    using Source = CollisionModel::Source;
    CollisionModel elements;
    elements.robot = model.robot;
    elements.solids = solids_of(model);
    elements.elements.resize(model.robot->links.size());
    elements.sources.resize(model.robot->links.size());
    for (std::size_t i = 0; i < model.robot->links.size(); ++i) {
        for (const SphereGroup& group : model.groups) {
            if (group.link == model.robot->links[i].name) {
                elements.elements[i].add(group.tree.elements()); // a link may have several groups
            }
        }
        const Elements& those = elements.elements[i];
        const bool cover = elements.solids[i] && !those.empty() && covers(*elements.solids[i], those);
        elements.sources[i] = cover ? Source::cover : Source::given;
    }
    SelfCollisionOptions options;
    options.cancel = cancel;
    return ignored_pairs(*model.robot, self_collision_matrix(Kinematics(model.robot), elements, options));
}

std::string give_rest_pose(SphereModel& model, const std::vector<GroupState>& named) {
    if (!model.facts.default_pose.empty() || model.robot->joints.empty() || model.geometry.empty()) {
        return "";
    }
    const Kinematics kinematics(model.robot);
    const ReferenceConfiguration reference = reference_configuration(
        kinematics, solids_of(model), {.given = {}, .named = named, .held = model.facts.lock_joints, .seed = 0});
    model.facts.default_pose = moved_joints(kinematics, reference.configuration);
    return reference.source == ReferenceConfiguration::Source::zero ? "" : sentence_about(kinematics, reference);
}

std::vector<std::filesystem::path> files_of(const StageInfo& writer, const std::filesystem::path& target) {
    std::vector<std::filesystem::path> files{target};
    for (const std::string& ending : writer.companions) {
        files.push_back(companion_of(target, ending));
        if (files.back() == target) {
            throw Error(ErrorCode::usage, fmt::format("{} writes other files beside {}, one of them under the same "
                                                      "name; remedy: a file that ends in .{}",
                                                      writer.name, target.string(), writer.extensions.front()));
        }
    }
    return files;
}

std::vector<WrittenFile> written_files(const Writer& writer, const StageInfo& info, SphereModel model,
                                       const std::filesystem::path& target, Context& context) {
    model.folder = target.empty() ? target : std::filesystem::absolute(target).parent_path();
    model.file = target.filename().string();
    require_held(info, model);
    std::vector<WrittenFile> files{{target, writer.write(model, context)}};
    if (model.into) {
        files.front().bytes = with_provenance(std::move(files.front().bytes), model);
    }
    for (const std::string& ending : info.companions) {
        files.push_back({companion_of(target, ending), writer.companion(ending, model, context)});
    }
    for (auto& [name, bytes] : writer.files_beside(model, context)) {
        if (target.empty()) {
            throw Error(ErrorCode::usage,
                        fmt::format("{} writes other files beside the one; remedy: -o FILE", info.name));
        }
        if (!is_within_folder(name)) {
            throw Error(ErrorCode::plugin,
                        fmt::format("{} broke its contract: it writes '{}' beside {}, outside its folder", info.name,
                                    shown(name), target.string()));
        }
        files.push_back({target.parent_path() / name, std::move(bytes), true});
    }
    return files;
}

std::map<std::string, Elements> read_back(const Writer& writer, const std::vector<WrittenFile>& files) {
    std::map<std::string, std::string> beside;
    const std::filesystem::path folder = files.front().file.parent_path();
    for (const WrittenFile& file : files) {
        if (file.beside) {
            beside[file.file.lexically_relative(folder).string()] = file.bytes;
        }
    }
    return writer.read(files.front().bytes, beside);
}

/// Returns whether the spheres are those of the model with radii that are larger by one buffer, or by none.
static bool are_same_up_to_buffer(const std::vector<Sphere>& found, const std::vector<Sphere>& model) {
    return std::equal(found.begin(), found.end(), model.begin(), model.end(), [&](const Sphere& a, const Sphere& b) {
        const double buffer = found.front().radius - model.front().radius;
        return a.center == b.center && std::abs(a.radius - b.radius - buffer) <= 1e-9 * a.radius;
    });
}

/// Returns whether a buffer has made the spheres smaller, or switched some off.
static bool are_smaller(const std::vector<Sphere>& found, const std::vector<Sphere>& model) {
    return !found.empty() && std::all_of(found.begin(), found.end(), [&](const Sphere& a) {
        return std::any_of(model.begin(), model.end(), [&](const Sphere& b) {
            return a.center == b.center && a.radius < b.radius;
        });
    });
}

void require_written(const SphereModel& model, const Writer& writer, const StageInfo& info,
                     const std::vector<WrittenFile>& files) {
    std::map<std::string, Elements> links;
    for (const SphereGroup& group : model.groups) {
        links[group.link].add(group.tree.elements());
    }
    auto read = read_back(writer, files);
    for (const auto& [link, elements] : links) {
        const Elements& found = read[link];
        if (info.consumer.elements_optional && !elements.are_spheres()) {
            continue;
        }
        // A format may have another kind around an element, such as a sphere around a capsule of hardly any length.
        if (elements.are_spheres() ? !found.are_spheres() : found.size() < least_count(elements)) {
            throw Error(ErrorCode::internal,
                        fmt::format("link '{}': the written file gives {}, the model has {}", shown(link),
                                    counts_text(kinds_of(found)), counts_text(kinds_of(elements))));
        }
        if (elements.are_spheres() && are_smaller(found.spheres(), elements.spheres())) {
            throw Error(ErrorCode::output,
                        fmt::format("link '{}': with its buffer, the file's reader takes smaller spheres than the "
                                    "model's; remedy: a buffer that is not negative",
                                    shown(link)));
        }
        if (elements.are_spheres() && !are_same_up_to_buffer(found.spheres(), elements.spheres())) {
            throw Error(ErrorCode::internal,
                        fmt::format("link '{}': the written file gives other spheres than the model", shown(link)));
        }
    }
}

/// Gives the model the verdict and the line that says so. `origin`: the line without it.
static void give_verdict(SphereModel& model, ProvedLinks verdict, const std::string& origin) {
    model.verdict = std::move(verdict);
    for (SphereGroup& group : model.groups) {
        const auto& open = model.verdict.left_out;
        group.measures.certified = std::none_of(
            open.begin(), open.end(), [&](const ProvedLinks::LeftOut& link) { return link.link == group.link; });
    }
    model.guarantee = model.verdict.all() ? Guarantee::outer : Guarantee::fitted;
    model.provenance = origin + "; " + statement_of(model.verdict);
}

/// Returns the elements of the files, by link; nothing where they are those of the given file, or stand in another one.
static std::optional<SphereFile> changed_by_writing(const SphereFile& given, const Writer& writer,
                                                    const StageInfo& info, const std::vector<WrittenFile>& files) {
    SphereFile file;
    file.file = files.front().file;
    bool same = true;
    for (auto& [link, elements] : read_back(writer, files)) {
        const auto before = std::find_if(given.links.begin(), given.links.end(),
                                         [&, &name = link](const LinkSpheres& one) { return one.link == name; });
        same = same && before != given.links.end() && before->elements == elements;
        file.links.push_back({link, std::move(elements)});
    }
    const bool elsewhere = info.consumer.elements_optional &&
                           std::any_of(given.links.begin(), given.links.end(),
                                       [](const LinkSpheres& link) { return !link.elements.are_spheres(); });
    return same || elsewhere ? std::nullopt : std::optional(std::move(file));
}

JudgedFiles judged_files(const Writer& writer, const StageInfo& info, SphereModel model, const Original* original,
                         const SphereFile& given, const std::filesystem::path& target, Context& context) {
    const std::string origin = model.provenance;
    std::string statement = "nothing is proved without the robot's original geometry";
    model.provenance = origin + "; " + statement;
    if (original) {
        give_verdict(model, verdict_on(*original, given, info.consumer.float32), origin);
        statement = statement_of(model.verdict);
    }
    std::vector<WrittenFile> files = written_files(writer, info, model, target, context);
    require_written(model, writer, info, files);
    std::optional<SphereFile> changed = original ? changed_by_writing(given, writer, info, files) : std::nullopt;
    if (!changed) {
        return {std::move(files), std::move(statement)};
    }
    name_only_link(*changed, original);
    ProvedLinks verdict = verdict_on(*original, *changed, info.consumer.float32);
    if (statement_of(verdict) != statement) {
        give_verdict(model, std::move(verdict), origin);
        statement = statement_of(model.verdict);
        QuietContext quiet; // what the writer warns of is reported
        files = written_files(writer, info, model, target, quiet);
    }
    return {std::move(files), std::move(statement)};
}

} // namespace foam::inline judge
