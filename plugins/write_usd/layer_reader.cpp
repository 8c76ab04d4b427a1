// Reads the spheres of layers that layer_text() wrote. Other statements of USD are skipped, so that an edited layer can
// be read; transforms of other prims are not followed.
#include "layer.hpp"
#include "tokens.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <array>
#include <optional>

namespace foam::usd {
namespace {

/// A prim that is being read.
struct Prim {
    std::string type, name;
    std::optional<std::string> link; ///< foam:link, of this prim or one above
    std::optional<double> radius;
    Vec3 center;
    bool transformed = false; ///< by more than a translation
};

class LayerReader {
public:
    LayerReader(std::string_view text, const std::filesystem::path& file)
        : tokens_(text, file.string()), result_{.file = file,
                                                .format = "USD layer",
                                                .links = {},
                                                .fixed_joints = {},
                                                .notes = {}} {}

    SphereFile read() {
        if (tokens_.now().is('(')) {
            tokens_.skip_group(); // metadata of the layer
        }
        while (tokens_.now().kind != Token::Kind::end) {
            statement();
        }
        if (!prims_.empty()) {
            tokens_.fail(fmt::format("the file ends within the prim '{}'", prims_.back().name));
        }
        if (result_.links.empty()) {
            throw Error(ErrorCode::input,
                        fmt::format("{}: no prim has spheres and the attribute foam:link; remedy: only layers of "
                                    "write.usd are read, write this one again",
                                    result_.file.string()));
        }
        if (strangers_ > 0) {
            result_.notes.push_back(fmt::format("{} sphere{} outside of prims with foam:link {} left out", strangers_,
                                                strangers_ == 1 ? "" : "s", strangers_ == 1 ? "is" : "are"));
        }
        return std::move(result_);
    }

private:
    void statement() {
        const Token& now = tokens_.now();
        if (now.is('}') && !prims_.empty()) {
            end_prim();
            tokens_.take();
        } else if (now.is('(')) {
            tokens_.skip_group(); // metadata of the attribute before
        } else if (now.is(';')) {
            tokens_.take();
        } else if (now.kind != Token::Kind::word) {
            tokens_.fail(fmt::format("expected a prim or an attribute, got '{}'", now.value));
        } else if (now.value == "def" || now.value == "over" || now.value == "class") {
            begin_prim();
        } else {
            property();
        }
    }

    void begin_prim() {
        tokens_.take();
        Prim prim;
        if (tokens_.now().kind == Token::Kind::word) {
            prim.type = tokens_.take().value;
        }
        if (tokens_.now().kind != Token::Kind::text) {
            tokens_.fail("expected the name of a prim in quotes");
        }
        prim.name = tokens_.take().value;
        if (tokens_.now().is('(')) {
            tokens_.skip_group();
        }
        if (!tokens_.now().is('{')) {
            tokens_.fail(fmt::format("expected '{{' after the name of the prim '{}'", prim.name));
        }
        tokens_.take();
        prim.link = prims_.empty() ? std::nullopt : prims_.back().link;
        prims_.push_back(std::move(prim));
    }

    void end_prim() {
        const Prim prim = std::move(prims_.back());
        prims_.pop_back();
        if (prim.type != "Sphere") {
            return;
        }
        if (!prim.link) {
            ++strangers_;
            return;
        }
        if (!prim.radius || prim.transformed) {
            tokens_.fail(fmt::format("the sphere '{}' {}; remedy: write the layer again with write.usd", prim.name,
                                     prim.radius ? "is turned or scaled" : "has no radius"));
        }
        if (result_.links.empty() || result_.links.back().link != *prim.link) { // nearly always the same link
            spheres_of(result_, *prim.link).push_back({prim.center, *prim.radius});
        } else {
            result_.links.back().spheres.push_back({prim.center, *prim.radius});
        }
    }

    /// Reads `[custom] [uniform] TYPE NAME [= VALUE]`, all but the value on one line.
    void property() {
        const int line = tokens_.now().line;
        std::string name;
        while (tokens_.now().line == line && !tokens_.now().is('=') && !tokens_.now().is('}') &&
               tokens_.now().kind != Token::Kind::end) {
            if (tokens_.now().is('(')) {
                return; // metadata of an attribute without a value
            }
            const Token token = tokens_.take();
            name = token.kind == Token::Kind::word ? token.value : name;
            if (token.is(';')) {
                return;
            }
        }
        if (tokens_.now().is('=') && tokens_.now().line == line) {
            tokens_.take();
            value(name);
        }
    }

    void value(const std::string& name) {
        Prim outermost; // properties outside of prims mean nothing
        Prim& prim = prims_.empty() ? outermost : prims_.back();
        const bool sphere = prim.type == "Sphere";
        if (name == "foam:link" && tokens_.now().kind == Token::Kind::text) {
            prim.link = tokens_.take().value;
        } else if (sphere && name == "radius") {
            prim.radius = number();
        } else if (sphere && name == "xformOp:translate") {
            prim.center = point();
        } else {
            prim.transformed = prim.transformed || name.starts_with("xformOp:");
            tokens_.now().opens() ? tokens_.skip_group() : skip_value();
        }
    }

    void skip_value() {
        if (tokens_.now().kind == Token::Kind::end || tokens_.now().closes()) {
            tokens_.fail("a value is missing after '='");
        }
        tokens_.take();
    }

    double number() {
        const std::optional<double> value =
            tokens_.now().kind == Token::Kind::word ? parse_number(tokens_.now().value) : std::nullopt;
        if (!value) {
            tokens_.fail(fmt::format("expected a finite number, got '{}'", tokens_.now().value));
        }
        tokens_.take();
        return *value;
    }

    Vec3 point() {
        std::array<double, 3> values{};
        const auto expect = [&](char sign) {
            if (!tokens_.now().is(sign)) {
                tokens_.fail(fmt::format("expected '{}' of three numbers, got '{}'", sign, tokens_.now().value));
            }
            tokens_.take();
        };
        for (std::size_t i = 0; i < 3; ++i) {
            expect(i == 0 ? '(' : ',');
            values[i] = number();
        }
        expect(')');
        return {values[0], values[1], values[2]};
    }

    Tokens tokens_;
    SphereFile result_;
    std::vector<Prim> prims_;
    std::size_t strangers_ = 0;
};

} // namespace

bool is_layer(std::string_view text) {
    if (text.starts_with("#usda ")) {
        return true;
    }
    return (text.starts_with('(') || text.starts_with("def ") || text.starts_with("over ")) &&
           (text.find("def Sphere \"") != text.npos || text.find("foam:link") != text.npos);
}

SphereFile read_layer(std::string_view text, const std::filesystem::path& file) {
    return LayerReader(text, file).read();
}

} // namespace foam::usd
