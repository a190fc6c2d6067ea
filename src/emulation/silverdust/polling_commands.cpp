#include "interpolated_motion_driver/emulation/silverdust/polling_commands.h"

#include "interpolated_motion_driver/emulation/silverdust/command_values.h"

namespace interpolated_motion::emulation {

using namespace command_value;

Answer PollingCommands::obey(Command command, const Packet& packet) {
  switch (command) {
    case Command::Poll:
      return poll();
    case Command::PollRoutine:
      return poll_in_full();
    case Command::ClearPoll:
      return clear(packet);
    default:
      return Answer::nak(NakCode::BadCommand);
  }
}

Answer PollingCommands::poll() {
  const std::uint16_t status = status_.report();
  return status == 0 ? Answer{} : Answer::word(Command::Poll, status);
}

Answer PollingCommands::poll_in_full() {
  Answer answer = Answer::data(parameters_.por_echo);
  answer.add_word(status_.report());
  return answer;
}

Answer PollingCommands::clear(const Packet& packet) {
  if (!is_word(packet.parameters[0])) return Answer::bad_value();
  status_.clear(to_word(packet.parameters[0]));
  return Answer{};
}

}  // namespace interpolated_motion::emulation
