// Layers of USD as text (.usda) that put spheres and other elements over the links of another layer.
#pragma once

#include <foam/sdk/elements.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace foam::usd {

/// Returns whether a prim can have that name: letters, digits and '_', no digit at the beginning.
bool is_identifier(std::string_view name);
/// Returns the name with '_' in place of what an identifier cannot hold, as TfMakeValidIdentifier() and importers do.
std::string identifier(std::string_view name);

/// Names of prims for links: the links' own where these are identifiers, else similar ones; no two are equal.
std::map<std::string, std::string> prim_names(const std::vector<std::string>& links);

/// A pattern of prim paths such as "/World/{robot}/{link}".
class PathPattern {
public:
    /// Throws Error(output) naming the pattern, for what gives no paths or not one for each link.
    PathPattern(const std::string& pattern, const std::string& robot, bool many_links);

    /// Returns "/World/panda/link0". `prim_name`: of prim_names().
    std::string path(const std::string& prim_name) const;

private:
    std::vector<std::string> parts_; ///< some with {link}
};

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

/// Where importers put links. A robot that was read from USD has its own paths.
constexpr const char* usual_prim = "/{robot}/{link}";

/// Parameters of write.usd.
struct LayerOptions {
    std::string prim = usual_prim; ///< path of a link's prim
    std::string sublayer;          ///< layer below this one; empty: that of a robot that was read from USD, or none
    std::string inactive;          ///< child of each link's prim that is switched off; empty: none
    bool pairs = true;             ///< write pairs of links that need no check
    KnownKinds known{};
};

/// Returns the layer of a model. Throws Error(output) for options that no layer can hold.
std::string layer_text(const SphereModel& model, const LayerOptions& options);

/// Returns whether a text is a layer; its first line is a comment, and may be missing.
bool is_layer(std::string_view text);
/// Returns the elements of a layer of layer_text(), by link. Throws Error(input) naming file, line and reason.
SphereFile read_layer(std::string_view text, const std::filesystem::path& file);

} // namespace foam::usd
