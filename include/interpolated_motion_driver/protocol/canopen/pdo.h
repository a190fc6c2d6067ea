#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/object.h"

namespace interpolated_motion::canopen {

/// One object in a PDO (CiA 301, 7.5.2.36).
struct PdoEntry {
  ObjectAddress address;  ///< must be mappable in the drive
  std::uint8_t bits = 0;  ///< 1..64

  /// As it stands in 0x1600.. and 0x1A00..: 0x20C10040.
  constexpr std::uint32_t value() const {
    return static_cast<std::uint32_t>(address.index) << 16 |
           static_cast<std::uint32_t>(address.subindex) << 8 | bits;
  }
};

/// The same object and the same number of bits.
inline constexpr bool operator==(const PdoEntry& a, const PdoEntry& b) { return a.value() == b.value(); }

/// The objects in one PDO, in the order of the data bytes; 64 bits together at most.
struct PdoMapping {
  std::vector<PdoEntry> entries;  ///< 1..8 in a PDO that is to be set up

  /// Sum of the entries, 0..64 in a valid mapping.
  unsigned bits() const;
  /// Length of the PDO in bytes.
  std::uint8_t length() const { return static_cast<std::uint8_t>((bits() + 7) / 8); }
  /// Bit at which the object begins, counted from bit 0 of byte 0; empty when it is not mapped.
  std::optional<unsigned> offset(ObjectAddress address) const;
};

/// Bits `offset` .. `offset + bits - 1` of a PDO of 8 bytes, least significant first; `bits` 1..64.
std::uint64_t get_field(const std::uint8_t* data, unsigned offset, unsigned bits);
/// Sets those bits to the lowest `bits` of `value`; the others stay.
void set_field(std::uint8_t* data, unsigned offset, unsigned bits, std::uint64_t value);

enum class PdoDirection {
  Rpdo,  ///< host to drive: 0x1400.., 0x1600..
  Tpdo,  ///< drive to host: 0x1800.., 0x1A00..
};

/// Transmission types (CiA 301, 7.5.2.35): 1..240 means every n-th SYNC.
inline constexpr std::uint8_t kSynchronous = 1;
inline constexpr std::uint8_t kRemoteRequest = 253;
inline constexpr std::uint8_t kEventDriven = 255;

/// Bits of a PDO's COB-ID entry (CiA 301, 7.5.2.35).
inline constexpr std::uint32_t kPdoInvalid = 0x80000000;
inline constexpr std::uint32_t kPdoNoRemote = 0x40000000;

/// How one PDO of a drive is to be set up.
struct PdoConfiguration {
  PdoDirection direction = PdoDirection::Rpdo;    ///< as the drive sees it
  int number = 1;                                 ///< 1..4
  PdoMapping mapping;                             ///< of 64 bits at most
  std::uint8_t transmission_type = kEventDriven;  ///< 0..240 by SYNC, 252..253 on request, 254..255 event
  /// Shortest pause between two TPDOs, in 100 us; not written when empty. RPDOs have none.
  std::optional<std::uint16_t> inhibit_time;
  /// TPDO at the latest after so many ms; not written when empty. EPOS2 has no such object (sub-index 5).
  std::optional<std::uint16_t> event_time;
  /// Identifier other than that of the predefined connection set, e.g. one for the time stamps of all drives.
  std::optional<std::uint32_t> cob_id;
};

/// The SDO writes, in the order a drive demands: COB-ID invalid, mapping emptied, objects, their number,
/// transmission type, times, COB-ID valid. TPDOs are marked "no remote request" unless their type is 252 or
/// 253. To be written in Pre-operational. Throws std::invalid_argument when `number`, the node id, the
/// COB-ID, the number of entries (1..8) or the size of the mapping (64 bits) is out of range.
std::vector<SdoWrite> pdo_configuration(const PdoConfiguration& configuration, std::uint8_t node);

/// The write that turns a PDO off.
SdoWrite pdo_disable(PdoDirection direction, int number, std::uint8_t node);

}  // namespace interpolated_motion::canopen
