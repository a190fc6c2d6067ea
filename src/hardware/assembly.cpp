#include "interpolated_motion_driver/hardware/assembly.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/cyclic/cyclic_axis.h"
#include "interpolated_motion_driver/axis/epos/epos_axis.h"
#include "interpolated_motion_driver/axis/silverlode/queue_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/register_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"
#include "interpolated_motion_driver/emulation/bus_faults.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/hardware/serial_port_device.h"
#include "interpolated_motion_driver/hardware/socketcan_device.h"

namespace interpolated_motion::hardware {

namespace {

void set_parameters(axis::AxisParameters& parameters, const Configuration& configuration,
                    const DriveConfiguration& drive) {
  parameters.joint = drive.joint;
  parameters.transmission = drive.transmission;
  parameters.limits = drive.limits;
  parameters.max_following_error = drive.max_following_error;
  parameters.bring_up_timeout = host_duration(configuration.bring_up_timeout);
}

void set_bus_parameters(axis::Cia402AxisParameters& parameters, const BusConfiguration& bus,
                        double record_bus_time) {
  parameters.record_bus_time = record_bus_time;
  parameters.host_node_id = static_cast<std::uint8_t>(bus.host_node_id);
  parameters.heartbeat_period = host_duration(bus.heartbeat_period);
  parameters.heartbeat_timeout = host_duration(bus.heartbeat_timeout);
  parameters.feedback_timeout = host_duration(bus.feedback_timeout);
}

/// Of an axis that encodes records and keeps them in its drive.
template <class Parameters>
void set_record_parameters(Parameters& parameters, const Configuration& configuration,
                           const DriveConfiguration& drive) {
  parameters.deviation_bound = drive.deviation_bound;
  parameters.stream_deviation_bound = drive.stream_deviation_bound;
  parameters.limit_margin = drive.limit_margin;
  parameters.commit_horizon = configuration.commit_horizon;
  parameters.stream_horizon = configuration.setpoints.horizon.count();
}

axis::EposAxisParameters epos_parameters(const Configuration& configuration, const DriveConfiguration& drive,
                                         const BusConfiguration& bus, double record_bus_time) {
  axis::EposAxisParameters parameters;
  set_parameters(parameters, configuration, drive);
  set_bus_parameters(parameters, bus, record_bus_time);
  set_record_parameters(parameters, configuration, drive);
  parameters.clock_discipline = bus.clock_discipline;
  return parameters;
}

axis::SilverlodeAxisParameters silverlode_parameters(const Configuration& configuration,
                                                     const DriveConfiguration& drive,
                                                     const BusConfiguration& bus, double start_lead) {
  axis::SilverlodeAxisParameters parameters;
  set_parameters(parameters, configuration, drive);
  set_record_parameters(parameters, configuration, drive);
  parameters.line_share = bus.max_load;
  parameters.start_lead = start_lead;
  parameters.status_period = host_duration(bus.serial.status_period);
  parameters.scale = drive.silverlode.scale;
  parameters.command_scale = drive.silverlode.command_scale;
  parameters.ims_arguments = drive.silverlode.ims_arguments;
  parameters.queue = drive.silverlode.queue;
  parameters.queue_depth = drive.silverlode.queue_depth;
  parameters.segment_registers = drive.silverlode.segment_registers;
  return parameters;
}

axis::CyclicAxisParameters cyclic_parameters(const Configuration& configuration,
                                             const DriveConfiguration& drive, const BusConfiguration& bus,
                                             double record_bus_time) {
  axis::CyclicAxisParameters parameters;
  set_parameters(parameters, configuration, drive);
  set_bus_parameters(parameters, bus, record_bus_time);
  parameters.deviation_bound = drive.deviation_bound;
  parameters.sync_period = host_duration(bus.sync_period);
  parameters.interpolation_order = drive.cyclic.interpolation_order;
  parameters.servo_period = drive.cyclic.servo_period;
  parameters.velocity_unit = drive.cyclic.velocity_unit;
  parameters.acceleration_unit = drive.cyclic.acceleration_unit;
  return parameters;
}

double segment_time(const DriveConfiguration& drive, const silverlode::LineMaster& line) {
  return drive.silverlode.queue == axis::SegmentQueue::Registers ? axis::RegisterDelivery::segment_time(line)
                                                                 : axis::QueueDelivery::segment_time(line);
}

/// From the start command to the begin of the path each drive of a line needs the time of IMS and of a few
/// segments.
double start_lead(const BusConfiguration& bus, const Configuration& configuration,
                  const silverlode::LineMaster& line) {
  constexpr double kSegmentsOfStart = 4.0;
  double lead = bus.serial.start_lead;
  for (const DriveConfiguration& drive : configuration.drives) {
    if (drive.bus == bus.name) lead += kSegmentsOfStart * segment_time(drive, line) / bus.max_load;
  }
  return lead;
}

transport::SocketcanParameters socketcan_parameters(const Configuration& configuration,
                                                    const BusConfiguration& bus) {
  transport::SocketcanParameters parameters;
  parameters.interface = bus.socketcan.interface;
  parameters.bitrate = bus.bitrate;
  if (bus.socketcan.receive_all) return parameters;
  parameters.node_ids.push_back(static_cast<std::uint8_t>(bus.host_node_id));
  for (const DriveConfiguration& drive : configuration.drives)
    if (drive.bus == bus.name) parameters.node_ids.push_back(static_cast<std::uint8_t>(drive.node_id));
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

}  // namespace

Assembly::Assembly(const Configuration& configuration, HostTime start, EventLoop loop)
    : world_(start), loop_(std::move(loop)) {
  for (const BusConfiguration& bus : configuration.buses) add_bus(configuration, bus);
  audits_.reserve(configuration.drives.size());
  for (const DriveConfiguration& drive : configuration.drives) {
    add_drive(configuration, drive);
  }
}

void Assembly::add_bus(const Configuration& configuration, const BusConfiguration& bus) {
  bus_configurations_[bus.name] = bus;
  if (bus.transport != TransportKind::Emulated && loop_.io == nullptr) {
    throw std::invalid_argument(fmt::format(
        "Parameter buses/{}/transport: only an emulated bus does without an event loop.", bus.name));
  }
  switch (bus.transport) {
    case TransportKind::Emulated:
      return bus.type == BusType::Canopen ? add_emulated_can_bus(bus) : add_emulated_line(bus);
    case TransportKind::Socketcan:
      return add_socketcan_bus(configuration, bus);
    case TransportKind::Serial:
      return add_serial_port(bus);
  }
}

void Assembly::add_link(std::unique_ptr<CanLink> link) {
  can_links_[link->name()] = link.get();
  links_.push_back(std::move(link));
}

void Assembly::add_link(std::unique_ptr<SerialLink> link) {
  serial_links_[link->name()] = link.get();
  links_.push_back(std::move(link));
}

void Assembly::add_socketcan_bus(const Configuration& configuration, const BusConfiguration& bus) {
  auto device =
      std::make_unique<SocketcanDevice>(loop_, socketcan_parameters(configuration, bus), world_.now());
  transport::CanBus& wire = device->bus();
  add_link(std::make_unique<CanLink>(bus, wire, std::move(device)));
}

void Assembly::add_serial_port(const BusConfiguration& bus) {
  auto device = std::make_unique<SerialPortDevice>(loop_, port_parameters(bus), world_.now());
  transport::SerialLine& wire = device->line();
  add_link(std::make_unique<SerialLink>(bus, wire, std::move(device)));
}

void Assembly::add_emulated_can_bus(const BusConfiguration& bus) {
  transport::VirtualCanBus& wire = world_.add_can_bus(bus.name, static_cast<int>(bus.bitrate));
  virtual_can_buses_[bus.name] = &wire;
  add_link(std::make_unique<CanLink>(bus, wire.host()));
  injectors_[bus.name] = [&wire](const std::string& command, HostTime now) {
    return emulation::obey_fault(command, emulation::faults_of(wire, now));
  };
}

void Assembly::add_emulated_line(const BusConfiguration& bus) {
  transport::SerialLineParameters parameters;
  parameters.baud = static_cast<int>(bus.serial.line.baud);
  parameters.bits_per_character = bus.serial.line.bits_per_character;
  parameters.wiring = bus.serial.wiring;
  transport::VirtualSerialLine& wire = world_.add_serial_line(bus.name, parameters);
  virtual_lines_[bus.name] = &wire;
  add_link(std::make_unique<SerialLink>(bus, wire.host()));
  injectors_[bus.name] = [&wire](const std::string& command, HostTime now) {
    return emulation::obey_fault(command, emulation::faults_of(wire, now));
  };
}

void Assembly::add_drive(const Configuration& configuration, const DriveConfiguration& drive) {
  switch (drive.type) {
    case DriveType::EposIpm:
      return add_epos(configuration, drive);
    case DriveType::SilverlodeIms:
      return add_silverlode(configuration, drive);
    case DriveType::Cyclic:
      return add_cyclic(configuration, drive);
  }
}

void Assembly::add_epos(const Configuration& configuration, const DriveConfiguration& drive) {
  CanLink& link = *can_links_.at(drive.bus);
  canopen::NodeLink& node = link.master().add_node(static_cast<std::uint8_t>(drive.node_id));
  const std::size_t index = axes_.size();
  axes_.push_back(std::make_unique<axis::EposAxis>(
      epos_parameters(configuration, drive, bus_configurations_.at(drive.bus), link.record_bus_time()),
      link.master(), node));
  audits_.emplace_back(drive.transmission, *axes_.back(), drive.type == DriveType::Cyclic);
  if (virtual_can_buses_.count(drive.bus) > 0 && !drive.emulation.missing) emulate_epos(drive, index);
}

void Assembly::observe(const DriveConfiguration& drive, std::size_t index, emulation::Drive& emulated) {
  injectors_[drive.joint] = [&emulated](const std::string& command, HostTime now) {
    return emulated.inject(command, now);
  };
  emulated_positions_[index] = [&emulated, transmission = drive.transmission] {
    return transmission.joint_position(emulated.position());
  };
  sampling_.push_back([this, index, &emulated](bool on) {
    if (!on) return emulated.observe({});
    emulated.observe([this, index](const DemandSample& sample) {
      if (sample.interpolating) take(index, sample);
    });
  });
}

void Assembly::emulate_epos(const DriveConfiguration& drive, std::size_t index) {
  observe(drive, index,
          world_.add<emulation::EposDrive>(*virtual_can_buses_.at(drive.bus), drive.emulation.drive));
}

void Assembly::add_silverlode(const Configuration& configuration, const DriveConfiguration& drive) {
  SerialLink& link = *serial_links_.at(drive.bus);
  silverlode::DeviceLink& device =
      link.master().add_device(static_cast<std::uint8_t>(drive.silverlode.address));
  const std::size_t index = axes_.size();
  const BusConfiguration& bus = bus_configurations_.at(drive.bus);
  const double lead = start_lead(bus, configuration, link.master());
  axes_.push_back(std::make_unique<axis::SilverlodeAxis>(
      silverlode_parameters(configuration, drive, bus, lead), link.master(), device, common_start(drive)));
  audits_.emplace_back(drive.transmission, *axes_.back(), drive.type == DriveType::Cyclic);
  if (virtual_lines_.count(drive.bus) > 0 && !drive.emulation.missing) emulate_silverlode(drive, index);
}

/// Null where each drive of the line is started by itself. All drives of a line have the same arguments of
/// IMS.
axis::LineStart* Assembly::common_start(const DriveConfiguration& drive) {
  if (bus_configurations_.at(drive.bus).serial.start != LineStartKind::Global) return nullptr;
  auto& start = line_starts_[drive.bus];
  if (!start) {
    start = std::make_unique<axis::LineStart>(serial_links_.at(drive.bus)->master(),
                                              drive.silverlode.ims_arguments);
  }
  return start.get();
}

void Assembly::emulate_silverlode(const DriveConfiguration& drive, std::size_t index) {
  observe(drive, index,
          world_.add<emulation::SilverDust>(*virtual_lines_.at(drive.bus), drive.silverlode.emulated));
}

void Assembly::add_cyclic(const Configuration& configuration, const DriveConfiguration& drive) {
  CanLink& link = *can_links_.at(drive.bus);
  canopen::NodeLink& node = link.master().add_node(static_cast<std::uint8_t>(drive.node_id));
  const std::size_t index = axes_.size();
  axes_.push_back(std::make_unique<axis::CyclicAxis>(
      cyclic_parameters(configuration, drive, bus_configurations_.at(drive.bus), link.record_bus_time()),
      link.master(), node));
  audits_.emplace_back(drive.transmission, *axes_.back(), drive.type == DriveType::Cyclic);
  if (virtual_can_buses_.count(drive.bus) > 0 && !drive.emulation.missing) emulate_cyclic(drive, index);
}

void Assembly::emulate_cyclic(const DriveConfiguration& drive, std::size_t index) {
  observe(drive, index,
          world_.add<emulation::CyclicDrive>(*virtual_can_buses_.at(drive.bus), drive.cyclic.emulated));
}

void Assembly::begin_audits(const std::vector<trajectory::Path>& paths, HostTime now) {
  for (std::size_t i = 0; i < audits_.size(); ++i) audits_[i].begin(paths[i], now);
  for (const auto& sample : sampling_) sample(true);
}

void Assembly::end_audits(HostTime now) {
  for (PathAudit& audit : audits_) audit.end(now);
  for (const auto& sample : sampling_) sample(false);
}

void Assembly::take(std::size_t joint, const DemandSample& sample) {
  audits_[joint].add(sample);
  if (sample_observer_) sample_observer_(joint, sample);
}

std::optional<double> Assembly::emulated_position(std::size_t joint) const {
  const auto found = emulated_positions_.find(joint);
  if (found == emulated_positions_.end()) return std::nullopt;
  return found->second();
}

bool Assembly::inject(const std::string& target, const std::string& command, HostTime now,
                      std::string* reason) {
  const auto found = injectors_.find(target);
  if (found != injectors_.end()) {
    const auto refused = found->second(command, now);
    if (refused) *reason = *refused;
    return !refused;
  }
  *reason = fmt::format("\"{}\" is neither a joint with an emulated drive nor an emulated bus", target);
  return false;
}

}  // namespace interpolated_motion::hardware
