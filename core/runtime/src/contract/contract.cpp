#include "promises.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>

namespace foam::inline runtime {
namespace {

/// Checks what the registry accepts, but readers of `foam describe` need.
void check_declaration(const StageInfo& info) {
    for (const Parameter& p : info.parameters) {
        const bool numeric = p.type == Parameter::Type::number || p.type == Parameter::Type::integer;
        require(p.type != Parameter::Type::number || !p.unit_text.empty(),
                fmt::format("parameter '{}' has no unit; remedy: .unit(\"m\"), or .unit(\"1\") for a ratio", p.name));
        require(!numeric || p.low || p.high,
                fmt::format("parameter '{}' has no bounds; remedy: .bounds(low, high) or .at_least(low)", p.name));
    }
}

/// Returns values at the bounds of a declaration.
std::vector<ParameterValue> extremes(const Parameter& p) {
    std::vector<ParameterValue> values;
    switch (p.type) {
    case Parameter::Type::boolean:
        return {false, true};
    case Parameter::Type::choice:
        return {p.choices.begin(), p.choices.end()};
    case Parameter::Type::text:
        return {p.default_value};
    case Parameter::Type::integer:
    case Parameter::Type::number:
        for (const std::optional<double>& end : {p.low, p.high}) {
            if (end) {
                p.type == Parameter::Type::integer ? values.emplace_back(static_cast<std::int64_t>(*end))
                                                   : values.emplace_back(*end);
            }
        }
    }
    return values;
}

/// A maker for stages that must work without other stages.
class NoOtherStages final : public StageMaker {
    std::unique_ptr<Stage> make_stage(std::string_view, StageKind,
                                      const std::map<std::string, ParameterValue>&) const override {
        return nullptr;
    }
};

void check_construction(const RegisteredStage& stage) {
    for (const Parameter& p : stage.info.parameters) {
        for (const ParameterValue& value : extremes(p)) {
            try {
                stage.factory(Parameters(stage.info.parameters, {{p.name, value}}), NoOtherStages());
            } catch (const std::exception& error) {
                throw Breach(
                    fmt::format("{}: {} is allowed by the declaration, but the constructor throws: {}; remedy: "
                                "declare narrower bounds",
                                p.name, to_text(value), error.what()));
            }
        }
    }
}

} // namespace

void Promises::check(const std::string& promise, const std::function<void()>& look) {
    if (options_.on_promise) {
        options_.on_promise(stage_, promise);
    }
    std::string message;
    try {
        look();
        return;
    } catch (const std::exception& error) {
        message = error.what();
    } catch (...) {
        message = "it threw an object that is not a std::exception; remedy: throw foam::Error";
    }
    findings.push_back({stage_, promise, message});
}

void require_stop(const std::function<void(Context&)>& call) {
    Stopped stopped;
    try {
        call(stopped);
    } catch (const Error& error) {
        require(error.code() == ErrorCode::cancelled,
                fmt::format("it threw another error when the user had asked to stop: {}", error.what()));
        return;
    }
    throw Breach("it went on after the user had asked to stop; remedy: call context.check_cancelled() in its loops");
}

void with_threads(std::size_t threads, const std::function<void()>& call) {
    const ThreadLimit limit(threads);
    call();
}

std::vector<ContractFinding> check_contract(const RegisteredStage& stage, const Registry& registry,
                                            const ContractOptions& options) {
    const std::string& name = stage.info.name;
    Promises promises(name, options);
    const auto found = options.parameters.find(name);
    const auto given = found == options.parameters.end() ? std::map<std::string, ParameterValue>{} : found->second;
    promises.check("declares its parameters well", [&] { check_declaration(stage.info); });
    promises.check("takes every value that it declares", [&] { check_construction(stage); });
    try {
        switch (stage.kind) {
        case StageKind::spherizer:
            check_spherizer(*registry.make<Spherizer>(name, given), stage.info, promises);
            check_objectives(stage, registry, promises);
            break;
        case StageKind::mesh_filter:
            check_mesh_filter(*registry.make<MeshFilter>(name, given), promises);
            break;
        case StageKind::mesh_loader:
            check_mesh_loader(*registry.make<MeshLoader>(name, given), stage.info, options, promises);
            break;
        case StageKind::writer:
            check_writer(*registry.make<Writer>(name, given), stage.info, promises);
            break;
        case StageKind::model_reader:
            check_model_reader(*registry.make<ModelReader>(name, given), options, promises);
            break;
        case StageKind::refiner:
            check_refiner(*registry.make<Refiner>(name, given), promises);
            break;
        case StageKind::robot_loader:
        case StageKind::renderer: // their results cannot be checked without knowledge of the method
            break;
        }
    } catch (const Error& error) {
        promises.findings.push_back({name, "can be made", error.what()});
    }
    return promises.findings;
}

} // namespace foam::runtime
