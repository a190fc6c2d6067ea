#include "interpolated_motion_driver/axis/cia402/pdo_check.h"

#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace interpolated_motion::axis {

using canopen::SdoResult;

namespace {

constexpr std::uint16_t kFirstMapping = 0x1600;    // 0x1600.., 0x1A00..
constexpr std::uint16_t kMappingOfTpdos = 0x0200;  // bit of 0x1A00.. that 0x1800.. lacks

bool is_communication(canopen::ObjectAddress address) {
  return address.index < kFirstMapping || (address.index >= 0x1800 && (address.index & kMappingOfTpdos) == 0);
}

bool is_time(canopen::ObjectAddress address) { return is_communication(address) && address.subindex > 2; }

/// A drive may answer remote requests or not, whatever it is told.
std::uint64_t compared(canopen::ObjectAddress address, std::uint64_t value) {
  const bool is_cob_id = is_communication(address) && address.subindex == 1;
  return is_cob_id ? value & ~std::uint64_t{canopen::kPdoNoRemote} : value;
}

SdoSequence::Step expect(canopen::ObjectAddress address, std::uint64_t wanted) {
  return SdoSequence::read(address, [address, wanted](const SdoResult& r) -> std::optional<std::string> {
    if (!r.ok) return r.text();
    if (compared(address, r.as_u64()) == compared(address, wanted)) return std::nullopt;
    return fmt::format(
        "its PDOs have been changed since it was configured: object {} is 0x{:X}, it was set to 0x{:X}. "
        "Another program has written to the drive",
        canopen::to_string(address), r.as_u64(), wanted);
  });
}

}  // namespace

std::vector<SdoSequence::Step> pdo_check(const std::vector<canopen::PdoConfiguration>& wanted,
                                         std::uint8_t node) {
  std::map<canopen::ObjectAddress, std::uint64_t> last;  // what is written last is what must be there
  for (const canopen::PdoConfiguration& one : wanted)
    for (const canopen::SdoWrite& write : canopen::pdo_configuration(one, node))
      last[write.address] = write.value;
  std::vector<SdoSequence::Step> steps;
  for (const auto& [address, value] : last)
    if (!is_time(address)) steps.push_back(expect(address, value));
  return steps;
}

}  // namespace interpolated_motion::axis
