#include "interpolated_motion_driver/hardware/assembly.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/can_link.h"
#include "interpolated_motion_driver/hardware/drive_kind.h"
#include "interpolated_motion_driver/hardware/serial_link.h"
#include "interpolated_motion_driver/hardware/serial_port_device.h"
#include "interpolated_motion_driver/hardware/socketcan_device.h"

namespace interpolated_motion::hardware {

namespace {

transport::SocketcanParameters socketcan_parameters(const Configuration& configuration,
                                                    const BusConfiguration& bus) {
  transport::SocketcanParameters parameters;
  parameters.interface = bus.socketcan.interface;
  parameters.bitrate = bus.bitrate;
  if (bus.socketcan.receive_all) return parameters;
  parameters.node_ids.push_back(static_cast<std::uint8_t>(bus.host_node_id));
  for (const DriveConfiguration& drive : configuration.drives)
    if (drive.bus == bus.name) parameters.node_ids.push_back(static_cast<std::uint8_t>(drive.number));
  return parameters;
}

transport::SerialPortParameters port_parameters(const BusConfiguration& bus) {
  constexpr int kStartAndDataBits = 9;
  transport::SerialPortParameters parameters;
  parameters.device = bus.port.device;
  parameters.baud = static_cast<int>(bus.serial.line.baud);
  parameters.stop_bits = bus.serial.line.bits_per_character - kStartAndDataBits;
  parameters.low_latency = bus.port.low_latency;
  parameters.rs485 = bus.port.rs485;
  return parameters;
}

std::unique_ptr<BusLink> socketcan_link(const Configuration& configuration, const BusConfiguration& bus,
                                        const EventLoop& loop, HostTime now) {
  auto device = std::make_unique<SocketcanDevice>(loop, socketcan_parameters(configuration, bus), now);
  transport::CanBus& wire = device->bus();
  return std::make_unique<CanLink>(bus, wire, std::move(device));
}

std::unique_ptr<BusLink> serial_port_link(const BusConfiguration& bus, const EventLoop& loop, HostTime now) {
  auto device = std::make_unique<SerialPortDevice>(loop, port_parameters(bus), now);
  transport::SerialLine& wire = device->line();
  return std::make_unique<SerialLink>(bus, wire, std::move(device));
}

std::unique_ptr<BusLink> link_to(transport::VirtualCanBus& wire, const BusConfiguration& bus) {
  return std::make_unique<CanLink>(bus, wire.host());
}

std::unique_ptr<BusLink> link_to(transport::VirtualSerialLine& wire, const BusConfiguration& bus) {
  return std::make_unique<SerialLink>(bus, wire.host());
}

}  // namespace

Assembly::Assembly(const Configuration& configuration, HostTime start, EventLoop loop)
    : world_(start), loop_(std::move(loop)) {
  for (const BusConfiguration& bus : configuration.buses) add_bus(configuration, bus);
  audits_.reserve(configuration.drives.size());
  for (const DriveConfiguration& drive : configuration.drives) add_drive(configuration, drive);
}

void Assembly::add_bus(const Configuration& configuration, const BusConfiguration& bus) {
  if (bus.transport != TransportKind::Emulated && loop_.io == nullptr) {
    throw std::invalid_argument(fmt::format(
        "Parameter buses/{}/transport: only an emulated bus does without an event loop.", bus.name));
  }
  switch (bus.transport) {
    case TransportKind::Emulated:
      return links_.push_back(emulated_link(bus));
    case TransportKind::Socketcan:
      return links_.push_back(socketcan_link(configuration, bus, loop_, world_.now()));
    case TransportKind::Serial:
      return links_.push_back(serial_port_link(bus, loop_, world_.now()));
  }
}

std::unique_ptr<BusLink> Assembly::emulated_link(const BusConfiguration& bus) {
  const EmulatedBus emulated = add_emulated_bus(world_, bus);
  emulated_buses_[bus.name] = emulated;
  return std::visit([&bus](auto* wire) { return link_to(*wire, bus); }, emulated);
}

void Assembly::add_drive(const Configuration& configuration, const DriveConfiguration& drive) {
  const auto link = std::find_if(links_.begin(), links_.end(),
                                 [&drive](const auto& one) { return one->name() == drive.bus; });
  const std::size_t joint = axes_.size();
  axes_.push_back(drive.kind->make_axis(drive, configuration, **link));
  mechanisms_.push_back(drive.emulation.mechanism);
  audits_.emplace_back(drive.emulation.mechanism, *axes_.back(), drive.kind->follows_host_time());
  const auto bus = emulated_buses_.find(drive.bus);
  if (bus == emulated_buses_.end() || drive.emulation.missing) return;
  emulated_drives_[drive.joint] = {joint, &drive.kind->make_emulated(drive, world_, bus->second)};
}

void Assembly::begin_audits(const std::vector<trajectory::Path>& paths, HostTime now) {
  for (std::size_t i = 0; i < audits_.size(); ++i) audits_[i].begin(paths[i], now);
  auditing_ = true;
  observe_drives();
}

void Assembly::end_audits(HostTime now) {
  for (PathAudit& audit : audits_) audit.end(now);
  auditing_ = false;
  observe_drives();
}

void Assembly::set_motion_observer(SampleObserver observer) {
  motion_observer_ = std::move(observer);
  observe_drives();
}

// Drives that nobody looks at compute less.
void Assembly::observe_drives() {
  const bool wanted = auditing_ || motion_observer_;
  for (const auto& [name, emulated] : emulated_drives_) {
    emulation::Drive::Observer observer;
    if (wanted) {
      observer = [this, joint = emulated.joint](const DemandSample& sample) { take_any(joint, sample); };
    }
    emulated.drive->observe(observer);
  }
}

void Assembly::take_any(std::size_t joint, const DemandSample& sample) {
  if (motion_observer_) motion_observer_(joint, sample);
  if (auditing_ && sample.interpolating) take(joint, sample);
}

void Assembly::take(std::size_t joint, const DemandSample& sample) {
  audits_[joint].add(sample);
  if (sample_observer_) sample_observer_(joint, sample);
}

std::optional<double> Assembly::emulated_position(std::size_t joint) const {
  for (const auto& [name, emulated] : emulated_drives_) {
    if (emulated.joint == joint) return mechanisms_[joint].position(emulated.drive->position());
  }
  return std::nullopt;
}

std::optional<bool> Assembly::emulated_power(std::size_t joint) const {
  for (const auto& [name, emulated] : emulated_drives_) {
    if (emulated.joint == joint) return emulated.drive->has_torque();
  }
  return std::nullopt;
}

std::optional<std::string> Assembly::inject(const std::string& target, const std::string& command,
                                            HostTime now) {
  const auto drive = emulated_drives_.find(target);
  if (drive != emulated_drives_.end()) return drive->second.drive->inject(command, now);
  const auto bus = emulated_buses_.find(target);
  if (bus != emulated_buses_.end()) return hardware::inject(bus->second, command, now);
  return fmt::format("\"{}\" is neither a joint with an emulated drive nor an emulated bus", target);
}

}  // namespace interpolated_motion::hardware
