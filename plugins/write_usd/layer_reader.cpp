// Reads the spheres of layers that layer_text() wrote. Other statements of USD are skipped, so that an edited layer can
// be read; transforms of other prims are not followed.
#include "layer.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/vector.hpp>

#include <fmt/format.h>

#include <array>
#include <optional>

namespace foam::usd {
namespace {

/// A prim that is being read.
struct Prim {
    std::string type, name;
    std::optional<std::string> link; ///< foam:link, of this prim or one above
    std::optional<double> radius, height, size;
    std::string axis = "Z";
    Vec3 center, scale{1, 1, 1};
    std::array<double, 4> orient{1, 0, 0, 0}; ///< w, x, y, z
    std::vector<Vec3> points;
    bool transformed = false; ///< by more than a translation, a quaternion and a scale
};

/// Returns the kind of element that a type of prim is.
std::optional<Element::Kind> kind_of(std::string_view type) {
    using Kind = Element::Kind;
    for (const auto& [name, kind] : {std::pair("Sphere", Kind::sphere),
                                     {"Capsule", Kind::capsule},
                                     {"Cylinder", Kind::cylinder},
                                     {"Cube", Kind::box},
                                     {"Mesh", Kind::hull}}) {
        if (type == name) {
            return kind;
        }
    }
    return {};
}

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
                        fmt::format("{}: no prim has elements and the attribute foam:link; remedy: only layers of "
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
        const std::optional<Element::Kind> kind = kind_of(prim.type);
        if (!kind || (*kind != Element::Kind::sphere && !prim.link)) {
            return; // a robot's own pictures
        }
        if (!prim.link) {
            ++strangers_;
            return;
        }
        const Element element = element_of(prim, *kind);
        LinkSpheres& link = result_.links.empty() || result_.links.back().link != *prim.link
                                ? link_of(result_, *prim.link)
                                : result_.links.back(); // nearly always the same link
        link.elements.add(element);
    }

    [[noreturn]] void refuse(const Prim& prim, const std::string& why) const {
        tokens_.fail(fmt::format("the {} '{}' {}; remedy: write the layer again with write.usd", lower_case(prim.type),
                                 prim.name, why));
    }

    Element element_of(const Prim& prim, Element::Kind kind) const {
        using Kind = Element::Kind;
        const bool round = kind != Kind::box && kind != Kind::hull;
        const bool turned = prim.orient != std::array<double, 4>{1, 0, 0, 0};
        if (prim.transformed || (kind != Kind::box && prim.scale != Vec3{1, 1, 1}) ||
            (kind == Kind::sphere && turned)) {
            refuse(prim, "is turned or scaled");
        }
        if (round && !prim.radius) {
            refuse(prim, "has no radius");
        }
        Element element{.kind = kind, .radius = round ? *prim.radius : 0};
        element.pose = from_quaternion(prim.center, prim.orient);
        if (kind == Kind::box) {
            element.half = prim.scale * (prim.size.value_or(2) / 2);
        } else if (kind == Kind::hull) {
            try {
                element.hull = convex_hull(prim.points);
            } catch (const Error& error) {
                refuse(prim, fmt::format("has no hull: {}", error.what()));
            }
        } else if (kind != Kind::sphere) {
            if (!prim.height || (prim.axis != "X" && prim.axis != "Y" && prim.axis != "Z")) {
                refuse(prim, prim.height ? fmt::format("has the axis '{}'", prim.axis) : "has no height");
            }
            element.half.z = *prim.height / 2;
            Pose axis; // its z is the prim's axis
            if (prim.axis == "X") {
                axis.rotation = {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
            } else if (prim.axis == "Y") {
                axis.rotation = {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}};
            }
            element.pose = element.pose * axis;
        }
        return element;
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
        const bool shape = kind_of(prim.type).has_value();
        if (name == "foam:link" && tokens_.now().kind == Token::Kind::text) {
            prim.link = tokens_.take().value;
        } else if (shape && (name == "radius" || name == "height" || name == "size")) {
            (name == "radius" ? prim.radius : name == "height" ? prim.height : prim.size) = number();
        } else if (shape && name == "axis" && tokens_.now().kind == Token::Kind::text) {
            prim.axis = tokens_.take().value;
        } else if (shape && (name == "xformOp:translate" || name == "xformOp:scale")) {
            (name == "xformOp:scale" ? prim.scale : prim.center) = point();
        } else if (shape && name == "xformOp:orient") {
            prim.orient = numbers<4>();
            if (prim.orient == std::array<double, 4>{}) {
                refuse(prim, "has a quaternion of zeros");
            }
        } else if (prim.type == "Mesh" && name == "points") {
            prim.points = points();
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

    void expect(char sign, const char* of) {
        if (!tokens_.now().is(sign)) {
            tokens_.fail(fmt::format("expected '{}' of {}, got '{}'", sign, of, tokens_.now().value));
        }
        tokens_.take();
    }

    template <std::size_t count> std::array<double, count> numbers() {
        std::array<double, count> values{};
        const char* of = count == 3 ? "three numbers" : "four numbers";
        for (std::size_t i = 0; i < count; ++i) {
            expect(i == 0 ? '(' : ',', of);
            values[i] = number();
        }
        expect(')', of);
        return values;
    }

    Vec3 point() {
        const auto [x, y, z] = numbers<3>();
        return {x, y, z};
    }

    std::vector<Vec3> points() {
        std::vector<Vec3> result;
        expect('[', "a list of points");
        while (!tokens_.now().is(']')) {
            if (!result.empty()) {
                expect(',', "a list of points");
            }
            result.push_back(point());
        }
        tokens_.take();
        return result;
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
