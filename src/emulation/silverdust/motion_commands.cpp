#include "interpolated_motion_driver/emulation/silverdust/motion_commands.h"

#include "interpolated_motion_driver/emulation/silverdust/command_values.h"

namespace interpolated_motion::emulation {

using namespace command_value;

namespace {

constexpr std::int64_t kLargestDeceleration = std::int64_t{1} << 29;  // of STP
constexpr std::int64_t kLargestAcceleration = std::int64_t{1} << 30;
constexpr std::int64_t kStopAtOnce = -1;  // deceleration of STP

}  // namespace

Answer MotionCommands::obey(Command command, const Packet& packet) {
  switch (command) {
    case Command::MoveAbsolute:
      return move(packet, 0);
    case Command::MoveRelative:
      return move(packet, motion_.target().counts());
    case Command::VelocityMode:
      return velocity_mode(packet);
    case Command::Stop:
      return stop(packet);
    case Command::ZeroTargetAndPosition:
      return zero_target_and_position();
    case Command::TargetToPosition:
      return target_to_position();
    default:
      return Answer::nak(NakCode::BadCommand);
  }
}

// To the position of the packet, counts from `origin`.
Answer MotionCommands::move(const Packet& packet, std::int64_t origin) {
  const auto& p = packet.parameters;
  const bool valid = in_range(p[0], kInt32Min, kInt32Max) && in_range(p[1], 1, kLargestAcceleration) &&
                     in_range(p[2], 0, kInt32Max);
  if (!valid) return Answer::bad_value();
  if (!electronics_.enabled()) return Answer::cannot_start();
  motion_.move_to(to_int32(origin + p[0]), p[1], p[2]);
  return Answer{};
}

Answer MotionCommands::velocity_mode(const Packet& packet) {
  const auto& p = packet.parameters;
  const bool valid = in_range(p[0], 1, kLargestAcceleration) && in_range(p[1], kInt32Min, kInt32Max);
  if (!valid) return Answer::bad_value();
  if (!electronics_.enabled()) return Answer::cannot_start();
  program_.stop();
  motion_.run_at(p[1], p[0]);
  return Answer{};
}

Answer MotionCommands::stop(const Packet& packet) {
  const std::int64_t deceleration = packet.parameters[0];
  if (!in_range(deceleration, kStopAtOnce, kLargestDeceleration)) return Answer::bad_value();
  program_.stop();
  if (!motion_.active()) return Answer{};
  if (deceleration == kStopAtOnce) {
    motion_.stop_at(axis_.counts());
  } else {
    motion_.stop(deceleration);
  }
  return Answer{};
}

Answer MotionCommands::zero_target_and_position() {
  motion_.place(0);
  axis_.place(0.0);
  return Answer{};
}

Answer MotionCommands::target_to_position() {
  motion_.place(axis_.counts());
  return Answer{};
}

}  // namespace interpolated_motion::emulation
