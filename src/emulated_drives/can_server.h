#pragma once

#include <deque>
#include <string>
#include <vector>

#include "interpolated_motion_driver/transport/socketcan_bus.h"
#include "server.h"

namespace interpolated_motion::emulated_drives {

/// Emulated drives on a SocketCAN interface. On an interface without bit timing (vcan) their bus has
/// the bit times of a real one; on one with bit timing frames take no time in it, as they take theirs
/// outside.
class CanServer : public Server {
 public:
  /// As Server().
  CanServer(boost::asio::io_context& io, const ServedBus& served, const std::string& samples_folder,
            Announcement announce);

 private:
  void turn() override;
  std::vector<emulation::FaultCommand> bus_faults() override;
  void follow_interface(HostTime now);
  void wait_for_frames();
  void take_frames();
  void run_drives(HostTime now);
  void send_frames(HostTime now);
  std::string ready_text() const;

  transport::VirtualCanBus& wire_;
  transport::SocketcanBus interface_;
  bool waiting_ = false;
  HostTime last_frame_{};  ///< from the host
  std::deque<canopen::Frame> outgoing_;
};

}  // namespace interpolated_motion::emulated_drives
