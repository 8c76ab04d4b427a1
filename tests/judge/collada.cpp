#include "collada.hpp"

#include "mesh_files.hpp"
#include "polygon.hpp"
#include "xml.hpp"

#include <map>
#include <numbers>
#include <stdexcept>

namespace judge {
namespace {

/// Row by row; the last row is 0 0 0 1.
struct Matrix {
    std::array<std::array<Real, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    Point apply(const Point& p) const {
        const auto row = [&](std::size_t i) {
            return rows[i][0] * p.x + rows[i][1] * p.y + rows[i][2] * p.z + rows[i][3];
        };
        return {row(0), row(1), row(2)};
    }
};

Matrix operator*(const Matrix& a, const Matrix& b) {
    Matrix product;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            product.rows[i][j] = j == 3 ? a.rows[i][3] : 0;
            for (std::size_t k = 0; k < 3; ++k) {
                product.rows[i][j] += a.rows[i][k] * b.rows[k][j];
            }
        }
    }
    return product;
}

Matrix rotation(const std::vector<double>& v) {
    const Point axis{v.at(0), v.at(1), v.at(2)};
    const Point n = 1 / length(axis) * axis;
    const Real angle = static_cast<Real>(v.at(3)) * std::numbers::pi_v<Real> / 180, c = std::cos(angle),
               s = std::sin(angle), d = 1 - c;
    return {{{{c + d * n.x * n.x, d * n.x * n.y - s * n.z, d * n.x * n.z + s * n.y, 0},
              {d * n.x * n.y + s * n.z, c + d * n.y * n.y, d * n.y * n.z - s * n.x, 0},
              {d * n.x * n.z - s * n.y, d * n.y * n.z + s * n.x, c + d * n.z * n.z, 0}}}};
}

Matrix transformation(const Element& element) {
    const std::vector<double> v = numbers_of(element.text);
    Matrix matrix;
    if (element.name == "matrix") {
        for (std::size_t i = 0; i < 12; ++i) {
            matrix.rows[i / 4][i % 4] = v.at(i);
        }
    } else if (element.name == "translate") {
        for (std::size_t i = 0; i < 3; ++i) {
            matrix.rows[i][3] = v.at(i);
        }
    } else if (element.name == "scale") {
        for (std::size_t i = 0; i < 3; ++i) {
            matrix.rows[i][i] = v.at(i);
        }
    } else if (element.name == "rotate") {
        matrix = rotation(v);
    }
    return matrix;
}

class Collada {
public:
    explicit Collada(const Element& root) { remember(root); }

    std::vector<Corners> triangles(const Element& root) {
        Matrix unit;
        if (const Element* asset = root.child("asset"); asset && asset->child("unit")) {
            const double metre = numbers_of(asset->at("unit").attribute("meter", "1")).at(0);
            for (std::size_t i = 0; i < 3; ++i) {
                unit.rows[i][i] = metre;
            }
        }
        const Element& scene = find(root.at("scene").at("instance_visual_scene").attribute("url"));
        for (const Element& node : scene.children) {
            if (node.name == "node") {
                place(node, unit);
            }
        }
        return std::move(triangles_);
    }

private:
    void remember(const Element& element) {
        if (const std::string id = element.attribute("id"); !id.empty()) {
            ids_[id] = &element;
        }
        for (const Element& child : element.children) {
            remember(child);
        }
    }
    const Element& find(const std::string& url) const {
        const auto found = url.starts_with("#") ? ids_.find(url.substr(1)) : ids_.end();
        if (found == ids_.end()) {
            throw std::runtime_error("COLLADA: nothing is called " + url);
        }
        return *found->second;
    }

    void place(const Element& node, Matrix matrix) {
        for (const Element& child : node.children) {
            matrix = matrix * transformation(child);
        }
        for (const Element& child : node.children) {
            if (child.name == "node") {
                place(child, matrix);
            } else if (child.name == "instance_node") {
                place(find(child.attribute("url")), matrix);
            } else if (child.name == "instance_geometry") {
                add(find(child.attribute("url")), matrix);
            }
        }
    }

    void add(const Element& geometry, const Matrix& matrix) {
        const Element* mesh = geometry.child("mesh");
        if (!mesh) {
            return;
        }
        for (const Element& primitives : mesh->children) {
            if (primitives.name == "triangles" || primitives.name == "polylist" || primitives.name == "polygons") {
                add_polygons(primitives, matrix);
            }
        }
    }

    std::vector<Point> positions(const Element& vertices) const {
        for (const Element& input : vertices.children) {
            if (input.name != "input" || input.attribute("semantic") != "POSITION") {
                continue;
            }
            const Element& source = find(input.attribute("source"));
            const std::vector<double> values = numbers_of(source.at("float_array").text);
            std::vector<Point> points;
            for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
                points.push_back({values[i], values[i + 1], values[i + 2]});
            }
            return points;
        }
        throw std::runtime_error("COLLADA: vertices without positions");
    }

    void add_polygons(const Element& primitives, const Matrix& matrix) {
        std::size_t stride = 1, offset = 0;
        std::vector<Point> points;
        for (const Element& input : primitives.children) {
            if (input.name != "input") {
                continue;
            }
            const auto at = static_cast<std::size_t>(numbers_of(input.attribute("offset", "0")).at(0));
            stride = std::max(stride, at + 1);
            if (input.attribute("semantic") == "VERTEX") {
                offset = at;
                points = positions(find(input.attribute("source")));
            }
        }
        std::vector<double> counts;
        if (const Element* vcount = primitives.child("vcount")) {
            counts = numbers_of(vcount->text);
        }
        for (const Element& p : primitives.children) {
            if (p.name != "p") {
                continue;
            }
            const std::vector<double> indices = numbers_of(p.text);
            const std::size_t corners = indices.size() / stride;
            const auto corner = [&](std::size_t i) {
                return matrix.apply(points.at(static_cast<std::size_t>(indices.at(i * stride + offset))));
            };
            std::size_t begin = 0;
            for (std::size_t polygon = 0; begin < corners; ++polygon) {
                const std::size_t size = primitives.name == "triangles"  ? 3
                                         : primitives.name == "polygons" ? corners
                                                                         : static_cast<std::size_t>(counts.at(polygon));
                std::vector<Point> polygon_corners;
                for (std::size_t k = 0; k < size; ++k) {
                    polygon_corners.push_back(corner(begin + k));
                }
                append_polygon(std::move(polygon_corners), triangles_);
                begin += size;
            }
        }
    }

    std::map<std::string, const Element*> ids_;
    std::vector<Corners> triangles_;
};

} // namespace

std::vector<Corners> read_collada(const std::string& text) {
    const Element root = parse_xml(text);
    return Collada(root).triangles(root);
}

} // namespace judge
