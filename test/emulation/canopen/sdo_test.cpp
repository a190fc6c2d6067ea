#include <gtest/gtest.h>

#include <string>

#include "wire_host.h"

// SDO protocols of CiA 301, 7.2.4, at the wire.
namespace interpolated_motion::emulation {
namespace {

// CRC-16/XMODEM bit by bit from its definition; "123456789" gives 0x31C3.
unsigned crc16(const std::string& text) {
  unsigned crc = 0;
  for (const char c : text) {
    for (int bit = 7; bit >= 0; --bit) {
      const unsigned in = (static_cast<unsigned char>(c) >> bit & 1U) ^ (crc >> 15 & 1U);
      crc = (crc << 1 & 0xFFFFU) ^ (in != 0 ? 0x1021U : 0U);
    }
  }
  return crc;
}

struct Sdo : testing::Test {
  WireHost host{named("EPOS2 70/10 emulated")};

  static EposParameters named(const std::string& name) {
    EposParameters parameters;
    parameters.device_name = name;
    return parameters;
  }
  void SetUp() override { host.boot(); }
};

TEST_F(Sdo, ExpeditedResponsesHaveTheBytesOfTheStandard) {
  EXPECT_EQ(host.exchange({0x40, 0x00, 0x10, 0}), (Bytes{0x43, 0x00, 0x10, 0, 0x92, 0x01, 0x02, 0x00}));
  EXPECT_EQ(host.exchange({0x40, 0x61, 0x60, 0}), (Bytes{0x4F, 0x61, 0x60, 0, 1, 0, 0, 0}));
  EXPECT_EQ(host.exchange({0x40, 0x41, 0x60, 0}), (Bytes{0x4B, 0x41, 0x60, 0, 0x40, 0x01, 0, 0}));
  EXPECT_EQ(host.exchange({0x23, 0x81, 0x60, 0, 0x10, 0x27, 0, 0}), (Bytes{0x60, 0x81, 0x60, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.read(0x6081, 0), 10000U);
  EXPECT_EQ(host.exchange({0x22, 0x60, 0x60, 0, 7, 0, 0, 0})[0], 0x60) << "no size indicated";
  EXPECT_EQ(host.read(0x6061, 0), 7U);
  EXPECT_EQ(host.exchange({0x40, 0xC1, 0x60, 0}), (Bytes{0x80, 0xC1, 0x60, 0, 0x00, 0x00, 0x02, 0x06}));
}

TEST_F(Sdo, ResponseTakesTheSetTime) {
  host.send(0x601, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
  const HostTime sent = host.world.now();
  host.run(ms(2));
  const auto response = host.take(0x581);
  ASSERT_TRUE(response);
  // Two frames of 111..135 bits and 0.3 ms between them.
  EXPECT_GE(seconds(response->time - sent), 2 * 108e-6 + 300e-6);
  EXPECT_LE(seconds(response->time - sent), 2 * 135e-6 + 300e-6);
}

TEST_F(Sdo, SegmentedUpload) {
  EXPECT_EQ(host.exchange({0x40, 0x08, 0x10, 0}), (Bytes{0x41, 0x08, 0x10, 0, 20, 0, 0, 0}));
  EXPECT_EQ(host.exchange({0x60}), (Bytes{0x00, 'E', 'P', 'O', 'S', '2', ' ', '7'}));
  EXPECT_EQ(host.exchange({0x70}), (Bytes{0x10, '0', '/', '1', '0', ' ', 'e', 'm'}));
  EXPECT_EQ(host.exchange({0x60}), (Bytes{0x03, 'u', 'l', 'a', 't', 'e', 'd', 0}));
  EXPECT_EQ(WireHost::result(host.exchange({0x70}), 0), 0x05040001U) << "the transfer is over";
}

TEST_F(Sdo, SegmentedDownloadOfARecord) {
  ASSERT_EQ(host.write(0x6060, 0, 7, 1), 0U);
  ASSERT_EQ(host.write(0x60C4, 6, 1, 1), 0U);
  EXPECT_EQ(host.exchange({0x21, 0xC1, 0x20, 0, 8}), (Bytes{0x60, 0xC1, 0x20, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.exchange({0x00, 0x00, 0xF0, 0xFF, 0xFF, 0x24, 0xFA, 0xFF}),
            (Bytes{0x20, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.exchange({0x1D, 0x0A}), (Bytes{0x30, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.read(0x60C4, 4), 1U);
}

TEST_F(Sdo, BrokenTransfersAreAborted) {
  EXPECT_EQ(WireHost::result(host.exchange({0x00, 1}), 0), 0x05040001U) << "stray segment";
  EXPECT_EQ(WireHost::result(host.exchange({0x60}), 0), 0x05040001U);
  EXPECT_EQ(WireHost::result(host.exchange({0xE0}), 0), 0x05040001U) << "no such command";
  host.exchange({0x40, 0x08, 0x10, 0});
  EXPECT_EQ(WireHost::result(host.exchange({0x70}), 0), 0x05030000U) << "toggle bit";
  host.exchange({0x21, 0xC1, 0x20, 0, 8});
  EXPECT_EQ(WireHost::result(host.exchange({0x10, 1, 2, 3}), 0), 0x05030000U);
  host.exchange({0x21, 0xC1, 0x20, 0, 8});
  EXPECT_EQ(WireHost::result(host.exchange({0x01, 1, 2, 3, 4, 5, 6, 7}), 0), 0x06070010U) << "7 of 8 bytes";
  EXPECT_EQ(WireHost::result(host.exchange({0x21, 0xC1, 0x20, 0, 9}), 0), 0x06070012U);
  EXPECT_EQ(WireHost::result(host.exchange({0x21, 0xC1, 0x20, 0, 7}), 0), 0x06070013U);
}

TEST_F(Sdo, ANewRequestReplacesAnUnfinishedTransfer) {
  host.exchange({0x21, 0xC1, 0x20, 0, 8});
  EXPECT_EQ(host.read(0x6061, 0), 1U);
  EXPECT_EQ(WireHost::result(host.exchange({0x00, 1}), 0), 0x05040001U);
}

TEST_F(Sdo, AClientsAbortEndsATransferInSilence) {
  host.exchange({0x21, 0xC1, 0x20, 0, 8});
  EXPECT_TRUE(host.exchange({0x80, 0xC1, 0x20, 0, 0, 0, 4, 5}).empty());
  EXPECT_EQ(WireHost::result(host.exchange({0x00, 1}), 0), 0x05040001U);
}

TEST_F(Sdo, BlockDownloadWithCrc) {
  ASSERT_EQ(host.write(0x6060, 0, 7, 1), 0U);
  ASSERT_EQ(host.write(0x60C4, 6, 1, 1), 0U);
  const std::string data("\x64\x00\x00\x00\x01\x00\x00\x0A", 8);
  const unsigned crc = crc16(data);
  const auto download = [&](unsigned sent_crc) {
    EXPECT_EQ(host.exchange({0xC6, 0xC1, 0x20, 0, 8}), (Bytes{0xA4, 0xC1, 0x20, 0, 127, 0, 0, 0}));
    host.send(0x601, {0x01, 0x64, 0, 0, 0, 1, 0, 0});
    EXPECT_EQ(host.exchange({0x82, 0x0A}), (Bytes{0xA2, 2, 127, 0, 0, 0, 0, 0}));
    return host.exchange({0xC1 | 6U << 2, sent_crc & 0xFF, sent_crc >> 8});
  };
  EXPECT_EQ(download(crc), (Bytes{0xA1, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.read(0x60C4, 4), 1U);
  EXPECT_EQ(WireHost::result(download(crc ^ 1), 0), 0x05040004U);
  EXPECT_EQ(host.read(0x60C4, 4), 1U);
}

TEST_F(Sdo, BlockDownloadAsksAgainForALostSegment) {
  host.exchange({0xC2, 0xC1, 0x20, 0, 8});
  EXPECT_EQ(host.exchange({0x82, 0x0A}), (Bytes{0xA2, 0, 127, 0, 0, 0, 0, 0})) << "segment 1 is missing";
  host.send(0x601, {0x01, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(host.exchange({0x82, 0x0A}), (Bytes{0xA2, 2, 127, 0, 0, 0, 0, 0}));
}

TEST_F(Sdo, BlockUploadWithCrcAndARepeatedSegment) {
  const std::string name = "EPOS2 70/10 emulated";
  EXPECT_EQ(host.exchange({0xA4, 0x08, 0x10, 0, 2, 0}), (Bytes{0xC6, 0x08, 0x10, 0, 20, 0, 0, 0}));
  host.send(0x601, {0xA3, 0, 0, 0, 0, 0, 0, 0});
  host.run(ms(4));
  ASSERT_EQ(host.count(0x581), 2U);
  EXPECT_EQ(bytes_of(host.take(0x581)->frame), (Bytes{1, 'E', 'P', 'O', 'S', '2', ' ', '7'}));
  EXPECT_EQ(bytes_of(host.take(0x581)->frame), (Bytes{2, '0', '/', '1', '0', ' ', 'e', 'm'}));
  host.send(0x601, {0xA2, 1, 127, 0, 0, 0, 0, 0});  // only the first one has arrived
  host.run(ms(4));
  ASSERT_EQ(host.count(0x581), 2U);
  EXPECT_EQ(bytes_of(host.take(0x581)->frame), (Bytes{1, '0', '/', '1', '0', ' ', 'e', 'm'}));
  EXPECT_EQ(bytes_of(host.take(0x581)->frame), (Bytes{0x82, 'u', 'l', 'a', 't', 'e', 'd', 0}));
  const unsigned crc = crc16(name);
  const Bytes end{
      0xC1 | 1 << 2, static_cast<std::uint8_t>(crc), static_cast<std::uint8_t>(crc >> 8), 0, 0, 0, 0, 0};
  EXPECT_EQ(host.exchange({0xA2, 2, 127}), end);
  EXPECT_TRUE(host.exchange({0xA1}).empty());
}

TEST_F(Sdo, BlockUploadOfAShortObjectMaySwitchToAnOrdinaryOne) {
  EXPECT_EQ(host.exchange({0xA4, 0x61, 0x60, 0, 127, 4}), (Bytes{0x4F, 0x61, 0x60, 0, 1, 0, 0, 0}));
  EXPECT_EQ(WireHost::result(host.exchange({0xA4, 0x08, 0x10, 0, 0, 0}), 0), 0x05040002U) << "block size 0";
}

TEST_F(Sdo, NoServiceInStoppedState) {
  host.nmt(2);
  EXPECT_TRUE(host.exchange({0x40, 0x00, 0x10, 0}).empty());
  host.nmt(128);
  EXPECT_EQ(host.read(0x1000, 0), 0x00020192U);
}

TEST_F(Sdo, StoreAndRestoreParameters) {
  EXPECT_EQ(host.write(0x1010, 1, 0x12345678, 4), 0x08000020U);
  ASSERT_EQ(host.write(0x6065, 0, 1234, 4), 0U);
  host.nmt(129);
  host.boot();
  EXPECT_EQ(host.read(0x6065, 0), 2000U) << "not stored, lost";
  ASSERT_EQ(host.write(0x6065, 0, 1234, 4), 0U);
  ASSERT_EQ(host.write(0x1010, 1, 0x65766173, 4), 0U);
  host.nmt(129);
  host.boot();
  EXPECT_EQ(host.read(0x6065, 0), 1234U);
  ASSERT_EQ(host.write(0x1011, 1, 0x64616F6C, 4), 0U);
  EXPECT_EQ(host.read(0x6065, 0), 1234U);
  host.nmt(129);
  host.boot();
  EXPECT_EQ(host.read(0x6065, 0), 2000U);
}

}  // namespace
}  // namespace interpolated_motion::emulation
