// A writer that wishes for a process of its own, which calls of writers never have.
#include "stage.hpp"

namespace {

class Text final : public foam::Writer {
public:
    std::string write(const foam::SphereModel&, foam::Context&) const override { return ""; }
    std::map<std::string, foam::Elements> read(const std::string&, const std::map<std::string, std::string>&) const override { return {}; }
};

} // namespace

FOAM_PLUGIN("isolation_of_writer", "1.0", "Apache-2.0") {
    foam::StageInfo writer = info("write.apart");
    writer.isolation.process = true;
    enrol.add<Text>(writer);
}
