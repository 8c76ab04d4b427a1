#include "links.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

namespace foam::sdf {
namespace {

using Node = xml::Element;

class Walk {
public:
    explicit Walk(const std::string& file) : file_(file) {}

    std::vector<std::pair<std::string, const Node*>> run(const Node& root) {
        std::vector<const Node*> holders{&root};
        for (const Node* world : root.children_named("world")) {
            holders.push_back(world);
        }
        std::size_t models = 0;
        for (const Node* holder : holders) {
            models += holder->children_named("model").size() + holder->children_named("include").size();
        }
        if (models == 0) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: there is no <model>", file_, root.line));
        }
        for (const Node* holder : holders) {
            add_models(*holder, "", models > 1);
        }
        return std::move(links_);
    }

private:
    const std::string& name_of(const Node& element) const {
        const std::string* name = element.attribute("name");
        if (!name || name->empty()) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: <{}> has no name", file_, element.line, element.name));
        }
        return *name;
    }

    /// Adds the links of the models of an element; those within others are at most as deep as the parser allows.
    void add_models(const Node& holder, const std::string& scope, bool scoped) {
        for (const Node* model : holder.children_named("model")) {
            const std::string inner = scoped ? scope + name_of(*model) + "::" : scope;
            for (const Node* link : model->children_named("link")) {
                links_.emplace_back(inner + name_of(*link), link);
            }
            add_models(*model, inner, true);
        }
    }

    const std::string& file_;
    std::vector<std::pair<std::string, const Node*>> links_;
};

} // namespace

std::vector<std::pair<std::string, const Node*>> links_of(const Node& root, const std::string& file) {
    return Walk(file).run(root);
}

std::string_view content_of(const Node& element, std::string_view text) {
    return element.self_closing() ? std::string_view()
                                  : text.substr(element.start_tag.end, element.end_tag - element.start_tag.end);
}

bool is_masked(const Node& collision, std::string_view text) {
    const Node* at = &collision;
    for (const std::string_view name : {"surface", "contact", "collide_bitmask"}) {
        at = at ? at->child(name) : nullptr;
    }
    if (!at || words(content_of(*at, text)).empty()) {
        return false;
    }
    const std::string mask(words(content_of(*at, text)).front());
    const bool hexadecimal = mask.starts_with("0x") || mask.starts_with("0X");
    return mask.find_first_not_of('0', hexadecimal ? 2 : 0) == std::string::npos;
}

} // namespace foam::sdf
