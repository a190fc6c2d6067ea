#include "interpolated_motion_driver/hardware/epos/drive_kind.h"

#include <cstdint>

#include "interpolated_motion_driver/axis/epos/epos_axis.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/hardware/can_bits.h"
#include "interpolated_motion_driver/hardware/drive_parameters.h"
#include "interpolated_motion_driver/hardware/epos/configuration.h"

namespace interpolated_motion::hardware {

namespace {

class EposKind : public CanDriveKind {
 public:
  const char* name() const override { return "epos_ipm"; }
  const char* product() const override { return "EPOS2"; }
  double default_deviation_bound() const override { return 1.0; }
  bool sends_records() const override { return true; }

  /// A position and a buffer report, and a tenth of a demand report.
  double bits_per_sync(const BusConfiguration& /*bus*/) const override { return 2.1 * longest_frame_bits(8); }

  std::shared_ptr<const DriveSettings> parse(ParameterReader& reader, ParameterReader& emulation,
                                             const DriveConfiguration& drive) const override {
    return parse_epos(reader, emulation, drive);
  }

 private:
  std::unique_ptr<axis::Axis> make_axis_on(CanLink& link, const DriveConfiguration& drive,
                                           const Configuration& all) const override {
    axis::EposAxisParameters parameters;
    set_cia402_parameters(parameters, drive, all, link);
    set_record_parameters(parameters, drive, all);
    parameters.stream_deviation_bound = settings_of<EposSettings>(drive).stream_deviation_bound;
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
