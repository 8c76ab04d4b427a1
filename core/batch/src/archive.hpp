// Meshes in archives: "FILE.zip::MEMBER", "FILE.tar::MEMBER".
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam::inline batch {

/// The parts of a path into an archive.
struct ArchivePath {
    std::filesystem::path archive;
    std::string member;
};
/// Returns them; nothing for a path of a file outside archives.
std::optional<ArchivePath> archive_path(std::string_view path);

/// Whether the extension is that of an archive that foam reads: .zip or .tar.
bool is_archive(const std::filesystem::path& file);

/// A file of an archive.
struct ArchiveMember {
    std::string name;
    std::uintmax_t bytes = 0;
};

/// An open archive.
class Archive {
public:
    virtual ~Archive() = default;
    /// Returns the files, each once.
    virtual std::vector<ArchiveMember> members() const = 0;
    /// Returns the content of a file. Throws Error(input) if there is none of that name, or if it cannot be read. It
    /// reads that file alone.
    virtual std::string read(const std::string& member) = 0;
};

/// Opens an archive. O(members). Throws Error(input).
std::unique_ptr<Archive> open_archive(const std::filesystem::path& file);

/// Archives that stay open.
class Archives {
public:
    Archive& at(const std::filesystem::path& file);

private:
    std::map<std::filesystem::path, std::unique_ptr<Archive>> open_;
};

} // namespace foam::batch
