#include "interpolated_motion_driver/emulation/silverdust/status_commands.h"

#include "interpolated_motion_driver/emulation/silverdust/command_values.h"

namespace interpolated_motion::emulation {

using namespace command_value;

Answer StatusCommands::obey(Command command, const Packet& packet) {
  switch (command) {
    case Command::ReadInternalStatus:
      return Answer::word(command, electronics_.status().word());
    case Command::ReadIo:
      return Answer::word(command, electronics_.status().io_word(motion_.active()));
    case Command::ClearInternalStatus:
      return clear();
    case Command::CheckInternalStatus:
      return check(packet);
    default:
      return Answer::nak(NakCode::BadCommand);
  }
}

Answer StatusCommands::clear() {
  electronics_.clear_status();
  return Answer{};
}

// Bit 6 of the polling status word when one of the enabled bits of the internal status word is as asked for.
Answer StatusCommands::check(const Packet& packet) {
  const auto& p = packet.parameters;
  if (!is_word(p[0]) || !is_word(p[1])) return Answer::bad_value();
  const auto equal = static_cast<std::uint16_t>(~(electronics_.status().word() ^ to_word(p[1])));
  if ((equal & to_word(p[0])) != 0) polling_.raise(polling_bit::kStatusCheck);
  return Answer{};
}

}  // namespace interpolated_motion::emulation
