#include "interpolated_motion_driver/axis/cia402/sdo_steps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis::sdo_steps {

namespace object = cia402::object;
using canopen::SdoResult;
using Failure = std::optional<std::string>;

Step read_device_type() {
  return SdoSequence::read(object::kDeviceType, [](const SdoResult& r) -> Failure {
    if (!r.ok) return r.text();
    if ((r.as_u32() & 0xFFFFu) == cia402::kServoDriveProfile) return std::nullopt;
    return fmt::format(
        "the device is no servo drive: device type 0x1000 is 0x{:08X}, its low word must be 402 (CiA 402)",
        r.as_u32());
  });
}

Step read_u32(canopen::ObjectAddress address, std::uint32_t& to) {
  return SdoSequence::read(address, [&to](const SdoResult& r) -> Failure {
    if (!r.ok) return r.text();
    to = r.as_u32();
    return std::nullopt;
  });
}

Step require_value(canopen::ObjectAddress address, std::int64_t wanted, const char* meaning) {
  return SdoSequence::read(address, [wanted, meaning](const SdoResult& r) -> Failure {
    if (!r.ok) return r.text();
    const std::int64_t found = wanted < 0 ? r.as_i64() : static_cast<std::int64_t>(r.as_u64());
    if (found == wanted) return std::nullopt;
    return fmt::format("object {} ({}) is {}, it must be {}", canopen::to_string(r.address), meaning, found,
                       wanted);
  });
}

Step require_mode(cia402::Mode mode) {
  return SdoSequence::read(object::kSupportedDriveModes, [mode](const SdoResult& r) -> Failure {
    if (!r.ok) return r.text();
    if (cia402::supports(r.as_u32(), mode)) return std::nullopt;
    return fmt::format("the drive does not support mode {}: supported drive modes 0x6502 are {}",
                       static_cast<int>(mode), cia402::supported_modes_text(r.as_u32()));
  });
}

Step write_u32(canopen::ObjectAddress address, std::uint32_t value) {
  return SdoSequence::write(canopen::sdo_write<std::uint32_t>(address, value));
}

Step write_if_present(const canopen::SdoWrite& write) {
  return SdoSequence::write(write, [](const SdoResult& r) -> Failure {
    const bool absent = r.aborted_by_drive && (r.abort_code == canopen::abort_code::kNoObject ||
                                               r.abort_code == canopen::abort_code::kNoSubindex);
    if (r.ok || absent) return std::nullopt;
    return r.text();
  });
}

Step because_of(Step step, const std::string& origin) {
  step.check = [check = std::move(step.check), origin](const SdoResult& r) -> Failure {
    Failure failure = check ? check(r) : r.ok ? Failure() : Failure(r.text());
    if (failure && r.aborted_by_drive) *failure += "; the drive does not take what follows from " + origin;
    return failure;
  };
  return step;
}

Steps writes(const std::vector<canopen::SdoWrite>& list) {
  Steps steps;
  for (const auto& write : list) steps.push_back(SdoSequence::write(write));
  return steps;
}

Steps pdo(const canopen::PdoConfiguration& configuration, std::uint8_t node) {
  return writes(canopen::pdo_configuration(configuration, node));
}

void append(Steps& steps, Steps more) { std::move(more.begin(), more.end(), std::back_inserter(steps)); }

std::uint32_t to_u32(double value) {
  return static_cast<std::uint32_t>(std::clamp(std::ceil(value), 1.0, 4294967295.0));
}

std::int32_t to_i32(double value) {
  constexpr double kLow = std::numeric_limits<std::int32_t>::min();
  constexpr double kHigh = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(value, kLow, kHigh));
}

}  // namespace interpolated_motion::axis::sdo_steps
