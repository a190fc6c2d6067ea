#include "interpolated_motion_driver/emulation/drive.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/emulation/bus_faults.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/emulation/world.h"

namespace interpolated_motion::emulation {
namespace {

using std::chrono::milliseconds;

/// Of each kind one.
struct Kind {
  const char* name;
  std::function<Drive&(World&)> add;
};

const Kind kKinds[] = {{"Epos",
                        [](World& world) -> Drive& {
                          return world.add<EposDrive>(world.add_can_bus("bus", 1'000'000), EposParameters{});
                        }},
                       {"Cyclic",
                        [](World& world) -> Drive& {
                          return world.add<CyclicDrive>(world.add_can_bus("bus", 1'000'000),
                                                        CyclicParameters{});
                        }},
                       {"SilverDust", [](World& world) -> Drive& {
                          return world.add<SilverDust>(world.add_serial_line("bus"), SilverDustParameters{});
                        }}};

void run(World& world, HostDuration length) {
  const HostTime end = world.now() + length;
  while (world.now() < end) world.advance(end);
}

class AnyDrive : public testing::TestWithParam<Kind> {
 protected:
  std::string refused(const std::string& command) {
    return drive.inject(command, world.now()).value_or("done");
  }

  World world;
  Drive& drive = GetParam().add(world);
};

TEST_P(AnyDrive, ObeysItsCommands) {
  run(world, milliseconds(500));
  for (const char* command : {"stall 1", "stall 0", "silence 1", "silence 0", "clock -100000", "clock 0x10",
                              "clock 0", " power_cycle  0.1 ", "power_cycle 3600"})
    EXPECT_EQ(refused(command), "done") << command;
  run(world, milliseconds(500));
}

// Not one of these numbers can be carried out: time would stand still, or run backwards, or overflow.
TEST_P(AnyDrive, RefusesNumbersOutOfTheirRange) {
  for (const char* number : {"nan", "-nan", "1e300", "-1000000", "100001", "inf", "fast", "1s"}) {
    EXPECT_EQ(refused(std::string("clock ") + number), "\"clock " + std::string(number) + "\": PPM is " +
                                                           number +
                                                           "; it must be a number within -100000..100000");
  }
  for (const char* number : {"nan", "-1", "3601", "1e300"}) {
    EXPECT_EQ(refused(std::string("power_cycle ") + number), "\"power_cycle " + std::string(number) +
                                                                 "\": SECONDS is " + number +
                                                                 "; it must be a number within 0..3600");
  }
  EXPECT_EQ(refused("stall 2"), "\"stall 2\": 0|1 is 2; it must be a whole number within 0..1");
  EXPECT_EQ(refused("silence 0.5"), "\"silence 0.5\": 0|1 is 0.5; it must be a whole number within 0..1");
  run(world, milliseconds(100));
}

TEST_P(AnyDrive, TellsWhatItKnowsInstead) {
  for (const char* command : {"", "explode", "clock", "clock 1 2", "stall"}) {
    const std::string reason = refused(command);
    EXPECT_EQ(reason.find("\"" + std::string(command) + "\" is no fault; known: "), 0U) << reason;
    EXPECT_NE(reason.find("power_cycle SECONDS, stall 0|1, silence 0|1, clock PPM"), std::string::npos)
        << reason;
  }
}

TEST_P(AnyDrive, IsObservedUntilNobodyLooks) {
  std::vector<DemandSample> samples;
  drive.observe([&samples](const DemandSample& sample) { samples.push_back(sample); });
  run(world, milliseconds(300));
  ASSERT_GT(samples.size(), 50U);
  EXPECT_FALSE(samples.back().interpolating);
  EXPECT_EQ(samples.back().velocity, 0.0);
  EXPECT_EQ(samples.back().actual, drive.position());
  const std::size_t seen = samples.size();
  drive.observe({});
  run(world, milliseconds(100));
  EXPECT_EQ(samples.size(), seen);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AnyDrive, testing::ValuesIn(kKinds),
                         [](const testing::TestParamInfo<Kind>& kind) { return kind.param.name; });

TEST(Drive, HasCommandsOfItsKind) {
  World world;
  EposDrive& epos = world.add<EposDrive>(world.add_can_bus("can", 1'000'000), EposParameters{});
  SilverDust& silver = world.add<SilverDust>(world.add_serial_line("line"), SilverDustParameters{});
  run(world, milliseconds(500));
  EXPECT_EQ(epos.inject("emcy 0x2310", world.now()), std::nullopt);
  EXPECT_EQ(epos.counters().emergencies, 1U);
  EXPECT_EQ(epos.inject("emcy 65536", world.now()).value(),
            "\"emcy 65536\": CODE is 65536; it must be a whole number within 1..65535");
  EXPECT_TRUE(epos.inject("fault low_voltage", world.now()));
  EXPECT_EQ(silver.inject("fault low_voltage", world.now()), std::nullopt);
  EXPECT_EQ(silver.inject("nak 25 2 3", world.now()), std::nullopt);
  EXPECT_TRUE(silver.inject("nak 25 2 nan", world.now()));
  EXPECT_TRUE(silver.inject("fault high_spirits", world.now()));
  EXPECT_TRUE(silver.inject("emcy 0x2310", world.now()));
}

TEST(BusFaults, HaveRangesToo) {
  World world;
  auto& bus = world.add_can_bus("can", 1'000'000);
  auto& line = world.add_serial_line("line");
  const auto on_bus = [&](const std::string& text) { return obey_fault(text, faults_of(bus, world.now())); };
  const auto on_line = [&](const std::string& text) {
    return obey_fault(text, faults_of(line, world.now()));
  };
  for (const char* command : {"drop 3", "drop_id 0x581 1", "disconnect 1", "disconnect 0", "bus_off 0.1"})
    EXPECT_EQ(on_bus(command), std::nullopt) << command;
  for (const char* command :
       {"drop nan", "drop 1e300", "drop -1", "drop 0.5", "drop_id 0x800 1", "drop_id 1 nan", "disconnect 2",
        "bus_off nan", "bus_off 1e300", "bus_off -1", "drop", "lose_replies 1"})
    EXPECT_TRUE(on_bus(command)) << command;
  for (const char* command : {"lose_requests 2", "lose_replies 2", "garble_requests 2", "garble_replies 2",
                              "garbage # 10 0000|", "disconnect 1"})
    EXPECT_EQ(on_line(command), std::nullopt) << command;
  for (const char* command :
       {"lose_requests nan", "garble_replies 1e300", "disconnect -1", "garbage", "drop 1"})
    EXPECT_TRUE(on_line(command)) << command;
  EXPECT_EQ(on_line("garbag").value(),
            "\"garbag\" is no fault; known: lose_requests COUNT, lose_replies COUNT, garble_requests COUNT, "
            "garble_replies COUNT, lose_request COUNT, lose_reply COUNT, refuse_nth COUNT, garbage TEXT, "
            "disconnect 0|1");
}

}  // namespace
}  // namespace interpolated_motion::emulation
