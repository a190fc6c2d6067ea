#pragma once

#include <deque>
#include <list>
#include <string>

#include "drive_list.h"
#include "interpolated_motion_driver/transport/socketcan_bus.h"
#include "sample_file.h"
#include "server.h"

namespace interpolated_motion::emulated_drives {

/// Emulated EPOS2 drives on a SocketCAN interface. On an interface without bit timing (vcan) their bus has
/// the bit times of a real one; on one with bit timing frames take no time in it, as they take theirs
/// outside.
class CanServer : public Server {
 public:
  /// Throws std::invalid_argument for drives that cannot be, std::runtime_error for a folder of samples that
  /// cannot be written.
  CanServer(boost::asio::io_context& io, const CanDrives& list, const std::string& samples_folder,
            Announcement announce);

 private:
  void turn() override;
  void add_drive(const NamedDrive<emulation::EposParameters>& drive, const std::string& samples_folder);
  void follow_interface(HostTime now);
  void wait_for_frames();
  void take_frames();
  void run_drives(HostTime now);
  void send_frames(HostTime now);
  std::string ready_text() const;

  transport::VirtualCanBus& bus_;
  transport::SocketcanBus interface_;
  std::string interface_name_;
  std::string nodes_;
  std::list<SampleFile> samples_;
  bool waiting_ = false;
  HostTime last_frame_{};  ///< from the host
  std::deque<canopen::Frame> outgoing_;
};

}  // namespace interpolated_motion::emulated_drives
