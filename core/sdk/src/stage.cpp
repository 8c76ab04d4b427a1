// Out-of-line destructors and defaults of the classes that plugins derive from: their type information exists only in
// core.
#include <foam/sdk/stage.hpp>

#include <foam/base/error.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/plugin.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

namespace foam::inline sdk {

Stage::Stage() = default;
Stage::~Stage() = default;
MeshLoader::~MeshLoader() = default;
RobotLoader::~RobotLoader() = default;
MeshFilter::~MeshFilter() = default;
SphereSearch::SphereSearch() = default;
SphereSearch::~SphereSearch() = default;
Spherizer::~Spherizer() = default;
Renderer::~Renderer() = default;
Writer::~Writer() = default;
ModelReader::~ModelReader() = default;
Refinement::Refinement() = default;
Refinement::~Refinement() = default;
Refiner::~Refiner() = default;
Enrolment::~Enrolment() = default;
StageMaker::~StageMaker() = default;

namespace {

/// Calls the spherizer anew for each budget.
class OneByOne final : public SphereSearch {
public:
    OneByOne(const Spherizer& spherizer, const Shape& shape) : spherizer_(spherizer), shape_(shape) {}
    std::vector<SphereTree> at_most(std::span<const Budget> budgets, Context& context) override {
        std::vector<SphereTree> trees;
        trees.reserve(budgets.size());
        for (const Budget& budget : budgets) {
            context.check_cancelled();
            trees.push_back(spherizer_.spherize(shape_, budget, context));
        }
        return trees;
    }

private:
    const Spherizer& spherizer_;
    const Shape& shape_;
};

} // namespace

std::unique_ptr<SphereSearch> Spherizer::search(const Shape& shape) const {
    return std::make_unique<OneByOne>(*this, shape);
}

std::map<std::string, std::string> Writer::files_beside(const SphereModel&, Context&) const {
    return {};
}

std::string Writer::companion(const std::string& ending, const SphereModel&, Context&) const {
    throw Error(ErrorCode::internal, fmt::format("the writer names the ending .{}, but writes no such file", ending));
}

std::filesystem::path companion_of(const std::filesystem::path& file, const std::string& ending) {
    return std::filesystem::path(file).replace_extension(ending);
}

/// Returns whether the parameter `engine` of the writer names this program.
static bool is_for(const StageInfo& writer, const Parameters& parameters, const std::string& engine) {
    return std::any_of(writer.parameters.begin(), writer.parameters.end(),
                       [](const Parameter& declared) { return declared.name == "engine"; }) &&
           parameters.text("engine") == engine;
}

bool lists_pairs(const StageInfo& writer, const std::map<std::string, ParameterValue>& given, bool into) {
    const Consumer& consumer = writer.consumer;
    if (!consumer.pairs) {
        return false;
    }
    const Parameters parameters(writer.parameters, given);
    const bool edited =
        into && std::any_of(writer.parameters.begin(), writer.parameters.end(), [](const Parameter& declared) {
            return declared.name == "pairs" && declared.type == Parameter::Type::choice;
        });
    return edited ? pair_edit(parameters) != PairEdit::keep
                  : consumer.pairs_if.empty() || parameters.boolean(consumer.pairs_if) ||
                        is_for(writer, parameters, consumer.pairs_if);
}

SphereFile read_written(const Writer& writer, const std::string& text, const std::filesystem::path& file,
                        std::string format, std::string_view remedy) {
    SphereFile result{.file = file, .format = std::move(format), .links = {}, .fixed_joints = {}, .notes = {}};
    try {
        for (auto& [link, elements] : writer.read(text, {})) {
            result.links.push_back({link, std::move(elements)});
        }
    } catch (const Error& error) {
        throw Error(ErrorCode::input, fmt::format("{}: {}; remedy: {}", file.string(), error.what(), remedy));
    }
    return result;
}

Isolation Isolation::over(const Isolation& base) const {
    Isolation result = *this;
    result.process = process ? process : base.process;
    result.time_limit = time_limit ? time_limit : base.time_limit;
    result.memory_limit = memory_limit ? memory_limit : base.memory_limit;
    return result;
}

const char* to_string(StageKind kind) {
    switch (kind) {
    case StageKind::mesh_loader:
        return "mesh loader";
    case StageKind::robot_loader:
        return "robot loader";
    case StageKind::mesh_filter:
        return "mesh filter";
    case StageKind::spherizer:
        return "spherizer";
    case StageKind::renderer:
        return "renderer";
    case StageKind::writer:
        return "writer";
    case StageKind::model_reader:
        return "model reader";
    case StageKind::refiner:
        return "refiner";
    }
    return "stage";
}

Context::~Context() = default;

void Context::check_cancelled() const {
    if (cancelled()) {
        throw Error(ErrorCode::cancelled, "cancelled");
    }
}

QuietContext::QuietContext(std::uint64_t seed) : seed_(seed) {}
QuietContext::~QuietContext() = default;
std::uint64_t QuietContext::seed() const {
    return seed_;
}
bool QuietContext::cancelled() const {
    return false;
}
void QuietContext::progress(double) {}
void QuietContext::log(Severity, std::string_view) {}
void QuietContext::metric(std::string_view, double, std::string_view) {}

MeshColours::MeshColours() = default;
MeshColours::~MeshColours() = default;

} // namespace foam::inline sdk
