// load.usd: robots in USD (https://openusd.org), as OpenUSD composes them.
#include "reader.hpp"

#include <foam/sdk/plugin.hpp>

namespace foam::load_usd {
namespace {

/// Returns whether the first file of a zip archive is a layer of USD.
bool is_package(std::string_view text) {
    constexpr std::size_t name_at = 30; // after the local header
    if (!text.starts_with("PK\x03\x04") || text.size() < name_at) {
        return false;
    }
    const auto length = static_cast<std::size_t>(static_cast<unsigned char>(text[26])) +
                        256 * static_cast<std::size_t>(static_cast<unsigned char>(text[27]));
    const std::string_view name = text.substr(name_at, length);
    return name.ends_with(".usd") || name.ends_with(".usda") || name.ends_with(".usdc");
}

class UsdLoader final : public RobotLoader {
public:
    bool recognises(std::string_view text) const override {
        return text.starts_with("#usda ") || text.starts_with("PXR-USDC") || is_package(text);
    }

    Robot load(const std::string&, const std::filesystem::path& file, const ResourceResolver&,
               Context& context) const override {
        return robot_of(file, context);
    }
};

} // namespace
} // namespace foam::load_usd

FOAM_PLUGIN("load_usd", "1.0", "Apache-2.0") {
    enrol.add<foam::load_usd::UsdLoader>(
        {.name = "load.usd",
         .summary = "Reads a robot from a stage of USD, by the Python package usd-core.",
         .reference = "https://openusd.org/release/api/usd_physics_page_front.html",
         .extensions = {"usd", "usda", "usdc", "usdz"}});
}
