#include "reporting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <string_view>

namespace foam::c {

Error usage(const std::string& message) {
    return Error(ErrorCode::usage, message);
}

static int status_of(ErrorCode code) {
    switch (code) {
    case ErrorCode::usage:
        return FOAM_USAGE;
    case ErrorCode::input:
    case ErrorCode::geometry:
        return FOAM_GEOMETRY;
    case ErrorCode::cancelled:
        return FOAM_CANCELLED;
    default:
        return FOAM_INTERNAL;
    }
}

/// Writes a text that a caller can print: one line, cut between characters.
static void tell(foam_report& report, std::string_view text) noexcept {
    std::size_t length = std::min(text.size(), sizeof report.error - 1);
    while (length < text.size() && length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80) {
        --length;
    }
    std::copy_n(text.data(), length, report.error);
    std::replace(report.error, report.error + length, '\n', ' ');
    report.error[length] = 0;
}

int describe_failure(foam_report& report) noexcept {
    try {
        throw;
    } catch (const Error& error) {
        tell(report, error.what());
        return status_of(error.code());
    } catch (const std::bad_alloc&) {
        tell(report, "there is not enough memory; remedy: fewer triangles or elements");
        return FOAM_MEMORY;
    } catch (const std::exception& error) {
        tell(report, error.what());
    } catch (...) {
        tell(report, "an exception of an unknown type; remedy: let no exception leave options->poll");
    }
    return FOAM_INTERNAL;
}

void require_size(std::size_t size, std::size_t expected, const char* name) {
    if (size != expected) {
        throw usage(fmt::format("{0}->size is {1}, not {2}; remedy: set .size = sizeof(foam_{0}), and compile with the "
                                "foam.h of this library, version " FOAM_VERSION,
                                name, size, expected));
    }
}

void require_given(const void* pointer, const char* name, const char* remedy) {
    if (!pointer) {
        throw usage(fmt::format("{} is NULL; remedy: {}", name, remedy));
    }
}

} // namespace foam::c
