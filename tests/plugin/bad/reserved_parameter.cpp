// A writer whose parameter has the name of the key that says where to write.
#include <foam/sdk/plugin.hpp>

namespace {

class Text final : public foam::Writer {
public:
    explicit Text(const foam::Parameters&) {}
    std::string write(const foam::SphereModel&, foam::Context&) const override { return ""; }
    std::map<std::string, foam::Elements> read(const std::string&, const std::map<std::string, std::string>&) const override { return {}; }
};

} // namespace

FOAM_PLUGIN("reserved_parameter", "1.0", "Apache-2.0") {
    enrol.add<Text>({.name = "write.reserved",
                     .summary = "For tests.",
                     .reference = "",
                     .parameters = {foam::Parameter::text("file", "a").doc("Where to write.")},
                     .extensions = {"txt"}});
}
