// An SDF that libsdformat has read.
#pragma once

#include "references.hpp"

#include <foam/sdk/context.hpp>

#include <sdf/Root.hh>

#include <filesystem>
#include <string>
#include <vector>

namespace foam::load_sdf {

/// A place in a file.
struct Place {
    std::filesystem::path file;
    int line = 0; ///< 1-based; 0: not known
};

class Document {
public:
    /// Reads the text and the files that it includes. Throws Error(input) for what libsdformat refuses, and logs what
    /// it warns of.
    Document(const std::string& text, const std::filesystem::path& file, References& references, Context& context);

    const ::sdf::Root& root() const { return root_; }
    const std::filesystem::path& file() const { return file_; }
    /// Whether links are called after their model as well: there is more than one <model> or <include>.
    bool scoped() const { return scoped_; }

    /// Returns the files that it includes, sorted.
    std::vector<std::filesystem::path> included() const;
    /// Returns the file that an element stands in, and its line.
    Place place_of(const ::sdf::ElementPtr& element) const;
    /// Returns the line of an element of the text itself; 0 for one of an included file.
    int own_line(const ::sdf::ElementPtr& element) const;
    /// Returns "file:line".
    std::string shown_place(const ::sdf::ElementPtr& element) const;
    /// Throws Error(input) "file:line: what".
    [[noreturn]] void fail(const ::sdf::ElementPtr& element, const std::string& what) const;
    /// Throws the first of libsdformat's errors as Error(input); does nothing if there is none.
    void require_none(const ::sdf::Errors& errors) const;

private:
    std::string message_of(const ::sdf::Error& error) const;
    void log_warnings(const ::sdf::Errors& warnings, Context& context) const;

    std::filesystem::path file_;
    bool scoped_ = false;
    ::sdf::Root root_;
};

} // namespace foam::load_sdf
