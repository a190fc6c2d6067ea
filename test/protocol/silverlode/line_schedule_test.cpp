#include <gtest/gtest.h>

#include "protocol/silverlode/scripted_line.h"

namespace interpolated_motion::silverlode::test {
namespace {

using Texts = std::vector<std::string>;

TEST(LineSchedule, ControlBeforeBulk) {
  ScriptedLine line(healthy);
  DeviceLink& a = line.master().add_device(1);
  DeviceLink& b = line.master().add_device(2);
  a.offer_bulk(imw_request(1, 1, 2, 3, 4), at_us(0));
  b.request(ris_request(2));
  b.request(rio_request(2));
  line.run_for(200 * kMs);
  EXPECT_EQ(line.sent_texts(), (Texts{"@2 20", "@2 21", "@1 25 1 2 3 4"}));
}

TEST(LineSchedule, ControlRequestsDeviceAfterDevice) {
  ScriptedLine line(healthy);
  for (std::uint8_t address = 5; address <= 7; ++address) {
    DeviceLink& device = line.master().add_device(address);
    for (int i = 0; i < 3; ++i) device.request(wri_request(address, 30, i));
  }
  line.run_for(500 * kMs);
  EXPECT_EQ(line.sent_texts(), (Texts{"@5 11 30 0", "@6 11 30 0", "@7 11 30 0", "@5 11 30 1", "@6 11 30 1",
                                      "@7 11 30 1", "@5 11 30 2", "@6 11 30 2", "@7 11 30 2"}));
}

TEST(LineSchedule, BulkByDeadline) {
  ScriptedLine line(healthy);
  const int deadline_ms[] = {70, 30, 90, 50};
  for (std::uint8_t i = 0; i < 4; ++i) {
    DeviceLink& device = line.master().add_device(static_cast<std::uint8_t>(i + 1));
    device.offer_bulk(imw_request(device.address(), i, 0, 0, 0), at_us(deadline_ms[i] * 1000));
  }
  line.run_for(200 * kMs);
  EXPECT_EQ(line.sent_texts(), (Texts{"@2 25 1 0 0 0", "@4 25 3 0 0 0", "@1 25 0 0 0 0", "@3 25 2 0 0 0"}));
}

// Six axes that offer their next segment as soon as the last one is acknowledged share the line evenly, and
// the line carries as many as the budget says.
TEST(LineSchedule, SaturatedLineIsSharedEvenly) {
  ScriptedLine line(healthy);
  std::vector<DeviceLink*> devices;
  for (std::uint8_t address = 11; address <= 16; ++address) {
    devices.push_back(&line.master().add_device(address));
  }
  const auto segment = [](std::uint8_t address) {
    return imw_request(address, 4000, 1073741824, 1073742, 536870912);
  };
  std::vector<int> acknowledged(devices.size(), 0);
  const HostDuration step = 100 * kUs;
  for (HostTime t{}; t < at_us(2e6); t += step) {
    for (std::size_t i = 0; i < devices.size(); ++i) {
      for (const Outcome& outcome : take_all(*devices[i])) acknowledged[i] += outcome.accepted() ? 1 : 0;
      if (devices[i]->pending() == 0) devices[i]->offer_bulk(segment(devices[i]->address()), at_us(0));
    }
    line.run_until(t + step);
  }
  // 41 + 5 characters and 2 ms each.
  const double per_device = 2.0 / (46 * 11 / 57600.0 + 0.002) / 6;
  for (const int n : acknowledged) EXPECT_NEAR(n, per_device, 1.5);
  EXPECT_NEAR(line.master().load(line.now()), 1.0, 0.01);
}

// Attempts to reach a dead drive cost time-outs; the segments of the others go in between.
TEST(LineSchedule, DeadDriveDoesNotStarveTheOthers) {
  ScriptedLine line([](const std::string& request) {
    return request.rfind("@9 ", 0) == 0 ? std::vector<Answer>{} : healthy(request);
  });
  DeviceLink& dead = line.master().add_device(9);
  DeviceLink& alive = line.master().add_device(10);
  for (int i = 0; i < 4; ++i) dead.request(ris_request(9));
  int segments = 0;
  for (int ms = 0; ms < 600; ++ms) {
    for (const Outcome& outcome : take_all(alive)) segments += outcome.accepted() ? 1 : 0;
    if (alive.pending() == 0) alive.offer_bulk(imw_request(10, 1, 2, 3, 4), line.now());
    line.run_for(1 * kMs);
  }
  const Texts texts = line.sent_texts();
  ASSERT_GT(texts.size(), 20u);
  for (std::size_t i = 0; i + 1 < 20; ++i) EXPECT_NE(texts[i], texts[i + 1]) << i;
  EXPECT_GE(segments, 12);
}

// An IMQ that must be repeated may not be overtaken by a segment of its own drive: it would clear it.
TEST(LineSchedule, SegmentsWaitForTheControlRequestsOfTheirDrive) {
  int answered = 0;
  ScriptedLine line([&answered](const std::string& request) {
    return ++answered <= 2 ? std::vector<Answer>{} : healthy(request);
  });
  DeviceLink& drive = line.master().add_device(9);
  drive.request(imq_request(9));
  drive.offer_bulk(imw_request(9, 1, 2, 3, 4), at_us(0));
  line.run_for(500 * kMs);
  EXPECT_EQ(line.sent_texts(), (Texts{"@9 254", "@9 254", "@9 254", "@9 25 1 2 3 4"}));
}

TEST(LineSchedule, DeadlineOnlyWhenSomethingIsDue) {
  LineMaster master("line0");
  DeviceLink& drive = master.add_device(16);
  EXPECT_EQ(master.next_deadline(), kNever);
  drive.request(emd_request(16));
  EXPECT_EQ(master.next_deadline(), kNever) << "it may go at once";
  ASSERT_TRUE(master.peek_outgoing(at_us(0)));
  EXPECT_EQ(master.next_deadline(), kNever) << "the transport has no room";
  master.pop_outgoing(at_us(0));
  const double timeout = (8 + 15) * kCharacterUs + 20000;
  EXPECT_NEAR(to_us(master.next_deadline()), timeout, 1);
  master.poll(at_us(timeout + 1));
  EXPECT_NEAR(to_us(master.next_deadline()), timeout + 10000, 2);
  EXPECT_FALSE(master.peek_outgoing(at_us(timeout + 9990)));
  EXPECT_TRUE(master.peek_outgoing(at_us(timeout + 10002)));
}

TEST(LineSchedule, RefusedByTheTransportItIsOfferedAgain) {
  LineMaster master("line0");
  DeviceLink& drive = master.add_device(16);
  drive.request(emd_request(16));
  for (int ms = 0; ms < 100; ++ms) EXPECT_EQ(master.peek_outgoing(HostTime{ms * kMs}), "@16 227\r");
  EXPECT_EQ(drive.statistics().sent, 0u);
  master.pop_outgoing(at_us(100000));
  EXPECT_FALSE(master.peek_outgoing(at_us(100000)));
  EXPECT_NEAR(to_us(master.next_deadline()), 100000 + 23 * kCharacterUs + 20000, 1);
}

TEST(LineLoad, ShareOfTheLastSecond) {
  LineLoad load;
  EXPECT_EQ(load.load(at_us(5e6)), 0);
  load.add(at_us(5.05e6), at_us(5.25e6));
  // At the end of a slot of 100 ms exactly one second counts.
  EXPECT_NEAR(load.load(at_us(5.999999e6)), 0.2, 1e-5);
  EXPECT_NEAR(load.load(at_us(6.099999e6)), 0.15, 1e-5);
  EXPECT_NEAR(load.load(at_us(6.199999e6)), 0.05, 1e-5);
  EXPECT_EQ(load.load(at_us(6.3e6)), 0);
  load.add(at_us(7e6), at_us(20e6));
  EXPECT_NEAR(load.load(at_us(19.999999e6)), 1, 1e-5);
}

TEST(LineLoad, OfExchanges) {
  ScriptedLine line(healthy);
  DeviceLink& drive = line.master().add_device(16);
  for (int ms = 0; ms < 1000; ms += 50) {
    drive.request(rrg_request(16, 1));
    line.run_for(50 * kMs);
    take_all(drive);
  }
  EXPECT_NEAR(line.master().load(at_us(999999)), 20 * (29 * kCharacterUs + 2000) * 1e-6, 1e-4);
}

}  // namespace
}  // namespace interpolated_motion::silverlode::test
