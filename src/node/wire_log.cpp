#include "interpolated_motion_driver/node/wire_log.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
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

std::string stamp(HostDuration time) {
  const auto microseconds = std::chrono::duration_cast<std::chrono::microseconds>(time).count();
  return fmt::format("({}.{:06})", microseconds / 1'000'000, microseconds % 1'000'000);
}

bool is_printable(char c) { return c >= ' ' && c <= '~'; }

/// `(seconds.microseconds) BUS ...`
bool is_of_a_log(const std::string& line) {
  constexpr const char* kDigits = "0123456789";
  constexpr std::size_t kFraction = 6;
  const std::size_t point = line.find_first_not_of(kDigits, 1);
  if (line.empty() || line[0] != '(' || point == std::string::npos || point < 2) return false;
  const std::size_t end = line.find_first_not_of(kDigits, point + 1);
  return line[point] == '.' && end == point + 1 + kFraction && line.compare(end, 2, ") ") == 0;
}

command_line::OpenFile open_log(const std::string& path) {
  try {
    return command_line::open_output_file(path, command_line::EarlierFile::GoOn, &is_of_a_log);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("Parameter wire_log: {}.", error.what()));
  }
}

}  // namespace

std::string candump_line(const std::string& bus, const canopen::Frame& frame, HostDuration time) {
  return fmt::format("{} {} {}\n", stamp(time), bus, canopen::to_string(frame));
}

std::string serial_line(const std::string& bus, bool from_host, std::string_view text, HostDuration time) {
  std::string line = fmt::format("{} {} {} ", stamp(time), bus, from_host ? '>' : '<');
  for (const char c : text) line += is_printable(c) ? std::string(1, c) : fmt::format("\\x{:02X}", c & 0xFF);
  return line + '\n';
}

WireLog::WireLog(const std::string& path, HostDuration offset, std::vector<std::string> buses)
    : path_(std::filesystem::absolute(path)),
      offset_(offset),
      buses_(std::move(buses)),
      file_(open_log(path_)) {
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

void WireLog::append(const std::string& bus, const canopen::ReceivedFrame& frame) { queue(bus, frame); }

void WireLog::append(const std::string& bus, const hardware::SerialText& text) {
  Text copy{{}, std::min(text.text.size(), kLongestText), text.time, text.from_host};
  std::copy_n(text.text.begin(), copy.length, copy.characters.begin());
  queue(bus, copy);
}

void WireLog::queue(const std::string& bus, const Traffic& traffic) {
  const auto known = std::find(buses_.begin(), buses_.end(), bus);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (known == buses_.end() || queue_.size() == kQueueLength) {
    ++lost_;
  } else {
    queue_.push_back({static_cast<std::size_t>(known - buses_.begin()), traffic});
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

std::string WireLog::line_of(const Entry& entry) const {
  const std::string& bus = buses_[entry.bus];
  if (const auto* received = std::get_if<canopen::ReceivedFrame>(&entry.traffic))
    return candump_line(bus, received->frame, received->time.time_since_epoch() + offset_);
  const Text& text = std::get<Text>(entry.traffic);
  return serial_line(bus, text.from_host, {text.characters.data(), text.length},
                     text.time.time_since_epoch() + offset_);
}

void WireLog::write(const std::vector<Entry>& entries) {
  std::uint64_t failed = 0;
  for (const Entry& entry : entries) {
    if (std::fputs(line_of(entry).c_str(), file_.get()) < 0) ++failed;
  }
  if (std::fflush(file_.get()) != 0) failed = entries.size();
  if (failed == 0) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  lost_ += failed;
}

}  // namespace interpolated_motion::node
