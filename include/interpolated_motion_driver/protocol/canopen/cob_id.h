#pragma once

#include <cstdint>
#include <string>

namespace interpolated_motion::canopen {

/// Node ids are 1..127 (CiA 301, 7.3.2.2.1); 0 addresses all nodes in an NMT command.
inline constexpr std::uint8_t kMaxNodeId = 127;
inline constexpr std::uint8_t kAllNodes = 0;

/// PDOs of the predefined connection set: 1..4 of each direction.
inline constexpr int kPdosOfNode = 4;

/// Whether a number is one of those, a drive's node id or PDO.
inline constexpr bool valid_node_id(unsigned node) { return node >= 1 && node <= kMaxNodeId; }
inline constexpr bool valid_pdo_number(int n) { return n >= 1 && n <= kPdosOfNode; }

/// Identifiers of the predefined connection set (CiA 301, 7.3.5). A lower identifier wins the bus, so a flood
/// of RPDOs starves SDO and heartbeat. Directions are named as the drive sees them: a TPDO comes from the
/// drive, an RPDO goes to it.
namespace cob_id {

inline constexpr std::uint32_t kNmt = 0x000;          ///< commands of the master
inline constexpr std::uint32_t kSync = 0x080;         ///< start of a cycle, from one producer
inline constexpr std::uint32_t kTime = 0x100;         ///< time of day; not sent by this driver
inline constexpr std::uint32_t kLssResponse = 0x7E4;  ///< layer setting services (CiA 305), of a drive
inline constexpr std::uint32_t kLssRequest = 0x7E5;   ///< layer setting services (CiA 305), of the master

/// The services of `node`, 1..127.
inline constexpr std::uint32_t emcy(std::uint8_t node) { return 0x080u + node; }
/// TPDO `n`, 1..4.
inline constexpr std::uint32_t tpdo(int n, std::uint8_t node) {
  return 0x080u + 0x100u * static_cast<std::uint32_t>(n) + node;
}
/// RPDO `n`, 1..4.
inline constexpr std::uint32_t rpdo(int n, std::uint8_t node) {
  return 0x100u + 0x100u * static_cast<std::uint32_t>(n) + node;
}
inline constexpr std::uint32_t sdo_response(std::uint8_t node) { return 0x580u + node; }
inline constexpr std::uint32_t sdo_request(std::uint8_t node) { return 0x600u + node; }
/// High resolution time stamps of the master with node id `host`, one identifier for all drives of a bus:
/// that of the RPDO 3 the master itself would have. Node ids are unique, so no drive's PDO has it.
inline constexpr std::uint32_t time_stamp(std::uint8_t host) { return rpdo(3, host); }
inline constexpr std::uint32_t heartbeat(std::uint8_t node) { return 0x700u + node; }

}  // namespace cob_id

/// What an identifier is used for in the predefined connection set.
enum class Service {
  Nmt,
  Sync,
  Emcy,
  Time,
  Tpdo,
  Rpdo,
  SdoResponse,
  SdoRequest,
  Heartbeat,  ///< heartbeat, boot-up and node guarding share it
  Lss,
  Unknown,
};

/// An 11-bit identifier taken apart.
struct CobIdMeaning {
  Service service = Service::Unknown;  ///< `Unknown` for an identifier that is free
  std::uint8_t node = 0;               ///< 1..127, or 0 for a service without a node
  int pdo = 0;                         ///< 1..4 for Tpdo and Rpdo, else 0
};

/// Meaning of any 11-bit identifier; `Unknown` for those the predefined connection set leaves free.
CobIdMeaning classify(std::uint32_t id);

/// "TPDO 2 of node 3", "SYNC", "unknown COB-ID 0x781".
std::string describe_cob_id(std::uint32_t id);

}  // namespace interpolated_motion::canopen
