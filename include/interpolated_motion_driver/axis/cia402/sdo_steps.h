#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"

namespace interpolated_motion::axis {

/// Steps of a bring-up that every drive by CiA 402 has. Each check ends with a sentence that names the
/// object, what was found and what is needed. References must outlive the sequence.
namespace sdo_steps {

using Step = SdoSequence::Step;
using Steps = std::vector<Step>;

/// 0x1000 must say that this is a servo drive.
Step read_device_type();
/// The value goes to `to`; whatever the object's size, what it lacks of 4 bytes is 0.
Step read_u32(canopen::ObjectAddress address, std::uint32_t& to);
/// A negative `wanted` is compared with what is read as a signed number.
Step require_value(canopen::ObjectAddress address, std::int64_t wanted, const char* meaning);
/// 0x6502 must name `mode`.
Step require_mode(cia402::Mode mode);

/// Of an UNSIGNED32: a drive refuses a write of another size (abort 0x06070010).
Step write_u32(canopen::ObjectAddress address, std::uint32_t value);
/// A drive that has no such object does without.
Step write_if_present(const canopen::SdoWrite& write);
/// Where the drive refuses `step`, it is also told where the value comes from: "drives/joint1/limits/...".
Step because_of(Step step, const std::string& origin);
/// In the order of the list; each must succeed.
Steps writes(const std::vector<canopen::SdoWrite>& list);
/// The writes of canopen::pdo_configuration(), which throws where the configuration is out of range.
Steps pdo(const canopen::PdoConfiguration& configuration, std::uint8_t node);

/// Moves `more` to the end of `steps`.
void append(Steps& steps, Steps more);

/// Rounded up, at least 1, at most what fits.
std::uint32_t to_u32(double value);
/// Cut off where it does not fit.
std::int32_t to_i32(double value);

}  // namespace sdo_steps
}  // namespace interpolated_motion::axis
