// A reader that recognises every file.
#include <foam/sdk/plugin.hpp>

namespace {

class Greedy final : public foam::ModelReader {
public:
    bool recognises(std::string_view) const override { return true; }
    foam::SphereFile read(const std::string&, const std::filesystem::path&, foam::Context&) const override { return {}; }
};

} // namespace

FOAM_PLUGIN("greedy_reader", "1.0", "Apache-2.0") {
    enrol.add<Greedy>({.name = "read.greedy", .summary = "For tests."});
}
