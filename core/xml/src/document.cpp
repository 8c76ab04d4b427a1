#include "mend.hpp"

#include <expat.h>

#include <algorithm>
#include <limits>

namespace foam::xml {
namespace {

constexpr std::size_t deepest_nesting = 200;

/// Builds the elements while expat reads the text. Exceptions must not pass through expat's C frames: the first error
/// stops the parser and is thrown afterwards.
class Builder {
public:
    explicit Builder(std::string_view text, const Mended* lenient = nullptr)
        : text_(text), lenient_(lenient), parser_(XML_ParserCreate(lenient ? lenient->encoding : nullptr)) {
        XML_SetUserData(parser_, this);
        XML_SetElementHandler(parser_, on_start, on_end);
        XML_SetEntityDeclHandler(parser_, on_entity);
        XML_SetSkippedEntityHandler(parser_, on_skipped);
    }
    ~Builder() { XML_ParserFree(parser_); }
    Builder(const Builder&) = delete;
    Builder& operator=(const Builder&) = delete;

    std::unique_ptr<const Element> build(const std::string& label, ErrorCode code) {
        if (text_.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) / 2) {
            throw Error(code, label + ": is larger than 1 GB");
        }
        if (text_.starts_with("\xFE\xFF") || text_.starts_with("\xFF\xFE")) {
            throw Error(code, label + ": is UTF-16; convert it first: iconv -f UTF-16 -t UTF-8");
        }
        if (XML_Parse(parser_, text_.data(), static_cast<int>(text_.size()), 1) != XML_STATUS_OK && !ended_) {
            const XML_Error error = XML_GetErrorCode(parser_);
            const std::string reason =
                complaint_.empty() ? std::string("XML: ") + XML_ErrorString(error) + remedy_for(error) : complaint_;
            throw Error(code, label + ":" + std::to_string(XML_GetCurrentLineNumber(parser_)) + ":" +
                                  std::to_string(XML_GetCurrentColumnNumber(parser_) + 1) + ": " + reason);
        }
        return std::move(root_);
    }

private:
    static const char* remedy_for(XML_Error error) {
        switch (error) {
        case XML_ERROR_INVALID_TOKEN:
            return "; remedy: values in quotes, a blank between attributes, &lt; for '<' in a value, no control "
                   "characters";
        case XML_ERROR_NO_ELEMENTS:
        case XML_ERROR_UNCLOSED_TOKEN:
            return "; the file ends too early; remedy: get the whole file, or close what is open";
        case XML_ERROR_TAG_MISMATCH:
            return "; remedy: close each <NAME> by </NAME>, the inner ones first";
        case XML_ERROR_DUPLICATE_ATTRIBUTE:
            return "; remedy: keep one";
        default:
            return "";
        }
    }
    static void on_start(void* self, const XML_Char* name, const XML_Char** attributes) {
        static_cast<Builder*>(self)->start(name, attributes);
    }
    static void on_end(void* self, const XML_Char*) { static_cast<Builder*>(self)->end(); }
    static void on_entity(void* self, const XML_Char* name, int, const XML_Char*, int, const XML_Char*, const XML_Char*,
                          const XML_Char*, const XML_Char*) {
        static_cast<Builder*>(self)->complain(std::string("the text declares an entity of its own, '") + name +
                                              "'; write it out first: xmllint --noent");
    }
    static void on_skipped(void* self, const XML_Char* name, int) {
        static_cast<Builder*>(self)->complain(std::string("unknown entity '") + name + "'");
    }

    std::size_t offset() const { return static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_)); }
    std::size_t length() const { return static_cast<std::size_t>(XML_GetCurrentByteCount(parser_)); }

    void complain(std::string why) {
        if (complaint_.empty()) {
            complaint_ = std::move(why);
            XML_StopParser(parser_, XML_FALSE);
        }
    }

    void start(const XML_Char* name, const XML_Char** attributes) {
        if (open_.size() == deepest_nesting) {
            complain("elements are nested more than " + std::to_string(deepest_nesting) + " deep");
            return;
        }
        auto element = std::make_unique<Element>();
        element->name = name;
        for (; *attributes; attributes += 2) {
            element->attributes.emplace_back(attributes[0], attributes[1]);
            if (lenient_ && lenient_->has_bare_ampersands) {
                std::string& value = element->attributes.back().second;
                std::replace(value.begin(), value.end(), bare_ampersand, '&');
            }
        }
        element->start_tag = {offset(), offset() + length()};
        element->line = static_cast<int>(XML_GetCurrentLineNumber(parser_));
        Element* raw = element.get();
        if (open_.empty()) {
            root_ = std::move(element);
        } else {
            open_.back()->children.push_back(std::move(element));
        }
        open_.push_back(raw);
    }

    void end() {
        if (!complaint_.empty()) {
            return;
        }
        Element& element = *open_.back();
        open_.pop_back();
        const bool self_closing = text_.substr(element.start_tag.end - 2, 2) == "/>";
        element.end_tag = self_closing ? element.start_tag.end : offset();
        element.span = {element.start_tag.begin, self_closing ? element.start_tag.end : offset() + length()};
        if (open_.empty() && lenient_) { // what follows need not be XML
            ended_ = true;
            XML_StopParser(parser_, XML_FALSE);
        }
    }

    std::string_view text_;
    const Mended* lenient_;
    XML_Parser parser_;
    bool ended_ = false; ///< the root element, in a text that is read leniently
    std::unique_ptr<Element> root_;
    std::vector<Element*> open_;
    std::string complaint_;
};

/// Returns whether a text has blanks and whole comments only.
bool is_epilogue(std::string_view text) {
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        const std::size_t end = text.starts_with("<!--") ? text.find("-->") : text.npos;
        if (end == text.npos) {
            return text.empty();
        }
        text.remove_prefix(end + 3);
    }
}

} // namespace

const std::string* Element::attribute(std::string_view key) const {
    for (const auto& [name_, value] : attributes) {
        if (name_ == key) {
            return &value;
        }
    }
    return nullptr;
}

const Element* Element::child(std::string_view child_name) const {
    for (const auto& candidate : children) {
        if (candidate->name == child_name) {
            return candidate.get();
        }
    }
    return nullptr;
}

Span Element::attribute_span(std::string_view key, std::string_view text) const {
    constexpr std::string_view space = " \t\r\n";
    std::size_t at = text.find_first_of(" \t\r\n/>", start_tag.begin + 1);
    while (true) { // name, '=', value in quotes; the text is well-formed
        const std::size_t begin = text.find_first_not_of(space, at);
        const std::size_t end = text.find_first_of(" \t\r\n=", begin);
        const std::size_t quote = text.find_first_of("\"'", end);
        const std::size_t close = quote < start_tag.end ? text.find(text[quote], quote + 1) : text.npos;
        if (close >= start_tag.end) {
            return {};
        }
        if (text.substr(begin, end - begin) == key) {
            return {quote + 1, close};
        }
        at = close + 1;
    }
}

std::vector<const Element*> Element::children_named(std::string_view child_name) const {
    std::vector<const Element*> result;
    for (const auto& candidate : children) {
        if (candidate->name == child_name) {
            result.push_back(candidate.get());
        }
    }
    return result;
}

std::string_view root_name(std::string_view text) {
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        const std::string_view end = text.starts_with("<?") ? "?>" : text.starts_with("<!--") ? "-->" : "";
        if (end.empty()) {
            break;
        }
        const std::size_t at = text.find(end);
        text.remove_prefix(at == text.npos ? text.size() : at + end.size());
    }
    if (!text.starts_with('<')) {
        return {};
    }
    return text.substr(1, text.find_first_of(" \t\r\n/>", 1) - 1);
}

std::unique_ptr<const Element> parse(std::string_view text, const std::string& label, ErrorCode code) {
    return Builder(text).build(label, code);
}

std::unique_ptr<const Element> parse_leniently(std::string_view text, const std::string& label, ErrorCode code,
                                               std::vector<Fault>& faults) {
    const Mended lenient = mended(text);
    faults.insert(faults.end(), lenient.faults.begin(), lenient.faults.end());
    auto root = Builder(lenient.text, &lenient).build(label, code);
    if (const std::string_view rest = text.substr(root->span.end); !is_epilogue(rest)) {
        const auto lines = std::count(text.begin(), text.end() - static_cast<std::ptrdiff_t>(rest.size()), '\n');
        faults.push_back({static_cast<int>(lines) + 1, "what follows </" + root->name +
                                                           "> is not read; remedy: let "
                                                           "the file end there"});
    }
    return root;
}

} // namespace foam::xml
