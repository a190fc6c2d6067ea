#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/Trigger.h>

#include "interpolated_motion_driver/command_line/file_series.h"
#include "interpolated_motion_driver/hardware/recorder_configuration.h"
#include "interpolated_motion_driver/node/fault_trigger.h"
#include "interpolated_motion_driver/node/hardware_thread.h"

namespace interpolated_motion::node {

/// Writes what the flight recorder has: half a second after each fault, from a thread of its own, and when
/// `~dump_recording` asks for it.
class RecordingWriter {
 public:
  /// `~dump_recording` is served by the queue of `node`. `hardware` must live longer.
  RecordingWriter(ros::NodeHandle node, HardwareThread& hardware,
                  const hardware::RecorderConfiguration& configuration);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Writes the recording of a fault that is not written yet, and ends the thread. While `hardware` still
  /// runs.
  void stop();

 private:
  struct Written {
    bool success = false;
    std::string message;  ///< the file's path, or why there is none
  };

  bool serve(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  Written write(const std::string& cause);
  void write_fault();
  void run();

  HardwareThread& hardware_;
  const hardware::WriteRecording when_;
  const command_line::FileSeries files_;
  std::mutex writing_;  ///< one at a time

  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  motion::Snapshot snapshot_;
  FaultTrigger trigger_;
  std::string fault_;
  ros::ServiceServer service_;
  std::thread thread_;
};

}  // namespace interpolated_motion::node
