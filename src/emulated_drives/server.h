#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/units/time.h"

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
  bool knows(const std::string& target) const { return targets_.count(target) > 0; }
  /// A fault of a target it knows; commands as in emulation/drive.h and emulation/bus_faults.h. Returns why
  /// not.
  std::optional<std::string> inject(const std::string& target, const std::string& command) {
    return targets_.at(target)(command);
  }
  /// The names it knows, for people.
  std::string target_names() const;

 protected:
  using Injector = std::function<std::optional<std::string>(const std::string& command)>;

  /// `announce` is told in one line what becomes of the interface.
  Server(boost::asio::io_context& io, Announcement announce);

  /// Takes what has come, runs the drives up to now, and sends what they say.
  virtual void turn() = 0;
  /// Has turn() called at `time`, unless something comes before.
  void turn_at(HostTime time);
  void add_target(const std::string& name, Injector injector) { targets_[name] = std::move(injector); }
  void announce(const std::string& text) const { announce_(text); }

  emulation::World world_;

 private:
  boost::asio::steady_timer timer_;
  Announcement announce_;
  std::map<std::string, Injector> targets_;
};

}  // namespace interpolated_motion::emulated_drives
