#pragma once

#include <functional>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "drive_list.h"
#include "interpolated_motion_driver/emulation/drive.h"
#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/hardware/emulated_bus.h"
#include "interpolated_motion_driver/units/time.h"
#include "sample_file.h"

namespace interpolated_motion::emulated_drives {

/// Emulated drives in real time on one bus that leads out of this process: a world whose only bus has its
/// host end joined to an interface of the operating system.
class Server {
 public:
  using Announcement = std::function<void(const std::string&)>;

  virtual ~Server() = default;
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Runs until the io_context is stopped.
  void start() { turn(); }

  /// Whether `target` names a drive (joint, node id or address) or the interface of this server.
  bool knows(const std::string& target) const { return target == name_ || drives_.count(target) > 0; }
  /// A fault of a target it knows; commands as in emulation/drive.h and emulation/bus_faults.h. Returns why
  /// not.
  std::optional<std::string> inject(const std::string& target, const std::string& command);
  /// The names it knows, for people.
  std::string target_names() const;

 protected:
  /// Drives and bus of `served`. `announce` is told in one line what becomes of the interface.
  /// `samples_folder`: where each drive's latest motion is written, see SampleFile; empty: nowhere. Throws
  /// std::invalid_argument for drives that cannot be, std::runtime_error for a folder that cannot be written.
  Server(boost::asio::io_context& io, const ServedBus& served, const std::string& samples_folder,
         Announcement announce);

  /// Takes what has come, runs the drives up to now, and sends what they say.
  virtual void turn() = 0;
  /// What can happen to its bus.
  virtual std::vector<emulation::FaultCommand> bus_faults() = 0;
  /// Has turn() called at `time`, unless something comes before.
  void turn_at(HostTime time);
  void announce(const std::string& text) const { announce_(text); }
  /// The interface or link.
  const std::string& name() const { return name_; }
  /// "EPOS2 drives with node ids 1, 2", for each kind.
  const std::string& drives_text() const { return drives_text_; }

  emulation::World world_;
  const hardware::EmulatedBus bus_;

 private:
  void add_drive(const hardware::DriveConfiguration& drive, const std::string& samples_folder);

  std::string name_;
  std::string drives_text_;
  boost::asio::steady_timer timer_;
  Announcement announce_;
  std::list<SampleFile> samples_;
  std::map<std::string, emulation::Drive*> drives_;  ///< by joint, and by node id or address
};

}  // namespace interpolated_motion::emulated_drives
