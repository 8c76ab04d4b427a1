#include <foam/sdk/context.hpp>

#include <foam/base/error.hpp>

namespace foam::inline sdk {

Context::~Context() = default;

void Context::check_cancelled() const {
    if (cancelled()) {
        throw Error(ErrorCode::cancelled, "cancelled");
    }
}

QuietContext::QuietContext(std::uint64_t seed) : seed_(seed) {}
QuietContext::~QuietContext() = default;
std::uint64_t QuietContext::seed() const {
    return seed_;
}
bool QuietContext::cancelled() const {
    return false;
}
void QuietContext::progress(double) {}
void QuietContext::log(Severity, std::string_view) {}
void QuietContext::metric(std::string_view, double, std::string_view) {}

} // namespace foam::sdk
