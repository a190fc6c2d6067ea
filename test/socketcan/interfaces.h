#pragma once

#include <cstdlib>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace interpolated_motion::transport {

/// Runs a command of iproute2; true when it succeeded.
inline bool run_command(const std::string& command) {
  // NOLINTNEXTLINE(bugprone-command-processor,cert-env33-c)
  return std::system(("PATH=/usr/sbin:/sbin:$PATH; " + command).c_str()) == 0;
}

/// A vcan interface of a test's own, up; gone with this object.
class Vcan {
 public:
  explicit Vcan(std::string name) : name_(std::move(name)) { create(); }
  ~Vcan() {
    if (exists_) remove();
  }
  Vcan(const Vcan&) = delete;
  Vcan& operator=(const Vcan&) = delete;

  const std::string& name() const { return name_; }

  void create() {
    exists_ = run_command("ip link add dev " + name_ + " type vcan");
    EXPECT_TRUE(exists_) << "run these tests by scripts/with_vcan";
    set_up(true);
  }
  void remove() {
    EXPECT_TRUE(run_command("ip link del dev " + name_));
    exists_ = false;
  }
  void set_up(bool up) { set(up ? "up" : "down"); }
  void set(const std::string& settings) {
    EXPECT_TRUE(run_command("ip link set dev " + name_ + " " + settings));
  }
  /// Lets the interface take 1.28 ms for each frame, of which the kernel counts 16 bytes, and makes its queue
  /// `frames` short.
  void slow_down(int frames) {
    EXPECT_TRUE(run_command("tc qdisc replace dev " + name_ + " root tbf rate 100kbit burst 32 limit " +
                            std::to_string(16 * frames)));
  }

 private:
  std::string name_;
  bool exists_ = false;
};

}  // namespace interpolated_motion::transport
