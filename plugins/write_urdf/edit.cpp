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

std::string sphere_element(const Sphere& sphere, const std::string& properties) {
    return "<collision><origin xyz=\"" + number_text(sphere.center.x) + " " + number_text(sphere.center.y) + " " +
           number_text(sphere.center.z) + "\" rpy=\"0 0 0\"/><geometry><sphere radius=\"" + number_text(sphere.radius) +
           "\"/></geometry>" + properties + "</collision>";
}

} // namespace

void UrdfEditor::set_attribute(const xml::Element& element, std::string_view key, const std::string& value) {
    if (element.attribute(key)) {
        replace(element.attribute_span(key, text_), value);
        return;
    }
    const std::size_t after_name = element.span.begin + 1 + element.name.size();
    replace({after_name, after_name}, " " + std::string(key) + "=\"" + value + "\"");
}

void UrdfEditor::remove(const xml::Element& element) {
    replace({element.span.begin - line_start(text_, element.span.begin).size(), element.span.end}, "");
}

void UrdfEditor::append_child(const xml::Element& parent, std::string child) {
    if (appended_.empty() || appended_.back().first != &parent) {
        appended_.push_back({&parent, {}});
    }
    appended_.back().second.push_back(std::move(child));
}

void UrdfEditor::replace_collisions(const xml::Element& link, const std::vector<Sphere>& spheres,
                                    const std::string& properties) {
    CancellationCounter asking(256);
    const std::vector<const xml::Element*> collisions = link.children_named("collision");
    if (collisions.empty()) {
        for (const Sphere& sphere : spheres) {
            asking.check();
            append_child(link, sphere_element(sphere, properties));
        }
        return;
    }
    const std::string_view separator = line_start(text_, collisions.front()->span.begin);
    std::string elements;
    for (const Sphere& sphere : spheres) {
        asking.check();
        elements += elements.empty() ? "" : separator;
        elements += sphere_element(sphere, properties);
    }
    replace(collisions.front()->span, std::move(elements));
    for (std::size_t i = 1; i < collisions.size(); ++i) {
        remove(*collisions[i]);
    }
}

void UrdfEditor::add_children(const Appended& appended) {
    const xml::Element& parent = *appended.first;
    const std::string outer(line_start(text_, parent.span.begin));
    const std::string inner = !parent.children.empty()
                                  ? std::string(line_start(text_, parent.children.front()->span.begin))
                              : outer.empty() ? ""
                                              : outer + "  ";
    std::string elements;
    for (const std::string& child : appended.second) {
        elements += inner + child;
    }
    if (parent.self_closing()) {
        const std::size_t slash = parent.span.end - 2;
        replace({slash, parent.span.end}, ">" + elements + outer + "</" + parent.name + ">");
        return;
    }
    const std::size_t end = parent.end_tag - line_start(text_, parent.end_tag).size();
    replace({end, end}, std::move(elements));
}

std::string UrdfEditor::result() {
    std::stable_sort(appended_.begin(), appended_.end(),
                     [](const Appended& a, const Appended& b) { return a.first->span.begin < b.first->span.begin; });
    for (std::size_t i = 0; i < appended_.size();) { // those of one parent are one change
        Appended whole = std::move(appended_[i]);
        for (++i; i < appended_.size() && appended_[i].first == whole.first; ++i) {
            std::move(appended_[i].second.begin(), appended_[i].second.end(), std::back_inserter(whole.second));
        }
        add_children(whole);
    }
    appended_.clear();
    std::stable_sort(changes_.begin(), changes_.end(),
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
