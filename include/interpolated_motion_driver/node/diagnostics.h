#pragma once

#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/node/hardware_thread.h"
#include "interpolated_motion_driver/node/wire_log.h"

namespace interpolated_motion::node {

using DiagnosticStatus = diagnostic_updater::DiagnosticStatusWrapper;

/// The group of drives: OK while it can move or is switched off, ERROR with the reason in a fault.
/// `longest_turn`: of the thread that owns the buses.
void diagnose_group(const motion::Snapshot& snapshot, HostDuration longest_turn, DiagnosticStatus& status);
/// One drive: ERROR when it is silent or in fault, WARN when its buffer has run dry or it refused records.
/// `bus`: which of them tells what the bits of its statusword mean.
void diagnose_drive(const motion::JointSnapshot& joint, hardware::BusType bus, DiagnosticStatus& status);
/// One bus: ERROR with what to do when it cannot be used, WARN when frames were lost on this host or when it
/// carries more than `max_load` of its bit rate.
void diagnose_bus(const motion::BusSnapshot& bus, double max_load, DiagnosticStatus& status);
/// The wire log: WARN when frames are missing in it.
void diagnose_wire_log(const WireLog& log, DiagnosticStatus& status);

/// Publishes `/diagnostics`.
class Diagnostics {
 public:
  /// `wire_log` may be null. What is pointed to must live longer.
  Diagnostics(const ros::NodeHandle& node, const HardwareThread& hardware,
              const hardware::Configuration& configuration, const WireLog* wire_log);

  /// Publishes all statuses from the latest snapshot; to be called about once a second.
  void publish();

 private:
  void add_drive(const std::string& joint, hardware::BusType bus);
  void add_bus(const hardware::BusConfiguration& bus);

  const HardwareThread& hardware_;
  motion::Snapshot snapshot_;
  diagnostic_updater::Updater updater_;
};

}  // namespace interpolated_motion::node
