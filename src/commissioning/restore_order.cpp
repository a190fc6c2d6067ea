#include <algorithm>
#include <cstdint>
#include <map>

#include "interpolated_motion_driver/commissioning/can_drive.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"

namespace interpolated_motion::commissioning {
namespace {

using canopen::ObjectAddress;
using Values = std::map<ObjectAddress, Parameter>;

/// CiA 301: communication parameters of RPDOs from 0x1400 and of TPDOs from 0x1800 on; their mappings are
/// 0x200 behind.
constexpr std::uint16_t kFirstPdo = 0x1400;
constexpr std::uint16_t kLastPdo = 0x1BFF;
constexpr std::uint16_t kMapping = 0x0200;

bool is_pdo(std::uint16_t index) { return index >= kFirstPdo && index <= kLastPdo; }

/// Index of the communication parameters of the PDO that an object belongs to.
std::uint16_t pdo_of(std::uint16_t index) { return static_cast<std::uint16_t>(index & ~kMapping); }

ObjectAddress address_of(const Parameter& parameter) {
  return find_object(parameter.number, nullptr).value().address;
}

Parameter with_value(Parameter parameter, std::uint64_t value) {
  parameter.value = std::to_string(value);
  return parameter;
}

/// All of one PDO, with its mapping, as CiA 301 wants it changed: invalid, unmapped, mapped anew, valid.
void add_pdo(std::uint16_t index, const Values& wanted, std::vector<Parameter>& order) {
  const auto mapping_index = static_cast<std::uint16_t>(index + kMapping);
  const auto cob_id = wanted.find({index, 1});
  const auto count = wanted.find({mapping_index, 0});
  const auto entries = [&](std::uint16_t of, std::uint8_t first) {
    for (auto next = wanted.lower_bound({of, first}); next != wanted.end() && next->first.index == of; ++next)
      order.push_back(next->second);
  };
  if (cob_id != wanted.end())
    order.push_back(with_value(cob_id->second, std::stoull(cob_id->second.value) | canopen::kPdoInvalid));
  if (count != wanted.end()) order.push_back(with_value(count->second, 0));
  entries(mapping_index, 1);
  if (count != wanted.end()) order.push_back(count->second);
  entries(index, 2);
  if (cob_id != wanted.end()) order.push_back(cob_id->second);
}

}  // namespace

std::vector<Parameter> restore_order(const std::vector<Parameter>& wanted,
                                     const std::vector<Change>& changes) {
  Values all;
  for (const Parameter& parameter : wanted) all[address_of(parameter)] = parameter;
  std::vector<Parameter> order;
  std::vector<std::uint16_t> done;
  for (const Change& change : changes) {
    const ObjectAddress address = address_of(change.before);
    if (!is_pdo(address.index)) {
      order.push_back(with_value(change.before, 0));
      order.back().value = change.after;
      continue;
    }
    const std::uint16_t pdo = pdo_of(address.index);
    if (std::find(done.begin(), done.end(), pdo) != done.end()) continue;
    done.push_back(pdo);
    add_pdo(pdo, all, order);
  }
  return order;
}

}  // namespace interpolated_motion::commissioning
