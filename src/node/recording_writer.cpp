#include "interpolated_motion_driver/node/recording_writer.h"

#include <chrono>
#include <cstdint>
#include <exception>

#include <ros/console.h>

#include "interpolated_motion_driver/node/clock.h"
#include "interpolated_motion_driver/recording/recording.h"

namespace interpolated_motion::node {
namespace {

constexpr auto kGlance = std::chrono::milliseconds(50);

}  // namespace

RecordingWriter::RecordingWriter(ros::NodeHandle node, HardwareThread& hardware,
                                 const hardware::RecorderConfiguration& configuration)
    : hardware_(hardware),
      when_(configuration.write),
      files_(configuration.folder, "recording_", configuration.keep),
      service_(node.advertiseService("dump_recording", &RecordingWriter::serve, this)) {
  if (when_ == hardware::WriteRecording::OnFault) thread_ = std::thread([this] { run(); });
}

RecordingWriter::~RecordingWriter() { stop(); }

void RecordingWriter::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
  if (trigger_.is_pending()) write_fault();
}

void RecordingWriter::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!wake_.wait_for(lock, kGlance, [this] { return stopping_; })) {
    hardware_.snapshot(snapshot_);
    if (!snapshot_.fault.empty()) fault_ = snapshot_.fault;
    if (trigger_.update(snapshot_.state, host_now())) write_fault();
  }
}

void RecordingWriter::write_fault() {
  const Written written = write("fault: " + fault_);
  if (written.success) {
    ROS_WARN_STREAM("the last seconds before the fault are in " << written.message);
  } else {
    ROS_ERROR_STREAM("there is no recording of the fault: " << written.message);
  }
}

RecordingWriter::Written RecordingWriter::write(const std::string& cause) {
  const std::lock_guard<std::mutex> lock(writing_);
  const auto copy = hardware_.call([](auto& hardware, HostTime) { return hardware.recording(); });
  if (!copy) return {false, "the driver is shutting down"};
  try {
    return {true, files_.write(recording::to_text(*copy, cause, wall_clock_offset()))};
  } catch (const std::exception& error) {
    return {false, error.what()};
  }
}

bool RecordingWriter::serve(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  const Written written = when_ == hardware::WriteRecording::Never
                              ? Written{false,
                                        "Parameter flight_recorder/write is never; allowed: on_fault, "
                                        "on_request, never. Set another one to have recordings written."}
                              : write("request: ~dump_recording");
  response.success = static_cast<std::uint8_t>(written.success);
  response.message = written.message;
  return true;
}

}  // namespace interpolated_motion::node
