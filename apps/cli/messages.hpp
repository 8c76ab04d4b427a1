// What people read and what stops the program: messages, numbers, interrupts.
#pragma once

#include <foam/base/cancellation.hpp>
#include <foam/runtime/run.hpp>

#include <CLI/CLI.hpp>

#include <atomic>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace foam::cli {

/// The words of `--color`.
enum class Colour { automatic, always, never };

/// Chooses colours. Automatic: on a terminal, unless NO_COLOR is set or TERM is "dumb".
void choose_colours(Colour colour);
/// Shows "stdin" in the place of these names.
void show_as_standard_input(std::vector<std::string> names);

/// Returns the text with "stdin" for the names of show_as_standard_input().
std::string with_names(std::string text);
enum class Stream { out, err };
/// Returns a text for people as the stream shows it: errors and statements that do not hold red, warnings yellow,
/// statements that hold green.
std::string coloured(const std::string& text, Stream stream);

/// Returns the check that a word is a whole number within these bounds.
CLI::Validator whole_number(std::uint64_t least = 0, std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
/// Returns the check that a word is a finite number above, or from, `least`.
CLI::Validator number_above(double least);
CLI::Validator number_from(double least);
/// Returns the check that a word is a number between these two.
CLI::Validator number_between(double below, double above);

/// Returns "; did you mean 'run'?" with the nearest of the known words; empty if none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);
/// Returns "unknown command 'rum'; did you mean 'run'?".
std::string unknown_command(const std::string& word, const std::vector<std::string>& known);

/// From now on SIGINT and SIGTERM set the flag that is returned; a second one ends the program at once. So does the
/// first if the program has not ended 2 s later.
const std::atomic<bool>& stop_on_interrupt();
/// Ends the program as one that the user has cut, if he has: by SIGINT itself, so that a shell's loop ends too, or,
/// after SIGTERM, with 130. Returns `code` otherwise. A later signal ends the program as any other program.
int exit_code_after(int code);

/// Whether one came.
bool interrupted();

/// The same for what works without a run: its loops ask the thread.
class InterruptRequest final : public StopRequest {
public:
    bool asked() const override { return interrupted(); }
};

/// Says what goes on although it was to end, and ends the program: nothing half-written is left.
[[noreturn]] void give_up(const Unresponsive& what);

} // namespace foam::cli
