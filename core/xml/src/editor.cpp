#include <foam/xml/document.hpp>

#include <foam/base/cancellation.hpp>

#include <algorithm>

namespace foam::xml {
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

} // namespace

void Editor::set_attribute(const Element& element, std::string_view key, const std::string& value) {
    if (element.attribute(key)) {
        replace(element.attribute_span(key, text_), value);
        return;
    }
    const std::size_t after_name = element.span.begin + 1 + element.name.size();
    std::string attribute(1, ' ');
    attribute.append(key).append("=\"").append(value).append("\"");
    replace({after_name, after_name}, std::move(attribute));
}

void Editor::remove(const Element& element) {
    replace({element.span.begin - line_start(text_, element.span.begin).size(), element.span.end}, "");
}

void Editor::append_child(const Element& parent, std::string child) {
    if (appended_.empty() || appended_.back().first != &parent) {
        appended_.push_back({&parent, {}});
    }
    appended_.back().second.push_back(std::move(child));
}

void Editor::replace_children(const Element& parent, const std::vector<const Element*>& old,
                              const std::vector<std::string>& children) {
    CancellationCounter asking(256);
    if (old.empty() || children.empty()) {
        for (const std::string& child : children) {
            asking.check();
            append_child(parent, child);
        }
        for (const Element* element : old) {
            remove(*element);
        }
        return;
    }
    const std::string_view separator = line_start(text_, old.front()->span.begin);
    std::string elements;
    for (const std::string& child : children) {
        asking.check();
        elements += elements.empty() ? "" : separator;
        elements += child;
    }
    replace(old.front()->span, std::move(elements));
    for (std::size_t i = 1; i < old.size(); ++i) {
        remove(*old[i]);
    }
}

void Editor::add_children(const Appended& appended) {
    const Element& parent = *appended.first;
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

std::string Editor::result() {
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

} // namespace foam::xml
