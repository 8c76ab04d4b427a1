#include "tree_writer.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/elements.hpp>

#include <fmt/format.h>

namespace foam::tree {

std::string TreeWriter::write(const SphereModel& model, Context& context) const {
    const std::vector<LinkSpheres> links = spheres_by_link(model);
    if (!model.into) {
        return text_of(document(model, links, context), model);
    }
    yaml::Splice file(model.into->text, model.into->file.string(), ErrorCode::input);
    edit(file, model, links, context);
    return file.text();
}

std::map<std::string, Elements> TreeWriter::read(const std::string& bytes, const std::map<std::string, std::string>&) const {
    SphereFile read;
    read.file = name_;
    Tree tree(read);
    try {
        reading_(parse(bytes, read.file), tree);
    } catch (const Error& error) {
        throw Error(ErrorCode::output, error.what());
    }
    add_buffers(read); // the proof is of what the program uses
    return elements_of(std::move(read));
}

void TreeWriter::edit(yaml::Splice&, const SphereModel& model, const std::vector<LinkSpheres>&, Context&) const {
    throw Error(ErrorCode::output, fmt::format("{}: {} writes whole files only; remedy: without 'into'",
                                               model.into->file.string(), name_));
}

std::string TreeWriter::text_of(const yaml::Value& document, const SphereModel& model) const {
    return (model.provenance.empty() ? "" : "# " + model.provenance + "\n") + yaml::block_text(document);
}

void edit_ignored_links(yaml::Splice& file, const std::vector<std::string_view>& path, const SphereModel& model,
                        PairEdit edit, Context& context) {
    StatedPairs stated{.file = model.into->file.string(), .ignored = {}, .decided = {}};
    const yaml::Value* map = file.find(path);
    const bool is_map = map && map->is(yaml::Value::Kind::map);
    for (std::size_t i = 0; is_map && i < map->keys.size(); ++i) {
        for (const yaml::Value& other : map->items[i].items) {
            stated.ignored.push_back({map->keys[i].text, other.text, ""});
        }
    }
    const auto pairs = pairs_into(edit, stated, model.ignored_pairs, context);
    if (pairs && (edit == PairEdit::replace || !is_map || map->keys.empty())) {
        file.set(path, ignored_links(*pairs));
    } else if (pairs) {
        const yaml::Value added = ignored_links(*pairs);
        for (std::size_t i = 0; i < added.keys.size(); ++i) {
            std::vector<std::string_view> key = path;
            key.push_back(added.keys[i].text);
            file.extend(key, added.items[i]);
        }
    }
}

void fail_without_key(const SphereModel& model, const std::string& key, const std::string& remedy) {
    throw Error(ErrorCode::input,
                fmt::format("{}: there is no '{}'; remedy: {}", model.into->file.string(), key, remedy));
}

} // namespace foam::tree
