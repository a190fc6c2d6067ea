#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "drive_list.h"
#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/transport/socketcan_bus.h"

namespace interpolated_motion::emulated_drives {

/// Emulated drives in real time on a SocketCAN interface. They sit on a bus of their own world whose host end
/// is that interface. On an interface without bit timing (vcan) that bus has the bit times of a real one; on
/// one with bit timing frames take no time in it, as they take theirs outside.
class CanServer {
 public:
  using Announcement = std::function<void(const std::string&)>;

  /// `announce` is told in one line when the interface has come or gone. Throws std::invalid_argument for
  /// drives that cannot be.
  CanServer(boost::asio::io_context& io, const std::string& interface, const DriveList& list,
            Announcement announce);

  /// Runs until `io` is stopped.
  void start() { turn(); }

  /// A fault: `target` is a drive's name, its node id, or the interface; commands as in
  /// hardware/fault_injection.h. False with a reason when it is none.
  bool inject(const std::string& target, const std::string& command, std::string* reason);

 private:
  void turn();
  void follow_interface(HostTime now);
  void wait_for_frames();
  void take_frames();
  void run_drives(HostTime now);
  void send_frames(HostTime now);
  void wait_until(HostTime time);
  std::string ready_text() const;

  emulation::World world_;
  transport::VirtualCanBus& bus_;
  transport::SocketcanBus interface_;
  std::map<std::string, emulation::EposDrive*> drives_;
  std::string interface_name_;
  std::string nodes_;
  Announcement announce_;
  boost::asio::steady_timer timer_;
  bool waiting_ = false;
  std::deque<canopen::Frame> outgoing_;
};

}  // namespace interpolated_motion::emulated_drives
