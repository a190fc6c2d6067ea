#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"

#include <algorithm>
#include <iterator>

namespace interpolated_motion::canopen {
namespace {

struct AbortText {
  std::uint32_t code;
  std::string_view text;
};

// CiA 301 table 22, then maxon's own codes. Ascending, for the search.
constexpr AbortText kTexts[] = {
    {0x05030000, "toggle bit not alternated"},
    {0x05040000, "SDO protocol timed out"},
    {0x05040001, "command specifier not valid or unknown"},
    {0x05040002, "block size not valid"},
    {0x05040003, "sequence number not valid"},
    {0x05040004, "CRC error"},
    {0x05040005, "out of memory"},
    {0x06010000, "unsupported access to the object"},
    {0x06010001, "object is write-only"},
    {0x06010002, "object is read-only"},
    {0x06010003, "sub-index 0 must be set to 0 before the entry is written"},
    {0x06020000, "object does not exist"},
    {0x06040041, "object cannot be mapped into a PDO"},
    {0x06040042, "mapped objects exceed the length of a PDO"},
    {0x06040043, "general parameter incompatibility"},
    {0x06040047, "general internal incompatibility in the device"},
    {0x06060000, "access failed because of a hardware error"},
    {0x06070010, "data type does not match, length does not match"},
    {0x06070012, "data type does not match, too long"},
    {0x06070013, "data type does not match, too short"},
    {0x06090011, "sub-index does not exist"},
    {0x06090030, "value out of range"},
    {0x06090031, "value too high"},
    {0x06090032, "value too low"},
    {0x06090036, "maximum is less than minimum"},
    {0x060A0023, "resource not available: SDO connection"},
    {0x08000000, "general error"},
    {0x08000020, "data cannot be transferred or stored"},
    {0x08000021, "data cannot be stored because of local control"},
    {0x08000022, "data cannot be stored in the present device state"},
    {0x08000023, "object dictionary not present or not generated"},
    {0x08000024, "no data available"},
    {0x0F00FFB9, "CAN identifier not valid"},
    {0x0F00FFBC, "device is not in service mode"},
    {0x0F00FFBE, "password incorrect"},
    {0x0F00FFBF, "command code is illegal, it does not exist"},
    {0x0F00FFC0, "device is in the wrong NMT state"},
};

}  // namespace

std::string_view describe_abort(std::uint32_t code) {
  const auto* found =
      std::lower_bound(std::begin(kTexts), std::end(kTexts), code,
                       [](const AbortText& entry, std::uint32_t c) { return entry.code < c; });
  return found != std::end(kTexts) && found->code == code ? found->text : "unknown abort code";
}

}  // namespace interpolated_motion::canopen
