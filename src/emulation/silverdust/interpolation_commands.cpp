#include "interpolated_motion_driver/emulation/silverdust/interpolation_commands.h"

#include "interpolated_motion_driver/emulation/silverdust/command_values.h"

namespace interpolated_motion::emulation {

using namespace command_value;

Answer InterpolationCommands::obey(Command command, const Packet& packet) {
  switch (command) {
    case Command::InterpolatedMoveStart:
      return start(packet);
    case Command::WriteQueue:
      return write(packet);
    case Command::QueueClear:
      return clear();
    default:
      return Answer::nak(NakCode::BadCommand);
  }
}

Answer InterpolationCommands::start(const Packet& packet) {
  const auto count = static_cast<int>(packet.parameter_count);
  const bool expected = parameters_.ims_arguments < 0 ? count != 1 : count == parameters_.ims_arguments;
  if (!expected) return Answer::nak(NakCode::BadFormat);
  if (!electronics_.enabled()) return Answer::cannot_start();
  motion_.interpolate();
  return Answer{};
}

Answer InterpolationCommands::write(const Packet& packet) {
  const auto& p = packet.parameters;
  const bool valid = in_range(p[0], 0, kInt32Max) && in_range(p[1], kInt32Min, kInt32Max) &&
                     in_range(p[2], 0, kInt32Max) && in_range(p[3], 0, kInt32Max);
  if (!valid) return Answer::bad_value();
  const bool taken = queue_.push({to_int32(p[0]), to_int32(p[1]), to_int32(p[2]), to_int32(p[3])});
  return taken ? Answer{} : Answer::nak(NakCode::BufferFull);
}

Answer InterpolationCommands::clear() {
  queue_.clear();
  return Answer{};
}

}  // namespace interpolated_motion::emulation
