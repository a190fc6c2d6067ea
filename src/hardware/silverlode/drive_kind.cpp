#include "interpolated_motion_driver/hardware/silverlode/drive_kind.h"

#include <algorithm>
#include <any>
#include <cstdint>

#include "interpolated_motion_driver/axis/silverlode/ims_plan.h"
#include "interpolated_motion_driver/axis/silverlode/line_start.h"
#include "interpolated_motion_driver/axis/silverlode/queue_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/register_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/hardware/drive_parameters.h"
#include "interpolated_motion_driver/hardware/silverlode/configuration.h"
#include "interpolated_motion_driver/protocol/silverlode/line_silence.h"

namespace interpolated_motion::hardware {

namespace {

/// s, that one segment takes of the line.
double segment_time(const SilverlodeSettings& settings, const silverlode::LineMaster& line) {
  return settings.queue == axis::SegmentQueue::Registers ? axis::RegisterDelivery::segment_time(line)
                                                         : axis::QueueDelivery::segment_time(line);
}

/// From the start command to the begin of the path each drive of a line needs the time of IMS and of a few
/// segments. s.
double start_lead(const DriveConfiguration& drive, const Configuration& all,
                  const silverlode::LineMaster& line) {
  constexpr auto kSegmentsOfStart = static_cast<double>(axis::kSegmentsOfLead);
  const BusConfiguration& bus = all.bus_of(drive);
  double lead = bus.serial.start_lead;
  for (const DriveConfiguration& other : all.drives) {
    if (other.bus != bus.name || other.kind != drive.kind) continue;
    lead += kSegmentsOfStart * segment_time(settings_of<SilverlodeSettings>(other), line) / bus.max_load;
  }
  return lead;
}

/// What starts all drives of the line at once; null where each is started by itself. They have the same
/// arguments of IMS, see check_common_start().
axis::LineStart* common_start(SerialLink& link, const DriveConfiguration& drive, const Configuration& all) {
  using Shared = std::shared_ptr<axis::LineStart>;
  if (all.bus_of(drive).serial.start != LineStartKind::Global) return nullptr;
  std::any& shared = link.shared_by(*drive.kind);
  if (!shared.has_value()) {
    const std::string& arguments = settings_of<SilverlodeSettings>(drive).ims_arguments;
    shared = std::make_shared<axis::LineStart>(link.master(), arguments);
  }
  return std::any_cast<Shared&>(shared).get();
}

/// s of motion kept in a drive: a drive that falls silent takes the line from the others, which must not run
/// dry before that is known.
double commit_horizon(const DriveConfiguration& drive, const Configuration& all) {
  const auto on_line = std::count_if(all.drives.begin(), all.drives.end(),
                                     [&](const DriveConfiguration& other) { return other.bus == drive.bus; });
  if (on_line == 1) return all.commit_horizon;
  const double silence = seconds(silverlode::longest_silence(all.bus_of(drive).serial.line));
  return std::max(all.commit_horizon, silence);
}

axis::SilverlodeAxisParameters axis_parameters(const DriveConfiguration& drive, const Configuration& all,
                                               const silverlode::LineMaster& line) {
  const BusConfiguration& bus = all.bus_of(drive);
  const auto& settings = settings_of<SilverlodeSettings>(drive);
  axis::SilverlodeAxisParameters parameters;
  set_axis_parameters(parameters, drive, all);
  set_record_parameters(parameters, drive, all);
  parameters.commit_horizon = commit_horizon(drive, all);
  parameters.stream_deviation_bound = settings.stream_deviation_bound;
  parameters.line_share = bus.max_load;
  parameters.start_lead = start_lead(drive, all, line);
  parameters.status_period = host_duration(bus.serial.status_period);
  parameters.scale = settings.scale;
  parameters.command_scale = settings.command_scale;
  parameters.ims_arguments = settings.ims_arguments;
  parameters.queue = settings.queue;
  parameters.queue_depth = settings.queue_depth;
  parameters.target_in_motion = settings.target_in_motion;
  parameters.segment_registers = settings.segment_registers;
  return parameters;
}

class SilverlodeKind : public LineDriveKind {
 public:
  const char* name() const override { return "silverlode_ims"; }
  const char* product() const override { return "SilverLode"; }
  double default_deviation_bound() const override { return 2.0; }

  std::shared_ptr<const DriveSettings> parse(ParameterReader& reader, ParameterReader& emulation,
                                             const DriveConfiguration& drive) const override {
    return parse_silverlode(reader, emulation, drive);
  }

  void check(const DriveConfiguration& drive, const Configuration& all) const override {
    check_common_start(drive, all);
  }

 private:
  std::unique_ptr<axis::Axis> make_axis_on(SerialLink& link, const DriveConfiguration& drive,
                                           const Configuration& all) const override {
    silverlode::DeviceLink& device = link.master().add_device(static_cast<std::uint8_t>(drive.number));
    return std::make_unique<axis::SilverlodeAxis>(axis_parameters(drive, all, link.master()), link.master(),
                                                  device, common_start(link, drive, all));
  }

  emulation::Drive& make_emulated_on(transport::VirtualSerialLine& line, const DriveConfiguration& drive,
                                     emulation::World& world) const override {
    emulation::SilverDustParameters parameters = settings_of<SilverlodeSettings>(drive).emulated;
    parameters.clock_error_ppm = drive.emulation.clock_error_ppm;
    return world.add<emulation::SilverDust>(line, parameters);
  }
};

}  // namespace

const DriveKind& silverlode_kind() {
  static const SilverlodeKind kind;
  return kind;
}

}  // namespace interpolated_motion::hardware
