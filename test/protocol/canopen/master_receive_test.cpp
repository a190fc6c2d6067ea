#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "protocol/canopen/bytes.h"
#include "protocol/canopen/drain.h"
#include "protocol/canopen/sdo_server.h"
#include "protocol/property_cases.h"

// What the master does with received frames, and with a wrong configuration.
namespace interpolated_motion::canopen::test {
namespace {

using std::chrono::milliseconds;

TEST(MasterReceiving, DispatchesToTheNode) {
  MasterParameters parameters;
  parameters.heartbeat_timeout = milliseconds(200);
  Master master("can0", parameters);
  NodeLink& three = master.add_node(3);
  NodeLink& four = master.add_node(4);
  Texts pdos;
  three.set_tpdo_handler([&pdos](int n, const Frame& frame, HostTime time) {
    pdos.push_back(std::to_string(n) + " " + to_string(frame) + " " +
                   std::to_string(time.time_since_epoch() / milliseconds(1)));
  });
  master.on_frame(from_bus(make_frame(0x183, {0x37, 0x13}), at_ms(1)));
  master.on_frame(from_bus(make_frame(0x483, {0x01}), at_ms(2)));
  master.on_frame(from_bus(make_frame(0x184, {0x37, 0x13}), at_ms(3)));
  EXPECT_EQ(pdos, (Texts{"1 183#3713 1", "4 483#01 2"}));

  master.on_frame(from_bus(make_frame(0x084, {0x0C, 0xFF, 0x20, 0, 0, 0, 0, 0}), at_ms(4)));
  EXPECT_EQ(four.take_emcy()->code, 0xFF0C);
  EXPECT_FALSE(three.take_emcy());

  master.on_frame(from_bus(make_frame(0x704, {0x7F}), at_ms(5)));
  EXPECT_EQ(four.heartbeat().take_event(), HeartbeatEvent::Started);
  EXPECT_EQ(master.next_deadline(), at_ms(205));
  master.poll(at_ms(205));
  EXPECT_EQ(four.heartbeat().take_event(), HeartbeatEvent::Lost);

  three.sdo().start_upload({0x6041, 0}, at_ms(300));
  drain(master, at_ms(300));
  master.on_frame(from_bus(make_frame(0x584, {0x4B, 0x41, 0x60, 0, 1, 0, 0, 0}), at_ms(301)));
  EXPECT_TRUE(three.sdo().busy());
  master.on_frame(from_bus(make_frame(0x583, {0x4B, 0x41, 0x60, 0, 2, 0, 0, 0}), at_ms(302)));
  EXPECT_EQ(three.sdo().take_result()->as_u16(), 2);
}

TEST(MasterReceiving, OldestEmergenciesAreForgottenAndCounted) {
  MasterParameters parameters;
  parameters.emcy_capacity = 2;
  Master master("can0", parameters);
  NodeLink& node = master.add_node(3);
  for (int i = 1; i <= 3; ++i)
    master.on_frame(from_bus(make_frame(0x083, {i, 0, 0, 0, 0, 0, 0, 0}), at_ms(i)));
  EXPECT_EQ(node.emergencies_lost(), 1u);
  EXPECT_EQ(node.take_emcy()->code, 2);
  EXPECT_EQ(node.take_emcy()->code, 3);
}

TEST(MasterReceiving, OwnFramesConfirmSyncAndPdos) {
  Master master("can0");
  NodeLink& node = master.add_node(3);
  master.on_frame(from_bus(make_frame(0x080, {}), at_us(1500), true));
  EXPECT_EQ(master.last_sync_time(), at_us(1500));
  EXPECT_EQ(master.syncs_confirmed(), 1u);
  master.on_frame(from_bus(make_frame(0x203, {1, 2, 3, 4, 5, 6, 7, 8}), at_us(1700), true));
  master.on_frame(from_bus(make_frame(0x203, {1, 2, 3, 4, 5, 6, 7, 8}), at_us(1900), true));
  EXPECT_EQ(node.rpdos_confirmed(1), 2u);
  EXPECT_EQ(node.rpdos_confirmed(2), 0u);
  EXPECT_EQ(node.last_rpdo_time(1), at_us(1900));
  // Another's SYNC is not ours.
  master.on_frame(from_bus(make_frame(0x080, {}), at_us(2500)));
  EXPECT_EQ(master.last_sync_time(), at_us(1500));
  EXPECT_EQ(master.foreign().unexpected(UnexpectedFrame::OtherMaster).count, 1u);
}

TEST(MasterReceiving, CountsWhatItCannotUseByCause) {
  Master master("can0");
  master.add_node(3);
  EXPECT_EQ(master.unexpected_text(UnexpectedFrame::UnconfiguredNode), "");
  master.on_frame(from_bus(make_frame(0x189, {0x37, 0x02}), at_ms(1)));
  EXPECT_EQ(master.unexpected_text(UnexpectedFrame::UnconfiguredNode),
            "can0: 1 frame of nodes that are not configured, last: TPDO 1 of node 9, 189#3702");
  master.on_frame(from_bus(make_frame(0x709, {0}), at_ms(2)));
  EXPECT_EQ(master.unexpected_text(UnexpectedFrame::UnconfiguredNode),
            "can0: 2 frames of nodes that are not configured, last: heartbeat of node 9, 709#00");

  master.on_frame(from_bus(make_frame(0x781, {1}), at_ms(3)));
  EXPECT_EQ(master.unexpected_text(UnexpectedFrame::UnknownCobId),
            "can0: 1 frame with an unknown COB-ID, last: unknown COB-ID 0x781, 781#01");

  Frame remote = make_frame(0x183, {});
  remote.remote = true;
  master.on_frame(from_bus(remote, at_ms(4)));
  EXPECT_EQ(master.unexpected_text(UnexpectedFrame::RemoteFrame),
            "can0: 1 frame sent as remote request, last: TPDO 1 of node 3, 183#R");

  Frame extended = make_frame(0x12345, {1});
  extended.extended = true;
  master.on_frame(from_bus(extended, at_ms(5)));
  EXPECT_EQ(master.unexpected_text(UnexpectedFrame::ExtendedFrame),
            "can0: 1 frame with a 29-bit identifier, last: 00012345#01");

  for (std::uint32_t id : {0x000u, 0x100u, 0x203u, 0x603u, 0x77Fu}) {
    master.on_frame(from_bus(make_frame(id, {1}), at_ms(6)));
  }
  EXPECT_EQ(master.foreign().unexpected(UnexpectedFrame::OtherMaster).count, 5u);
  master.on_frame(from_bus(make_frame(0x703, {5, 5}), at_ms(7)));
  master.on_frame(from_bus(make_frame(0x083, {5}), at_ms(8)));
  EXPECT_EQ(master.foreign().unexpected(UnexpectedFrame::Malformed).count, 2u);
  EXPECT_EQ(master.foreign().unexpected(UnexpectedFrame::Malformed).time, at_ms(8));
}

TEST(MasterReceiving, MeasuresTheLoadOfOwnAndOthersFrames) {
  Master master("can0");
  const Frame frame = make_frame(0x203, {1, 2, 3, 4, 5, 6, 7, 8});
  for (int ms = 0; ms < 2000; ++ms) {
    master.on_frame(from_bus(frame, at_ms(ms), true));
    master.on_frame(from_bus(frame, at_ms(ms)));
  }
  EXPECT_NEAR(master.bus_load(), 0.237, 0.002);  // 2000 frames of 118.5 bits per second
  EXPECT_EQ(master.bus_load(at_ms(4000)), 0.0);
}

TEST(MasterConfiguration, RefusesWhatIsOutOfRangeWithParameterAndRange) {
  const auto refusal = [](auto change) -> std::string {
    MasterParameters parameters;
    change(parameters);
    try {
      Master master("can0", parameters);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal([](MasterParameters&) {}), "accepted");
  EXPECT_EQ(refusal([](MasterParameters& p) { p.own_node_id = 0; }),
            "can0: own_node_id = 0 is not in 1..127");
  EXPECT_EQ(refusal([](MasterParameters& p) { p.bitrate = 9999; }),
            "can0: bitrate = 9999 is not in 10000..1000000");
  EXPECT_NE(refusal([](MasterParameters& p) { p.max_bulk_load = 1.5; }).find("max_bulk_load = 1.5"),
            std::string::npos);
  EXPECT_NE(refusal([](MasterParameters& p) { p.max_bulk_load = std::nan(""); }), "accepted");
  EXPECT_NE(refusal([](MasterParameters& p) { p.sync_period = milliseconds(-1); }), "accepted");
  EXPECT_NE(refusal([](MasterParameters& p) { p.bulk_capacity = 0; }), "accepted");

  Master master("can0");
  master.add_node(3);
  EXPECT_EQ(master.find_node(4), nullptr);
  EXPECT_EQ(master.find_node(3)->name(), "can0 node 3");
  EXPECT_THROW(master.add_node(3), std::invalid_argument);
  EXPECT_THROW(master.add_node(127), std::invalid_argument);
  EXPECT_THROW(master.add_node(0), std::invalid_argument);
  EXPECT_THROW(master.add_node(200), std::invalid_argument);
}

/// A frame of the services of two nodes, or any frame at all.
Frame random_frame(std::mt19937_64& random) {
  Frame frame;
  const bool any = interpolated_motion::test::below(random, 2) == 0;
  const auto node = 3 + interpolated_motion::test::below(random, 2);
  frame.id = any ? static_cast<std::uint32_t>(random() >> 35)
                 : 0x80 * interpolated_motion::test::below(random, 16) + node;
  frame.extended = interpolated_motion::test::below(random, 20) == 0;
  frame.remote = interpolated_motion::test::below(random, 20) == 0;
  frame.length = static_cast<std::uint8_t>(
      interpolated_motion::test::below(random, 10) == 0 ? interpolated_motion::test::below(random, 16) : 8);
  put_le(frame.data.data(), random());
  return frame;
}

TEST(MasterReceiving, SurvivesGarbageAndStaysUsable) {
  using interpolated_motion::test::below;
  std::mt19937_64 random(5);
  MasterParameters parameters;
  parameters.heartbeat_timeout = milliseconds(50);
  parameters.sync_period = milliseconds(10);
  Master master("can0", parameters);
  int pdos = 0;
  for (std::uint8_t id : {std::uint8_t{3}, std::uint8_t{4}}) {
    master.add_node(id).set_tpdo_handler([&pdos](int n, const Frame&, HostTime) {
      ASSERT_TRUE(n >= 1 && n <= 4);
      ++pdos;
    });
  }
  HostTime now = at_ms(0);
  const int cases = interpolated_motion::test::property_cases(2000) * 10;
  for (int i = 0; i < cases; ++i) {
    now += std::chrono::microseconds(below(random, 500));
    master.on_frame({random_frame(random), now, below(random, 10) == 0});
    SdoClient& sdo = master.find_node(static_cast<std::uint8_t>(3 + i % 2))->sdo();
    const auto kind = below(random, 2) == 0 ? SdoTransfer::Automatic : SdoTransfer::Block;
    if (below(random, 2) == 0)
      sdo.start_upload({0x6041, 0}, now, kind);
    else
      sdo.start_download({0x2000, 0}, kData, 8, now, kind);
    master.poll(now);
    drain(master, now, below(random, 4));
    ASSERT_LE(master.pending_control(), parameters.control_capacity);
  }
  EXPECT_GT(pdos, 0);

  // Thereafter a plain transfer works.
  NodeLink& node = *master.find_node(3);
  now += milliseconds(1000);
  master.poll(now);
  drain(master, now);
  ASSERT_FALSE(node.sdo().busy());
  SdoServer server(3);
  server.objects[0x604100] = {0x37, 0x02};
  node.sdo().start_upload({0x6041, 0}, now);
  const Frame request = *master.peek_outgoing(now);
  master.pop_outgoing(now);
  for (const Frame& reply : server.handle(request)) master.on_frame(from_bus(reply, now));
  EXPECT_EQ(node.sdo().take_result()->as_u16(), 0x0237);
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
