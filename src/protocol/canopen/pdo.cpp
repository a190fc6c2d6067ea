#include "interpolated_motion_driver/protocol/canopen/pdo.h"

#include <fmt/format.h>

#include <stdexcept>

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"

namespace interpolated_motion::canopen {
namespace {

constexpr std::size_t kMaxEntries = 8;  ///< 0x1600:00 and 0x1A00:00 of EPOS2
constexpr unsigned kMaxBits = 64;

std::uint64_t low_bits(unsigned bits) {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

std::uint16_t communication_index(PdoDirection direction, int number) {
  return static_cast<std::uint16_t>((direction == PdoDirection::Rpdo ? 0x1400 : 0x1800) + number - 1);
}

std::uint16_t mapping_index(PdoDirection direction, int number) {
  return static_cast<std::uint16_t>((direction == PdoDirection::Rpdo ? 0x1600 : 0x1A00) + number - 1);
}

std::uint32_t predefined_cob_id(PdoDirection direction, int number, std::uint8_t node) {
  return direction == PdoDirection::Rpdo ? cob_id::rpdo(number, node) : cob_id::tpdo(number, node);
}

bool answers_remote_requests(std::uint8_t type) { return type == 252 || type == kRemoteRequest; }

void check_pdo(PdoDirection direction, int number, std::uint8_t node) {
  const char* name = direction == PdoDirection::Rpdo ? "RPDO" : "TPDO";
  if (!valid_node_id(node)) {
    throw std::invalid_argument(
        fmt::format("{} {}: node id {} is not in 1..{}", name, number, node, kMaxNodeId));
  }
  if (!valid_pdo_number(number)) {
    throw std::invalid_argument(
        fmt::format("{} {} of node {}: the number is not in 1..{}", name, number, node, kPdosOfNode));
  }
}

void check(const PdoConfiguration& c, std::uint8_t node) {
  check_pdo(c.direction, c.number, node);
  const std::string name =
      fmt::format("{} {} of node {}", c.direction == PdoDirection::Rpdo ? "RPDO" : "TPDO", c.number, node);
  if (c.mapping.entries.empty() || c.mapping.entries.size() > kMaxEntries) {
    throw std::invalid_argument(
        fmt::format("{}: {} mapped objects, allowed are 1..{}", name, c.mapping.entries.size(), kMaxEntries));
  }
  if (c.mapping.bits() > kMaxBits) {
    throw std::invalid_argument(
        fmt::format("{}: {} bits are mapped, allowed are 1..{}", name, c.mapping.bits(), kMaxBits));
  }
  if (c.cob_id && (*c.cob_id < 1 || *c.cob_id > 0x7FF)) {
    throw std::invalid_argument(fmt::format("{}: COB-ID 0x{:X} is not in 0x1..0x7FF", name, *c.cob_id));
  }
}

void append_mapping(std::vector<SdoWrite>& writes, const PdoConfiguration& c) {
  const std::uint16_t index = mapping_index(c.direction, c.number);
  const auto count = static_cast<std::uint8_t>(c.mapping.entries.size());
  writes.push_back(sdo_write<std::uint8_t>({index, 0}, 0));
  for (std::uint8_t i = 0; i < count; ++i) {
    writes.push_back(
        sdo_write<std::uint32_t>({index, static_cast<std::uint8_t>(i + 1)}, c.mapping.entries[i].value()));
  }
  writes.push_back(sdo_write<std::uint8_t>({index, 0}, count));
}

}  // namespace

unsigned PdoMapping::bits() const {
  unsigned sum = 0;
  for (const PdoEntry& entry : entries) sum += entry.bits;
  return sum;
}

std::optional<unsigned> PdoMapping::offset(ObjectAddress address) const {
  unsigned position = 0;
  for (const PdoEntry& entry : entries) {
    if (entry.address == address) return position;
    position += entry.bits;
  }
  return std::nullopt;
}

std::uint64_t get_field(const std::uint8_t* data, unsigned offset, unsigned bits) {
  return get_le<std::uint64_t>(data) >> offset & low_bits(bits);
}

void set_field(std::uint8_t* data, unsigned offset, unsigned bits, std::uint64_t value) {
  const std::uint64_t mask = low_bits(bits) << offset;
  put_le(data, (get_le<std::uint64_t>(data) & ~mask) | (value << offset & mask));
}

std::vector<SdoWrite> pdo_configuration(const PdoConfiguration& c, std::uint8_t node) {
  check(c, node);
  const std::uint16_t index = communication_index(c.direction, c.number);
  const bool transmit = c.direction == PdoDirection::Tpdo;
  std::uint32_t id = c.cob_id.value_or(predefined_cob_id(c.direction, c.number, node));
  if (transmit && !answers_remote_requests(c.transmission_type)) id |= kPdoNoRemote;

  std::vector<SdoWrite> writes{sdo_write<std::uint32_t>({index, 1}, id | kPdoInvalid)};
  append_mapping(writes, c);
  writes.push_back(sdo_write<std::uint8_t>({index, 2}, c.transmission_type));
  if (transmit && c.inhibit_time) writes.push_back(sdo_write<std::uint16_t>({index, 3}, *c.inhibit_time));
  if (transmit && c.event_time) writes.push_back(sdo_write<std::uint16_t>({index, 5}, *c.event_time));
  writes.push_back(sdo_write<std::uint32_t>({index, 1}, id));
  return writes;
}

SdoWrite pdo_disable(PdoDirection direction, int number, std::uint8_t node) {
  check_pdo(direction, number, node);
  std::uint32_t id = predefined_cob_id(direction, number, node) | kPdoInvalid;
  if (direction == PdoDirection::Tpdo) id |= kPdoNoRemote;
  return sdo_write<std::uint32_t>({communication_index(direction, number), 1}, id);
}

}  // namespace interpolated_motion::canopen
