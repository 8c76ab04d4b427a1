#include "elf_note.hpp"

#include <elf.h>

#include <cstring>
#include <fstream>
#include <iterator>

namespace foam {
namespace {

/// A read-only view of the file's bytes that refuses to look outside them.
class Bytes {
public:
    explicit Bytes(std::string data) : data_(std::move(data)) {}

    template <class T> bool read(std::uint64_t offset, T& value) const {
        if (offset > data_.size() || data_.size() - offset < sizeof(T)) {
            return false;
        }
        std::memcpy(&value, data_.data() + offset, sizeof(T));
        return true;
    }
    std::optional<std::string> text(std::uint64_t offset, std::uint64_t size) const {
        if (offset > data_.size() || data_.size() - offset < size) {
            return std::nullopt;
        }
        return data_.substr(offset, size);
    }

private:
    std::string data_;
};

constexpr std::uint64_t aligned(std::uint64_t size) {
    return (size + 3) / 4 * 4;
}

std::optional<std::string> find_note(const Bytes& bytes, std::uint64_t offset, std::uint64_t size) {
    for (std::uint64_t at = 0; at + sizeof(Elf64_Nhdr) <= size;) {
        Elf64_Nhdr note{};
        if (!bytes.read(offset + at, note)) {
            return std::nullopt;
        }
        const std::uint64_t name_at = offset + at + sizeof note;
        const std::uint64_t description_at = name_at + aligned(note.n_namesz);
        const auto name = bytes.text(name_at, note.n_namesz);
        if (name && note.n_type == 1 && *name == std::string("foam", 5)) {
            if (auto text = bytes.text(description_at, note.n_descsz)) {
                return text->substr(0, text->find('\0'));
            }
        }
        at += sizeof note + aligned(note.n_namesz) + aligned(note.n_descsz);
    }
    return std::nullopt;
}

} // namespace

ElfNote read_foam_note(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        return {"the file cannot be read", {}};
    }
    const Bytes bytes(std::string(std::istreambuf_iterator<char>(stream), {}));
    Elf64_Ehdr header{};
    if (!bytes.read(0, header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) {
        return {"it is not a shared library (no ELF header)", {}};
    }
    Elf64_Ehdr own{};
    std::ifstream("/proc/self/exe", std::ios::binary).read(reinterpret_cast<char*>(&own), sizeof own);
    if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_machine != own.e_machine) {
        return {"it is built for another processor", {}};
    }
    if (header.e_type != ET_DYN) {
        return {"it is an ELF file, but not a shared library", {}};
    }
    for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
        Elf64_Phdr segment{};
        if (!bytes.read(header.e_phoff + i * header.e_phentsize, segment)) {
            return {"its ELF header is damaged (the file is cut off)", {}};
        }
        if (segment.p_type == PT_NOTE) {
            if (auto found = find_note(bytes, segment.p_offset, segment.p_filesz)) {
                return {"", found};
            }
        }
    }
    return {};
}

} // namespace foam
