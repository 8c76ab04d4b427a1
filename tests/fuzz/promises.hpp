// What a reader must keep whatever the file holds.
#pragma once

#include <foam/base/error.hpp>

#include <stdexcept>
#include <string>
#include <string_view>

namespace foam::fuzz {

/// Thrown for a broken promise: a bug of foam.
class BrokenPromise : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

inline void promise(bool kept, const std::string& what) {
    if (!kept) {
        throw BrokenPromise(what);
    }
}

/// A refusal is an Error(input) whose message starts with the file's name.
inline void check_refusal(const Error& error, std::string_view file) {
    promise(error.code() == ErrorCode::input, std::string("not an input error: ") + error.what());
    promise(std::string_view(error.what()).starts_with(file), std::string("does not name the file: ") + error.what());
}

} // namespace foam::fuzz
