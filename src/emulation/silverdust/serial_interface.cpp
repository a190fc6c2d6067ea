#include "interpolated_motion_driver/emulation/silverdust/serial_interface.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::int64_t kGlobalAddress = 255;
constexpr std::size_t kLongestAnswer = 64;

}  // namespace

SerialInterface::SerialInterface(transport::VirtualSerialLine& line, transport::SerialListener& listener,
                                 const SilverDustParameters& parameters)
    : parameters_(parameters),
      line_(line),
      port_(line.add_port(listener)),
      address_(parameters.address),
      group_(parameters.group),
      ack_delay_(parameters.ack_delay) {
  text_.reserve(kLongestAnswer);
}

void SerialInterface::restart(HostTime now) {
  drop_answers(now);
  parser_.reset();
  address_ = parameters_.address;
  group_ = parameters_.group;
  ack_delay_ = parameters_.ack_delay;
}

void SerialInterface::silence(bool silent, HostTime now) {
  silent_ = silent;
  parser_.reset();
  if (silent) drop_answers(now);
}

void SerialInterface::drop_answers(HostTime now) {
  line_.connect(port_, false, now);
  line_.connect(port_, true, now);
}

bool SerialInterface::obeys(const Packet& packet) const {
  const bool shared = packet.address == kGlobalAddress || (group_ != 0 && packet.address == group_);
  return shared || packet.address == address_;
}

SerialInterface::Reply SerialInterface::reply_to(const Packet& packet, HostTime time) const {
  Reply reply;
  reply.expected = packet.address == address_;
  reply.address = address_;
  reply.command = static_cast<std::uint16_t>(packet.command);
  reply.time = time + ack_delay_ * parameters_.tick + parameters_.turnaround;
  return reply;
}

void SerialInterface::send(const Answer& answer, const Reply& reply) {
  if (!reply.expected) return;
  if (answer.refused()) ++naks_;
  text_.clear();
  answer.append_to(text_, reply.address, reply.command);
  line_.send(port_, text_, reply.time);
}

}  // namespace interpolated_motion::emulation
