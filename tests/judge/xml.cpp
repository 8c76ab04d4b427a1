#include "xml.hpp"

#include <cstdlib>
#include <stdexcept>

namespace judge {
namespace {

void append_utf8(std::string& text, unsigned long code) {
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0 | (code >> 6));
        text += static_cast<char>(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        text += static_cast<char>(0xE0 | (code >> 12));
        text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
        text += static_cast<char>(0x80 | (code & 0x3F));
    } else {
        text += static_cast<char>(0xF0 | (code >> 18));
        text += static_cast<char>(0x80 | ((code >> 12) & 0x3F));
        text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
        text += static_cast<char>(0x80 | (code & 0x3F));
    }
}

std::string decoded(const std::string& raw, bool attribute) {
    static const std::map<std::string, char> entities{
        {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
    std::string text;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const std::size_t end = raw[i] == '&' ? raw.find(';', i) : std::string::npos;
        if (end == std::string::npos) {
            const bool space = raw[i] == '\n' || raw[i] == '\t' || raw[i] == '\r';
            text += attribute && space ? ' ' : raw[i];
            continue;
        }
        const std::string entity = raw.substr(i + 1, end - i - 1);
        if (entity.starts_with("#x")) {
            append_utf8(text, std::strtoul(entity.c_str() + 2, nullptr, 16));
        } else if (entity.starts_with("#")) {
            append_utf8(text, std::strtoul(entity.c_str() + 1, nullptr, 10));
        } else {
            text += entities.at(entity);
        }
        i = end;
    }
    return text;
}

class Parser {
public:
    explicit Parser(const std::string& text) : text_(text) {}

    Element document() {
        skip_other();
        expect('<');
        return element();
    }

private:
    [[noreturn]] static void fail(const std::string& what) { throw std::runtime_error("XML: " + what); }

    bool starts(const char* word) const { return text_.compare(at_, std::char_traits<char>::length(word), word) == 0; }
    void skip_past(const char* word) {
        const std::size_t found = text_.find(word, at_);
        if (found == std::string::npos) {
            fail(std::string("no ") + word);
        }
        at_ = found + std::char_traits<char>::length(word);
    }
    void skip_space() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }
    void expect(char c) {
        if (at_ >= text_.size() || text_[at_] != c) {
            fail(std::string("expected ") + c);
        }
        ++at_;
    }
    /// Comments, instructions, declarations before the root.
    void skip_other() {
        for (;;) {
            at_ = std::min(text_.find('<', at_), text_.size());
            if (starts("<!--")) {
                skip_past("-->");
            } else if (starts("<?")) {
                skip_past("?>");
            } else if (starts("<!")) {
                skip_past(">");
            } else {
                return;
            }
        }
    }
    std::string name() {
        const std::size_t end = text_.find_first_of(" \t\r\n/>=", at_);
        std::string result = text_.substr(at_, end - at_);
        at_ = std::min(end, text_.size());
        const std::size_t colon = result.rfind(':');
        return colon == std::string::npos ? result : result.substr(colon + 1);
    }
    void read_attribute(Element& element) {
        const std::string key = name();
        skip_space();
        expect('=');
        skip_space();
        const char quote = at_ < text_.size() ? text_[at_] : '\0';
        const std::size_t end = quote == '"' || quote == '\'' ? text_.find(quote, at_ + 1) : std::string::npos;
        if (end == std::string::npos) {
            fail("attribute " + key + " has no value");
        }
        element.attributes[key] = decoded(text_.substr(at_ + 1, end - at_ - 1), true);
        at_ = end + 1;
    }
    /// After its '<'.
    Element element() {
        Element result;
        result.name = name();
        for (skip_space(); !starts("/>") && !starts(">"); skip_space()) {
            read_attribute(result);
        }
        if (starts("/>")) {
            at_ += 2;
            return result;
        }
        expect('>');
        content(result);
        return result;
    }
    /// Up to and with the end tag.
    void content(Element& parent) {
        for (;;) {
            const std::size_t tag = text_.find('<', at_);
            if (tag == std::string::npos) {
                fail("<" + parent.name + "> does not end");
            }
            parent.text += decoded(text_.substr(at_, tag - at_), false);
            at_ = tag;
            if (starts("</")) {
                skip_past(">");
                return;
            }
            if (starts("<!--")) {
                skip_past("-->");
            } else if (starts("<![CDATA[")) {
                const std::size_t begin = at_ + 9;
                skip_past("]]>");
                parent.text += text_.substr(begin, at_ - 3 - begin);
            } else if (starts("<?")) {
                skip_past("?>");
            } else {
                ++at_;
                parent.children.push_back(element());
            }
        }
    }

    const std::string& text_;
    std::size_t at_ = 0;
};

} // namespace

const Element* Element::child(const std::string& wanted) const {
    for (const Element& element : children) {
        if (element.name == wanted) {
            return &element;
        }
    }
    return nullptr;
}

const Element& Element::at(const std::string& wanted) const {
    if (const Element* found = child(wanted)) {
        return *found;
    }
    throw std::runtime_error("<" + name + "> has no <" + wanted + ">");
}

std::string Element::attribute(const std::string& wanted, const std::string& otherwise) const {
    const auto found = attributes.find(wanted);
    return found == attributes.end() ? otherwise : found->second;
}

Element parse_xml(const std::string& text) {
    return Parser(text).document();
}

} // namespace judge
