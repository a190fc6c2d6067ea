#include <limits>

#include "implementation.h"

// What the commands with parameters do, and which values they take.
namespace interpolated_motion::emulation {
namespace {

constexpr std::int64_t kInt32Min = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t kInt32Max = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kUint32Max = std::numeric_limits<std::uint32_t>::max();
constexpr std::int64_t kInt16Min = std::numeric_limits<std::int16_t>::min();
constexpr std::int64_t kWordMax = std::numeric_limits<std::uint16_t>::max();
constexpr std::int64_t kLargestDeceleration = std::int64_t{1} << 29;  // of STP
constexpr std::int64_t kLargestAcceleration = std::int64_t{1} << 30;  // of ordinary motions
constexpr std::int64_t kLargestAddress = 254;

bool in_range(std::int64_t value, std::int64_t low, std::int64_t high) {
  return value >= low && value <= high;
}
bool is_word(std::int64_t value) { return in_range(value, 0, kWordMax); }

// A word of 32 bit may be written signed or unsigned.
bool is_long(std::int64_t value) { return in_range(value, kInt32Min, kUint32Max); }

std::int32_t to_int32(std::int64_t value) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
}

std::uint16_t to_word(std::int64_t value) { return static_cast<std::uint16_t>(value); }

}  // namespace

SilverDust::Implementation::Answer SilverDust::Implementation::clear_poll(const Packet& packet) {
  if (!is_word(packet.parameters[0])) return bad_value();
  polling_.clear(to_word(packet.parameters[0]));
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::restart_command() {
  restart(now_, now_ + parameters_.boot_time);
  Answer answer;
  answer.kind = Answer::Kind::None;
  return answer;
}

SilverDust::Implementation::Answer SilverDust::Implementation::read_registers(const Packet& packet) {
  const std::size_t count = packet.parameter_count;
  if (count > 1 && !parameters_.multi_register_read) return nak(NakCode::BadFormat);
  Answer answer;
  answer.kind = Answer::Kind::Data;
  answer.echo = to_word(packet.command);
  for (std::size_t i = 0; i < count; ++i) {
    if (!RegisterFile::exists(packet.parameters[i])) return bad_value();
    const auto value = static_cast<std::uint32_t>(read_register(packet.parameters[i]));
    answer.words[answer.word_count++] = to_word(value >> 16);
    answer.words[answer.word_count++] = to_word(value & 0xFFFF);
  }
  return answer;
}

SilverDust::Implementation::Answer SilverDust::Implementation::write_register(const Packet& packet) {
  const std::int64_t number = packet.parameters[0];
  const std::int64_t value = packet.parameters[1];
  if (!RegisterFile::writable(number) || !is_long(value)) return bad_value();
  if (!set_register(number, to_int32(value))) polling_.raise(polling_bit::kCommandError);
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::write_queue(const Packet& packet) {
  const auto& p = packet.parameters;
  const bool valid = in_range(p[0], 0, kInt32Max) && in_range(p[1], kInt32Min, kInt32Max) &&
                     in_range(p[2], 0, kInt32Max) && in_range(p[3], 0, kInt32Max);
  if (!valid) return bad_value();
  if (!queue_.push({to_int32(p[0]), to_int32(p[1]), to_int32(p[2]), to_int32(p[3])})) {
    ++counters_.segments_refused_full;
    return nak(NakCode::BufferFull);
  }
  ++counters_.segments_accepted;
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::start_interpolation(const Packet& packet) {
  const auto count = static_cast<int>(packet.parameter_count);
  const bool expected = parameters_.ims_arguments < 0 ? count != 1 : count == parameters_.ims_arguments;
  if (!expected) return nak(NakCode::BadFormat);
  if (!enabled_) return cannot_start();
  interpolation_.start();
  motion_ = Motion::Interpolated;
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::start_move(Command command,
                                                                          const Packet& packet) {
  const auto& p = packet.parameters;
  const bool valid = in_range(p[0], kInt32Min, kInt32Max) && in_range(p[1], 1, kLargestAcceleration) &&
                     in_range(p[2], 0, kInt32Max);
  if (!valid) return bad_value();
  if (!enabled_) return cannot_start();
  const std::int64_t goal = command == Command::MoveRelative ? profile_.counts() + p[0] : p[0];
  motion_step_ = ordinary_step(p[1]);
  profile_.move_to(to_int32(goal), motion_step_, p[2]);
  motion_ = Motion::Profile;
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::velocity_mode(const Packet& packet) {
  const auto& p = packet.parameters;
  if (!in_range(p[0], 1, kLargestAcceleration) || !in_range(p[1], kInt32Min, kInt32Max)) return bad_value();
  if (!enabled_) return cannot_start();
  program_.stop();
  interpolation_.abandon();
  motion_step_ = ordinary_step(p[0]);
  profile_.run_at(p[1], motion_step_);
  motion_ = Motion::Velocity;
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::stop(const Packet& packet) {
  const std::int64_t deceleration = packet.parameters[0];
  if (!in_range(deceleration, -1, kLargestDeceleration)) return bad_value();
  program_.stop();
  if (motion_ == Motion::None) return Answer{};
  const std::int64_t step = deceleration == 0 ? running_step() : ordinary_step(deceleration);
  interpolation_.abandon();
  if (deceleration < 0) {
    profile_.place(axis_.counts());
    end_motion();
  } else {
    profile_.brake(step);
    motion_step_ = step;
    motion_ = Motion::Stopping;
  }
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::set_error_limits(const Packet& packet) {
  const auto& p = packet.parameters;
  // Negative limits select the drag mode, which this drive does not have.
  if (!in_range(p[0], 1, -kInt16Min - 1) || !in_range(p[1], 1, -kInt16Min - 1) || !is_word(p[2]))
    return bad_value();
  moving_limit_ = static_cast<int>(p[0]);
  holding_limit_ = static_cast<int>(p[1]);
  holding_delay_ = static_cast<int>(p[2]);
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::set_identity(const Packet& packet) {
  const std::size_t unit = packet.parameter_count - 1;
  const auto& p = packet.parameters;
  if (!in_range(p[unit], 1, kLargestAddress) || (unit == 1 && !in_range(p[0], 0, kLargestAddress)))
    return bad_value();
  address_ = static_cast<int>(p[unit]);
  if (unit == 1) group_ = static_cast<int>(p[0]);
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::set_ack_delay(const Packet& packet) {
  if (!is_word(packet.parameters[0])) return bad_value();
  ack_delay_ = static_cast<int>(packet.parameters[0]);
  return Answer{};
}

// Bit 6 of the polling status word when one of the enabled bits of the internal status word is as asked for.
SilverDust::Implementation::Answer SilverDust::Implementation::check_status(const Packet& packet) {
  const auto& p = packet.parameters;
  if (!is_word(p[0]) || !is_word(p[1])) return bad_value();
  const auto equal = static_cast<std::uint16_t>(~(internal_status() ^ to_word(p[1])));
  if ((equal & to_word(p[0])) != 0) polling_.raise(polling_bit::kStatusCheck);
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::kill_conditions(const Packet& packet) {
  const auto& p = packet.parameters;
  if (!is_word(p[0]) || !is_word(p[1])) return bad_value();
  kill_enable_ = to_word(p[0]);
  kill_state_ = to_word(p[1]);
  check_kill_conditions();
  return Answer{};
}

}  // namespace interpolated_motion::emulation
