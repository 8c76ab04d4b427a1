#include <foam/yaml/value.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::yaml {

const Value* Value::find(std::string_view key) const {
    const auto it = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.text == key; });
    return it == keys.end() ? nullptr : &items[static_cast<std::size_t>(it - keys.begin())];
}

const Key* Value::find_key(std::string_view key) const {
    const auto it = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.text == key; });
    return it == keys.end() ? nullptr : &*it;
}

void Value::erase(std::string_view key) {
    const auto it = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.text == key; });
    if (it != keys.end()) {
        items.erase(items.begin() + (it - keys.begin()));
        keys.erase(it);
    }
}

std::string Value::description() const {
    switch (kind) {
    case Kind::null:
        return "nothing";
    case Kind::boolean:
    case Kind::integer:
    case Kind::number:
        return text.size() <= 40 ? text : "a long number";
    case Kind::text:
        return fmt::format("the text {}", in_quotes(text));
    case Kind::list:
        return "a list";
    case Kind::map:
        return "a map";
    }
    return "";
}

} // namespace foam::yaml
