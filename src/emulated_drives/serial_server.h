#pragma once

#include <memory>
#include <string>
#include <vector>

#include "interpolated_motion_driver/emulation/fault_command.h"
#include "interpolated_motion_driver/transport/pseudo_terminal.h"
#include "server.h"

namespace interpolated_motion::emulated_drives {

/// Emulated drives on a pseudo-terminal. A pseudo-terminal passes characters at once: on the
/// drives' line they take the time they take on a wire. What drives say is passed on at its CR, or once they
/// are silent for two characters, like by a USB adapter that sends what it has at such a character.
class SerialServer : public Server {
 public:
  /// As Server(); std::runtime_error for a link that cannot be made, too.
  SerialServer(boost::asio::io_context& io, const ServedBus& served, const std::string& samples_folder,
               Announcement announce);

 private:
  void turn() override;
  /// Besides what can happen to any line: `unplug SECONDS`, the terminal is away.
  std::vector<emulation::FaultCommand> bus_faults() override;
  void unplug(HostDuration length);
  void plug_in();
  void wait_for_characters();
  void take_characters();
  void run_drives(HostTime now);

  boost::asio::io_context& io_;
  transport::VirtualSerialLine& line_;
  std::unique_ptr<transport::PseudoTerminal> terminal_;  ///< null while unplugged
  HostTime plug_in_at_ = kNever;
  bool waiting_ = false;
  std::string incoming_;  ///< what the drives' line had no room for yet
};

}  // namespace interpolated_motion::emulated_drives
