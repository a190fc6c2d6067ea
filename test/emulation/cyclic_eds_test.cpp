#include <gtest/gtest.h>

#include <set>

#include "eds_objects.h"
#include "interpolated_motion_driver/emulation/cyclic_object_table.h"
#include "wire_host.h"

namespace interpolated_motion::emulation {
namespace {

const std::string kPath = std::string(IMD_SOURCE_DIR) + "/config/eds/cyclic_emulated.eds";

TEST(CyclicEds, EachObjectIsInTheEmulatorAsStated) {
  const auto objects = objects_of(read_eds(kPath));
  ASSERT_EQ(objects.size(), kCyclicObjects.size());
  Key previous{0, 0};
  for (const ObjectEntry& entry : kCyclicObjects) {
    const Key key{entry.index, entry.subindex};
    SCOPED_TRACE(testing::Message() << std::hex << key.first << ":" << key.second);
    EXPECT_LT(previous, key) << "the table is searched by halves";
    previous = key;
    ASSERT_EQ(objects.count(key), 1U);
    const auto& eds = objects.at(key);
    const auto type = static_cast<unsigned>(std::stoul(eds.at("datatype"), nullptr, 0));
    EXPECT_EQ(static_cast<unsigned>(entry.type), type);
    EXPECT_EQ(access_text(entry.access), eds.at("accesstype"));
    EXPECT_EQ(entry.mappable, eds.at("pdomapping") == "1");
    EXPECT_EQ(entry.has_default, !eds.at("defaultvalue").empty());
    EXPECT_EQ(entry.plus_node_id, eds.at("defaultvalue").find("$nodeid") == 0);
    EXPECT_EQ(entry.initial, number(eds.at("defaultvalue"), type));
    EXPECT_EQ(entry.has_range, eds.count("lowlimit") == 1);
    if (!entry.has_range) continue;
    EXPECT_EQ(entry.low, number(eds.at("lowlimit"), type));
    EXPECT_EQ(entry.high, number(eds.at("highlimit"), type));
  }
}

TEST(CyclicEds, ObjectListsNameEachIndexOnce) {
  const EdsFile file = read_eds(kPath);
  std::set<unsigned> listed;
  for (const char* section : {"mandatoryobjects", "optionalobjects", "manufacturerobjects"}) {
    const auto& keys = file.at(section);
    EXPECT_EQ(std::stoul(keys.at("supportedobjects")) + 1, keys.size());
    for (const auto& [key, value] : keys) {
      if (key == "supportedobjects") continue;
      EXPECT_TRUE(listed.insert(static_cast<unsigned>(std::stoul(value, nullptr, 0))).second) << value;
    }
  }
  std::set<unsigned> present;
  for (const auto& [key, eds] : objects_of(file)) present.insert(key.first);
  EXPECT_EQ(listed, present);
}

TEST(CyclicEds, DefaultsAndReadAccessHoldAtTheWire) {
  CyclicParameters parameters;
  parameters.node_id = 23;
  WireHost host(parameters);
  host.boot();
  for (const auto& [key, eds] : objects_of(read_eds(kPath))) {
    SCOPED_TRACE(testing::Message() << std::hex << key.first << ":" << key.second);
    const auto type = static_cast<unsigned>(std::stoul(eds.at("datatype"), nullptr, 0));
    if (bits_of(type) == 0) continue;
    const Bytes r = host.exchange({0x40, key.first & 0xFF, key.first >> 8, key.second});
    ASSERT_EQ(r.size(), 8U);
    ASSERT_EQ(8 * (4 - ((r[0] >> 2) & 3)), bits_of(type));
    if (eds.at("defaultvalue").empty()) continue;
    const bool of_node = eds.at("defaultvalue").find("$nodeid") == 0;
    const std::int64_t expected = number(eds.at("defaultvalue"), type) + (of_node ? 23 : 0);
    const std::uint32_t mask = 0xFFFFFFFFU >> (32 - bits_of(type));
    EXPECT_EQ(WireHost::word(r, 4) & mask, static_cast<std::uint32_t>(expected) & mask);
  }
}

TEST(CyclicEds, WriteAccessLengthAndRangeHoldAtTheWire) {
  WireHost host{CyclicParameters{}};
  host.boot();
  for (const auto& [key, eds] : objects_of(read_eds(kPath))) {
    SCOPED_TRACE(testing::Message() << std::hex << key.first << ":" << key.second);
    const auto type = static_cast<unsigned>(std::stoul(eds.at("datatype"), nullptr, 0));
    const auto size = static_cast<unsigned>(bits_of(type)) / 8;
    const std::string& access = eds.at("accesstype");
    if (access == "ro" || access == "const") {
      EXPECT_EQ(host.write(key.first, key.second, 0, 4), 0x06010002U);
      continue;
    }
    if (size < 4) {
      EXPECT_EQ(host.write(key.first, key.second, 0, size + 1), 0x06070012U);
    }
    if (size > 1) {
      EXPECT_EQ(host.write(key.first, key.second, 0, size - 1), 0x06070013U);
    }
    if (eds.count("lowlimit") == 0) continue;
    const std::int64_t low = number(eds.at("lowlimit"), type);
    const std::int64_t high = number(eds.at("highlimit"), type);
    const int sign_bits = type <= 4 ? 1 : 0;
    if (high < (std::int64_t{1} << (bits_of(type) - sign_bits)) - 1) {
      EXPECT_EQ(host.write(key.first, key.second, high + 1, size), 0x06090031U);
    }
    if (sign_bits != 0 || low > 0) {
      EXPECT_EQ(host.write(key.first, key.second, low - 1, size), 0x06090032U);
    }
  }
}

}  // namespace
}  // namespace interpolated_motion::emulation
