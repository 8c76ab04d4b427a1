#include "plugin_file.hpp"

#include <fmt/format.h>

#include <elf.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

namespace foam::inline sdk {
namespace {

/// A read-only view of the file's bytes with bounds checks. Reads only the requested bytes.
class Bytes {
public:
    explicit Bytes(const std::filesystem::path& file) : stream_(file, std::ios::binary) {
        std::error_code error;
        const std::uintmax_t size = std::filesystem::file_size(file, error);
        size_ = error ? 0 : size;
    }

    bool readable() const { return static_cast<bool>(stream_); }
    bool holds(std::uint64_t offset, std::uint64_t size) const { return offset <= size_ && size_ - offset >= size; }

    template <class T> bool read(std::uint64_t offset, T& value) { return read(offset, sizeof(T), &value); }
    std::optional<std::string> text(std::uint64_t offset, std::uint64_t size) {
        constexpr std::uint64_t longest = 1 << 20;
        std::string result(static_cast<std::size_t>(std::min(size, longest)), '\0');
        return size <= longest && read(offset, size, result.data()) ? std::optional(result) : std::nullopt;
    }

private:
    bool read(std::uint64_t offset, std::uint64_t size, void* target) {
        if (!holds(offset, size)) {
            return false;
        }
        stream_.clear();
        stream_.seekg(static_cast<std::streamoff>(offset));
        stream_.read(static_cast<char*>(target), static_cast<std::streamsize>(size));
        return static_cast<bool>(stream_);
    }

    std::ifstream stream_;
    std::uint64_t size_ = 0;
};

constexpr std::uint64_t aligned(std::uint64_t size) {
    return (size + 3) / 4 * 4;
}

/// The name of a note, with the zero at its end, and its type.
struct NoteKind {
    std::string_view name;
    std::uint32_t type;
};
constexpr NoteKind fingerprint_note{{"foam", 5}, 1}, build_id_note{{"GNU", 4}, NT_GNU_BUILD_ID};

/// Returns the description of the first note of that kind.
std::optional<std::string> find_note(std::string_view notes, const NoteKind& kind) {
    constexpr std::uint64_t longest = 4096;
    while (notes.size() >= sizeof(Elf64_Nhdr)) {
        Elf64_Nhdr note{};
        std::memcpy(&note, notes.data(), sizeof note);
        const std::uint64_t description_at = sizeof note + aligned(note.n_namesz);
        const std::uint64_t next = description_at + aligned(note.n_descsz);
        if (note.n_type == kind.type && note.n_namesz == kind.name.size() && note.n_descsz <= longest &&
            description_at + note.n_descsz <= notes.size() &&
            notes.substr(sizeof note, kind.name.size()) == kind.name) {
            return std::string(notes.substr(description_at, note.n_descsz));
        }
        notes.remove_prefix(std::min<std::uint64_t>(next, notes.size()));
    }
    return std::nullopt;
}

std::string processor(unsigned char file_class, std::uint16_t machine) {
    static constexpr std::pair<std::uint16_t, const char*> names[] = {
        {EM_X86_64, "x86-64"}, {EM_AARCH64, "ARM 64"}, {EM_RISCV, "RISC-V"}, {EM_386, "x86 32"},
        {EM_ARM, "ARM 32"},    {EM_PPC64, "POWER"},    {EM_S390, "s390"}};
    std::string name = fmt::format("processor {}", machine);
    for (const auto& [number, text] : names) {
        name = number == machine ? text : name;
    }
    const bool narrow = file_class != ELFCLASS64 && !name.ends_with(" 32");
    return narrow ? name + " (32 bits)" : name;
}

/// Returns why the file's segments cannot be mapped; empty if they can. To map a truncated file would end the process.
std::string read_segments(Bytes& bytes, const Elf64_Ehdr& header, std::vector<Elf64_Phdr>& segments) {
    constexpr const char* cut_off =
        "its ELF structure is damaged (the file is cut off); remedy: build or copy it again";
    for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
        Elf64_Phdr segment{};
        if (!bytes.read(header.e_phoff + i * header.e_phentsize, segment) ||
            (segment.p_type != PT_NULL && !bytes.holds(segment.p_offset, segment.p_filesz))) {
            return cut_off;
        }
        segments.push_back(segment);
    }
    // Linkers write the section headers last: if they are there, the file is complete.
    const bool whole = bytes.holds(header.e_shoff, std::uint64_t{header.e_shnum} * header.e_shentsize);
    return whole ? "" : cut_off;
}

} // namespace

ElfNote read_foam_note(const std::filesystem::path& file) {
    Bytes bytes(file);
    if (!bytes.readable()) {
        return {"the file cannot be read; remedy: check its permissions", {}, {}};
    }
    Elf64_Ehdr header{};
    if (!bytes.read(0, header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) {
        return {"it is no shared library (it has no ELF header); remedy: build it with foam_add_plugin()", {}, {}};
    }
    Elf64_Ehdr own{};
    std::ifstream("/proc/self/exe", std::ios::binary).read(reinterpret_cast<char*>(&own), sizeof own);
    if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_machine != own.e_machine) {
        return {fmt::format("it is built for {}, this foam for {}; remedy: build it for this machine",
                            processor(header.e_ident[EI_CLASS], header.e_machine),
                            processor(own.e_ident[EI_CLASS], own.e_machine)),
                {}, {}};
    }
    if (header.e_type != ET_DYN) {
        return {"it is an ELF file, but no shared library; remedy: build it with foam_add_plugin()", {}, {}};
    }
    std::vector<Elf64_Phdr> segments;
    if (const std::string why = read_segments(bytes, header, segments); !why.empty()) {
        return {why, {}, {}};
    }
    ElfNote result;
    for (const Elf64_Phdr& segment : segments) {
        if (segment.p_type != PT_NOTE) {
            continue;
        }
        const std::string notes = bytes.text(segment.p_offset, segment.p_filesz).value_or("");
        if (const auto found = find_note(notes, fingerprint_note); found && !result.fingerprint) {
            result.fingerprint = found->substr(0, found->find('\0'));
        }
        result.build_id = result.build_id.empty() ? build_id_in(notes) : result.build_id;
    }
    return result;
}

std::string build_id_in(std::string_view notes) {
    std::string digits;
    for (const char byte : find_note(notes, build_id_note).value_or("")) {
        digits += fmt::format("{:02x}", static_cast<unsigned char>(byte));
    }
    return digits;
}

} // namespace foam::sdk
