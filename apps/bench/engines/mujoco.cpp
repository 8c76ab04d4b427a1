// MuJoCo. Every link is a free body, so that any configuration can be set; a mesh is its convex hull. MuJoCo has no
// query for distances: contacts are asked for within a margin that is larger than the scene. Between hulls it finds
// them by Minkowski portal refinement, which gives no exact distances there.
#include "mujoco_model.hpp"

#include <foam/bench/collision_engine.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

namespace foam {
namespace {

constexpr double far = 10; ///< m; larger than the scene

std::array<double, 4> quaternion_of(const Pose& pose) {
    double matrix[9];
    for (int i = 0; i < 9; ++i) {
        matrix[i] = pose.rotation[static_cast<std::size_t>(i / 3)][i % 3];
    }
    std::array<double, 4> q{};
    mju_mat2Quat(q.data(), matrix);
    return q;
}

std::string pose_text(const Pose& pose) {
    const auto& t = pose.translation;
    return fmt::format("pos='{} {} {}' quat='{}'", t.x, t.y, t.z, fmt::join(quaternion_of(pose), " "));
}

std::array<double, 3> size_of(const Element& p) {
    switch (p.kind) {
    case Element::Kind::box:
    case Element::Kind::ellipsoid:
        return {p.half.x, p.half.y, p.half.z};
    case Element::Kind::sphere:
        return {p.radius, 0, 0};
    case Element::Kind::cylinder:
    case Element::Kind::capsule:
        return {p.radius, p.half.z, 0};
    case Element::Kind::swept_box:
    case Element::Kind::hull:
        break; // a mesh
    }
    return {};
}

std::string shape_text(const Element& p) {
    return fmt::format("type='{}' size='{}'", to_string(p.kind), fmt::join(size_of(p), " "));
}

/// The vertices; those of a flat mesh, which MuJoCo takes no hull of, twice, 0.1 mm to both sides of its plane.
std::vector<Vec3> solid_points(const Mesh& mesh) {
    constexpr double flat = 1e-6, half_thickness = 1e-4; // m
    Vec3 normal{};
    Vec3 origin{};
    for (const Triangle& t : mesh.triangles) { // the largest one says where the plane is
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        if (const Vec3 candidate = cross(b - a, c - a); norm(candidate) > norm(normal)) {
            normal = candidate;
            origin = a;
        }
    }
    normal = normalized(normal);
    const bool is_flat = std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                                     [&](const Vec3& v) { return std::abs(dot(v - origin, normal)) < flat; });
    std::vector<Vec3> points;
    for (const Vec3& v : mesh.vertices) {
        if (is_flat) {
            points.push_back(v + half_thickness * normal);
            points.push_back(v - half_thickness * normal);
        } else {
            points.push_back(v);
        }
    }
    return points;
}

/// The scene in MuJoCo's own format.
class Text {
public:
    Text(const EngineRobot& robot, const std::vector<Obstacle>& obstacles) {
        for (std::size_t i = 0; i < obstacles.size(); ++i) {
            world_ += fmt::format("<geom name='o{}' {} {}/>\n", i, shape_text(obstacles[i].shape),
                                  pose_text(obstacles[i].pose));
        }
        for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
            add(b, robot.bodies[b]);
        }
        std::set<std::array<std::uint32_t, 2>> tested(robot.pairs.begin(), robot.pairs.end());
        for (std::uint32_t a = 0; a < robot.bodies.size(); ++a) {
            for (std::uint32_t b = a + 1; b < robot.bodies.size(); ++b) {
                if (!tested.contains({a, b})) {
                    exclusions_ += fmt::format("<exclude body1='b{}' body2='b{}'/>\n", a, b);
                }
            }
        }
        contacts_ = most_contacts(robot, obstacles.size());
    }

    std::string text() const {
        return fmt::format("<mujoco>\n<size nconmax='{}' njmax='1'/>\n"
                           "<asset>\n{}</asset>\n<worldbody>\n{}</worldbody>\n<contact>\n{}</contact>\n</mujoco>\n",
                           contacts_, assets_, world_, exclusions_);
    }

private:
    void add(std::size_t index, const EngineBody& body) {
        world_ +=
            fmt::format("<body name='b{}'><freejoint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>\n", index);
        for (const EngineShape& shape : body) {
            std::string geometry;
            if (const auto* primitive = std::get_if<Element>(&shape.geometry)) {
                geometry = shape_text(*primitive);
            } else {
                geometry = fmt::format("type='mesh' mesh='m{}'", meshes_);
                add(*std::get<std::shared_ptr<const Mesh>>(shape.geometry));
            }
            world_ += fmt::format("<geom {} {}/>\n", geometry, pose_text(shape.pose));
        }
        world_ += "</body>\n";
    }
    /// Its vertices alone: MuJoCo makes their hull.
    void add(const Mesh& mesh) {
        std::string coordinates;
        for (const Vec3& v : solid_points(welded(mesh))) {
            coordinates += fmt::format("{} {} {} ", v.x, v.y, v.z);
        }
        assets_ += fmt::format("<mesh name='m{}' vertex='{}'/>\n", meshes_++, coordinates);
    }
    /// Between all shapes that are tested: one for a sphere, at most eight between boxes.
    static std::size_t most_contacts(const EngineRobot& robot, std::size_t obstacles) {
        const auto weight = [](const EngineBody& body) {
            std::size_t sum = 0;
            for (const EngineShape& shape : body) {
                const auto* primitive = std::get_if<Element>(&shape.geometry);
                sum += primitive && primitive->kind == Element::Kind::sphere ? 1 : 3;
            }
            return sum;
        };
        std::size_t count = 0;
        for (const EngineBody& body : robot.bodies) {
            count += 3 * weight(body) * obstacles;
        }
        for (const auto& [a, b] : robot.pairs) {
            count += weight(robot.bodies[a]) * weight(robot.bodies[b]);
        }
        return count + 1;
    }

    std::string assets_, world_, exclusions_;
    std::size_t meshes_ = 0, contacts_ = 0;
};

class MuJoCo final : public CollisionEngine {
public:
    MuJoCo(const EngineRobot& robot, const std::vector<Obstacle>& obstacles)
        : model_(mujoco::compiled(Text(robot, obstacles).text())), data_(mj_makeData(model_.get())) {}

    void set_obstacles(const std::vector<Obstacle>& obstacles) override {
        for (std::size_t i = 0; i < obstacles.size(); ++i) {
            const int g = mj_name2id(model_.get(), mjOBJ_GEOM, fmt::format("o{}", i).c_str());
            const Obstacle& obstacle = obstacles[i];
            const auto size = size_of(obstacle.shape);
            const auto quaternion = quaternion_of(obstacle.pose);
            for (int k = 0; k < 3; ++k) {
                model_->geom_size[3 * g + k] = size[static_cast<std::size_t>(k)];
                model_->geom_pos[3 * g + k] = obstacle.pose.translation[k];
            }
            std::copy(quaternion.begin(), quaternion.end(), model_->geom_quat + 4 * g);
            model_->geom_rbound[g] = mju_norm3(size.data());
            model_->geom_sameframe[g] = 0;
        }
    }
    void move(std::span<const Pose> poses) override {
        for (std::size_t b = 0; b < poses.size(); ++b) {
            double* q = data_->qpos + 7 * b;
            for (int k = 0; k < 3; ++k) {
                q[k] = poses[b].translation[k];
            }
            const auto quaternion = quaternion_of(poses[b]);
            std::copy(quaternion.begin(), quaternion.end(), q + 3);
        }
        mj_kinematics(model_.get(), data_.get());
        found_ = Found::nothing;
    }
    bool hits_obstacle() override { return least(Found::collisions, true) <= 0; }
    bool hits_itself(bool every_pair) override {
        found_ = every_pair ? Found::nothing : found_; // asked anew, as it is measured
        return least(Found::collisions, false) <= 0;
    }
    double distance_to_obstacles() override { return least(Found::distances, true); }
    double distance_to_itself() override { return least(Found::distances, false); }

private:
    enum class Found { nothing, collisions, distances };

    /// MuJoCo looks for all contacts at once; both questions are answered from what it finds.
    double least(Found wanted, bool obstacles) {
        if (found_ != wanted) {
            std::fill_n(model_->geom_margin, model_->ngeom, wanted == Found::distances ? far : 0.0);
            mj_collision(model_.get(), data_.get());
            if (data_->warning[mjWARN_CONTACTFULL].number > 0) {
                throw std::runtime_error("MuJoCo has no room for all contacts");
            }
            found_ = wanted;
        }
        double result = std::numeric_limits<double>::infinity();
        for (int c = 0; c < data_->ncon; ++c) {
            const mjContact& contact = data_->contact[c];
            const bool obstacle = model_->geom_bodyid[contact.geom1] == 0 || model_->geom_bodyid[contact.geom2] == 0;
            if (obstacle == obstacles) {
                result = std::min(result, contact.dist);
            }
        }
        return result;
    }

    mujoco::Model model_;
    mujoco::Data data_;
    Found found_ = Found::nothing;
};

/// Neither a log file in the current folder nor exit(): an error is an exception like others.
void be_quiet() {
    mju_user_warning = [](const char*) {};
    mju_user_error = [](const char* text) { throw std::runtime_error(fmt::format("MuJoCo: {}", text)); };
}

} // namespace
} // namespace foam

int main() {
    using namespace foam;
    be_quiet();
    return serve_engine(fmt::format("MuJoCo {}", mj_versionString()),
                        [](const std::string&, const EngineRobot& robot, const std::vector<Obstacle>& obstacles) {
                            return std::make_unique<MuJoCo>(robot, obstacles);
                        });
}
