#pragma once

#include <fcntl.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "interfaces.h"

namespace interpolated_motion::transport {

/// A CAN interface with bit timing and controller states, and no hardware: the kernel's slcan driver on a
/// pseudo-terminal, whose other end plays the adapter in its ASCII protocol (Lawicel). Linux 6.0 and later
/// give it the settings of a real controller.
class Slcan {
 public:
  Slcan() : adapter_(posix_openpt(O_RDWR | O_NOCTTY)) {
    constexpr int kSlcanDiscipline = 17;  // N_SLCAN, linux/tty.h
    if (adapter_ < 0 || grantpt(adapter_) != 0 || unlockpt(adapter_) != 0) return;
    line_ = open(ptsname(adapter_), O_RDWR | O_NOCTTY);
    if (ioctl(line_, TIOCSETD, &kSlcanDiscipline) != 0) return;
    ifreq request{};
    if (ioctl(line_, SIOCGIFNAME, &request) == 0) name_ = request.ifr_name;
    // The driver waits for each of its commands to be taken.
    listener_ = std::thread([this] { listen(); });
  }
  ~Slcan() { unplug(); }
  Slcan(const Slcan&) = delete;
  Slcan& operator=(const Slcan&) = delete;

  /// Empty where the kernel has no slcan.
  const std::string& name() const { return name_; }

  bool set(const std::string& settings) { return run_command("ip link set dev " + name_ + " " + settings); }

  void unplug() {
    if (line_ >= 0) close(line_);  // the listener's read ends with it
    if (listener_.joinable()) listener_.join();
    if (adapter_ >= 0) close(adapter_);
    line_ = adapter_ = -1;
  }

  /// The adapter says something.
  void say(const std::string& text) {
    ASSERT_EQ(write(adapter_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  /// Waits until the adapter has heard `text`.
  bool hears(const std::string& text) {
    std::unique_lock<std::mutex> lock(mutex_);
    return news_.wait_for(lock, std::chrono::seconds(10),
                          [&] { return heard_.find(text) != std::string::npos; });
  }

 private:
  void listen() {
    char buffer[256];
    for (ssize_t length = 1; length > 0;) {
      length = read(adapter_, buffer, sizeof buffer);
      const std::lock_guard<std::mutex> lock(mutex_);
      if (length > 0) heard_.append(buffer, static_cast<std::size_t>(length));
      news_.notify_all();
    }
  }

  int adapter_ = -1;
  int line_ = -1;
  std::string name_;
  std::thread listener_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::string heard_;
};

}  // namespace interpolated_motion::transport
