#include "interpolated_motion_driver/protocol/canopen/pdo.h"

#include <gtest/gtest.h>

namespace interpolated_motion::canopen {

inline void PrintTo(const SdoWrite& write, std::ostream* out) {
  *out << to_string(write.address) << " = " << write.value << " (" << int{write.size} << " bytes)";
}

namespace test {
namespace {

using Writes = std::vector<SdoWrite>;

TEST(PdoEntry, Value) { EXPECT_EQ((PdoEntry{{0x20C4, 1}, 16}.value()), 0x20C40110u); }

TEST(PdoMapping, LengthAndOffsets) {
  const PdoMapping mapping{{{{0x20C4, 1}, 16}, {{0x6041, 0}, 16}, {{0x6061, 0}, 8}}};
  EXPECT_EQ(mapping.bits(), 40u);
  EXPECT_EQ(mapping.length(), 5);
  EXPECT_EQ(mapping.offset({0x20C4, 1}), 0u);
  EXPECT_EQ(mapping.offset({0x6041, 0}), 16u);
  EXPECT_EQ(mapping.offset({0x6061, 0}), 32u);
  EXPECT_FALSE(mapping.offset({0x6064, 0}));
}

TEST(PdoField, ReadsAndWritesBits) {
  // 20C4:01 = 0xC001, 6041 = 0x1337, 6061 = 7
  std::uint8_t data[8] = {0x01, 0xC0, 0x37, 0x13, 0x07, 0xAA, 0xAA, 0xAA};
  EXPECT_EQ(get_field(data, 0, 16), 0xC001u);
  EXPECT_EQ(get_field(data, 16, 16), 0x1337u);
  EXPECT_EQ(get_field(data, 32, 8), 7u);
  EXPECT_EQ(get_field(data, 0, 64), 0xAAAAAA071337C001u);
  set_field(data, 16, 16, 0x12340F1F);
  EXPECT_EQ(get_field(data, 16, 16), 0x0F1Fu);
  EXPECT_EQ(get_field(data, 0, 16), 0xC001u);
  EXPECT_EQ(get_field(data, 32, 8), 7u);
  set_field(data, 0, 64, 5);
  EXPECT_EQ(get_field(data, 0, 64), 5u);
}

TEST(PdoConfiguration, ReceivePdoOfInterpolationRecords) {
  PdoConfiguration c;
  c.mapping.entries = {{{0x20C1, 0}, 64}};
  const Writes expected{{{0x1400, 1}, 4, 0x80000203}, {{0x1600, 0}, 1, 0},    {{0x1600, 1}, 4, 0x20C10040},
                        {{0x1600, 0}, 1, 1},          {{0x1400, 2}, 1, 0xFF}, {{0x1400, 1}, 4, 0x203}};
  EXPECT_EQ(pdo_configuration(c, 3), expected);
}

TEST(PdoConfiguration, TransmitPdoOfStatus) {
  PdoConfiguration c;
  c.direction = PdoDirection::Tpdo;
  c.number = 2;
  c.mapping.entries = {{{0x20C4, 1}, 16}, {{0x6041, 0}, 16}, {{0x6061, 0}, 8}};
  c.inhibit_time = 20;
  const Writes expected{
      {{0x1801, 1}, 4, 0xC0000283}, {{0x1A01, 0}, 1, 0},          {{0x1A01, 1}, 4, 0x20C40110},
      {{0x1A01, 2}, 4, 0x60410010}, {{0x1A01, 3}, 4, 0x60610008}, {{0x1A01, 0}, 1, 3},
      {{0x1801, 2}, 1, 0xFF},       {{0x1801, 3}, 2, 20},         {{0x1801, 1}, 4, 0x40000283}};
  EXPECT_EQ(pdo_configuration(c, 3), expected);
}

TEST(PdoConfiguration, RemoteRequestTypesAllowRemoteRequests) {
  PdoConfiguration c;
  c.direction = PdoDirection::Tpdo;
  c.number = 3;
  c.mapping.entries = {{{0x60C4, 2}, 32}};
  c.transmission_type = kRemoteRequest;
  EXPECT_EQ(pdo_configuration(c, 1).back().value, 0x381u);
}

TEST(PdoConfiguration, OwnIdentifierForSharedTimeStamp) {
  PdoConfiguration c;
  c.number = 3;
  c.mapping.entries = {{{0x1013, 0}, 32}};
  c.cob_id = 0x100;
  const Writes writes = pdo_configuration(c, 9);
  EXPECT_EQ(writes.front(), (SdoWrite{{0x1402, 1}, 4, 0x80000100}));
  EXPECT_EQ(writes.back(), (SdoWrite{{0x1402, 1}, 4, 0x100}));
}

TEST(PdoConfiguration, Disable) {
  EXPECT_EQ(pdo_disable(PdoDirection::Rpdo, 4, 3), (SdoWrite{{0x1403, 1}, 4, 0x80000503}));
  EXPECT_EQ(pdo_disable(PdoDirection::Tpdo, 4, 3), (SdoWrite{{0x1803, 1}, 4, 0xC0000483}));
}

TEST(PdoConfiguration, RefusesWhatADriveWould) {
  PdoConfiguration c;
  EXPECT_THROW(pdo_configuration(c, 3), std::invalid_argument);  // nothing mapped
  c.mapping.entries = {{{0x20C1, 0}, 64}};
  EXPECT_NO_THROW(pdo_configuration(c, 3));
  EXPECT_THROW(pdo_configuration(c, 0), std::invalid_argument);
  EXPECT_THROW(pdo_configuration(c, 128), std::invalid_argument);
  c.mapping.entries.push_back({{0x6060, 0}, 8});  // 72 bits
  EXPECT_THROW(pdo_configuration(c, 3), std::invalid_argument);
  c.mapping.entries.assign(9, {{0x6060, 0}, 1});
  EXPECT_THROW(pdo_configuration(c, 3), std::invalid_argument);
  c.mapping.entries.resize(8);
  c.number = 5;
  EXPECT_THROW(pdo_configuration(c, 3), std::invalid_argument);
  EXPECT_THROW(pdo_disable(PdoDirection::Rpdo, 0, 3), std::invalid_argument);
  c.number = 4;
  c.cob_id = 0x800;
  EXPECT_THROW(pdo_configuration(c, 3), std::invalid_argument);
}

}  // namespace
}  // namespace test
}  // namespace interpolated_motion::canopen
