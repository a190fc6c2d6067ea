#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <boost/asio/io_context.hpp>

#include "failing_calls/failing_calls.h"
#include "interpolated_motion_driver/transport/pseudo_terminal.h"
#include "interpolated_motion_driver/transport/serial_port_line.h"

namespace interpolated_motion::transport {
namespace {

using test::Counted;
using test::FailingCall;

constexpr HostDuration kPollPeriod = std::chrono::milliseconds(200);
constexpr int kTries = 20;

struct Case {
  std::string call;
  int error;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return info.param.call + "_" + std::to_string(info.param.error);
}

/// A port from its opening to its closing, against a clock of the test's own. Whatever fails once is told and
/// has been overcome some polls later.
class SerialCallFails : public testing::TestWithParam<Case> {
 protected:
  /// Opens, sends, receives, closes; every call within counts. How often the port was not open.
  int session();
  void open();
  void poll();
  void send(const std::string& text);
  void expect_at_far_end(const std::string& text);
  void expect_here(const std::string& text);

  boost::asio::io_context io_;
  PseudoTerminal adapter_{io_};
  HostTime now_{};
  std::unique_ptr<SerialPortLine> line_;
  int told_ = 0;
};

void SerialCallFails::poll() {
  const Counted counted;
  now_ += kPollPeriod;
  line_->poll_port(now_);
  if (line_->state() == SerialPortState::Open) return;
  ++told_;
  EXPECT_NE(line_->status_text().find(adapter_.path()), std::string::npos) << line_->status_text();
  EXPECT_LE(line_->next_deadline(), now_ + kPollPeriod) << "nobody would look at it again";
}

void SerialCallFails::open() {
  SerialPortParameters parameters;
  parameters.device = adapter_.path();
  const Counted counted;
  line_ = std::make_unique<SerialPortLine>(io_, parameters, now_);
}

void SerialCallFails::send(const std::string& text) {
  for (int i = 0; i < kTries; ++i) {
    {
      const Counted counted;
      if (line_->send(text, now_)) return;
    }
    poll();
  }
  FAIL() << text << " is never taken: " << line_->status_text();
}

void SerialCallFails::expect_at_far_end(const std::string& text) {
  std::string seen;
  while (const auto character = adapter_.receive()) seen += character->value;
  EXPECT_EQ(seen, text);
}

// A port that was closed has lost what was on the way: the text is sent again, as a drive does that is asked
// again.
void SerialCallFails::expect_here(const std::string& text) {
  std::string seen;
  for (int i = 0; i < kTries && seen != text; ++i) {
    seen.clear();
    ASSERT_TRUE(adapter_.send(text, now_));
    for (int tries = 0; tries < kTries && seen.size() < text.size(); ++tries) {
      const Counted counted;
      while (const auto character = line_->receive()) seen += character->value;
    }
    if (seen != text) poll();
  }
  EXPECT_EQ(seen, text) << line_->status_text();
}

int SerialCallFails::session() {
  told_ = 0;
  open();
  poll();
  send("@16 12 1\r");
  expect_at_far_end("@16 12 1\r");
  expect_here("* 10\r");
  const Counted counted;
  line_.reset();
  return told_;
}

TEST_P(SerialCallFails, OnceInTurn) {
  ASSERT_EQ(session(), 0) << "without a failure";
  const int before = test::open_descriptors();
  int failed = 0;
  for (int n = 1;; ++n) {
    SCOPED_TRACE(GetParam().call + " " + std::to_string(n) + ": " + std::strerror(GetParam().error));
    const FailingCall failing(GetParam().call, n, GetParam().error);
    session();
    EXPECT_EQ(test::open_descriptors(), before);
    if (HasFailure() || !failing.has_happened()) break;
    ++failed;
    ASSERT_LT(n, 1000) << "it is called again and again";
  }
  EXPECT_GT(failed, 0) << "it is not called at all";
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* call : {"open", "read", "write", "ioctl", "flock", "isatty", "epoll_ctl"})
    for (const int error : {EIO, ENOBUFS, EINTR, ENODEV}) all.push_back({call, error});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Calls, SerialCallFails, testing::ValuesIn(cases()), name_of);

}  // namespace
}  // namespace interpolated_motion::transport
