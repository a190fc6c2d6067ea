#include "interpolated_motion_driver/hardware/cyclic/drive_kind.h"

#include <cstdint>

#include "interpolated_motion_driver/axis/cyclic/cyclic_axis.h"
#include "interpolated_motion_driver/axis/cyclic/telemetry.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"
#include "interpolated_motion_driver/hardware/can_bits.h"
#include "interpolated_motion_driver/hardware/cyclic/configuration.h"
#include "interpolated_motion_driver/hardware/drive_parameters.h"

namespace interpolated_motion::hardware {

namespace {

class CyclicKind : public CanDriveKind {
 public:
  const char* name() const override { return "cyclic"; }
  const char* product() const override { return "cyclic"; }
  double default_deviation_bound() const override { return 5.0; }
  bool follows_host_time() const override { return true; }

  /// Target position with its velocity and, in a frame of its own, its torque, as far as they are asked for;
  /// status, and the slower reports by their share.
  double bits_per_sync(const DriveConfiguration& drive, const BusConfiguration& bus) const override {
    const auto& settings = settings_of<CyclicSettings>(drive);
    const HostDuration period = host_duration(bus.sync_period);
    const double torque = settings.torque_per_acceleration == 0.0 ? 0.0 : longest_frame_bits(2);
    return longest_frame_bits(settings.velocity_feedforward ? 8 : 4) + torque + longest_frame_bits(7) +
           longest_frame_bits(8) / axis::cyclic_pdo::velocity_interval(period) +
           longest_frame_bits(4) / axis::cyclic_pdo::demand_interval(period);
  }

  std::shared_ptr<const DriveSettings> parse(ParameterReader& reader, ParameterReader& emulation,
                                             const DriveConfiguration& drive) const override {
    return parse_cyclic(reader, emulation, drive);
  }

  void check(const DriveConfiguration& drive, const Configuration& all) const override {
    check_sync_period(drive, all.bus_of(drive));
  }

 private:
  std::unique_ptr<axis::Axis> make_axis_on(CanLink& link, const DriveConfiguration& drive,
                                           const Configuration& all) const override {
    const auto& settings = settings_of<CyclicSettings>(drive);
    axis::CyclicAxisParameters parameters;
    set_cia402_parameters(parameters, drive, all, link);
    parameters.deviation_bound = drive.deviation_bound;
    parameters.stream_deviation_bound = settings.stream_deviation_bound;
    parameters.limit_margin = drive.limit_margin;
    parameters.sync_period = host_duration(all.bus_of(drive).sync_period);
    parameters.interpolation_order = settings.interpolation_order;
    parameters.servo_period = settings.servo_period;
    parameters.velocity_unit = settings.velocity_unit;
    parameters.acceleration_unit = settings.acceleration_unit;
    parameters.velocity_feedforward = settings.velocity_feedforward;
    parameters.torque_per_acceleration = settings.torque_per_acceleration;
    canopen::NodeLink& node = link.master().add_node(static_cast<std::uint8_t>(drive.number));
    return std::make_unique<axis::CyclicAxis>(parameters, link.master(), node);
  }

  emulation::Drive& make_emulated_on(transport::VirtualCanBus& bus, const DriveConfiguration& drive,
                                     emulation::World& world) const override {
    emulation::CyclicParameters parameters = settings_of<CyclicSettings>(drive).emulated;
    parameters.clock_error_ppm = drive.emulation.clock_error_ppm;
    return world.add<emulation::CyclicDrive>(bus, parameters);
  }
};

}  // namespace

const DriveKind& cyclic_kind() {
  static const CyclicKind kind;
  return kind;
}

}  // namespace interpolated_motion::hardware
