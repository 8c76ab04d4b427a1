#include "reader.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::urdf {

namespace {

/// Returns the text with blanks in place of the commas that separate numbers: those before a blank, and the two of
/// "1,2,3". Another is a decimal comma.
std::string without_commas(std::string text) {
    const bool all = words(text).size() == 1 && std::count(text.begin(), text.end(), ',') == 2;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == ',' && (all || i + 1 == text.size() || text[i + 1] == ' ')) {
            text[i] = ' ';
        }
    }
    return text;
}

} // namespace

bool is_xacro_expression(std::string_view text) {
    return text.find("${") != std::string_view::npos || text.find("$(") != std::string_view::npos;
}

std::string Reader::place(const xml::Element& element) const {
    return fmt::format("{}:{}", label_, element.line);
}

void Reader::fail(int line, const std::string& what) const {
    throw Error(ErrorCode::input, fmt::format("{}:{}: {}", label_, line, shown(what)));
}

void Reader::warn(int line, const std::string& what) const {
    auto same =
        std::find_if(warnings_.begin(), warnings_.end(), [&](const auto& known) { return known.first == what; });
    if (same == warnings_.end()) {
        same = warnings_.insert(same, {what, {}});
    }
    same->second.push_back(line);
}

void Reader::report(Context& context) const {
    for (const auto& [what, lines] : warnings_) {
        const std::string more =
            lines.size() == 1 ? "" : fmt::format(" ({} more, the next in line {})", lines.size() - 1, lines[1]);
        context.log(Severity::warning, fmt::format("{}:{}: {}{}", label_, lines.front(), shown(what), more));
    }
}

const std::string& Reader::required(const xml::Element& element, std::string_view attribute) const {
    const std::string* text = element.attribute(attribute);
    if (!text || text->empty()) {
        fail(element, fmt::format("<{}> has no {}", element.name, attribute));
    }
    if (is_xacro_expression(*text)) {
        fail(element, fmt::format("<{} {}=\"{}\"> is a xacro expression; run xacro first: xacro IN.xacro > OUT.urdf",
                                  element.name, attribute, *text));
    }
    return *text;
}

double Reader::parse(const xml::Element& element, std::string_view attribute, std::string_view text) const {
    if (const std::optional<double> value = parse_number(text)) {
        return *value;
    }
    std::string point(text);
    std::replace(point.begin(), point.end(), ',', '.');
    const std::string remedy = parse_number(point) ? "; remedy: " + point : "";
    fail(element, fmt::format("<{} {}>: '{}' is not a finite number{}", element.name, attribute, text, remedy));
}

bool Reader::is_empty(const xml::Element& element, std::string_view attribute) const {
    const std::string* text = element.attribute(attribute);
    if (text && words(*text).empty()) {
        warn(element, fmt::format("<{0} {1}=\"\"> counts as absent; remedy: remove {1}", element.name, attribute));
    }
    return !text || words(*text).empty();
}

std::optional<double> Reader::number(const xml::Element& element, std::string_view attribute) const {
    if (is_empty(element, attribute)) {
        return {};
    }
    const std::string& text = required(element, attribute);
    const std::vector<std::string_view> pieces = words(text);
    return parse(element, attribute, pieces.size() == 1 ? pieces.front() : text);
}

double Reader::required_number(const xml::Element& element, std::string_view attribute) const {
    const std::string& text = required(element, attribute);
    if (words(text).empty()) {
        parse(element, attribute, text);
    }
    return *number(element, attribute);
}

std::string Reader::evaluated(const xml::Element& element, std::string_view attribute) const {
    constexpr std::string_view variable = "$(optenv ";
    const std::string& text = *element.attribute(attribute);
    const std::size_t value = text.find(' ', variable.size());
    if (!text.starts_with(variable) || !text.ends_with(')') || value == text.npos || text.find('$', 1) != text.npos) {
        return required(element, attribute);
    }
    const std::string result = text.substr(value + 1, text.size() - value - 2);
    warn(element, fmt::format("<{} {}=\"{}\"> is read as \"{}\"; remedy: run xacro first: xacro IN.xacro > OUT.urdf",
                              element.name, attribute, text, result));
    return result;
}

std::optional<Vec3> Reader::vector(const xml::Element& element, std::string_view attribute) const {
    if (is_empty(element, attribute)) {
        return {};
    }
    const std::string text = evaluated(element, attribute);
    const std::string blanks = without_commas(text);
    const std::vector<std::string_view> pieces = words(blanks);
    if (pieces.size() < 3) {
        fail(element, fmt::format("<{} {}=\"{}\"> expects three numbers with blanks between them, got {}", element.name,
                                  attribute, text, pieces.size()));
    }
    const Vec3 result{parse(element, attribute, pieces[0]), parse(element, attribute, pieces[1]),
                      parse(element, attribute, pieces[2])};
    if (blanks != text || pieces.size() > 3) {
        const std::string fault = blanks != text
                                      ? "has commas between its numbers"
                                      : fmt::format("has {} numbers, of which the first three count", pieces.size());
        warn(element, fmt::format("<{} {}=\"{}\"> {}; remedy: {}=\"{} {} {}\"", element.name, attribute, text, fault,
                                  attribute, number_text(result.x), number_text(result.y), number_text(result.z)));
    }
    return result;
}

const xml::Element* Reader::only_child(const xml::Element& element, std::string_view name) const {
    const std::vector<const xml::Element*> found = element.children_named(name);
    if (found.size() > 1) {
        warn(*found[1], fmt::format("a second <{0}> in <{1}> is not read; remedy: keep one", name, element.name));
    }
    return found.empty() ? nullptr : found.front();
}

Pose Reader::origin(const xml::Element& element) const {
    const xml::Element* origin = only_child(element, "origin");
    if (!origin) {
        return {};
    }
    const Vec3 xyz = vector(*origin, "xyz").value_or(Vec3{});
    if (const std::string* quaternion = origin->attribute("quat_xyzw")) { // of URDF 1.2
        std::vector<double> q;
        for (const std::string_view word : words(*quaternion)) {
            q.push_back(parse(*origin, "quat_xyzw", word));
        }
        if (q.size() != 4 || !(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 0)) {
            fail(*origin, fmt::format("<origin quat_xyzw=\"{}\"> is no quaternion of four numbers", *quaternion));
        }
        return from_quaternion(xyz, {q[3], q[0], q[1], q[2]});
    }
    return Pose::from_xyz_rpy(xyz, vector(*origin, "rpy").value_or(Vec3{}));
}

} // namespace foam::urdf
