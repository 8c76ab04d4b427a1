#include "edit.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/text.hpp>

#include <algorithm>

namespace foam {
namespace {

/// Returns the white space before `position` on its line, with the line end before it: "\r\n ". Empty if there is
/// anything else on the line.
std::string_view line_start(std::string_view text, std::size_t position) {
    std::size_t begin = position;
    while (begin > 0 && (text[begin - 1] == ' ' || text[begin - 1] == '\t')) {
        --begin;
    }
    if (begin > 0 && text[begin - 1] == '\n') {
        begin -= begin > 1 && text[begin - 2] == '\r' ? 2 : 1;
        return text.substr(begin, position - begin);
    }
    return {};
}

std::string sphere_element(const Sphere& sphere) {
    return "<collision><origin xyz=\"" + number_text(sphere.center.x) + " " + number_text(sphere.center.y) + " " +
           number_text(sphere.center.z) + "\" rpy=\"0 0 0\"/><geometry><sphere radius=\"" + number_text(sphere.radius) +
           "\"/></geometry></collision>";
}

std::string sphere_elements(const std::vector<Sphere>& spheres, std::string_view separator) {
    std::string result;
    CancellationCounter asking(256);
    for (const Sphere& sphere : spheres) {
        asking.check();
        result += result.empty() ? "" : separator;
        result += sphere_element(sphere);
    }
    return result;
}

} // namespace

void UrdfEditor::replace_collisions(const xml::Element& link, const std::vector<Sphere>& spheres) {
    const std::vector<const xml::Element*> collisions = link.children_named("collision");
    if (spheres.empty()) {
        for (const xml::Element* collision : collisions) {
            const xml::Span span = collision->span;
            changes_.push_back({{span.begin - line_start(text_, span.begin).size(), span.end}, ""});
        }
        return;
    }
    if (!collisions.empty()) {
        const xml::Element& first = *collisions.front();
        changes_.push_back({first.span, sphere_elements(spheres, line_start(text_, first.span.begin))});
        for (std::size_t i = 1; i < collisions.size(); ++i) {
            const xml::Span span = collisions[i]->span;
            changes_.push_back({{span.begin - line_start(text_, span.begin).size(), span.end}, ""});
        }
        return;
    }
    const std::string outer(line_start(text_, link.span.begin));
    const std::string inner = outer.empty() ? "" : outer + "  ";
    const std::string elements = inner + sphere_elements(spheres, inner);
    if (link.self_closing()) {
        const std::size_t slash = link.span.end - 2;
        changes_.push_back({{slash, link.span.end}, ">" + elements + outer + "</" + link.name + ">"});
    } else {
        const std::size_t end = link.end_tag - line_start(text_, link.end_tag).size();
        changes_.push_back({{end, end}, elements});
    }
}

std::string UrdfEditor::result() {
    std::sort(changes_.begin(), changes_.end(),
              [](const Change& a, const Change& b) { return a.span.begin < b.span.begin; });
    std::string result;
    std::size_t copied = 0;
    CancellationCounter asking(256);
    for (const Change& change : changes_) {
        asking.check();
        result.append(text_.substr(copied, change.span.begin - copied));
        result += change.replacement;
        copied = change.span.end;
    }
    result.append(text_.substr(copied));
    return result;
}

} // namespace foam
