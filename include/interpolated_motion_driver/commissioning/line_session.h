#pragma once

#include <string>
#include <vector>

#include "interpolated_motion_driver/commissioning/progress.h"
#include "interpolated_motion_driver/commissioning/waiter.h"
#include "interpolated_motion_driver/protocol/silverlode/line_master.h"
#include "interpolated_motion_driver/transport/serial_line.h"

namespace interpolated_motion::commissioning {

/// One conversation with the SilverLode drives of a serial line, one request at a time.
class LineSession {
 public:
  /// `name` is used in texts. `line` and `waiter` must outlive this. Throws std::invalid_argument for
  /// parameters out of range.
  LineSession(transport::SerialLine& line, Waiter& waiter, std::string name,
              const silverlode::LineParameters& parameters);

  /// Hears the line for `duration`.
  void listen(HostDuration duration);
  /// Sends a request to one drive and waits for its outcome.
  silverlode::Outcome ask(const silverlode::Request& request);

  /// The line's end of the drive at `address`, 1..254: its statistics and texts.
  silverlode::DeviceLink& device(std::uint8_t address);
  const silverlode::LineMaster& master() const { return master_; }
  /// Characters heard so far.
  std::uint64_t characters() const { return characters_; }
  HostTime now() const { return waiter_.now(); }

 private:
  void turn(HostTime limit);

  transport::SerialLine& line_;
  Waiter& waiter_;
  silverlode::LineMaster master_;
  std::uint64_t characters_ = 0;
};

}  // namespace interpolated_motion::commissioning
