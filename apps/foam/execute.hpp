// Runs: their progress, their summary, what they write.
#pragma once

#include "cli/program.hpp"

#include <foam/judge/written_model.hpp>
#include <foam/runtime/run.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace foam::cli {

/// On stderr: the size of the input first. The bar is drawn on a terminal only; warnings and errors always, notes if
/// `verbose`. `quiet`: warnings and errors alone.
class Progress final : public Observer {
public:
    explicit Progress(bool verbose, bool quiet = false);
    ~Progress() override;
    void on(const Event& event) override;

private:
    void draw(const Event& event);
    void clear();

    bool verbose_, quiet_, terminal_, drawn_ = false;
    double last_drawn_ = -1;
    std::string task_;
};

struct ExecuteOptions {
    std::size_t threads = 0; ///< 0: all cores
    bool fresh = false;
    bool verbose = false;
    bool quiet = false;               ///< only warnings and errors: no size of the input, bar, table or names of files
    bool say_which = true;            ///< of the recipe's candidates is the input
    bool force = false;               ///< replace inputs
    bool report = true;               ///< of the run directory
    std::optional<double> time_limit; ///< s; instead of the recipe's
    std::filesystem::path input_name; ///< see RunOptions
    std::vector<std::filesystem::path> targets; ///< where the result goes beside the run directory
    /// Looks at the manifest before anything is put in place; see RunOptions.
    std::function<void(const std::string& manifest)> accept;
    std::function<void(const Robot& robot)> robot_known; ///< see RunOptions
};

/// `-j`, `--fresh`, `--time-limit`, `-v` and `-q`.
void add_execute_options(CLI::App& command, ExecuteOptions& options);
/// Tells the findings; throws Error(recipe) if there is an error among them.
void require_ok(const RecipeResult& read, const std::string& what);
/// Says which input is taken, runs, and shows the progress.
RunResult execute(const Recipe& recipe, const Registry& registry, const std::filesystem::path& directory,
                  const ExecuteOptions& options);
/// 0; 4 if links were left out after errors; 130 if the user ended the search.
int exit_code_of(const RunResult& result);

/// A table: a line a link, the total, and whether cover is proved.
std::string table_of(const RunResult& result, Guarantee guarantee);

std::vector<std::string> file_names(const std::vector<WrittenFile>& files);
/// Returns the names for people: of many files the first one, and where the others are.
std::string names_text(const std::vector<WrittenFile>& files);

/// Returns the parameters of a writer from texts like "version=0.7". Throws Error(usage) naming the text for an unknown
/// name or another type.
std::map<std::string, ParameterValue> parameters_of(const std::vector<std::string>& texts, const StageInfo& writer);

/// Warns of a length in such a text, without a unit, that is larger than the robot, whose size is `size` in m.
void question_setting(const std::string& text, const StageInfo& writer, double size);

/// Throws Error(usage) unless `force`: for a file that is one of the inputs, by whatever name or link; and for a file
/// beside the first that exists and does not belong to an earlier result of that name. It belongs to one if it names
/// another of the files, or one of them names it.
void refuse_replacing(const std::vector<WrittenFile>& files, const std::vector<std::filesystem::path>& inputs,
                      bool force);

/// Makes the folder of a file that lies beside an output.
void make_folder_of(const WrittenFile& file);

} // namespace foam::cli
