#include "interpolated_motion_driver/emulation/silverdust/communication_commands.h"

#include "interpolated_motion_driver/emulation/silverdust/command_values.h"

namespace interpolated_motion::emulation {

using namespace command_value;

namespace {

constexpr std::int64_t kLargestAddress = 254;

}  // namespace

Answer CommunicationCommands::obey(Command command, const Packet& packet) {
  switch (command) {
    case Command::Identity:
      return set_identity(packet);
    case Command::AckDelay:
      return set_ack_delay(packet);
    case Command::Revision:
      return Answer::word(command, parameters_.revision);
    case Command::Restart:
      return Answer::restart();
    default:
      return Answer::nak(NakCode::BadCommand);
  }
}

// The unit's address alone, or the group's before it.
Answer CommunicationCommands::set_identity(const Packet& packet) {
  const bool with_group = packet.parameter_count == 2;
  const std::int64_t first = packet.parameters[0];
  const std::int64_t unit = with_group ? packet.parameters[1] : first;
  const bool valid =
      in_range(unit, 1, kLargestAddress) && (!with_group || in_range(first, 0, kLargestAddress));
  if (!valid) return Answer::bad_value();
  serial_.set_address(static_cast<int>(unit));
  if (with_group) serial_.set_group(static_cast<int>(first));
  return Answer{};
}

Answer CommunicationCommands::set_ack_delay(const Packet& packet) {
  if (!is_word(packet.parameters[0])) return Answer::bad_value();
  serial_.set_ack_delay(static_cast<int>(packet.parameters[0]));
  return Answer{};
}

}  // namespace interpolated_motion::emulation
