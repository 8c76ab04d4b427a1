// The way from the plugin to the library that reads SDF by libsdformat, which is opened for the first file.
#pragma once

#include "model.hpp"

namespace foam::load_sdf {

/// The entry, an extern "C" function, returns robot_of() of the library.
using RobotOf = decltype(&robot_of);
using EntryOfReader = RobotOf (*)();
inline constexpr const char* reader_entry = "foam_sdf_reader";
/// The place of the library relative to the plugin's folder.
inline constexpr const char* reader_file = "load_sdf/libfoam-sdf-reader.so";

} // namespace foam::load_sdf
