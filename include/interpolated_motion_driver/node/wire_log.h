#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "interpolated_motion_driver/command_line/output_file.h"
#include "interpolated_motion_driver/hardware/wire_observer.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::node {

/// One line of a candump log file, `(seconds.microseconds) BUS ID#DATA`, as can-utils' `candump -L` writes
/// and `canplayer` and `log2asc` read it; with a newline. `time` is since the epoch.
std::string candump_line(const std::string& bus, const canopen::Frame& frame, HostDuration time);

/// One line of serial traffic, `(seconds.microseconds) BUS > TEXT` from the host to a drive and `<` from a
/// drive to the host, the CR not shown and other bytes that do not print as `\xNN`; with a newline. `time` is
/// since the epoch.
std::string serial_line(const std::string& bus, bool from_host, std::string_view text, HostDuration time);

/// Writes all traffic of all buses to a file, from a thread of its own. The bus thread only appends to a
/// bounded queue; when the file system cannot keep up, frames and lines are left out and counted.
class WireLog {
 public:
  /// Opens `path`, and goes on behind what is there if that is such a log; a relative path is below the
  /// process's working folder, which roslaunch sets to ROS_HOME. `offset`: wall clock minus host clock.
  /// `buses`: every name that will be given to append(). Throws std::runtime_error when the file cannot be
  /// written, is none, or holds something else.
  WireLog(const std::string& path, HostDuration offset, std::vector<std::string> buses);
  /// Writes what is queued and closes the file.
  ~WireLog();
  WireLog(const WireLog&) = delete;
  WireLog& operator=(const WireLog&) = delete;

  /// Queues one frame, without allocation; the lock is never held while the file is written.
  void append(const std::string& bus, const canopen::ReceivedFrame& frame);
  /// The same for a line of text; of one that is longer than kLongestText the rest is left out.
  void append(const std::string& bus, const hardware::SerialText& text);

  /// Characters; the longest command of the driver has 52.
  static constexpr std::size_t kLongestText = 120;

  /// Frames and lines that are missing in the file because the queue was full or the disk was.
  std::uint64_t lost() const;

  /// Absolute, whatever the constructor was given.
  const std::string& path() const { return path_; }

 private:
  struct Text {
    std::array<char, kLongestText> characters;  ///< the first `length`
    std::size_t length;                         ///< at most kLongestText
    HostTime time;                              ///< as SerialText has it
    bool from_host;                             ///< else from a drive
  };
  using Traffic = std::variant<canopen::ReceivedFrame, Text>;
  struct Entry {
    std::size_t bus;  ///< index in buses_
    Traffic traffic;  ///< a frame or a line of text
  };
  void queue(const std::string& bus, const Traffic& traffic);
  void run();
  void write(const std::vector<Entry>& entries);
  std::string line_of(const Entry& entry) const;

  const std::string path_;
  const HostDuration offset_;
  const std::vector<std::string> buses_;
  command_line::OpenFile file_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Entry> queue_;
  std::uint64_t lost_ = 0;
  bool closing_ = false;

  std::thread thread_;
};

}  // namespace interpolated_motion::node
