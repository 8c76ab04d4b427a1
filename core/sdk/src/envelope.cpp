#include "plugin_file.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <map>
#include <regex>
#include <vector>

namespace foam::inline sdk {
namespace {

/// Returns the fields of a fingerprint with readable names.
std::map<std::string, std::string> fields_of(std::string_view fingerprint) {
    static constexpr std::pair<std::string_view, std::string_view> names[] = {{"foam-abi", "ABI epoch"},
                                                                              {"layout", "ABI layout"},
                                                                              {"cxx11", "std::string ABI (cxx11)"},
                                                                              {"stdlib", "standard library"}};
    std::map<std::string, std::string> fields;
    for (const std::string_view word : words(fingerprint)) {
        const std::size_t equals = word.find('=');
        std::string name(word.substr(0, equals));
        for (const auto& [short_name, long_name] : names) {
            name = name == short_name ? long_name : name;
        }
        fields[name] = equals == word.npos ? "on" : std::string(word.substr(equals + 1));
    }
    return fields;
}

/// Returns whether the text has the form of an SPDX licence expression: "Apache-2.0", "(MIT OR LicenseRef-Mine) AND
/// BSD-3-Clause".
bool is_license(const std::string& text) {
    static const std::regex form(
        "\\(*[A-Za-z0-9][A-Za-z0-9.+:-]*\\)*( (AND|OR|WITH) \\(*[A-Za-z0-9][A-Za-z0-9.+:-]*\\)*)*");
    return std::regex_match(text, form);
}

} // namespace

std::string other_build(std::string_view has) {
    const auto theirs = fields_of(has), ours = fields_of(FOAM_ABI_FINGERPRINT);
    std::vector<std::string> built_for, is;
    for (const auto& [name, value] : ours) {
        const auto other = theirs.find(name);
        const bool implied = name == "ABI layout" && !built_for.empty(); // each epoch has its own layouts
        if (other != theirs.end() && other->second != value && !implied) {
            built_for.push_back(fmt::format("{} {}", name, other->second));
            is.push_back(fmt::format("{} {}", name, value));
        }
    }
    if (is.empty()) { // another number of fields: no release of foam writes that
        built_for.push_back(fmt::format("[{}]", has));
        is.push_back(fmt::format("[{}]", FOAM_ABI_FINGERPRINT));
    }
    return fmt::format("it was built for {}, this foam has {}; remedy: rebuild the plugin against this foam, with the "
                       "same compiler options",
                       fmt::join(built_for, " and "), fmt::join(is, " and "));
}

std::string why_bad(const foam_plugin_envelope_v1* envelope) {
    if (!envelope) {
        return "its entry point returns no envelope; remedy: use the FOAM_PLUGIN macro";
    }
    if (envelope->size != sizeof(foam_plugin_envelope_v1) || envelope->epoch != FOAM_ABI_EPOCH) {
        return fmt::format(
            "its envelope has {} bytes of ABI epoch {}, this foam's has {} of epoch {}; remedy: rebuild the "
            "plugin against this foam",
            envelope->size, envelope->epoch, sizeof(foam_plugin_envelope_v1), FOAM_ABI_EPOCH);
    }
    if (!envelope->fingerprint || std::string_view(envelope->fingerprint) != FOAM_ABI_FINGERPRINT) {
        return other_build(envelope->fingerprint ? envelope->fingerprint : "nothing");
    }
    for (const char* text : {envelope->name, envelope->version, envelope->license}) {
        if (!text || !*text) {
            return "its name, version or license is empty; remedy: state all three in FOAM_PLUGIN";
        }
    }
    if (!is_license(envelope->license)) {
        return fmt::format("its license '{}' is no SPDX expression; remedy: write an identifier of "
                           "spdx.org/licenses, e.g. Apache-2.0, or LicenseRef-NAME for one of your own",
                           envelope->license);
    }
    return envelope->enrol ? "" : "it has no function that enrols stages; remedy: use the FOAM_PLUGIN macro";
}

} // namespace foam::sdk
