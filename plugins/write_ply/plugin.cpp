// write.ply: spheres as a point set or as surfaces, in ASCII PLY (Turk 1994, "The PLY polygon file format").
//
// form: points   element vertex: x, y, z, radius, link - a point a sphere
// form: surface  element vertex and face: the spheres as icospheres, for viewers, the robot standing in its zero pose;
//                element sphere: x, y, z, radius, link
//
// Elements of other kinds are the rows of a last element `other`: link, kind (0 sphere, 1 capsule, 2 cylinder, 3 box, 4
// swept box, 5 hull, 6 ellipsoid) and a list of numbers: position, rotation by rows, length or edges, radius, half axes,
// or corners.
//
// `link` is an index into the "comment link INDEX NAME" lines; control characters and % in names are percent-encoded
// there.

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/inscribed_mesh.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace foam {
namespace {

std::string encoded(std::string_view name) {
    std::string result;
    for (const char c : name) {
        const unsigned char byte = static_cast<unsigned char>(c);
        result += byte < 0x20 || byte == 0x7F || c == '%' ? fmt::format("%{:02X}", byte) : std::string(1, c);
    }
    return result;
}

std::string header_of(const std::vector<LinkSpheres>& links) {
    std::string text = "ply\nformat ascii 1.0\ncomment spheres in link frames, metres\n";
    for (std::size_t i = 0; i < links.size(); ++i) {
        text += fmt::format("comment link {} {}\n", i, encoded(links[i].link));
    }
    return text;
}

constexpr std::string_view sphere_properties = "property double x\nproperty double y\nproperty double z\n"
                                               "property double radius\nproperty int link\n";

std::string sphere_rows(const std::vector<LinkSpheres>& links) {
    std::string text;
    for (std::size_t i = 0; i < links.size(); ++i) {
        for (const Sphere& s : links[i].elements.spheres()) {
            text += number_text(s.center.x) + ' ' + number_text(s.center.y) + ' ' + number_text(s.center.z) + ' ' +
                    number_text(s.radius) + ' ' + std::to_string(i) + '\n';
        }
    }
    return text;
}

/// Returns the names of the numbers of a kind, and how many each has; 0: the rest.
std::vector<std::pair<std::string, std::size_t>> columns_of(Element::Kind kind) {
    std::vector<std::pair<std::string, std::size_t>> columns{{"position", 3}, {"rotation", 9}};
    for (const std::string_view name : number_names(kind)) {
        const bool three = name == "size" || name == "radii";
        columns.emplace_back(name, name == "vertices" ? 0 : three ? 3 : 1);
    }
    return columns;
}

std::size_t count_others(const std::vector<LinkSpheres>& links) {
    std::size_t result = 0;
    for (const LinkSpheres& link : links) {
        result += link.elements.shaped().size();
    }
    return result;
}

/// Returns the declaration of the rows of other_rows(); empty if there are none.
std::string other_header(const std::vector<LinkSpheres>& links) {
    const std::size_t others = count_others(links);
    return others == 0 ? ""
                       : fmt::format("element other {}\nproperty int link\nproperty int kind\n"
                                     "property list int double numbers\n",
                                     others);
}

std::string other_rows(const std::vector<LinkSpheres>& links) {
    std::string text;
    for (std::size_t i = 0; i < links.size(); ++i) {
        for (const Element& element : links[i].elements.shaped()) {
            std::string numbers;
            std::size_t count = 0;
            const ElementNumbers all = numbers_of(element);
            for (const auto& [name, size] : columns_of(element.kind)) {
                const auto found = std::find_if(all.begin(), all.end(),
                                                [&, &wanted = name](const auto& n) { return n.first == wanted; });
                const std::vector<double> none{1, 0, 0, 0, 1, 0, 0, 0, 1}; // a rotation that is not stated
                for (const double number : found == all.end() ? none : found->second) {
                    numbers += ' ' + number_text(number);
                    ++count;
                }
            }
            text += fmt::format("{} {} {}{}\n", i, static_cast<int>(element.kind), count, numbers);
        }
    }
    return text;
}

std::size_t count(const std::vector<LinkSpheres>& links) {
    std::size_t result = 0;
    for (const LinkSpheres& link : links) {
        result += link.elements.spheres().size();
    }
    return result;
}

std::string as_points(const std::vector<LinkSpheres>& links) {
    return header_of(links) +
           fmt::format("element vertex {}\n{}{}end_header\n", count(links), sphere_properties, other_header(links)) +
           sphere_rows(links) + other_rows(links);
}

std::string as_surface(const std::vector<LinkSpheres>& links, const std::map<std::string, Pose>& poses,
                       int subdivisions, Context& context) {
    const Mesh unit = icosphere(subdivisions);
    const std::size_t spheres = count(links);
    std::string vertices, faces;
    std::size_t first = 0, triangles = spheres * unit.triangles.size();
    const auto add_faces = [&](const Mesh& mesh) {
        for (const auto& [a, b, c] : mesh.triangles) {
            faces += fmt::format("3 {} {} {}\n", first + a, first + b, first + c);
        }
        first += mesh.vertices.size();
    };
    const auto add_vertex = [&](const Vec3& p) {
        vertices += number_text(p.x) + ' ' + number_text(p.y) + ' ' + number_text(p.z) + '\n';
    };
    for (const LinkSpheres& link : links) {
        context.check_cancelled();
        const auto pose = poses.find(link.link);
        for (const Sphere& s : link.elements.spheres()) {
            const Vec3 center = pose == poses.end() ? s.center : pose->second * s.center;
            for (const Vec3& direction : unit.vertices) {
                add_vertex(center + direction * s.radius);
            }
            add_faces(unit);
        }
        for (const Element& element : link.elements.shaped()) {
            const Mesh mesh = enclosing_mesh(element, 8 << subdivisions); // about as fine as the spheres
            for (const Vec3& p : mesh.vertices) {
                add_vertex(pose == poses.end() ? p : pose->second * p);
            }
            add_faces(mesh);
            triangles += mesh.triangles.size();
        }
    }
    return header_of(links) +
           fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                       "element face {}\nproperty list uchar int vertex_indices\nelement sphere {}\n{}{}end_header\n",
                       first, triangles, spheres, sphere_properties, other_header(links)) +
           vertices + faces + sphere_rows(links) + other_rows(links);
}

/// Reads the files of write(): lines and words of an ASCII PLY.
class PlyReader {
public:
    explicit PlyReader(std::string_view text) : rest_(text) {}

    std::map<std::string, Elements> read() {
        read_header();
        std::map<std::string, Elements> result;
        const std::size_t last = elements_.size() - (elements_.back().first == "other" && elements_.size() > 1 ? 2 : 1);
        for (std::size_t i = 0; i < elements_.size(); ++i) {
            for (std::size_t row = 0; row < elements_[i].second; ++row) {
                const std::string_view text = line();
                if (i == last) {
                    read_sphere(text, result);
                } else if (i > last) {
                    read_other(text, result);
                }
            }
        }
        return result;
    }

private:
    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorCode::output, fmt::format("PLY:{}: {}", line_number_, why));
    }

    std::string_view line() {
        ++line_number_;
        const std::size_t end = rest_.find('\n');
        if (end == std::string_view::npos) {
            fail("the file ends too early");
        }
        const std::string_view result = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return result;
    }

    static std::string_view word(std::string_view& text) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view result = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        return result;
    }

    std::size_t whole_number(std::string_view text) const {
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size()) {
            fail(fmt::format("'{}' is not a count or an index", shown(text)));
        }
        return value;
    }

    /// Reads the header. The spheres are the rows of the last element in both forms, but for `other`.
    void read_header() {
        if (line() != "ply" || line() != "format ascii 1.0") {
            fail("not an ASCII PLY file");
        }
        for (std::string_view text = line(); text != "end_header"; text = line()) {
            const std::string_view keyword = word(text);
            if (keyword == "element") {
                const std::string name(word(text));
                elements_.emplace_back(name, whole_number(text));
            } else if (keyword == "comment" && word(text) == "link") {
                const std::size_t index = whole_number(word(text));
                names_[index] = percent_decoded(text);
            }
        }
        if (elements_.empty()) {
            fail("the header names no element");
        }
    }

    double number(std::string_view& text) const {
        const std::string_view number = word(text);
        const std::optional<double> parsed = parse_number(number);
        if (!parsed) {
            fail(fmt::format("'{}' is not a finite number", shown(number)));
        }
        return *parsed;
    }

    const std::string& link_named(std::string_view text) const {
        const auto name = names_.find(whole_number(text));
        if (name == names_.end()) {
            fail(fmt::format("no comment names link {}", text));
        }
        return name->second;
    }

    void read_sphere(std::string_view text, std::map<std::string, Elements>& result) const {
        std::array<double, 4> values{};
        for (double& value : values) {
            value = number(text);
        }
        result[link_named(text)].add(Sphere{{values[0], values[1], values[2]}, values[3]});
    }

    void read_other(std::string_view text, std::map<std::string, Elements>& result) const {
        const std::string& link = link_named(word(text));
        const std::size_t kind = whole_number(word(text)), count = whole_number(word(text));
        if (kind >= element_kinds) {
            fail(fmt::format("there is no kind {}; the last is {}", kind, element_kinds - 1));
        }
        std::vector<double> values;
        while (!text.empty()) {
            values.push_back(number(text));
        }
        ElementNumbers numbers;
        std::size_t at = 0;
        for (const auto& [name, size] : columns_of(static_cast<Element::Kind>(kind))) {
            const std::size_t end = size == 0 ? values.size() : at + size;
            if (count != values.size() || end > values.size()) {
                fail(fmt::format("the list has {} numbers", values.size()));
            }
            numbers.emplace_back(name, std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(at),
                                                           values.begin() + static_cast<std::ptrdiff_t>(end)));
            at = end;
        }
        try {
            result[link].add(element_of(to_string(static_cast<Element::Kind>(kind)), numbers));
        } catch (const Error& error) {
            fail(error.what());
        }
    }

    std::string_view rest_;
    int line_number_ = 0;
    std::vector<std::pair<std::string, std::size_t>> elements_;
    std::map<std::size_t, std::string> names_;
};

class PlyWriter final : public Writer {
public:
    explicit PlyWriter(const Parameters& parameters)
        : surface_(parameters.text("form") == "surface"),
          subdivisions_(static_cast<int>(parameters.integer("subdivisions"))),
          level_(static_cast<int>(parameters.integer("level"))) {}

    std::string write(const SphereModel& model, Context& context) const override {
        const std::vector<LinkSpheres> links = elements_by_link(model, level_);
        if (!surface_) {
            return as_points(links);
        }
        const auto poses = model.robot ? link_poses(*model.robot) : std::map<std::string, Pose>{};
        return as_surface(links, poses, subdivisions_, context);
    }

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>&) const override {
        return PlyReader(bytes).read();
    }

private:
    bool surface_;
    int subdivisions_, level_;
};

class PlyModelReader final : public ModelReader {
public:
    PlyModelReader(const Parameters&, const StageMaker& maker) : writer_(maker.make<Writer>("write.ply")) {}

    bool recognises(std::string_view text) const override { return text.starts_with("ply"); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_written(*writer_, text, file, "PLY", "write the file again with write.ply");
    }

private:
    std::unique_ptr<Writer> writer_;
};

} // namespace
} // namespace foam

FOAM_PLUGIN("write_ply", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::PlyWriter>(
        {.name = "write.ply",
         .summary = "Writes the elements of all links, each in its link's frame, as a PLY point set or as surfaces to "
                    "look at.",
         .reference = "Turk 1994, The PLY polygon file format",
         .parameters = {Parameter::choice("form", {"points", "surface"}, "points")
                            .doc("points: one vertex with a radius a sphere; surface: triangles.")
                            .source("The smaller file, which holds all there is."),
                        Parameter::integer("subdivisions", 2)
                            .bounds(0, 5)
                            .doc("How often the 20 triangles of an icosahedron are split into four, for form: surface.")
                            .source("320 triangles look round at the size of a robot link."),
                        Parameter::integer("level", -1)
                            .bounds(-1, 32)
                            .doc("Level of the sphere trees that is written: 0 the bounding spheres, -1 the finest.")
                            .source("The finest level is the one that is measured and proved.")},
         .extensions = {"ply"},
         .kinds = foam::every_kind()});
    enrol.add<foam::PlyModelReader>({.name = "read.ply",
                                     .summary = "Reads the spheres and other elements of a file of write.ply.",
                                     .reference = "Turk 1994, The PLY polygon file format",
                                     .extensions = {"ply"},
                                     .uses = {"write.ply"}});
}
