#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/hardware/bus_link.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/demand_sample.h"
#include "interpolated_motion_driver/hardware/emulated_bus.h"
#include "interpolated_motion_driver/hardware/path_audit.h"

namespace interpolated_motion::hardware {

/// Everything that one configuration asks for: buses with their masters, one axis per joint, and the emulated
/// drives of emulated buses. Built once; nothing of it moves afterwards. What a drive is made of, its kind
/// says.
class Assembly {
 public:
  /// `loop` is needed for buses outside of the process. Throws std::invalid_argument.
  Assembly(const Configuration& configuration, HostTime start, EventLoop loop);
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  /// Whether any bus is emulated: only then time passes in world().
  bool emulates() const { return !emulated_buses_.empty(); }
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
  /// As MotionHardware::set_motion_observer().
  void set_motion_observer(SampleObserver observer);

  /// Where the joint of an emulated drive stands in truth, rad or m, whether or not its bus tells; nothing if
  /// it is not emulated here.
  std::optional<double> emulated_position(std::size_t joint) const;

  /// Whether the motor of a joint's emulated drive has power; nothing if it is not emulated here.
  std::optional<bool> emulated_power(std::size_t joint) const;

  /// Injects a fault into what is called `target`, a joint or a bus. Returns why not: it is not emulated, or
  /// does not know the command.
  std::optional<std::string> inject(const std::string& target, const std::string& command, HostTime now);

 private:
  /// An emulated drive and the number of its joint.
  struct Emulated {
    std::size_t joint;
    emulation::Drive* drive;
  };

  void add_bus(const Configuration& configuration, const BusConfiguration& bus);
  std::unique_ptr<BusLink> emulated_link(const BusConfiguration& bus);
  void add_drive(const Configuration& configuration, const DriveConfiguration& drive);
  void observe_drives();
  void take_any(std::size_t joint, const DemandSample& sample);
  void take(std::size_t joint, const DemandSample& sample);

  emulation::World world_;
  EventLoop loop_;
  std::map<std::string, EmulatedBus> emulated_buses_;
  std::vector<std::unique_ptr<BusLink>> links_;
  std::vector<std::unique_ptr<axis::Axis>> axes_;
  std::vector<Mechanism> mechanisms_;  ///< as `joints` orders them
  std::vector<PathAudit> audits_;
  bool auditing_ = false;
  SampleObserver sample_observer_;
  SampleObserver motion_observer_;
  std::map<std::string, Emulated> emulated_drives_;  ///< by joint
};

}  // namespace interpolated_motion::hardware
