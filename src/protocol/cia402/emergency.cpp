#include "interpolated_motion_driver/protocol/cia402/emergency.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace interpolated_motion::cia402 {
namespace {

struct EmergencyText {
  std::uint16_t code;
  std::string_view text;
};

// Codes of EPOS2, ascending for the search.
constexpr EmergencyText kTexts[] = {
    {0x0000, "no error, or error reset"},
    {0x1000, "generic error"},
    {0x2310, "over-current error"},
    {0x3210, "over-voltage error"},
    {0x3220, "under-voltage error"},
    {0x4210, "over-temperature error"},
    {0x5113, "supply voltage (+5 V) too low"},
    {0x5114, "supply voltage of the output stage too low"},
    {0x6100, "internal software error"},
    {0x6320, "software parameter error"},
    {0x7320, "sensor position error"},
    {0x8110, "CAN overrun error, objects lost"},
    {0x8111, "CAN overrun error"},
    {0x8120, "CAN passive mode error"},
    {0x8130, "CAN life guard or heartbeat error"},
    {0x8150, "CAN transmit COB-ID collision"},
    {0x81FD, "CAN bus off"},
    {0x81FE, "CAN receive queue overrun"},
    {0x81FF, "CAN transmit queue overrun"},
    {0x8210, "CAN PDO length error"},
    {0x8611, "following error"},
    {0xFF01, "Hall sensor error"},
    {0xFF02, "index processing error"},
    {0xFF03, "encoder resolution error"},
    {0xFF04, "Hall sensor not found"},
    {0xFF06, "negative limit switch error"},
    {0xFF07, "positive limit switch error"},
    {0xFF08, "Hall angle detection error"},
    {0xFF09, "software position limit error"},
    {0xFF0A, "position sensor breach"},
    {0xFF0B, "system overloaded"},
    {0xFF0C, "interpolated position mode error"},
    {0xFF0D, "auto-tuning identification error"},
    {0xFF0F, "gear scaling factor error"},
    {0xFF10, "controller gain error"},
    {0xFF11, "main sensor direction error"},
    {0xFF12, "auxiliary sensor direction error"},
};

// CiA 301, table 40 (object 0x1001); bit 7 is the manufacturer's, for maxon it is "motion".
constexpr const char* kRegisterBits[8] = {"generic",       "current",        "voltage",  "temperature",
                                          "communication", "device profile", "reserved", "motion"};

}  // namespace

std::string_view describe_emergency(std::uint16_t code) {
  const auto* found =
      std::lower_bound(std::begin(kTexts), std::end(kTexts), code,
                       [](const EmergencyText& entry, std::uint16_t c) { return entry.code < c; });
  return found != std::end(kTexts) && found->code == code ? found->text : "unknown error";
}

std::string error_register_text(std::uint8_t error_register) {
  std::string text;
  for (unsigned bit = 0; bit < 8; ++bit) {
    if ((error_register >> bit & 1u) == 0) continue;
    if (!text.empty()) text += ", ";
    text += kRegisterBits[bit];
  }
  return text.empty() ? "none" : text;
}

std::string emergency_text(const canopen::Emcy& emcy) {
  return fmt::format("EMCY 0x{:04X} {} (error register 0x{:02X}: {})", emcy.code,
                     describe_emergency(emcy.code), emcy.error_register,
                     error_register_text(emcy.error_register));
}

}  // namespace interpolated_motion::cia402
