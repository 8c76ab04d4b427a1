// The words and signs of a layer of USD.
#pragma once

#include <string>
#include <string_view>

namespace foam::usd {

struct Token {
    enum class Kind { end, word, text, reference, sign }; ///< word: also numbers; reference: @…@ and <…>
    Kind kind = Kind::end;
    std::string value; ///< of a text: without quotes and escapes
    int line = 0;      ///< 1-based

    bool is(char sign) const { return kind == Kind::sign && value[0] == sign; }
    bool opens() const { return is('(') || is('[') || is('{'); }
    bool closes() const { return is(')') || is(']') || is('}'); }
};

/// Returns the tokens of a text one after the other, without comments.
class Tokens {
public:
    Tokens(std::string_view text, std::string file);

    /// Returns the token at the current place; does not move.
    const Token& now() const { return now_; }
    /// Returns the current token and moves to the next.
    Token take();
    /// Moves behind the sign that closes the current opening one.
    void skip_group();
    /// Throws Error(input) with the place of the current token.
    [[noreturn]] void fail(const std::string& why) const;

private:
    void skip_blanks();
    void advance();
    std::string quoted();
    char escaped();
    std::string_view until(std::string_view end, const std::string& what);

    std::string_view rest_;
    std::string file_;
    int line_ = 1;
    Token now_;
};

} // namespace foam::usd
