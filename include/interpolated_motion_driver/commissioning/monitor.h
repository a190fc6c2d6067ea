#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "interpolated_motion_driver/commissioning/can_session.h"
#include "interpolated_motion_driver/commissioning/line_session.h"

namespace interpolated_motion::commissioning {

/// What one drive does at the moment, in words; "-" for what it does not tell.
struct MonitorRow {
  std::string drive;      ///< "node 3", "address 16"
  std::string state;      ///< statusword, or the status words of SilverLode
  std::string mode;       ///< of operation
  std::string position;   ///< position units, counts
  std::string deviation;  ///< following error, in the same
  std::string buffer;     ///< records in its FIFO, of how many
  std::string current;    ///< per mille of the rated current; SilverLode: register 9, its torque
  std::string supply;     ///< V
  std::string errors;     ///< error register, newest error
};

/// Looks at drives on a CAN bus, by reading objects. What a drive does not have is asked once.
class CanMonitor {
 public:
  /// `nodes`: 1..127. `session` must outlive this.
  CanMonitor(CanSession& session, std::vector<std::uint8_t> nodes)
      : session_(session), nodes_(std::move(nodes)) {}

  /// One row for each node, as it is now.
  std::vector<MonitorRow> look();

 private:
  std::vector<SdoOrder> orders() const;

  CanSession& session_;
  std::vector<std::uint8_t> nodes_;
  std::map<std::uint8_t, std::vector<canopen::ObjectAddress>> absent_;  ///< objects a node does not have
};

/// Looks at SilverLode drives. The polling status word is not read, since reading it is what lets its bits be
/// cleared.
class LineMonitor {
 public:
  /// `addresses`: 1..254. `session` must outlive this.
  LineMonitor(LineSession& session, std::vector<std::uint8_t> addresses)
      : session_(session), addresses_(std::move(addresses)) {}

  std::vector<MonitorRow> look();

 private:
  LineSession& session_;
  std::vector<std::uint8_t> addresses_;
};

/// The rows under each other, with a head and aligned columns. Columns that no drive fills are left out.
std::string monitor_table(const std::vector<MonitorRow>& rows);

}  // namespace interpolated_motion::commissioning
