#include "interpolated_motion_driver/node/wire_log.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/canopen/frame_text.h"

namespace interpolated_motion::node {
namespace {

/// Half a second of a saturated 1 Mbit/s bus (at most 47 bits per frame) is 10600 frames; the writer empties
/// the queue 20 times a second.
constexpr std::size_t kQueueLength = 16384;
constexpr auto kWritePeriod = std::chrono::milliseconds(50);

}  // namespace

std::string candump_line(const std::string& bus, const canopen::Frame& frame, HostDuration time) {
  const auto microseconds = std::chrono::duration_cast<std::chrono::microseconds>(time).count();
  return fmt::format("({}.{:06}) {} {}\n", microseconds / 1'000'000, microseconds % 1'000'000, bus,
                     canopen::to_string(frame));
}

WireLog::WireLog(const std::string& path, HostDuration offset, std::vector<std::string> buses)
    : path_(path), offset_(offset), buses_(std::move(buses)), file_(std::fopen(path.c_str(), "w")) {
  if (!file_) {
    throw std::runtime_error(
        fmt::format("Parameter wire_log is {}, which cannot be written: {}.", path, std::strerror(errno)));
  }
  queue_.reserve(kQueueLength);
  thread_ = std::thread([this] { run(); });
}

WireLog::~WireLog() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void WireLog::append(const std::string& bus, const canopen::ReceivedFrame& frame) {
  const auto known = std::find(buses_.begin(), buses_.end(), bus);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (known == buses_.end() || queue_.size() == kQueueLength) {
    ++lost_;
  } else {
    queue_.push_back({static_cast<std::size_t>(known - buses_.begin()), frame});
  }
}

std::uint64_t WireLog::lost() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return lost_;
}

void WireLog::run() {
  std::vector<Entry> entries;
  entries.reserve(kQueueLength);
  for (bool last = false; !last;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      last = wake_.wait_for(lock, kWritePeriod, [this] { return closing_; });
      entries.swap(queue_);
    }
    write(entries);
    entries.clear();
  }
}

void WireLog::write(const std::vector<Entry>& entries) {
  std::uint64_t failed = 0;
  for (const Entry& entry : entries) {
    const std::string& bus = buses_[entry.bus];
    const std::string line =
        candump_line(bus, entry.frame.frame, entry.frame.time.time_since_epoch() + offset_);
    if (std::fputs(line.c_str(), file_.get()) < 0) ++failed;
  }
  if (std::fflush(file_.get()) != 0) failed = entries.size();
  if (failed == 0) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  lost_ += failed;
}

}  // namespace interpolated_motion::node
