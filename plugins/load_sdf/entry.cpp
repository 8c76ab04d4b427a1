// What load.sdf calls in this library.
#include "entry.hpp"

extern "C" __attribute__((visibility("default"))) foam::load_sdf::RobotOf foam_sdf_reader() {
    return &foam::load_sdf::robot_of;
}
