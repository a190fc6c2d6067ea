#pragma once

#include "interpolated_motion_driver/hardware/configuration.h"

namespace interpolated_motion::hardware {

/// Whether the parts of a configuration, each of them right by itself, go together: drives and the types of
/// their buses, node ids and addresses, interfaces and ports, and what each kind of drive asks for. Throws
/// std::invalid_argument that names the parameters and what to do.
void check_parts(const Configuration& configuration);

/// Whether each CAN bus can carry what flows whether anything moves or not, beside what is reserved for
/// records. To be called once it is known which buses are isochronous. Throws likewise.
void check_background_load(const Configuration& configuration);

}  // namespace interpolated_motion::hardware
