#include "interpolated_motion_driver/hardware/fault_injection.h"

#include <cstdlib>
#include <map>
#include <sstream>
#include <vector>

#include <fmt/format.h>

namespace interpolated_motion::hardware {

namespace {

/// A verb and its numbers; no verb when a number is not readable.
struct Command {
  std::string verb;
  std::vector<double> numbers;

  bool is(const char* name, std::size_t count) const { return verb == name && numbers.size() == count; }
};

Command parse(const std::string& text) {
  std::istringstream words(text);
  Command command;
  std::string word;
  words >> command.verb;
  while (words >> word) {
    char* end = nullptr;
    command.numbers.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0') return {};
  }
  return command;
}

bool unknown(const std::string& command, const char* known, std::string* reason) {
  *reason = fmt::format("\"{}\" is no fault; known: {}", command, known);
  return false;
}

/// What all emulated CANopen drives know.
template <class Drive>
bool inject_canopen_fault(Drive& drive, const std::string& text, HostTime now, std::string* reason) {
  constexpr std::uint8_t kGenericError = 0x01;
  const Command command = parse(text);
  if (command.is("emcy", 1)) {
    drive.raise_fault(static_cast<std::uint16_t>(command.numbers[0]), kGenericError, now);
  } else if (command.is("power_cycle", 1)) {
    drive.power_cycle(now, host_duration(command.numbers[0]));
  } else if (command.is("stall", 1)) {
    drive.stall(command.numbers[0] != 0.0);
  } else if (command.is("silence", 1)) {
    drive.silence(command.numbers[0] != 0.0, now);
  } else if (command.is("clock", 1)) {
    drive.set_clock_error(command.numbers[0]);
  } else {
    return unknown(text, "emcy CODE, power_cycle SECONDS, stall 0|1, silence 0|1, clock PPM", reason);
  }
  return true;
}

}  // namespace

bool inject_drive_fault(emulation::EposDrive& drive, const std::string& command, HostTime now,
                        std::string* reason) {
  return inject_canopen_fault(drive, command, now, reason);
}

bool inject_drive_fault(emulation::CyclicDrive& drive, const std::string& command, HostTime now,
                        std::string* reason) {
  return inject_canopen_fault(drive, command, now, reason);
}

bool inject_bus_fault(transport::VirtualCanBus& bus, const std::string& text, HostTime now,
                      std::string* reason) {
  constexpr int kHostPort = 0;
  const Command command = parse(text);
  if (command.is("drop", 1)) {
    bus.drop_next(static_cast<int>(command.numbers[0]));
  } else if (command.is("drop_id", 2)) {
    const auto id = static_cast<std::uint32_t>(command.numbers[0]);
    bus.drop_if([id, left = command.numbers[1]](const canopen::Frame& frame) mutable {
      return frame.id == id && left-- > 0;
    });
  } else if (command.is("disconnect", 1)) {
    bus.connect(kHostPort, command.numbers[0] == 0.0, now);
  } else if (command.is("bus_off", 1)) {
    bus.host_bus_off(now + host_duration(command.numbers[0]));
  } else {
    return unknown(text, "drop COUNT, drop_id ID COUNT, disconnect 0|1, bus_off SECONDS", reason);
  }
  return true;
}

bool inject_drive_fault(emulation::SilverDust& drive, const std::string& text, HostTime now,
                        std::string* reason) {
  using emulation::SilverDustFault;
  static const std::map<std::string, SilverDustFault> faults{
      {"fault over_temperature", SilverDustFault::OverTemperature},
      {"fault over_voltage", SilverDustFault::OverVoltage},
      {"fault low_voltage", SilverDustFault::LowVoltage},
      {"fault moving_error", SilverDustFault::MovingError},
      {"fault holding_error", SilverDustFault::HoldingError}};
  const Command command = parse(text);
  if (const auto fault = faults.find(text); fault != faults.end()) {
    drive.raise_fault(fault->second, now);
  } else if (command.is("power_cycle", 1)) {
    drive.power_cycle(now, host_duration(command.numbers[0]));
  } else if (command.is("stall", 1)) {
    drive.stall(command.numbers[0] != 0.0);
  } else if (command.is("silence", 1)) {
    drive.silence(command.numbers[0] != 0.0, now);
  } else if (command.is("clock", 1)) {
    drive.set_clock_error(command.numbers[0]);
  } else if (command.is("nak", 3)) {
    drive.refuse_next(static_cast<int>(command.numbers[0]), static_cast<int>(command.numbers[1]),
                      static_cast<int>(command.numbers[2]));
  } else {
    return unknown(text,
                   "fault over_temperature|over_voltage|low_voltage|moving_error|holding_error, power_cycle "
                   "SECONDS, stall 0|1, silence 0|1, clock PPM, nak COMMAND CODE COUNT",
                   reason);
  }
  return true;
}

bool inject_line_fault(transport::VirtualSerialLine& line, const std::string& text, HostTime now,
                       std::string* reason) {
  using transport::SerialDirection;
  constexpr int kHostPort = 0;
  const std::string garbage = "garbage ";
  const Command command = parse(text);
  const int count = command.numbers.empty() ? 0 : static_cast<int>(command.numbers[0]);
  if (command.is("lose_requests", 1)) {
    line.lose_next(SerialDirection::HostToDrive, count);
  } else if (command.is("lose_replies", 1)) {
    line.lose_next(SerialDirection::DriveToHost, count);
  } else if (command.is("garble_requests", 1)) {
    line.garble_next(SerialDirection::HostToDrive, count);
  } else if (command.is("garble_replies", 1)) {
    line.garble_next(SerialDirection::DriveToHost, count);
  } else if (text.compare(0, garbage.size(), garbage) == 0) {
    line.inject(SerialDirection::DriveToHost, text.substr(garbage.size()), now);
  } else if (command.is("disconnect", 1)) {
    line.connect(kHostPort, count == 0, now);
  } else {
    return unknown(text,
                   "lose_requests COUNT, lose_replies COUNT, garble_requests COUNT, garble_replies COUNT, "
                   "garbage TEXT, disconnect 0|1",
                   reason);
  }
  return true;
}

}  // namespace interpolated_motion::hardware
