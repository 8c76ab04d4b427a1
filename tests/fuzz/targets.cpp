#include "targets.hpp"

#include <array>

namespace foam::fuzz {

std::span<const NamedTarget> targets() {
    static constexpr std::array<NamedTarget, 9> all{{{"stl", read_stl},
                                                     {"obj", read_obj},
                                                     {"off", read_off},
                                                     {"ply", read_ply},
                                                     {"dae", read_dae},
                                                     {"gltf", read_gltf},
                                                     {"urdf", read_urdf},
                                                     {"spheres", read_spheres},
                                                     {"recipe", read_recipe}}};
    return all;
}

Target find_target(std::string_view name) {
    for (const NamedTarget& target : targets()) {
        if (target.name == name) {
            return target.run;
        }
    }
    return nullptr;
}

} // namespace foam::fuzz
