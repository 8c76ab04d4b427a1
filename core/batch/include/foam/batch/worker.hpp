// The process that turns one mesh after the other into spheres.
#pragma once

namespace foam {
inline namespace [[gnu::visibility("default")]] batch {

/// Serves run_batch() and never returns, if the command line says that this process was started for that; otherwise
/// does nothing. It must be among the first statements of main() of a program that calls run_batch().
void serve_batch_worker(int count, char** arguments);

} // namespace batch
} // namespace foam
