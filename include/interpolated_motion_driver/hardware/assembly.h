#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/silverlode/line_start.h"
#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/hardware/bus_link.h"
#include "interpolated_motion_driver/hardware/can_link.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/demand_sample.h"
#include "interpolated_motion_driver/hardware/path_audit.h"
#include "interpolated_motion_driver/hardware/serial_link.h"

namespace interpolated_motion::hardware {

/// Everything that one configuration asks for: buses with their masters, one axis per joint, and the emulated
/// drives of emulated buses. Built once; nothing of it moves afterwards.
class Assembly {
 public:
  /// `loop` is needed for buses outside of the process. Throws std::invalid_argument.
  Assembly(const Configuration& configuration, HostTime start, EventLoop loop);
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  /// Whether any bus is emulated: only then time passes in world().
  bool emulates() const { return !virtual_can_buses_.empty() || !virtual_lines_.empty(); }
  emulation::World& world() { return world_; }
  const std::vector<std::unique_ptr<BusLink>>& links() const { return links_; }
  const std::vector<std::unique_ptr<axis::Axis>>& axes() const { return axes_; }  ///< as `joints` orders them

  /// From now on the samples of each emulated drive are held against the path of its joint.
  void begin_audits(const std::vector<trajectory::Path>& paths, HostTime now);
  /// The drives have been told to leave their paths.
  void end_audits(HostTime now);
  /// One per joint; without a sample while the joint's drive is not emulated.
  std::vector<PathAudit>& audits() { return audits_; }
  /// `observer` sees all samples that are audited.
  void set_sample_observer(SampleObserver observer) { sample_observer_ = std::move(observer); }

  /// Where the emulated drive of a joint stands, rad, whether or not its bus tells; nothing if it is not
  /// emulated here.
  std::optional<double> emulated_position(std::size_t joint) const;

  /// Injects a fault into what is called `target`, a joint or a bus. False with a reason when it is not
  /// emulated or the command is unknown.
  bool inject(const std::string& target, const std::string& command, HostTime now, std::string* reason);

 private:
  using Injector = std::function<std::optional<std::string>(const std::string& command, HostTime now)>;

  void add_bus(const Configuration& configuration, const BusConfiguration& bus);
  void add_emulated_can_bus(const BusConfiguration& bus);
  void add_emulated_line(const BusConfiguration& bus);
  void add_socketcan_bus(const Configuration& configuration, const BusConfiguration& bus);
  void add_serial_port(const BusConfiguration& bus);
  void add_link(std::unique_ptr<CanLink> link);
  void add_link(std::unique_ptr<SerialLink> link);
  void add_drive(const Configuration& configuration, const DriveConfiguration& drive);
  void add_epos(const Configuration& configuration, const DriveConfiguration& drive);
  void add_silverlode(const Configuration& configuration, const DriveConfiguration& drive);
  void add_cyclic(const Configuration& configuration, const DriveConfiguration& drive);
  void emulate_epos(const DriveConfiguration& drive, std::size_t index);
  void emulate_silverlode(const DriveConfiguration& drive, std::size_t index);
  void emulate_cyclic(const DriveConfiguration& drive, std::size_t index);
  axis::LineStart* common_start(const DriveConfiguration& drive);
  void observe(const DriveConfiguration& drive, std::size_t index, emulation::Drive& emulated);
  void take(std::size_t joint, const DemandSample& sample);

  emulation::World world_;
  EventLoop loop_;
  std::map<std::string, BusConfiguration> bus_configurations_;
  std::map<std::string, CanLink*> can_links_;
  std::map<std::string, SerialLink*> serial_links_;
  std::map<std::string, std::unique_ptr<axis::LineStart>> line_starts_;
  std::map<std::string, transport::VirtualCanBus*> virtual_can_buses_;
  std::map<std::string, transport::VirtualSerialLine*> virtual_lines_;
  std::vector<std::unique_ptr<BusLink>> links_;
  std::vector<std::unique_ptr<axis::Axis>> axes_;
  std::vector<PathAudit> audits_;
  SampleObserver sample_observer_;
  /// Switch the samples of an emulated drive on and off: drives that nobody looks at compute less.
  std::vector<std::function<void(bool on)>> sampling_;
  std::map<std::string, Injector> injectors_;
  std::map<std::size_t, std::function<double()>> emulated_positions_;  ///< by joint, rad
};

}  // namespace interpolated_motion::hardware
