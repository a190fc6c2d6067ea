#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/protocol/canopen/nmt.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What can become of a drive as a node of its bus, whatever its power stage does.
enum class NodeEvent {
  Silent,          ///< no heartbeat comes
  Restarted,       ///< boot-up message: its communication at least has been reset
  NotOperational,  ///< it has been told to leave Operational, or says that it has: no PDO goes to or from it
  TwoDevices,      ///< more than one device answers to the node id
  OtherMaster,     ///< another master is on the bus
};

/// Watches over the NMT state of a drive (CiA 301, 7.3.2) and over who else talks to it: by its heartbeats,
/// and by the commands of others that are seen on the bus, which tell it sooner and tell who it was.
class NodeWatch {
 public:
  /// `master` and `node` must outlive the watch. `heartbeat_timeout`: for texts.
  NodeWatch(const canopen::Master& master, canopen::NodeLink& node, HostDuration heartbeat_timeout)
      : master_(master), node_(node), heartbeat_timeout_(heartbeat_timeout) {}

  /// What has happened so far is over: the drive is looked for.
  void forget();
  /// The drive is told to start (NMT): from now on it is to be operational.
  void expect_operational(HostTime now);

  /// What has happened and has not been taken yet; nothing if there is no more.
  std::optional<NodeEvent> next();
  /// Why that is a fault, without joint and node; `lost`: what a restarted drive has lost, "its settings".
  std::string text(NodeEvent event, const std::string& lost) const;

  bool silent() const { return silent_; }  ///< from Silent to the next heartbeat
  /// PDOs reach the drive, for all that is known.
  bool takes_pdos() const { return state_ == canopen::NodeState::Operational; }
  /// It takes nothing but NMT commands.
  bool stopped() const { return state_ == canopen::NodeState::Stopped; }
  /// Another master has told it to reset: that it restarts is no news.
  bool to_restart() const {
    return order_ == canopen::NmtCommand::ResetNode || order_ == canopen::NmtCommand::ResetCommunication;
  }
  /// Another master has been heard since forget().
  bool other_master() const { return forgotten_ != master_.foreign().of_master(); }

 private:
  std::optional<NodeEvent> take_order();
  std::optional<NodeEvent> take_heartbeat();
  bool has_left_operational();
  std::string not_operational_text() const;

  const canopen::Master& master_;
  canopen::NodeLink& node_;
  HostDuration heartbeat_timeout_;
  canopen::NodeState state_ = canopen::NodeState::Unknown;
  std::optional<canopen::NmtCommand> order_;  ///< of another master, the last
  HostTime started_{};
  bool expected_ = false;  ///< to be operational
  bool silent_ = false;
  std::uint64_t forgotten_ = 0;  ///< frames of another master before forget()
  std::uint64_t heard_ = 0;      ///< frames of another master that have been told
  std::uint64_t surplus_ = 0;    ///< answers that nobody had asked for, when the drive was looked for
};

}  // namespace interpolated_motion::axis
