#include "interpolated_motion_driver/hardware/epos/drive_kind.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/epos/epos_axis.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/hardware/can_bits.h"
#include "interpolated_motion_driver/hardware/drive_parameters.h"
#include "interpolated_motion_driver/hardware/epos/configuration.h"

namespace interpolated_motion::hardware {

namespace {

/// The drive has last heard the host up to a period before the host falls silent.
double host_watch(const BusConfiguration& bus, const Configuration& all) {
  return std::max(bus.heartbeat_timeout, all.commit_horizon + bus.heartbeat_period);
}

class EposKind : public CanDriveKind {
 public:
  const char* name() const override { return "epos_ipm"; }
  const char* product() const override { return "EPOS2"; }
  double default_deviation_bound() const override { return 1.0; }
  bool sends_records() const override { return true; }

  /// A position and a buffer report, and a tenth of a demand report.
  double bits_per_sync(const DriveConfiguration& /*drive*/, const BusConfiguration& /*bus*/) const override {
    return 2.1 * longest_frame_bits(8);
  }

  std::shared_ptr<const DriveSettings> parse(ParameterReader& reader, ParameterReader& emulation,
                                             const DriveConfiguration& drive) const override {
    return parse_epos(reader, emulation, drive);
  }

  void check(const DriveConfiguration& drive, const Configuration& all) const override {
    const BusConfiguration& bus = all.bus_of(drive);
    if (host_watch(bus, all) <= kLongestWatch) return;
    throw std::invalid_argument(fmt::format(
        "Parameters commit_horizon ({} s) and buses/{}/heartbeat_period ({} s) are {} s together; an EPOS2 "
        "watches its host over {} s at most (0x1016). Lower one of them.",
        all.commit_horizon, bus.name, bus.heartbeat_period, all.commit_horizon + bus.heartbeat_period,
        kLongestWatch));
  }

 private:
  static constexpr double kLongestWatch = 65.5;  ///< s; 16 bits of ms

  std::unique_ptr<axis::Axis> make_axis_on(CanLink& link, const DriveConfiguration& drive,
                                           const Configuration& all) const override {
    axis::EposAxisParameters parameters;
    set_cia402_parameters(parameters, drive, all, link);
    set_record_parameters(parameters, drive, all);
    parameters.stream_deviation_bound = settings_of<EposSettings>(drive).stream_deviation_bound;
    parameters.host_watch = host_duration(host_watch(all.bus_of(drive), all));
    parameters.host_watch_at_rest = host_duration(all.bus_of(drive).watch_at_rest);
    parameters.clock_discipline = all.bus_of(drive).clock_discipline;
    canopen::NodeLink& node = link.master().add_node(static_cast<std::uint8_t>(drive.number));
    return std::make_unique<axis::EposAxis>(parameters, link.master(), node);
  }

  emulation::Drive& make_emulated_on(transport::VirtualCanBus& bus, const DriveConfiguration& drive,
                                     emulation::World& world) const override {
    emulation::EposParameters parameters = settings_of<EposSettings>(drive).emulated;
    parameters.clock_error_ppm = drive.emulation.clock_error_ppm;
    return world.add<emulation::EposDrive>(bus, parameters);
  }
};

}  // namespace

const DriveKind& epos_kind() {
  static const EposKind kind;
  return kind;
}

}  // namespace interpolated_motion::hardware
