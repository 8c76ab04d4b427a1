// Runs of recipes.
#include "robot.hpp"
#include "work.hpp"

#include <foam/base/error.hpp>
#include <foam/batch/batch.hpp>
#include <foam/recipe/quick_recipe.hpp>
#include <foam/runtime/run_json.hpp>
#include <foam/sdk/kinds.hpp>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace foam::python {
namespace {

using Json = nlohmann::ordered_json;

/// Checked recipes.
struct HeldRecipes {
    std::shared_ptr<Registry> registry;
    std::vector<Recipe> recipes;
};

std::string findings_text(const RecipeResult& read, bool errors) {
    std::string text;
    for (const Diagnostic& finding : read.diagnostics) {
        if ((finding.level == Diagnostic::Level::error) == errors) {
            text += (text.empty() ? "" : "\n") + finding.text();
        }
    }
    return text;
}

std::shared_ptr<HeldRecipes> read_recipes(std::shared_ptr<Registry> registry,
                                          const std::optional<std::filesystem::path>& file, const std::string& text,
                                          const std::string& name, const std::vector<Setting>& settings,
                                          const std::vector<std::string>& variants) {
    return worked([&](const Signals&) {
        RecipeResult read = file ? read_recipe(*file, *registry, settings, variants)
                                 : parse_recipe(text, name, *registry, settings, variants);
        if (!read.ok()) {
            throw Error(ErrorCode::recipe, findings_text(read, true));
        }
        auto held = std::make_shared<HeldRecipes>();
        held->registry = std::move(registry);
        held->recipes = std::move(read.recipes);
        return held;
    });
}

const char* word_of_kind(Event::Kind kind) {
    constexpr const char* words[] = {"run_started", "input_loaded", "task_started", "task_finished",
                                     "progress",    "finding",      "run_finished"};
    return words[static_cast<std::size_t>(kind)];
}

/// Hands the events on to Python; where there are none for a while, how far the run is.
class Teller {
public:
    Teller(Events& events, const py::object& progress) : events_(events), progress_(progress) {}

    void operator()() {
        for (const Event& event : events_.take()) {
            tell(word_of_kind(event.kind), event);
            done_ = event.done;
            ended_ = event.kind == Event::Kind::run_finished;
        }
        if (!ended_ && pulse_.due()) {
            Event event;
            event.done = done_;
            event.seconds = pulse_.seconds();
            tell(word_of_kind(Event::Kind::progress), event);
        }
    }

private:
    void tell(const char* kind, const Event& event) {
        if (!progress_.is_none()) {
            progress_(kind, event.link, event.stage, event.done, event.seconds, event.seconds_left, event.message,
                      word_of(event.severity), event.cached);
        }
        pulse_.called();
    }

    Events& events_;
    const py::object& progress_;
    Pulse pulse_;
    double done_ = 0;
    bool ended_ = false;
};

/// `robot`: what the run works on in place of the recipe's input; null: that.
py::tuple ran(const HeldRecipes& held, std::size_t index, const std::optional<std::filesystem::path>& out, bool fresh,
              std::optional<double> time_limit, const std::filesystem::path& program,
              const std::optional<std::filesystem::path>& cache, const py::object& progress, const HeldRobot* robot) {
    const Recipe& recipe = held.recipes.at(index);
    Events events;
    RunOptions options;
    options.out = out.value_or("");
    options.fresh = fresh;
    options.time_limit = time_limit;
    options.program = program;
    options.cache = cache.value_or("");
    options.observer = &events;
    options.input = robot ? robot->original.loaded : nullptr;
    RunResult result;
    Teller teller(events, progress);
    work_aside(
        [&](const std::atomic<bool>& cancel) {
            options.cancel = &cancel;
            result = run(recipe, *held.registry, options);
        },
        std::ref(teller));
    auto model = std::make_shared<HeldModel>();
    model->registry = held.registry;
    model->of_run = true;
    std::string json = json_text(json_of_run<Json>(result, recipe, out.value_or("")));
    model->model = std::move(result.model);
    return py::make_tuple(json, model);
}

/// `kinds`: nothing for spheres alone, as `foam spherize`; else as `foam approximate`.
py::tuple quick(const std::filesystem::path& input, const std::string& method,
                const std::optional<std::vector<std::string>>& kinds, std::optional<std::size_t> count,
                std::optional<double> excess, std::optional<double> max_protrusion, std::optional<double> cost,
                const std::map<std::string, double>& costs, const std::string& objective,
                const std::optional<std::string>& unit, double scale, const std::string& geometry,
                const Registry& registry) {
    const QuickMethod by = kinds ? QuickMethod(method, kinds_named(*kinds, "kinds"), objective) : QuickMethod(method);
    const std::optional<QuickLength> protrusion =
        max_protrusion ? std::optional<QuickLength>(*max_protrusion) : std::nullopt;
    const QuickBudget budget{count, excess, protrusion, cost, costs};
    const QuickRecipe made = quick_recipe(input, by, is_mesh(input, registry) ? "json" : "urdf", budget,
                                          {.unit = unit, .scale = scale}, geometry, registry);
    return py::make_tuple(made.name, made.text, made.left_out, made.stage);
}

} // namespace

void add_runs(py::module_& module) {
    py::class_<HeldModel, std::shared_ptr<HeldModel>>(module, "Model").def("spheres", [](const HeldModel& held) {
        return std::make_shared<SphereFile>(file_of_model(held.model));
    });
    py::class_<HeldRecipes, std::shared_ptr<HeldRecipes>>(module, "Recipes")
        .def(py::init(&read_recipes), py::arg("registry"), py::arg("file"), py::arg("text"), py::arg("name"),
             py::arg("settings"), py::arg("variants"))
        .def("names",
             [](const HeldRecipes& held) {
                 std::vector<std::string> names;
                 for (const Recipe& recipe : held.recipes) {
                     names.push_back(recipe.name);
                 }
                 return names;
             })
        .def("run", &ran, py::arg("index"), py::arg("out"), py::arg("fresh"), py::arg("time_limit"), py::arg("program"),
             py::arg("cache"), py::arg("progress"), py::arg("robot").none(true));
    module.def(
        "collect_batch",
        [](const std::filesystem::path& folder, const std::filesystem::path& table) {
            worked([&](const Signals&) { return collect_batch(folder, table, {}).lines; });
        },
        py::arg("folder"), py::arg("table"));
    module.def(
        "read_batch_table",
        [](const std::filesystem::path& table) {
            std::string text;
            worked([&](const Signals&) { return (text = read_batch_table(table)).size(); });
            return py::bytes(text);
        },
        py::arg("table"));
    module.def("quick_recipe", &quick, py::arg("input"), py::arg("method"), py::arg("kinds"), py::arg("count"),
               py::arg("excess"), py::arg("max_protrusion"), py::arg("cost"), py::arg("costs"), py::arg("objective"),
               py::arg("unit"), py::arg("scale"), py::arg("geometry"), py::arg("registry"));
}

} // namespace foam::python
