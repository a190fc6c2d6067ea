#pragma once

#include <memory>

#include "can_port.h"
#include "interpolated_motion_driver/commissioning/drive_access.h"
#include "line_port.h"
#include "options.h"

namespace interpolated_motion::drive_tool {

/// The one drive that a command is about, and the port it is behind.
class OpenDrive {
 public:
  /// Throws std::invalid_argument or std::runtime_error with a sentence: no drive is named, the port cannot
  /// be used, another master is on the bus.
  explicit OpenDrive(const Options& options);

  commissioning::DriveAccess& operator*() { return *drive_; }
  commissioning::DriveAccess* operator->() { return drive_.get(); }

 private:
  std::unique_ptr<CanPort> can_;
  std::unique_ptr<LinePort> line_;
  std::unique_ptr<commissioning::DriveAccess> drive_;
};

/// Listens, and throws std::runtime_error where another master is on the bus, unless the user has said that
/// he knows.
void refuse_beside_master(CanPort& port, const Options& options);

}  // namespace interpolated_motion::drive_tool
