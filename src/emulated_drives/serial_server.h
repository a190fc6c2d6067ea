#pragma once

#include <list>
#include <memory>
#include <string>
#include <vector>

#include "drive_list.h"
#include "interpolated_motion_driver/emulation/fault_command.h"
#include "interpolated_motion_driver/transport/pseudo_terminal.h"
#include "sample_file.h"
#include "server.h"

namespace interpolated_motion::emulated_drives {

/// Emulated SilverLode drives on a pseudo-terminal. A pseudo-terminal passes characters at once: on the
/// drives' line they take the time they take on a wire. What drives say is passed on at its CR, or once they
/// are silent for two characters, like by a USB adapter that sends what it has at such a character.
class SerialServer : public Server {
 public:
  /// Throws std::invalid_argument for drives that cannot be, std::runtime_error for a link or a folder of
  /// samples that cannot be made.
  SerialServer(boost::asio::io_context& io, const SerialDrives& list, const std::string& samples_folder,
               Announcement announce);

 private:
  void turn() override;
  void add_drive(const NamedDrive<emulation::SilverDustParameters>& drive, const std::string& samples_folder);
  std::vector<emulation::FaultCommand> line_faults();
  void unplug(HostDuration length);
  void plug_in();
  void wait_for_characters();
  void take_characters();
  void run_drives(HostTime now);

  boost::asio::io_context& io_;
  transport::VirtualSerialLine& line_;
  std::string link_;
  std::string addresses_;
  std::unique_ptr<transport::PseudoTerminal> terminal_;  ///< null while unplugged
  HostTime plug_in_at_ = kNever;
  std::list<SampleFile> samples_;
  bool waiting_ = false;
  std::string incoming_;  ///< what the drives' line had no room for yet
};

}  // namespace interpolated_motion::emulated_drives
