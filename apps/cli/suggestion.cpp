#include "suggestion.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

namespace foam::cli {

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
    const std::string near = nearest_word(word, known);
    return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

std::string unknown_command(const std::string& word, const std::vector<std::string>& known) {
    return fmt::format("unknown command '{}'{}", word, did_you_mean(word, known));
}

} // namespace foam::cli
