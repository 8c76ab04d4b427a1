#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <array>

namespace foam::xml_models {

std::string numbers_text(std::span<const double> numbers) {
    std::string text;
    for (const double number : numbers) {
        text += (text.empty() ? "" : " ") + number_text(number);
    }
    return text;
}

std::string vector_text(const Vec3& v) {
    return numbers_text(std::array{v.x, v.y, v.z});
}

std::string attribute_text(std::string_view name, std::string_view value) {
    return fmt::format(" {}=\"{}\"", name, attribute_escaped(value));
}

const std::string& required(const xml::Element& element, std::string_view attribute, const std::string& file) {
    const std::string* text = element.attribute(attribute);
    if (!text || text->empty()) {
        throw Error(ErrorCode::input, fmt::format("{}:{}: <{}> has no {}; remedy: add {}=\"…\"", file, element.line,
                                                  element.name, attribute, attribute));
    }
    return *text;
}

std::vector<double> numbers_of(const xml::Element& element, std::string_view attribute, std::size_t count,
                               const std::string& file) {
    std::vector<double> numbers;
    for (const std::string_view word : words(required(element, attribute, file))) {
        const std::optional<double> number = parse_number(word);
        if (!number) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: {} of <{}>: '{}' is not a finite number", file,
                                                      element.line, attribute, element.name, word));
        }
        numbers.push_back(*number);
    }
    if (numbers.empty() || (count > 0 && numbers.size() != count)) {
        throw Error(ErrorCode::input, fmt::format("{}:{}: {} of <{}> holds {} numbers, not {}", file, element.line,
                                                  attribute, element.name, numbers.size(), count));
    }
    return numbers;
}

std::string comment_text(std::string_view text) {
    std::string safe(text);
    for (std::size_t at = 0; (at = safe.find("--", at)) != safe.npos;) {
        safe.replace(at, 2, "- -"); // "--" ends a comment
    }
    return safe.empty() ? "" : "<!-- " + safe + " -->\n";
}

} // namespace foam::xml_models
