#include "interpolated_motion_driver/emulation/silverdust/register_commands.h"

#include "interpolated_motion_driver/emulation/silverdust/command_values.h"

namespace interpolated_motion::emulation {

using namespace command_value;

Answer RegisterCommands::obey(Command command, const Packet& packet) {
  switch (command) {
    case Command::ReadRegister:
      return read(packet);
    case Command::WriteRegister:
    case Command::WriteRegisterProgram:
      return write(packet);
    default:
      return Answer::nak(NakCode::BadCommand);
  }
}

Answer RegisterCommands::read(const Packet& packet) const {
  const std::size_t count = packet.parameter_count;
  if (count > 1 && !parameters_.multi_register_read) return Answer::nak(NakCode::BadFormat);
  Answer answer = Answer::data(to_word(packet.command));
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t number = packet.parameters[i];
    if (!RegisterFile::exists(number)) return Answer::bad_value();
    answer.add_long(registers_.read(number));
  }
  return answer;
}

Answer RegisterCommands::write(const Packet& packet) {
  const std::int64_t number = packet.parameters[0];
  const std::int64_t value = packet.parameters[1];
  if (!RegisterFile::writable(number) || !is_long(value)) return Answer::bad_value();
  return registers_.write(number, to_int32(value)) ? Answer{} : Answer::command_error();
}

}  // namespace interpolated_motion::emulation
