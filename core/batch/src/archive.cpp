#include "archive.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <zip.h>

#include <cstdio>

namespace foam::inline batch {
namespace {

constexpr std::uintmax_t most_member_bytes = std::uintmax_t{1} << 32;

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view why) {
    throw Error(ErrorCode::input, fmt::format("{}: {}", file.string(), why));
}

[[noreturn]] void refuse_member(const std::filesystem::path& file, const std::string& member) {
    refuse(file, fmt::format("no file '{}' in the archive; remedy: check the part of the path behind '::'", member));
}

void require_size(const std::filesystem::path& file, const std::string& member, std::uintmax_t bytes) {
    if (bytes > most_member_bytes) {
        refuse(file, fmt::format("'{}' has {} bytes; the limit is {}", member, bytes, most_member_bytes));
    }
}

/// By libzip: its table of contents lies at the end of the file, so that each member is reached at once.
class ZipArchive final : public Archive {
public:
    explicit ZipArchive(const std::filesystem::path& file) : file_(file) {
        int code = 0;
        zip_.reset(zip_open(file.c_str(), ZIP_RDONLY, &code));
        if (!zip_) {
            zip_error_t error;
            zip_error_init_with_code(&error, code);
            const std::string why = zip_error_strerror(&error);
            zip_error_fini(&error);
            refuse(file, fmt::format("not a ZIP archive that can be read ({})", why));
        }
    }
    std::vector<ArchiveMember> members() const override {
        std::vector<ArchiveMember> result;
        for (zip_int64_t i = 0; i < zip_get_num_entries(zip_.get(), 0); ++i) {
            zip_stat_t stat;
            if (zip_stat_index(zip_.get(), static_cast<zip_uint64_t>(i), ZIP_FL_ENC_RAW, &stat) == 0 &&
                !std::string_view(stat.name).ends_with('/')) {
                result.push_back({stat.name, stat.size});
            }
        }
        return result;
    }
    std::string read(const std::string& member) override {
        zip_stat_t stat;
        if (zip_stat(zip_.get(), member.c_str(), ZIP_FL_ENC_RAW, &stat) != 0) {
            refuse_member(file_, member);
        }
        require_size(file_, member, stat.size);
        const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> opened(zip_fopen_index(zip_.get(), stat.index, 0),
                                                                        &zip_fclose);
        std::string bytes(stat.size, '\0');
        const zip_int64_t got = opened ? zip_fread(opened.get(), bytes.data(), bytes.size()) : -1;
        if (got < 0 || static_cast<std::size_t>(got) != bytes.size()) {
            refuse(file_, fmt::format("'{}' cannot be unpacked ({})", member,
                                      opened ? zip_file_strerror(opened.get()) : zip_strerror(zip_.get())));
        }
        // libzip compares the checksum where the file ends.
        char more = 0;
        if (zip_fread(opened.get(), &more, 1) != 0) {
            refuse(file_, fmt::format("'{}' is damaged ({}); remedy: make or copy the archive again", member,
                                      zip_error_code_zip(zip_file_get_error(opened.get())) != ZIP_ER_OK
                                          ? zip_file_strerror(opened.get())
                                          : "it is longer than the archive says"));
        }
        return bytes;
    }

private:
    struct Discard {
        void operator()(zip_t* zip) const { zip_discard(zip); }
    };
    std::filesystem::path file_;
    std::unique_ptr<zip_t, Discard> zip_;
};

/// By libarchive, which reads a tar from its beginning. The places of the headers are kept, so that a member is read
/// from its own header on.
class TarArchive final : public Archive {
public:
    explicit TarArchive(const std::filesystem::path& file) : file_(file) {
        const auto reader = read_from(0);
        archive_entry* entry = nullptr;
        for (int code = 0; (code = archive_read_next_header(reader.get(), &entry)) != ARCHIVE_EOF;) {
            if (code < ARCHIVE_WARN) {
                refuse(file, fmt::format("not a tar archive that can be read ({})", text_of(*reader)));
            }
            const char* name = archive_entry_pathname(entry);
            const char* linked = archive_entry_hardlink(entry);
            if (name && (linked || archive_entry_filetype(entry) == AE_IFREG)) {
                add(name, linked, static_cast<std::uintmax_t>(archive_entry_size(entry)),
                    archive_read_header_position(reader.get()));
            }
        }
    }
    std::vector<ArchiveMember> members() const override {
        std::vector<ArchiveMember> members;
        for (const auto& [name, place] : places_) {
            members.push_back({name, place.bytes});
        }
        return members;
    }
    std::string read(const std::string& member) override {
        const auto place = places_.find(member);
        if (place == places_.end()) {
            refuse_member(file_, member);
        }
        const auto reader = read_from(place->second.header);
        archive_entry* entry = nullptr;
        if (archive_read_next_header(reader.get(), &entry) < ARCHIVE_WARN) {
            refuse(file_, fmt::format("'{}' cannot be read ({})", member, text_of(*reader)));
        }
        const auto size = static_cast<std::uintmax_t>(archive_entry_size(entry));
        require_size(file_, member, size);
        std::string bytes(size, '\0');
        if (archive_read_data(reader.get(), bytes.data(), bytes.size()) != static_cast<la_ssize_t>(size)) {
            refuse(file_, fmt::format("'{}' cannot be read ({})", member, text_of(*reader)));
        }
        return bytes;
    }

private:
    struct Free {
        void operator()(struct archive* reader) const { archive_read_free(reader); }
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    using Reader = std::unique_ptr<struct archive, Free>;

    struct Place {
        std::int64_t header = 0;
        std::uintmax_t bytes = 0;
    };

    /// Keeps the place of a member. Of several with one name the last one counts, as tar itself unpacks them; a hard
    /// link has the content of the member that it names.
    void add(const std::string& name, const char* linked, std::uintmax_t bytes, std::int64_t header) {
        const auto target = places_.find(linked ? linked : "");
        places_[name] = target == places_.end() ? Place{header, bytes} : target->second;
    }
    static std::string text_of(struct archive& reader) {
        const char* text = archive_error_string(&reader);
        return text ? text : "unknown error";
    }
    /// A reader of the tar that begins at a header.
    Reader read_from(std::int64_t position) {
        stream_.reset(std::fopen(file_.c_str(), "rbe"));
        Reader reader(archive_read_new());
        archive_read_support_format_tar(reader.get());
        if (!stream_ || fseeko(stream_.get(), position, SEEK_SET) != 0 ||
            archive_read_open_FILE(reader.get(), stream_.get()) != ARCHIVE_OK) {
            refuse(file_, "not a tar archive that can be read");
        }
        return reader;
    }

    std::filesystem::path file_;
    std::unique_ptr<std::FILE, Free> stream_;
    std::map<std::string, Place> places_;
};

} // namespace

std::optional<ArchivePath> archive_path(std::string_view path) {
    constexpr std::string_view between = "::";
    for (std::size_t at = 0; (at = path.find(between, at)) != std::string_view::npos; ++at) {
        if (is_archive(path.substr(0, at))) {
            return ArchivePath{path.substr(0, at), std::string(path.substr(at + between.size()))};
        }
    }
    return {};
}

bool is_archive(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    return extension == "zip" || extension == "tar";
}

std::unique_ptr<Archive> open_archive(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        refuse(file, "there is no such archive; remedy: check the path");
    }
    if (extension_of(file) == "zip") {
        return std::make_unique<ZipArchive>(file);
    }
    return std::make_unique<TarArchive>(file);
}

Archive& Archives::at(const std::filesystem::path& file) {
    std::unique_ptr<Archive>& open = open_[file];
    if (!open) {
        open = open_archive(file);
    }
    return *open;
}

} // namespace foam::batch
