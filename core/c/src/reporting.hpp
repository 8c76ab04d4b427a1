// Errors as codes with texts.
#pragma once

#include <foam.h>

#include <foam/base/error.hpp>

#include <string>

namespace foam::c {

/// Returns the error of a wrong argument.
Error usage(const std::string& message);
/// Describes the exception that is being handled in the report, and returns its code.
int describe_failure(foam_report& report) noexcept;
/// Throws Error(usage) unless the caller has set the member `size` of a struct that the library fills.
void require_size(std::size_t size, std::size_t expected, const char* name);

/// Calls body(), and reports what it throws.
template <class Body> int reported(foam_report* report, Body body) noexcept {
    if (!report || report->size != sizeof(foam_report)) {
        return FOAM_USAGE; // there is no place for a text
    }
    *report = foam_report{};
    report->size = sizeof(foam_report);
    try {
        body();
        return FOAM_OK;
    } catch (...) {
        return describe_failure(*report);
    }
}

/// Throws Error(usage) for a null pointer, whose name and remedy are given.
void require_given(const void* pointer, const char* name, const char* remedy);

/// Sets a handle that a call is to make to null. Throws Error(usage) without a place for it.
template <class Handle> void require_place(Handle** place, const char* name) {
    require_given(place, name, "the address of a pointer");
    *place = nullptr;
}

} // namespace foam::c
