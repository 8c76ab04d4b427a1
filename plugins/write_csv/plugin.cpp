// write.csv: one sphere per row, "link,x,y,z,radius". Quoting of RFC 4180; lines end with "\n".
#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

namespace foam {
namespace {

constexpr std::string_view header = "link,x,y,z,radius";

std::string quoted(const std::string& field) {
    if (field.find_first_of(",\"\r\n") == std::string::npos) {
        return field;
    }
    std::string result = "\"";
    for (const char c : field) {
        result += c == '"' ? "\"\"" : std::string(1, c);
    }
    return result + '"';
}

/// Splits RFC 4180 text into rows of fields.
class RowReader {
public:
    explicit RowReader(std::string_view text) : rest_(text) {}

    bool at_end() const { return rest_.empty(); }

    std::vector<std::string> next() {
        std::vector<std::string> fields{field()};
        while (take(',')) {
            fields.push_back(field());
        }
        take('\r');
        if (!take('\n') && !at_end()) {
            throw Error(ErrorCode::output, "CSV: text after a closing quote");
        }
        return fields;
    }

private:
    bool take(char c) {
        const bool there = rest_.starts_with(c);
        rest_.remove_prefix(there ? 1 : 0);
        return there;
    }

    std::string field() {
        if (take('"')) {
            return quoted_field();
        }
        const std::size_t end = std::min(rest_.find_first_of(",\r\n"), rest_.size());
        const std::string result(rest_.substr(0, end));
        rest_.remove_prefix(end);
        return result;
    }

    std::string quoted_field() {
        std::string result;
        for (;;) {
            const std::size_t end = rest_.find('"');
            if (end == std::string_view::npos) {
                throw Error(ErrorCode::output, "CSV: a quoted field does not end");
            }
            result += rest_.substr(0, end);
            rest_.remove_prefix(end + 1);
            if (!take('"')) {
                return result;
            }
            result += '"';
        }
    }

    std::string_view rest_;
};

Sphere read_sphere(const std::vector<std::string>& row, std::size_t number) {
    std::array<double, 4> values{};
    if (row.size() != values.size() + 1) {
        throw Error(ErrorCode::output, fmt::format("CSV: row {} has {} fields, not 5", number, row.size()));
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::optional<double> value = parse_number(row[i + 1]);
        if (!value) {
            throw Error(ErrorCode::output,
                        fmt::format("CSV: row {}: '{}' is not a finite number", number, shown(row[i + 1])));
        }
        values[i] = *value;
    }
    return {{values[0], values[1], values[2]}, values[3]};
}

class CsvWriter final : public Writer {
public:
    explicit CsvWriter(const Parameters& parameters) : level_(static_cast<int>(parameters.integer("level"))) {}

    std::string write(const SphereModel& model, Context&) const override {
        std::string text(header);
        text += '\n';
        for (const LinkSpheres& link : spheres_by_link(model, level_)) {
            const std::string name = quoted(link.link);
            CancellationCounter asking(1024);
            for (const Sphere& s : link.spheres) {
                asking.check();
                text += name + ',' + number_text(s.center.x) + ',' + number_text(s.center.y) + ',' +
                        number_text(s.center.z) + ',' + number_text(s.radius) + '\n';
            }
        }
        return text;
    }

    std::map<std::string, std::vector<Sphere>> read(const std::string& bytes) const override {
        RowReader rows(bytes);
        if (rows.at_end() || fmt::format("{}", fmt::join(rows.next(), ",")) != header) {
            throw Error(ErrorCode::output, fmt::format("CSV: the first row is not '{}'", header));
        }
        std::map<std::string, std::vector<Sphere>> result;
        CancellationCounter asking(1024);
        for (std::size_t number = 2; !rows.at_end(); ++number) {
            asking.check();
            const std::vector<std::string> row = rows.next();
            result[row.front()].push_back(read_sphere(row, number));
        }
        return result;
    }

private:
    int level_;
};

class CsvModelReader final : public ModelReader {
public:
    CsvModelReader(const Parameters&, const StageMaker& maker) : writer_(maker.make<Writer>("write.csv")) {}

    bool recognises(std::string_view text) const override { return text.starts_with("link,"); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_written(*writer_, text, file, "CSV", "write the file again with write.csv");
    }

private:
    std::unique_ptr<Writer> writer_;
};

} // namespace
} // namespace foam

FOAM_PLUGIN("write_csv", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::CsvWriter>(
        {.name = "write.csv",
         .summary = "Writes a table of spheres: link, x, y, z, radius; metres, link frames.",
         .reference = "RFC 4180",
         .parameters = {Parameter::integer("level", -1)
                            .bounds(-1, 32)
                            .doc("Level of the sphere trees that is written: 0 the bounding spheres, -1 the finest.")
                            .source("The finest level is the one that is measured and proved.")},
         .extensions = {"csv"}});
    enrol.add<foam::CsvModelReader>({.name = "read.csv",
                                     .summary = "Reads the table of write.csv: link, x, y, z, radius.",
                                     .reference = "RFC 4180",
                                     .extensions = {"csv"},
                                     .uses = {"write.csv"}});
}
