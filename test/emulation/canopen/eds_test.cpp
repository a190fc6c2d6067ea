#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <string>

#include "eds_objects.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_object_table.h"
#include "interpolated_motion_driver/emulation/epos/epos_object_table.h"
#include "wire_host.h"

namespace interpolated_motion::emulation {
namespace {

template <class Parameters>
std::unique_ptr<WireHost> host_of(std::uint8_t node_id) {
  Parameters parameters;
  parameters.node_id = node_id;
  auto host = std::make_unique<WireHost>(parameters);
  host->boot();
  return host;
}

struct Kind {
  const char* name;
  const char* file;  ///< of config/eds
  ObjectTable table;
  std::unique_ptr<WireHost> (*host)(std::uint8_t node_id);
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

std::string text_of(const std::map<std::string, std::string>& eds, const std::string& key) {
  const auto found = eds.find(key);
  return found == eds.end() ? std::string() : found->second;
}

/// An emulated drive and the EDS file that describes it.
class Eds : public testing::TestWithParam<Kind> {
 protected:
  const ObjectTable& table() const { return GetParam().table; }

  const EdsFile file = read_eds(std::string(IMD_SOURCE_DIR) + "/config/eds/" + GetParam().file);
};

TEST_P(Eds, EachObjectIsInTheEmulatorAsStated) {
  const auto objects = objects_of(file);
  ASSERT_GT(objects.size(), 100U);
  for (const auto& [key, eds] : objects) {
    SCOPED_TRACE(testing::Message() << std::hex << key.first << ":" << key.second);
    const std::size_t slot =
        table().slot(static_cast<std::uint16_t>(key.first), static_cast<std::uint8_t>(key.second));
    ASSERT_LT(slot, table().size);
    const ObjectEntry& entry = table().rows[slot];
    const auto type = static_cast<unsigned>(std::stoul(eds.at("datatype"), nullptr, 0));
    EXPECT_EQ(static_cast<unsigned>(entry.type), type);
    EXPECT_EQ(access_text(entry.access), eds.at("accesstype"));
    EXPECT_EQ(entry.mappable, eds.at("pdomapping") == "1");
    EXPECT_EQ(entry.has_default, eds.count("defaultvalue") == 1);
    EXPECT_EQ(entry.plus_node_id, text_of(eds, "defaultvalue").find("$nodeid") == 0);
    EXPECT_EQ(entry.initial, number(text_of(eds, "defaultvalue"), type));
    EXPECT_EQ(entry.has_range, eds.count("lowlimit") == 1);
    if (!entry.has_range) continue;
    EXPECT_EQ(entry.low, number(eds.at("lowlimit"), type));
    EXPECT_EQ(entry.high, number(eds.at("highlimit"), type));
  }
}

// CiA 306: what is not known is left out, and an INTEGER is written with its sign. Programs that read the
// file read 0xFFFF as 65535, and refuse it for a number of 16 bits.
TEST_P(Eds, NumbersAreWrittenWithinTheirTypes) {
  for (const auto& [object, eds] : objects_of(file)) {
    const auto type = static_cast<unsigned>(std::stoul(eds.at("datatype"), nullptr, 0));
    const int bits = bits_of(type);
    for (const char* key : {"defaultvalue", "lowlimit", "highlimit"}) {
      SCOPED_TRACE(testing::Message() << std::hex << object.first << ":" << object.second << " " << key);
      if (eds.count(key) == 0) continue;
      std::string text = eds.at(key);
      ASSERT_FALSE(text.empty());
      if (bits == 0) continue;
      if (text.rfind("$nodeid+", 0) == 0) text = text.substr(8);
      std::size_t read = 0;
      const double value = static_cast<double>(std::stoll(text, &read, 0));
      EXPECT_EQ(read, text.size());
      const bool is_signed = type <= 4;
      EXPECT_GE(value, is_signed ? -std::ldexp(1.0, bits - 1) : 0.0);
      EXPECT_LT(value, std::ldexp(1.0, is_signed ? bits - 1 : bits));
    }
  }
}

TEST_P(Eds, EachObjectOfTheEmulatorIsStated) {
  const auto objects = objects_of(file);
  Key previous{0, 0};
  for (std::size_t slot = 0; slot < table().size; ++slot) {
    const Key key{table().rows[slot].index, table().rows[slot].subindex};
    EXPECT_EQ(objects.count(key), 1U) << std::hex << key.first << ":" << key.second;
    EXPECT_LT(previous, key) << "the table is searched by halves";
    previous = key;
  }
  EXPECT_EQ(objects.size(), table().size);
}

TEST_P(Eds, ObjectListsNameEachIndexOnce) {
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

// What the EDS says of reading is what the wire says, on a node id that shows whether $NODEID is added.
TEST_P(Eds, DefaultsAndReadAccessHoldAtTheWire) {
  const auto host = GetParam().host(23);
  for (const auto& [key, eds] : objects_of(file)) {
    SCOPED_TRACE(testing::Message() << std::hex << key.first << ":" << key.second);
    const auto type = static_cast<unsigned>(std::stoul(eds.at("datatype"), nullptr, 0));
    if (eds.at("accesstype") == "wo") {
      EXPECT_EQ(host->read_abort(key.first, key.second), 0x06010001U);
      continue;
    }
    if (bits_of(type) == 0) continue;
    const Bytes r = host->exchange({0x40, key.first & 0xFF, key.first >> 8, key.second});
    ASSERT_EQ(r.size(), 8U);
    ASSERT_EQ(8 * (4 - ((r[0] >> 2) & 3)), bits_of(type));
    if (eds.count("defaultvalue") == 0) continue;
    const bool of_node = eds.at("defaultvalue").find("$nodeid") == 0;
    const std::int64_t expected = number(eds.at("defaultvalue"), type) + (of_node ? 23 : 0);
    const std::uint32_t mask = 0xFFFFFFFFU >> (32 - bits_of(type));
    EXPECT_EQ(WireHost::word(r, 4) & mask, static_cast<std::uint32_t>(expected) & mask);
  }
}

TEST_P(Eds, WriteAccessLengthAndRangeHoldAtTheWire) {
  const auto host = GetParam().host(1);
  for (const auto& [key, eds] : objects_of(file)) {
    SCOPED_TRACE(testing::Message() << std::hex << key.first << ":" << key.second);
    const auto type = static_cast<unsigned>(std::stoul(eds.at("datatype"), nullptr, 0));
    const int bytes = bits_of(type) / 8;
    const std::string& access = eds.at("accesstype");
    if (access == "ro" || access == "const") {
      EXPECT_EQ(host->write(key.first, key.second, 0, 4), 0x06010002U);
      continue;
    }
    const auto size = static_cast<unsigned>(bytes);
    if (bytes < 4) {
      EXPECT_EQ(host->write(key.first, key.second, 0, size + 1), 0x06070012U);
    }
    if (bytes > 1 && bytes <= 4) {
      EXPECT_EQ(host->write(key.first, key.second, 0, size - 1), 0x06070013U);
    }
    if (eds.count("lowlimit") == 0 || bytes > 4) continue;
    const std::int64_t low = number(eds.at("lowlimit"), type);
    const std::int64_t high = number(eds.at("highlimit"), type);
    const std::int64_t top =
        type <= 4 ? (std::int64_t{1} << (8 * bytes - 1)) - 1 : (std::int64_t{1} << (8 * bytes)) - 1;
    if (high < top) {
      EXPECT_EQ(host->write(key.first, key.second, high + 1, size), 0x06090031U);
    }
    if (type <= 4 || low > 0) {
      EXPECT_EQ(host->write(key.first, key.second, low - 1, size), 0x06090032U);
    }
  }
}

TEST(EposEds, ObjectsThatEpos2DoesNotHaveAreRefused) {
  WireHost host;
  host.boot();
  for (const unsigned index : {0x60C1U, 0x603FU, 0x605AU, 0x6063U, 0x608FU, 0x1006U, 0x1015U, 0x1029U}) {
    EXPECT_EQ(host.read_abort(index, 0), 0x06020000U) << std::hex << index;
    EXPECT_EQ(host.write(index, 0, 0, 4), 0x06020000U) << std::hex << index;
  }
  EXPECT_EQ(host.read_abort(0x1018, 5), 0x06090011U);
  EXPECT_EQ(host.write(0x60C4, 7, 0, 1), 0x06090011U);
}

INSTANTIATE_TEST_SUITE_P(Drives, Eds,
                         testing::Values(Kind{"epos",
                                              "epos2_emulated.eds",
                                              {kEposObjects.data(), kEposObjects.size()},
                                              host_of<EposParameters>},
                                         Kind{"cyclic", "cyclic_emulated.eds", kCyclicTable,
                                              host_of<CyclicParameters>}),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace interpolated_motion::emulation
