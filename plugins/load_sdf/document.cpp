#include "document.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/xml/document.hpp>

#include <sdf/Console.hh>
#include <sdf/ParserConfig.hh>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::load_sdf {
namespace fs = std::filesystem;
namespace {

/// Puts the paths of the models that a text includes in place of their URIs: libsdformat would look for them in the
/// working folder first.
class Includes {
public:
    Includes(std::string_view text, const fs::path& file, const References& references)
        : text_(text), file_(file), references_(references), editor_(text) {}

    std::string resolved(const xml::Element& root) {
        resolve_below(root);
        return editor_.result();
    }

private:
    void resolve_below(const xml::Element& element) {
        for (const auto& child : element.children) {
            const xml::Element* uri = child->name == "include" ? child->child("uri") : nullptr;
            if (uri && !uri->self_closing()) {
                resolve(*uri);
            }
            resolve_below(*child);
        }
    }

    void resolve(const xml::Element& uri) {
        const std::string_view content = text_.substr(uri.start_tag.end, uri.end_tag - uri.start_tag.end);
        const std::vector<std::string_view> parts = words(content);
        if (parts.size() != 1 || content.find_first_of("&<") != content.npos) {
            return; // a path with blanks or entities: References::nested() finds it
        }
        const std::string name(parts.front());
        const ResolvedResource found = references_.model(name, references_.folder());
        if (!found.found()) {
            throw Error(ErrorCode::input,
                        fmt::format("{}:{}: the model '{}' that is included is not found{}\n{}", file_.string(),
                                    uri.line, shown(name), places_text(found), remedy_for(name)));
        }
        // The line ends stay, so that messages name the right lines.
        const std::string_view old = text_.substr(uri.span.begin, uri.span.size());
        editor_.replace(uri.span, std::string(static_cast<std::size_t>(std::ranges::count(old, '\n')), '\n') + "<uri>" +
                                      markup_escaped(fs::absolute(found.path).string()) + "</uri>");
    }

    std::string_view text_;
    const fs::path& file_;
    const References& references_;
    xml::Editor editor_;
};

/// Returns whether links need the name of their model. Throws for a text that libsdformat would read in part.
bool counted_models(const xml::Element& root, const fs::path& file) {
    const auto refuse_second = [&](const char* name, const char* remedy) {
        const auto found = root.children_named(name);
        if (found.size() > 1) {
            std::vector<std::string> names;
            for (const xml::Element* element : found) {
                names.push_back(element->attribute("name") ? *element->attribute("name") : "");
            }
            throw Error(ErrorCode::input, fmt::format("{}:{}: the file has several <{}>: {}; remedy: {}", file.string(),
                                                      found[1]->line, name, shown(first_names(names)), remedy));
        }
        return found;
    };
    const auto worlds = refuse_second("world", "a file for each");
    std::size_t models = refuse_second("model", "put them into one <world>").size();
    models += root.children_named("include").size();
    for (const xml::Element* world : worlds) {
        models += world->children_named("model").size() + world->children_named("include").size();
    }
    if (models == 0) {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}: there is no <model>; remedy: a file with one", file.string(), root.line));
    }
    return models > 1;
}

/// libsdformat calls a text that it did not read from a file "data-string", in angle brackets in errors.
bool is_main(const std::string& file) {
    return file.empty() || file.find("data-string") != file.npos;
}

::sdf::Errors load(::sdf::Root& root, const std::string& text, References& references,
                   ::sdf::EnforcementPolicy warnings) {
    ::sdf::ParserConfig config;
    config.SetWarningsPolicy(warnings);
    config.SetUnrecognizedElementsPolicy(warnings);
    config.SetFindCallback([&](const std::string& uri) { return references.nested(uri); });
    return root.LoadSdfString(text, config);
}

/// Returns whether an error is about what foam does not read: masses that no body has, sensors, looks. libsdformat has
/// read the links all the same.
bool is_aside(const ::sdf::Error& error) {
    const std::string message = error.Message();
    return error.Code() == ::sdf::ErrorCode::LINK_INERTIA_INVALID ||
           message.starts_with("Attempting to load a Sensor") || message.starts_with("A <script> element is missing");
}

} // namespace

Document::Document(const std::string& text, const fs::path& file, References& references, Context& context)
    : file_(file) {
    static const bool quiet = (::sdf::Console::Instance()->SetQuiet(true), true);
    static_cast<void>(quiet);
    const auto root = xml::parse(text, file.string(), ErrorCode::input);
    if (root->name != "sdf") {
        throw Error(ErrorCode::input, fmt::format("{}:{}: the root element of an SDF is <sdf>, not <{}>",
                                                  file.string(), root->line, root->name));
    }
    scoped_ = counted_models(*root, file);
    const std::string resolved = Includes(text, file, references).resolved(*root);
    // Warnings are told only as errors: read it again without them where there are some.
    const ::sdf::Errors all = load(root_, resolved, references, ::sdf::EnforcementPolicy::ERR);
    if (!all.empty()) {
        root_ = ::sdf::Root();
        ::sdf::Errors errors = load(root_, resolved, references, ::sdf::EnforcementPolicy::LOG);
        std::erase_if(errors, is_aside);
        require_none(errors);
        log_warnings(all, context);
    }
}

std::vector<fs::path> Document::included() const {
    std::set<fs::path> files;
    const auto walk = [&](const auto& self, const ::sdf::ElementPtr& element) -> void {
        for (::sdf::ElementPtr child = element; child; child = child->GetNextElement()) {
            if (const std::string& file = child->FilePath(); !file.empty() && !is_main(file)) {
                files.insert(fs::absolute(file).lexically_normal());
            }
            self(self, child->GetFirstElement());
        }
    };
    walk(walk, root_.Element());
    return {files.begin(), files.end()};
}

Place Document::place_of(const ::sdf::ElementPtr& element) const {
    Place place{.file = file_};
    if (element) {
        place.file = is_main(element->FilePath()) ? file_ : fs::path(element->FilePath());
        place.line = element->LineNumber().value_or(0);
    }
    return place;
}

int Document::own_line(const ::sdf::ElementPtr& element) const {
    const Place place = place_of(element);
    return place.file == file_ ? place.line : 0;
}

std::string Document::shown_place(const ::sdf::ElementPtr& element) const {
    const Place place = place_of(element);
    return place.line > 0 ? fmt::format("{}:{}", place.file.string(), place.line) : place.file.string();
}

void Document::fail(const ::sdf::ElementPtr& element, const std::string& what) const {
    throw Error(ErrorCode::input, shown_place(element) + ": " + what);
}

std::string Document::message_of(const ::sdf::Error& error) const {
    const std::string stated = error.FilePath().value_or("");
    const std::string file = is_main(stated) ? file_.string() : stated;
    const std::string line = error.LineNumber() ? fmt::format(":{}", *error.LineNumber()) : "";
    std::string message = error.Message();
    std::ranges::replace(message, '\n', ' ');
    message = shown(message);
    message.erase(std::find_if(message.rbegin(), message.rend(), [](char c) { return c != '.' && c != ' '; }).base(),
                  message.end());
    return fmt::format("{}{}: libsdformat: {}", file, line, message);
}

void Document::require_none(const ::sdf::Errors& errors) const {
    if (!errors.empty()) {
        const std::string more = errors.size() > 1 ? fmt::format(" ({} more)", errors.size() - 1) : "";
        throw Error(ErrorCode::input, fmt::format("{}{}; remedy: correct it; http://sdformat.org/spec has the format",
                                                  message_of(errors.front()), more));
    }
}

void Document::log_warnings(const ::sdf::Errors& warnings, Context& context) const {
    constexpr std::size_t most = 10;
    std::set<std::string> messages;
    for (const ::sdf::Error& warning : warnings) {
        messages.insert(message_of(warning));
    }
    std::size_t count = 0;
    for (const std::string& message : messages) {
        if (++count <= most) {
            context.log(Severity::warning, message);
        }
    }
    if (messages.size() > most) {
        context.log(Severity::warning, fmt::format("libsdformat warns {} more times", messages.size() - most));
    }
}

} // namespace foam::load_sdf
