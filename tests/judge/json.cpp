#include "json.hpp"

#include "mesh_files.hpp"

#include <stdexcept>

namespace judge {
namespace {

class JsonParser {
public:
    explicit JsonParser(const std::string& text) : text_(text) {}

    Json value() {
        Json result;
        switch (next()) {
        case '{':
            read_members(result);
            break;
        case '[':
            read_items(result);
            break;
        case '"':
            result.text = string();
            break;
        default:
            read_word(result);
        }
        return result;
    }

private:
    /// The next character that is no white space; it stays.
    char next() {
        at_ = text_.find_first_not_of(" \t\r\n", at_);
        if (at_ == std::string::npos) {
            throw std::runtime_error("JSON: it ends too early");
        }
        return text_[at_];
    }
    void expect_character(char c) {
        if (next() != c) {
            throw std::runtime_error(std::string("JSON: expected ") + c);
        }
        ++at_;
    }
    /// After an item: whether another one follows. Passes the comma or the end.
    bool more(char end) {
        const bool comma = next() == ',';
        expect_character(comma ? ',' : end);
        return comma;
    }
    void read_members(Json& object) {
        expect_character('{');
        if (next() == '}') {
            ++at_;
            return;
        }
        do {
            next();
            const std::string name = string();
            expect_character(':');
            object.members[name] = value();
        } while (more('}'));
    }
    void read_items(Json& array) {
        expect_character('[');
        if (next() == ']') {
            ++at_;
            return;
        }
        do {
            array.items.push_back(value());
        } while (more(']'));
    }
    /// Of escapes only those of one character: names of links need no others.
    std::string string() {
        expect_character('"');
        std::string result;
        for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
            at_ += text_[at_] == '\\' ? 1 : 0;
            result += text_.at(at_);
        }
        expect_character('"');
        return result;
    }
    void read_word(Json& result) {
        const std::size_t end = text_.find_first_of(" \t\r\n,]}", at_);
        const std::string word = text_.substr(at_, end - at_);
        at_ = end;
        if (word == "true" || word == "false" || word == "null") {
            result.text = word;
        } else {
            result.number = numbers_of(word).at(0);
        }
    }

    const std::string& text_;
    std::size_t at_ = 0;
};

} // namespace

const Json& Json::at(const std::string& name) const {
    const auto found = members.find(name);
    if (found == members.end()) {
        throw std::runtime_error("JSON: there is no " + name);
    }
    return found->second;
}

const std::vector<Json>& Json::list(const std::string& name) const {
    static const std::vector<Json> none;
    const auto found = members.find(name);
    return found == members.end() ? none : found->second.items;
}

Point Json::point() const {
    if (items.size() != 3) {
        throw std::runtime_error("JSON: a point has other than three numbers");
    }
    return {items[0].number, items[1].number, items[2].number};
}

Json parse_json(const std::string& text) {
    return JsonParser(text).value();
}

} // namespace judge
