#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/commissioning/can_session.h"
#include "interpolated_motion_driver/commissioning/progress.h"
#include "interpolated_motion_driver/protocol/canopen/nmt.h"
#include "interpolated_motion_driver/protocol/cia402/identity.h"

namespace interpolated_motion::commissioning {

/// What a node says it is. Empty is what it does not tell.
struct CanDevice {
  std::uint8_t node = 0;                     ///< 1..127
  std::optional<std::uint32_t> device_type;  ///< 0x1000
  cia402::Identity identity;                 ///< 0x1018
  std::string name;                          ///< 0x1008
  std::string hardware;                      ///< 0x1009
  std::string software;                      ///< 0x100A
  std::optional<std::uint32_t> modes;        ///< 0x6502
  std::optional<std::uint16_t> statusword;   ///< 0x6041
  std::optional<std::uint8_t> errors;        ///< 0x1001
  std::optional<std::uint32_t> fifo;         ///< 0x60C4:01, records
  std::optional<std::uint16_t> fifo_status;  ///< 0x20C4:01
  std::optional<canopen::NodeState> state;   ///< of its heartbeat, where it sends one
  bool twice = false;                        ///< two devices answer under this node id
};

struct CanScan {
  std::vector<CanDevice> devices;  ///< that have answered, by node id
  std::vector<std::uint8_t>
      mute;                  ///< node ids heard that answer no SDO: a master's heartbeat, a stopped node
  std::string other_master;  ///< what it sends; empty where there is none
  bool asked = true;         ///< false: nobody was asked, because of the other master
};

/// How long a bus is listened to before anybody is asked: heartbeats come several times a second, and a
/// driver that waits for its drives asks each once a second.
inline constexpr HostDuration kListen = std::chrono::milliseconds(1500);

/// Listens, then asks all node ids who they are: reads only. On a bus with another master nobody is asked
/// unless `beside_master`: a drive has one SDO channel, and the transfers of two masters spoil each other.
CanScan scan_can(CanSession& session, bool beside_master, const Progress& progress = {});

/// Why this driver cannot use a device, in a sentence; empty when it can, as `drive_type` says.
std::string why_unusable(const CanDevice& device);
/// `type` of a drive in the configuration of the driver: "epos_ipm", "cyclic"; empty for one it cannot use.
std::string drive_type(const CanDevice& device);

/// A device in some lines, as `drive_tool scan` shows it.
std::string to_text(const CanDevice& device);
/// Sentences on the bus as a whole: another master, mute nodes.
std::vector<std::string> remarks(const CanScan& scan);

}  // namespace interpolated_motion::commissioning
