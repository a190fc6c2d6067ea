#include <gtest/gtest.h>

#include <algorithm>

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/crc16.h"
#include "interpolated_motion_driver/protocol/canopen/emcy.h"
#include "interpolated_motion_driver/protocol/canopen/nmt.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"
#include "interpolated_motion_driver/protocol/canopen/ring.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_result.h"
#include "protocol/canopen/bytes.h"

namespace interpolated_motion::canopen::test {
namespace {

TEST(CobId, PredefinedConnectionSet) {
  EXPECT_EQ(cob_id::emcy(3), 0x083u);
  const std::uint32_t tpdos[] = {0x183, 0x283, 0x383, 0x483};
  const std::uint32_t rpdos[] = {0x203, 0x303, 0x403, 0x503};
  for (int n = 1; n <= 4; ++n) {
    EXPECT_EQ(cob_id::tpdo(n, 3), tpdos[n - 1]);
    EXPECT_EQ(cob_id::rpdo(n, 3), rpdos[n - 1]);
  }
  EXPECT_EQ(cob_id::sdo_response(3), 0x583u);
  EXPECT_EQ(cob_id::sdo_request(3), 0x603u);
  EXPECT_EQ(cob_id::heartbeat(3), 0x703u);
}

TEST(CobId, ClassifiesWhatItBuilds) {
  for (int node = 1; node <= 127; ++node) {
    const auto id = static_cast<std::uint8_t>(node);
    for (int n = 1; n <= 4; ++n) {
      const CobIdMeaning tpdo = classify(cob_id::tpdo(n, id));
      EXPECT_TRUE(tpdo.service == Service::Tpdo && tpdo.node == id && tpdo.pdo == n);
      const CobIdMeaning rpdo = classify(cob_id::rpdo(n, id));
      EXPECT_TRUE(rpdo.service == Service::Rpdo && rpdo.node == id && rpdo.pdo == n);
    }
    EXPECT_EQ(classify(cob_id::emcy(id)).service, Service::Emcy);
    EXPECT_EQ(classify(cob_id::sdo_response(id)).service, Service::SdoResponse);
    EXPECT_EQ(classify(cob_id::sdo_request(id)).service, Service::SdoRequest);
    EXPECT_EQ(classify(cob_id::heartbeat(id)).service, Service::Heartbeat);
    EXPECT_EQ(classify(cob_id::heartbeat(id)).node, id);
  }
  EXPECT_EQ(classify(0x000).service, Service::Nmt);
  EXPECT_EQ(classify(0x080).service, Service::Sync);
  EXPECT_EQ(classify(0x100).service, Service::Time);
  EXPECT_EQ(classify(0x7E4).service, Service::Lss);
  EXPECT_EQ(classify(0x7E5).service, Service::Lss);
}

TEST(CobId, CountsOfAllIdentifiers) {
  int known = 0;
  for (std::uint32_t id = 0; id <= 0x7FF; ++id) known += classify(id).service != Service::Unknown ? 1 : 0;
  // 127 nodes x (EMCY, 4 TPDOs, 4 RPDOs, 2 SDOs, heartbeat), NMT, SYNC, TIME, 2 of LSS.
  EXPECT_EQ(known, 127 * 12 + 5);
  for (std::uint32_t id : {0x001u, 0x07Fu, 0x101u, 0x180u, 0x680u, 0x700u, 0x780u, 0x800u}) {
    EXPECT_EQ(classify(id).service, Service::Unknown) << std::hex << id;
  }
}

TEST(CobId, Text) {
  EXPECT_EQ(describe_cob_id(0x283), "TPDO 2 of node 3");
  EXPECT_EQ(describe_cob_id(0x583), "SDO response of node 3");
  EXPECT_EQ(describe_cob_id(0x080), "SYNC");
  EXPECT_EQ(describe_cob_id(0x781), "unknown COB-ID 0x781");
}

TEST(Nmt, Frames) {
  EXPECT_EQ(nmt_frame(NmtCommand::Start, 0), make_frame(0, {0x01, 0x00}));
  EXPECT_EQ(nmt_frame(NmtCommand::Stop, 3), make_frame(0, {0x02, 0x03}));
  EXPECT_EQ(nmt_frame(NmtCommand::EnterPreOperational, 3), make_frame(0, {0x80, 0x03}));
  EXPECT_EQ(nmt_frame(NmtCommand::ResetNode, 3), make_frame(0, {0x81, 0x03}));
  EXPECT_EQ(nmt_frame(NmtCommand::ResetCommunication, 127), make_frame(0, {0x82, 0x7F}));
  EXPECT_EQ(heartbeat_frame(127, NodeState::Operational), make_frame(0x77F, {0x05}));
}

TEST(Nmt, HeartbeatDecoding) {
  EXPECT_EQ(decode_heartbeat(make_frame(0x703, {0x00})), NodeState::BootUp);
  EXPECT_EQ(decode_heartbeat(make_frame(0x703, {0x04})), NodeState::Stopped);
  EXPECT_EQ(decode_heartbeat(make_frame(0x703, {0x05})), NodeState::Operational);
  EXPECT_EQ(decode_heartbeat(make_frame(0x703, {0x7F})), NodeState::PreOperational);
  EXPECT_EQ(decode_heartbeat(make_frame(0x703, {0x85})), NodeState::Operational);
  EXPECT_EQ(decode_heartbeat(make_frame(0x703, {0x33})), NodeState::Unknown);
  EXPECT_FALSE(decode_heartbeat(make_frame(0x703, {})));
  EXPECT_FALSE(decode_heartbeat(make_frame(0x703, {5, 0})));
  Frame remote = make_frame(0x703, {5});
  remote.remote = true;
  EXPECT_FALSE(decode_heartbeat(remote));
}

TEST(Emcy, Decoding) {
  const auto emcy = decode_emcy(make_frame(0x083, {0x0C, 0xFF, 0x20, 1, 2, 3, 4, 5}), at_ms(7));
  ASSERT_TRUE(emcy);
  EXPECT_EQ(emcy->code, 0xFF0C);
  EXPECT_EQ(emcy->error_register, 0x20);
  EXPECT_EQ(emcy->manufacturer, (std::array<std::uint8_t, 5>{1, 2, 3, 4, 5}));
  EXPECT_TRUE(emcy->complete);
  EXPECT_EQ(emcy->time, at_ms(7));
}

TEST(Emcy, ShortAndOverlongFrames) {
  EXPECT_FALSE(decode_emcy(make_frame(0x083, {}), at_ms(0)));
  EXPECT_FALSE(decode_emcy(make_frame(0x083, {0x0C}), at_ms(0)));
  Frame stale = make_frame(0x083, {0x10, 0x82, 0x55, 0x55});
  stale.length = 2;  // bytes behind the length are not data
  const auto two = decode_emcy(stale, at_ms(0));
  ASSERT_TRUE(two);
  EXPECT_EQ(two->code, 0x8210);
  EXPECT_EQ(two->error_register, 0);
  EXPECT_FALSE(two->complete);
  Frame overlong = make_frame(0x083, {0x30, 0x81, 0x11, 0, 0, 0, 0, 9});
  overlong.length = 15;
  const auto eight = decode_emcy(overlong, at_ms(0));
  ASSERT_TRUE(eight);
  EXPECT_EQ(eight->code, 0x8130);
  EXPECT_EQ(eight->manufacturer[4], 9);
  EXPECT_TRUE(eight->complete);
}

TEST(Crc16, KnownVector) {
  const std::uint8_t text[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc16(text, 9), 0x31C3);
  EXPECT_EQ(crc16(text + 4, 5, crc16(text, 4)), 0x31C3);
  EXPECT_EQ(crc16(text, 0), 0);
}

TEST(Object, TextAndOrder) {
  EXPECT_EQ(to_string(ObjectAddress{0x60C4, 2}), "0x60C4:02");
  EXPECT_TRUE((ObjectAddress{0x20C4, 3} < ObjectAddress{0x60C4, 1}));
  EXPECT_TRUE((ObjectAddress{0x60C4, 1} < ObjectAddress{0x60C4, 2}));
  EXPECT_FALSE((ObjectAddress{0x60C4, 2} < ObjectAddress{0x60C4, 2}));
}

TEST(Object, LittleEndian) {
  std::uint8_t bytes[8] = {};
  put_le<std::int32_t>(bytes, -4096);
  EXPECT_EQ(bytes[0], 0x00);
  EXPECT_EQ(bytes[1], 0xF0);
  EXPECT_EQ(bytes[3], 0xFF);
  EXPECT_EQ(bytes[4], 0x00);
  EXPECT_EQ(get_le<std::int32_t>(bytes), -4096);
  put_le<std::uint64_t>(bytes, 0x0807060504030201);
  EXPECT_EQ(bytes[7], 8);
  EXPECT_EQ(get_le<std::uint16_t>(bytes), 0x0201);
  EXPECT_EQ(sign_extend(0xFFFA24, 24), -1500);
  EXPECT_EQ(sign_extend(0x7FFFFF, 24), 8388607);
}

TEST(SdoDataBytes, GrowAndShrinkAcrossTheInlineSize) {
  SdoData data;
  std::vector<std::uint8_t> expected;
  for (std::uint8_t i = 0; i < 30; i = static_cast<std::uint8_t>(i + 3)) {
    const std::uint8_t three[] = {i, static_cast<std::uint8_t>(i + 1), static_cast<std::uint8_t>(i + 2)};
    data.append(three, 3);
    expected.insert(expected.end(), three, three + 3);
    ASSERT_EQ(data.size(), expected.size());
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), data.data()));
  }
  for (std::size_t size : {29u, 9u, 8u, 7u, 0u}) {
    data.truncate(size);
    ASSERT_EQ(data.size(), size);
    ASSERT_TRUE(std::equal(data.data(), data.data() + size, expected.begin()));
  }
  const std::uint8_t one = 42;
  data.append(&one, 1);
  EXPECT_EQ(data[0], 42);
}

TEST(RingQueue, KeepsOrderAndCapacity) {
  Ring<int> ring(3);
  EXPECT_TRUE(ring.push(1) && ring.push(2) && ring.push(3));
  EXPECT_FALSE(ring.push(4));
  EXPECT_EQ(ring.take(), 1);
  EXPECT_TRUE(ring.push(5));
  EXPECT_FALSE(ring.push_over_oldest(6));
  EXPECT_EQ(ring.take(), 3);
  EXPECT_EQ(ring.take(), 5);
  EXPECT_EQ(ring.take(), 6);
  EXPECT_FALSE(ring.take());
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
