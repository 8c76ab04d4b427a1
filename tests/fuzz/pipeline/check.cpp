#include "check.hpp"

#include "figures.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/recipe/internal/glob.hpp>
#include <foam/runtime/run.hpp>

#include <judge/judge.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

namespace foam::fuzz {
namespace {

namespace fs = std::filesystem;

double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::set<std::string> listing(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.insert(entry.path().filename().string());
    }
    return names;
}

/// Words that no message for people has.
std::string odd_word(const std::string& message) {
    for (const char* word : {"std::", "bad_alloc", "internal error", "broke its contract", "a bug in foam",
                             "vector::", "basic_string", "Assertion", "unordered_map", "bad_variant", "bad optional"}) {
        if (message.find(word) != std::string::npos) {
            return word;
        }
    }
    const auto steers = [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7F; };
    return std::any_of(message.begin(), message.end(), steers) ? "a control character" : "";
}

class Check {
public:
    Check(const Case& made, Registry& registry, const fs::path& folder)
        : case_(made), registry_(registry), folder_(folder), limit_(made.threads) {}

    Outcome outcome() {
        const double begin = cpu_seconds();
        write_case(case_, folder_);
        if (read()) {
            before_ = listing(folder_);
            attempt();
        }
        outcome_.seconds = cpu_seconds() - begin;
        return std::move(outcome_);
    }

private:
    void find(const std::string& what) { outcome_.findings.push_back(what); }

    bool read() {
        const RecipeResult result = parse_recipe(case_.files.at("recipe.yaml"), folder_ / "recipe.yaml", registry_);
        for (const Diagnostic& diagnostic : result.diagnostics) {
            find("recipe: " + diagnostic.code + ": " + diagnostic.message);
        }
        if (result.ok()) {
            recipe_ = result.recipes.at(0);
            outcome_.spherizer = recipe_->spherizer.stage;
        }
        return result.ok();
    }

    RunOptions options(const std::string& out, std::size_t threads) const {
        RunOptions options;
        options.out = folder_ / out;
        options.fresh = !case_.cached;
        options.cache = folder_ / "cache";
        options.threads = threads;
        return options;
    }

    void attempt() {
        const double begin = cpu_seconds();
        try {
            result_ = run(*recipe_, registry_, options("out", case_.threads));
        } catch (const Error& error) {
            refused(error);
        } catch (const std::exception& error) {
            find(std::string("no foam::Error: ") + error.what());
        }
        const double limit = recipe_->budget_time_limit.value_or(1e9);
        if (cpu_seconds() - begin > 1.1 * limit + 0.5) {
            find("time: limit of " + std::to_string(limit) + " s took " + std::to_string(cpu_seconds() - begin) +
                 " s of CPU");
        }
        if (result_) {
            judge_result();
        }
    }

    void refused(const Error& error) {
        const std::string message = error.what(), odd = odd_word(message);
        outcome_.end = std::string("refused: ") + to_string(error.code()) + ": " + message;
        // Code recipe: a budget that only the geometry shows to be impossible.
        const bool proper = error.code() == ErrorCode::input || error.code() == ErrorCode::geometry ||
                            error.code() == ErrorCode::recipe ||
                            (error.code() == ErrorCode::cancelled && recipe_->budget_time_limit);
        if (!proper) {
            find(std::string("error of code ") + to_string(error.code()) + ": " + message);
        } else if (!odd.empty()) {
            find("message with " + odd + ": " + message);
        } else if (message.size() < 12) {
            find("message that says nothing: '" + message + "'");
        }
        std::set<std::string> after = listing(folder_);
        after.erase("cache");
        if (after != before_) {
            find("a refused run left files behind");
        }
    }

    void judge_result() {
        outcome_.end = recipe_->guarantee == Guarantee::fitted ? "fitted" : "proved";
        std::set<std::string> expected = before_, after = listing(folder_);
        expected.insert("out");
        after.erase("cache");
        if (after != expected) {
            find("a run left more than its directory behind");
        }
        for (const std::string& odd : odd_figures(*result_, *recipe_)) {
            find(odd);
        }
        for (const fs::path& file : result_->files) {
            std::error_code error;
            if (fs::file_size(folder_ / "out" / file, error) == 0 || error) {
                find("written file '" + file.string() + "' is empty or not there");
            }
        }
        try {
            judge_files();
        } catch (const std::exception& error) {
            find(std::string("reading back: ") + error.what());
        }
        if (case_.again && result_->cut == Cut::none) {
            run_again();
        }
    }

    /// Links without spheres of their own: left out by the recipe, or lost.
    std::set<std::string> left_out() const {
        std::set<std::string> names;
        for (const LinkReport& link : result_->links) {
            const bool has = std::any_of(result_->model.groups.begin(), result_->model.groups.end(),
                                         [&](const SphereGroup& group) { return group.link == link.link; });
            if (link.skipped || (!link.error.empty() && !has)) {
                names.insert(link.link);
            }
        }
        return names;
    }

    /// A link that was lost may be one that cannot be read.
    std::vector<std::string> globs_of_the_rest() const {
        std::vector<std::string> globs;
        const std::set<std::string> without = left_out();
        for (const SphereGroup& group : result_->model.groups) {
            globs.push_back(glob_of_name(group.link));
        }
        return without.empty() ? std::vector<std::string>{} : globs;
    }

    void judge_files() {
        const Original original = load_original(folder_ / case_.input, registry_, {.links = globs_of_the_rest()});
        for (const std::string& odd : excess_findings(original, *result_, *recipe_)) {
            find(odd);
        }
        for (const OutputCall& output : recipe_->outputs) {
            const fs::path file = folder_ / "out" / output.file;
            certify(original, file, output.writer);
            if (output.file.starts_with("case.")) {
                ask_the_judge(file);
            }
        }
    }

    /// A link that is left out keeps its geometry, however odd, and a reader may refuse that.
    static bool names_any(const std::string& error, const std::set<std::string>& links) {
        return std::any_of(links.begin(), links.end(), [&](const std::string& link) {
            return error.find("of link '" + link + "'") != std::string::npos;
        });
    }

    /// By foam's own hand, from the file.
    void certify(const Original& original, const fs::path& file, const StageCall& writer) {
        const auto form = writer.given.find("form");
        if (recipe_->guarantee == Guarantee::fitted ||
            (form != writer.given.end() && to_text(form->second) == "surface")) {
            return;
        }
        const std::set<std::string> without = left_out();
        std::optional<SphereFile> read;
        try {
            read = read_sphere_file(file, registry_);
        } catch (const Error& error) {
            if (names_any(error.what(), without)) {
                return;
            }
            throw;
        }
        const MatchedModel model = match(original, *read);
        const std::vector<LinkProof> proofs = prove(original, model, recipe_->guarantee);
        for (std::size_t i = 0; i < proofs.size(); ++i) {
            if (!proofs[i].holds && !without.contains(original.links[i].link)) {
                find("proved by the run, not by certify: " + file.filename().string() + ", link '" +
                     original.links[i].link + "', " + text_of_number(proofs[i].growth) + " m");
            }
        }
    }

    void ask_the_judge(const fs::path& file) {
        const fs::path input = folder_ / case_.input;
        if (recipe_->guarantee == Guarantee::fitted || !judged_formats()) {
            return;
        }
        const std::set<std::string> without = left_out();
        const auto spheres = ::judge::read_spheres(file, without);
        for (const ::judge::Link& link : ::judge::read_original(input)) {
            if (without.contains(link.name)) {
                continue;
            }
            const auto found = case_.robot ? spheres.find(link.name) : spheres.begin();
            if (found == spheres.end()) {
                find("judge: link '" + link.name + "' has no spheres");
                continue;
            }
            const bool inner = recipe_->guarantee == Guarantee::inner;
            const auto objection = !inner                 ? ::judge::outside_of_balls(link, found->second)
                                   : ::judge::plain(link) ? ::judge::outside_of_solid(link, found->second)
                                                          : std::nullopt;
            if (objection) {
                find("FALSE PROOF: link '" + link.name + "', off by " +
                     text_of_number(static_cast<double>(objection->distance)) + " m");
            }
        }
    }

    bool judged_formats() const {
        return std::none_of(case_.files.begin(), case_.files.end(), [](const auto& file) {
            return file.first.ends_with(".off") || file.first.ends_with(".ply");
        });
    }

    void run_again() {
        try {
            const RunResult again = run(*recipe_, registry_, options("again", 3 - case_.threads));
            for (const OutputCall& output : recipe_->outputs) {
                if (bytes_of(folder_ / "out" / output.file) != bytes_of(folder_ / "again" / output.file)) {
                    find("other bytes of " + output.file + " on another number of threads");
                }
            }
        } catch (const std::exception& error) {
            find(std::string("the second run failed: ") + error.what());
        }
    }

    const Case& case_;
    Registry& registry_;
    fs::path folder_;
    ThreadLimit limit_;
    std::set<std::string> before_;
    std::optional<Recipe> recipe_;
    std::optional<RunResult> result_;
    Outcome outcome_;
};

} // namespace

Outcome run_case(const Case& made, Registry& registry, const fs::path& folder) {
    return Check(made, registry, folder).outcome();
}

} // namespace foam::fuzz
