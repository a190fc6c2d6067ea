#include "hardware/standstill/drive_kind.h"

#include <cstdint>

#include "hardware/standstill/axis.h"
#include "hardware/standstill/emulated_drive.h"
#include "interpolated_motion_driver/hardware/can_bits.h"
#include "interpolated_motion_driver/hardware/drive_parameters.h"

namespace interpolated_motion::test {
namespace {

using hardware::Configuration;
using hardware::DriveConfiguration;

class StandstillKind : public hardware::CanDriveKind {
 public:
  const char* name() const override { return "standstill"; }
  const char* product() const override { return "standstill"; }
  double default_deviation_bound() const override { return 1.0; }
  bool follows_host_time() const override { return true; }
  double bits_per_sync(const DriveConfiguration& /*drive*/,
                       const hardware::BusConfiguration& /*bus*/) const override {
    return hardware::longest_frame_bits(4);
  }

  std::shared_ptr<const hardware::DriveSettings> parse(hardware::ParameterReader& /*reader*/,
                                                       hardware::ParameterReader& /*emulation*/,
                                                       const DriveConfiguration& /*drive*/) const override {
    return std::make_shared<hardware::DriveSettings>();
  }

 private:
  std::unique_ptr<axis::Axis> make_axis_on(hardware::CanLink& link, const DriveConfiguration& drive,
                                           const Configuration& all) const override {
    axis::AxisParameters parameters;
    hardware::set_axis_parameters(parameters, drive, all);
    canopen::NodeLink& node = link.master().add_node(static_cast<std::uint8_t>(drive.number));
    return std::make_unique<StandstillAxis>(parameters, link.master(), node);
  }

  emulation::Drive& make_emulated_on(transport::VirtualCanBus& bus, const DriveConfiguration& drive,
                                     emulation::World& world) const override {
    return world.add<StandstillDrive>(bus,
                                      StandstillParameters{drive.number, drive.emulation.initial_position});
  }
};

}  // namespace

const hardware::DriveKind& standstill_kind() {
  static const StandstillKind kind;
  return kind;
}

}  // namespace interpolated_motion::test
