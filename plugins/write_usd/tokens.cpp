#include "layer.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::usd {
namespace {

constexpr std::string_view signs = "()[]{}=,;";
constexpr std::string_view ends_of_word = "()[]{}=,;\"'@<# \t\r\n";

bool is_octal(std::string_view text, std::size_t i) {
    return i < text.size() && text[i] >= '0' && text[i] <= '7';
}

} // namespace

Tokens::Tokens(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {
    rest_.remove_prefix(rest_.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    advance();
}

void Tokens::fail(const std::string& why) const {
    throw Error(ErrorCode::input, fmt::format("{}:{}: {}", file_, now_.line, shown(why)));
}

Token Tokens::take() {
    Token token = std::move(now_);
    advance();
    return token;
}

void Tokens::skip_group() {
    std::size_t depth = 0;
    do {
        if (now_.kind == Token::Kind::end) {
            fail("the file ends within brackets");
        }
        depth += now_.opens() ? 1 : 0;
        depth -= now_.closes() ? 1 : 0;
        advance();
    } while (depth > 0);
}

void Tokens::skip_blanks() {
    for (;;) {
        const std::size_t blanks = std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size());
        line_ += static_cast<int>(std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(blanks), '\n'));
        rest_.remove_prefix(blanks);
        if (!rest_.starts_with('#')) {
            return;
        }
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
    }
}

void Tokens::advance() {
    skip_blanks();
    now_ = {.kind = Token::Kind::end, .value = "", .line = line_};
    if (rest_.empty()) {
        return;
    }
    const char c = rest_.front();
    if (c == '"' || c == '\'') {
        now_ = {Token::Kind::text, quoted(), now_.line};
    } else if (c == '@' || c == '<') {
        const std::string_view fence = c == '<' ? ">" : rest_.starts_with("@@@") ? "@@@" : "@";
        rest_.remove_prefix(fence.size());
        now_ = {Token::Kind::reference, std::string(until(fence, "reference")), now_.line};
    } else if (signs.find(c) != signs.npos) {
        now_ = {Token::Kind::sign, std::string(1, c), now_.line};
        rest_.remove_prefix(1);
    } else {
        const std::string_view word = rest_.substr(0, rest_.find_first_of(ends_of_word));
        now_ = {Token::Kind::word, std::string(word), now_.line};
        rest_.remove_prefix(word.size());
    }
}

std::string_view Tokens::until(std::string_view end, const std::string& what) {
    const std::size_t size = rest_.find(end);
    if (size == rest_.npos) {
        fail("a " + what + " does not end");
    }
    const std::string_view result = rest_.substr(0, size);
    line_ += static_cast<int>(std::count(result.begin(), result.end(), '\n'));
    rest_.remove_prefix(size + end.size());
    return result;
}

std::string Tokens::quoted() {
    const bool many_lines = rest_.starts_with("\"\"\"") || rest_.starts_with("'''");
    const std::string_view quote = rest_.substr(0, many_lines ? 3 : 1);
    rest_.remove_prefix(quote.size());
    std::string result;
    while (!rest_.starts_with(quote)) {
        if (rest_.empty() || (rest_.front() == '\n' && !many_lines)) {
            fail("a text in quotes does not end");
        }
        line_ += rest_.front() == '\n' ? 1 : 0;
        const char c = rest_.front();
        rest_.remove_prefix(1);
        result += c == '\\' ? escaped() : c;
    }
    rest_.remove_prefix(quote.size());
    return result;
}

char Tokens::escaped() {
    if (rest_.empty()) {
        fail("a text in quotes does not end");
    }
    if (is_octal(rest_, 0)) {
        unsigned value = 0;
        for (int digits = 0; digits < 3 && is_octal(rest_, 0); ++digits) {
            value = value * 8 + static_cast<unsigned>(rest_.front() - '0');
            rest_.remove_prefix(1);
        }
        return static_cast<char>(value & 0xFFU);
    }
    const char c = rest_.front();
    rest_.remove_prefix(1);
    line_ += c == '\n' ? 1 : 0;
    return c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c;
}

} // namespace foam::usd
