#include <gtest/gtest.h>

#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/axis/cia402/sdo_steps.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"

// A drive that answers late, or refuses.
namespace interpolated_motion::axis {
namespace {

using namespace std::chrono_literals;

constexpr HostDuration kTimeout = 200ms;

canopen::MasterParameters parameters() {
  canopen::MasterParameters p;
  p.sdo.timeout = kTimeout;
  return p;
}

/// A drive that answers each request `delay` later, whatever has come meanwhile, until it is aborted.
class LateDrive {
 public:
  LateDrive(canopen::Master& master, HostDuration delay) : master_(master), delay_(delay) {}

  void pass(HostTime now) {
    while (const canopen::Frame* frame = master_.peek_outgoing(now)) {
      if (frame->data[0] == 0x80) due_ = kNever;
      if (frame->data[0] == 0x40) {
        answer_ = *frame;
        due_ = now + delay_;
      }
      master_.pop_outgoing(now);
    }
    if (now < due_) return;
    due_ = kNever;
    answer_.id = 0x583;
    answer_.data[0] = 0x4B;
    answer_.data[4] = 0x37;
    master_.on_frame({answer_, now, false});
  }

 private:
  canopen::Master& master_;
  HostDuration delay_;
  canopen::Frame answer_;
  HostTime due_ = kNever;
};

struct Line {
  canopen::Master master{"can0", parameters()};
  canopen::NodeLink& node = master.add_node(3);
  SdoSequence sequence{node};

  void run(LateDrive& drive, HostDuration time) {
    for (HostTime now{}; now < HostTime(time); now += 1ms) {
      drive.pass(now);
      master.poll(now);
      sequence.poll(now);
    }
  }
};

TEST(SdoSequence, WaitsLongerForADriveThatAnswersLate) {
  Line line;
  LateDrive drive(line.master, 350ms);
  line.sequence.start({SdoSequence::read({0x6041, 0})}, HostTime{});
  line.run(drive, 2s);
  EXPECT_EQ(line.sequence.state(), SdoSequence::State::Done) << line.sequence.failure();
}

TEST(SdoSequence, NamesTheTimeAndTheParameterWhereNoneComes) {
  Line line;
  LateDrive drive(line.master, 5s);
  line.sequence.start({SdoSequence::read({0x6041, 0})}, HostTime{});
  line.run(drive, 3s);
  ASSERT_EQ(line.sequence.state(), SdoSequence::State::Failed);
  EXPECT_NE(line.sequence.failure().find("0x6041:00"), std::string::npos);
  EXPECT_NE(line.sequence.failure().find("within 0.60 s"), std::string::npos) << line.sequence.failure();
  EXPECT_NE(line.sequence.failure().find("sdo_timeout"), std::string::npos) << line.sequence.failure();
}

TEST(SdoSequence, NamesWhereARefusedValueComesFrom) {
  Line line;
  line.sequence.start(
      {sdo_steps::because_of(sdo_steps::write_u32({0x60C5, 0}, 70000), "limits/max_acceleration")},
      HostTime{});
  while (line.master.peek_outgoing(HostTime{}) != nullptr) line.master.pop_outgoing(HostTime{});
  canopen::Frame abort;
  abort.id = 0x583;
  abort.length = 8;
  abort.data = {0x80, 0xC5, 0x60, 0x00, 0x31, 0x00, 0x09, 0x06};
  line.master.on_frame({abort, HostTime{}, false});
  line.sequence.poll(HostTime{});
  ASSERT_EQ(line.sequence.state(), SdoSequence::State::Failed);
  for (const char* part : {"0x60C5:00", "0x00011170", "value too high", "limits/max_acceleration"})
    EXPECT_NE(line.sequence.failure().find(part), std::string::npos) << line.sequence.failure();
}

}  // namespace
}  // namespace interpolated_motion::axis
