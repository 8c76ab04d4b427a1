// A scene of MuJoCo from its text, owned.
#pragma once

#include <mujoco/mujoco.h>

#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

namespace foam::mujoco {

struct DeleteModel {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
    void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, DeleteModel>;
using Data = std::unique_ptr<mjData, DeleteData>;

/// Throws std::runtime_error with MuJoCo's reason if it does not take the scene.
inline Model compiled(const std::string& text) {
    constexpr const char* file = "scene.xml";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), file, static_cast<int>(text.size()));
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), file)], text.data(), text.size());
    char why[1000] = "";
    Model model(mj_loadXML(file, files.get(), why, sizeof why));
    mj_deleteVFS(files.get());
    if (!model) {
        throw std::runtime_error(std::string("MuJoCo does not take the scene: ") + why);
    }
    return model;
}

} // namespace foam::mujoco
