// write.csv: one sphere per row, "link,x,y,z,radius". Where there are other elements, one element per row, with its
// kind, its edges, its length along z or its diameters, and its rotation by rows. Quoting of RFC 4180; lines end with "\n".
#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

namespace foam {
namespace {

constexpr std::string_view header = "link,x,y,z,radius";
constexpr std::string_view element_header =
    "link,kind,x,y,z,radius,size_x,size_y,size_z,r11,r12,r13,r21,r22,r23,r31,r32,r33";

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

/// Returns the numbers of a row, from a field on to the end.
template <std::size_t count>
std::array<double, count> numbers_of(const std::vector<std::string>& row, std::size_t first, std::size_t number) {
    std::array<double, count> values{};
    if (row.size() != first + count) {
        throw Error(ErrorCode::output,
                    fmt::format("CSV: row {} has {} fields, not {}", number, row.size(), first + count));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<double> value = parse_number(row[i + first]);
        if (!value) {
            throw Error(ErrorCode::output,
                        fmt::format("CSV: row {}: '{}' is not a finite number", number, shown(row[i + first])));
        }
        values[i] = *value;
    }
    return values;
}

Sphere read_sphere(const std::vector<std::string>& row, std::size_t number) {
    const auto values = numbers_of<4>(row, 1, number);
    return {{values[0], values[1], values[2]}, values[3]};
}

Element read_element(const std::vector<std::string>& row, std::size_t number) {
    const auto v = numbers_of<16>(row, 2, number);
    const std::optional<Element::Kind> kind = element_kind_named(row[1]);
    Element element;
    if (kind && *kind != Element::Kind::hull) {
        element = {.kind = *kind, .half = Vec3{v[4], v[5], v[6]} * 0.5, .radius = v[3]};
        element.pose.translation = {v[0], v[1], v[2]};
        element.pose.rotation = {Vec3{v[7], v[8], v[9]}, Vec3{v[10], v[11], v[12]}, Vec3{v[13], v[14], v[15]}};
    }
    if (!kind || !is_valid(element)) {
        throw Error(ErrorCode::output,
                    fmt::format("CSV: row {}: a '{}' with these numbers is no element", number, shown(row[1])));
    }
    return element;
}

std::string element_row(const std::string& name, const Element& element) {
    if (element.kind == Element::Kind::hull) {
        throw Error(ErrorCode::output, "write.csv: a row holds no hull; remedy: write.json");
    }
    std::string text = name + ',' + to_string(element.kind);
    const auto append = [&](std::initializer_list<double> numbers) {
        for (const double number : numbers) {
            text += ',' + number_text(number);
        }
    };
    const auto& [a, b, c] = element.pose.rotation;
    const Vec3 &p = element.pose.translation, size = element.half * 2;
    append({p.x, p.y, p.z, element.radius, size.x, size.y, size.z});
    append({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z});
    return text + '\n';
}

/// Returns all kinds but the hull, which no row holds.
std::vector<Element::Kind> kinds_of_rows() {
    std::vector<Element::Kind> kinds = every_kind();
    std::erase(kinds, Element::Kind::hull);
    return kinds;
}

class CsvWriter final : public Writer {
public:
    explicit CsvWriter(const Parameters& parameters) : level_(static_cast<int>(parameters.integer("level"))) {}

    std::string write(const SphereModel& model, Context&) const override {
        const std::vector<LinkSpheres> links = elements_by_link(model, level_);
        const bool others =
            std::any_of(links.begin(), links.end(), [](const LinkSpheres& link) { return !link.elements.are_spheres(); });
        std::string text(others ? element_header : header);
        text += '\n';
        for (const LinkSpheres& link : links) {
            const std::string name = quoted(link.link);
            CancellationCounter asking(1024);
            for (const Element& element : link.elements.shaped()) {
                asking.check();
                text += element_row(name, element);
            }
            for (const Sphere& s : link.elements.spheres()) {
                asking.check();
                if (others) {
                    text += element_row(name, {.pose = {.translation = s.center}, .radius = s.radius});
                    continue;
                }
                text += name + ',' + number_text(s.center.x) + ',' + number_text(s.center.y) + ',' +
                        number_text(s.center.z) + ',' + number_text(s.radius) + '\n';
            }
        }
        return text;
    }

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>&) const override {
        RowReader rows(bytes);
        const std::string first = rows.at_end() ? "" : fmt::format("{}", fmt::join(rows.next(), ","));
        const bool others = first == element_header;
        if (!others && first != header) {
            throw Error(ErrorCode::output, fmt::format("CSV: the first row is not '{}'", header));
        }
        std::map<std::string, Elements> result;
        CancellationCounter asking(1024);
        for (std::size_t number = 2; !rows.at_end(); ++number) {
            asking.check();
            const std::vector<std::string> row = rows.next();
            if (others) {
                result[row.front()].add(read_element(row, number));
            } else {
                result[row.front()].add(read_sphere(row, number));
            }
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
         .summary =
             "Writes a table of spheres: link, x, y, z, radius; metres, link frames. With elements of other kinds "
             "also kind, size and rotation.",
         .reference = "RFC 4180",
         .parameters = {Parameter::integer("level", -1)
                            .bounds(-1, 32)
                            .doc("Level of the sphere trees that is written: 0 the bounding spheres, -1 the finest.")
                            .source("The finest level is the one that is measured and proved.")},
         .extensions = {"csv"},
         .kinds = foam::kinds_of_rows()});
    enrol.add<foam::CsvModelReader>({.name = "read.csv",
                                     .summary = "Reads the table of write.csv: spheres, or elements of several kinds.",
                                     .reference = "RFC 4180",
                                     .extensions = {"csv"},
                                     .uses = {"write.csv"}});
}
