#include <foam/base/error.hpp>

namespace foam::inline base {

Error::Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
Error::Error(const Error&) = default;
Error::~Error() = default;

const char* to_string(ErrorCode code) {
    switch (code) {
    case ErrorCode::usage:
        return "usage";
    case ErrorCode::recipe:
        return "recipe";
    case ErrorCode::plugin:
        return "plugin";
    case ErrorCode::input:
        return "input";
    case ErrorCode::geometry:
        return "geometry";
    case ErrorCode::output:
        return "output";
    case ErrorCode::internal:
        return "internal";
    case ErrorCode::cancelled:
        return "cancelled";
    }
    return "internal";
}

int exit_code(ErrorCode code) {
    switch (code) {
    case ErrorCode::usage:
    case ErrorCode::recipe:
        return 2;
    case ErrorCode::plugin:
        return 3;
    case ErrorCode::cancelled:
        return 130;
    case ErrorCode::input:
    case ErrorCode::geometry:
    case ErrorCode::output:
    case ErrorCode::internal:
        break;
    }
    return 1;
}

} // namespace foam::base
