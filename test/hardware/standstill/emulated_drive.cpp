#include "hardware/standstill/emulated_drive.h"

namespace interpolated_motion::test {
namespace {

constexpr std::uint32_t kSync = 0x080;
constexpr std::uint32_t kTpdo1 = 0x180;
constexpr std::uint8_t kStart = 1;  // NMT
constexpr emulation::FaultNumber kCounts{"COUNTS", -1e6, 1e6};

}  // namespace

StandstillDrive::StandstillDrive(transport::VirtualCanBus& bus, const StandstillParameters& parameters,
                                 HostTime /*now*/)
    : bus_(bus), port_(bus.add_port(*this)), node_id_(parameters.node_id), position_(parameters.position) {}

void StandstillDrive::on_can_frame(const canopen::Frame& frame, HostTime time) {
  if (silent_) return;
  const bool for_me = frame.data[1] == 0 || frame.data[1] == node_id_;
  if (frame.id == 0 && for_me) operational_ = frame.data[0] == kStart;
  if (frame.id == kSync && operational_) report(time);
}

void StandstillDrive::report(HostTime time) {
  canopen::Frame frame;
  frame.id = kTpdo1 + static_cast<std::uint32_t>(node_id_);
  frame.length = 4;
  const auto bits = static_cast<std::uint32_t>(position_);
  for (unsigned i = 0; i < 4; ++i) frame.data[i] = static_cast<std::uint8_t>(bits >> (8 * i));
  bus_.send(port_, frame, time);
  const double demand = position_;
  if (observer_) observer_({time, 0.0, demand, position_, 0.0, true});
}

std::vector<emulation::FaultCommand> StandstillDrive::own_faults(HostTime /*now*/) {
  return {{"wedge", {kCounts}, [this](const emulation::FaultCommand::Numbers& n) {
             position_ += static_cast<std::int32_t>(n[0]);
           }}};
}

}  // namespace interpolated_motion::test
