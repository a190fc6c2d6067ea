#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "eds_objects.h"
#include "interpolated_motion_driver/emulation/epos_object_table.h"
#include "wire_host.h"

namespace interpolated_motion::emulation {
namespace {

const std::string kPath = std::string(IMD_SOURCE_DIR) + "/config/eds/epos2_emulated.eds";

TEST(Eds, EachObjectIsInTheEmulatorAsStated) {
  const auto objects = objects_of(read_eds(kPath));
  ASSERT_GT(objects.size(), 190U);
  for (const auto& [key, eds] : objects) {
    SCOPED_TRACE(testing::Message() << std::hex << key.first << ":" << key.second);
    const std::size_t slot =
        object_slot(static_cast<std::uint16_t>(key.first), static_cast<std::uint8_t>(key.second));
    ASSERT_LT(slot, kEposObjects.size());
    const ObjectEntry& entry = kEposObjects[slot];
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

TEST(Eds, EachObjectOfTheEmulatorIsStated) {
  const auto objects = objects_of(read_eds(kPath));
  Key previous{0, 0};
  for (const ObjectEntry& entry : kEposObjects) {
    const Key key{entry.index, entry.subindex};
    EXPECT_EQ(objects.count(key), 1U) << std::hex << key.first << ":" << key.second;
    EXPECT_LT(previous, key) << "the table is searched by halves";
    previous = key;
  }
  EXPECT_EQ(objects.size(), kEposObjects.size());
}

TEST(Eds, ObjectListsNameEachIndexOnce) {
  const EdsFile file = read_eds(kPath);
  std::set<unsigned> listed;
  for (const char* section : {"mandatoryobjects", "optionalobjects", "manufacturerobjects"}) {
    const auto& keys = file.at(section);
    EXPECT_EQ(std::stoul(keys.at("supportedobjects")) + 1, keys.size());
    for (const auto& [key, value] : keys) {
      if (key != "supportedobjects") {
        EXPECT_TRUE(listed.insert(static_cast<unsigned>(std::stoul(value, nullptr, 0))).second) << value;
      }
    }
  }
  for (const auto& [key, eds] : objects_of(file)) EXPECT_EQ(listed.count(key.first), 1U) << key.first;
}

// What the EDS says of reading is what the wire says, on a node id that shows whether $NODEID is added.
TEST(Eds, DefaultsAndReadAccessHoldAtTheWire) {
  EposParameters parameters;
  parameters.node_id = 23;
  WireHost host(parameters);
  host.boot();
  for (const auto& [key, eds] : objects_of(read_eds(kPath))) {
    SCOPED_TRACE(testing::Message() << std::hex << key.first << ":" << key.second);
    const auto type = static_cast<unsigned>(std::stoul(eds.at("datatype"), nullptr, 0));
    if (eds.at("accesstype") == "wo") {
      EXPECT_EQ(host.read_abort(key.first, key.second), 0x06010001U);
      continue;
    }
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

TEST(Eds, WriteAccessLengthAndRangeHoldAtTheWire) {
  WireHost host;
  host.boot();
  for (const auto& [key, eds] : objects_of(read_eds(kPath))) {
    SCOPED_TRACE(testing::Message() << std::hex << key.first << ":" << key.second);
    const auto type = static_cast<unsigned>(std::stoul(eds.at("datatype"), nullptr, 0));
    const int bytes = bits_of(type) / 8;
    const std::string& access = eds.at("accesstype");
    if (access == "ro" || access == "const") {
      EXPECT_EQ(host.write(key.first, key.second, 0, 4), 0x06010002U);
      continue;
    }
    const auto size = static_cast<unsigned>(bytes);
    if (bytes < 4) {
      EXPECT_EQ(host.write(key.first, key.second, 0, size + 1), 0x06070012U);
    }
    if (bytes > 1 && bytes <= 4) {
      EXPECT_EQ(host.write(key.first, key.second, 0, size - 1), 0x06070013U);
    }
    if (eds.count("lowlimit") == 0 || bytes > 4) continue;
    const std::int64_t low = number(eds.at("lowlimit"), type);
    const std::int64_t high = number(eds.at("highlimit"), type);
    const std::int64_t top =
        type <= 4 ? (std::int64_t{1} << (8 * bytes - 1)) - 1 : (std::int64_t{1} << (8 * bytes)) - 1;
    if (high < top) {
      EXPECT_EQ(host.write(key.first, key.second, high + 1, size), 0x06090031U);
    }
    if (type <= 4 || low > 0) {
      EXPECT_EQ(host.write(key.first, key.second, low - 1, size), 0x06090032U);
    }
  }
}

TEST(Eds, ObjectsThatEpos2DoesNotHaveAreRefused) {
  WireHost host;
  host.boot();
  for (const unsigned index : {0x60C1U, 0x603FU, 0x605AU, 0x6063U, 0x608FU, 0x1006U, 0x1015U, 0x1029U}) {
    EXPECT_EQ(host.read_abort(index, 0), 0x06020000U) << std::hex << index;
    EXPECT_EQ(host.write(index, 0, 0, 4), 0x06020000U) << std::hex << index;
  }
  EXPECT_EQ(host.read_abort(0x1018, 5), 0x06090011U);
  EXPECT_EQ(host.write(0x60C4, 7, 0, 1), 0x06090011U);
}

}  // namespace
}  // namespace interpolated_motion::emulation
