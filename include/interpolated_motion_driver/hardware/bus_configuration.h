#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/hardware/parameter_reader.h"
#include "interpolated_motion_driver/protocol/silverlode/line_parameters.h"
#include "interpolated_motion_driver/transport/virtual_serial_line.h"

namespace interpolated_motion::hardware {

/// Where the drives of a bus are.
enum class TransportKind {
  Emulated,   ///< within the process
  Socketcan,  ///< behind a CAN interface of the kernel
  Serial,     ///< behind a serial port
};

/// The protocol of a bus.
enum class BusType { Canopen, Silverlode };

/// What tells the drives of a bus apart.
struct DriveNumbers {
  const char* key;    ///< as the configuration calls it: "node_id"
  const char* noun;   ///< in a sentence: "a node id"
  const char* nouns;  ///< "node ids"
  int highest;        ///< the lowest is 1
};

/// Node ids on CANopen, addresses on a SilverLode line.
const DriveNumbers& drive_numbers(BusType type);

/// As the configuration calls it: "canopen".
const char* name_of(BusType type);

/// The CAN interface of a bus with transport `socketcan`.
struct SocketcanConfiguration {
  std::string interface;     ///< "can0"
  bool receive_all = false;  ///< frames of nodes that are not configured too, for the wire log and the load
};

/// The serial port of a bus with transport `serial`.
struct SerialPortConfiguration {
  std::string device;       ///< "/dev/ttyUSB0"
  bool low_latency = true;  ///< pass characters on at once, where the adapter can
  bool rs485 = false;       ///< let the UART switch the direction by RTS
};

/// How the drives of a serial line are started.
enum class LineStartKind {
  Addressed,  ///< each by a command of its own
  Global,     ///< all by one command to the global address
};

/// What only serial lines have.
struct SerialLineConfiguration {
  silverlode::LineParameters line;  ///< bits, pauses and patience of the line
  transport::SerialWiring wiring = transport::SerialWiring::Rs485TwoWire;  ///< of an emulated line
  LineStartKind start = LineStartKind::Addressed;                          ///< of interpolated motion
  double start_lead =
      0.15;  ///< s, and kLeadOfDrive more for each drive: from the start command to the motion
  double status_period = 0.05;  ///< s, between two looks at one drive in motion
};

/// A bus and its protocol. What only one protocol knows is without meaning for the other.
struct BusConfiguration {
  std::string name;                 ///< its key under `buses`
  BusType type = BusType::Canopen;  ///< decides which kinds of drives it can have
  /// Socketcan for CANopen only, Serial for SilverLode only.
  TransportKind transport = TransportKind::Emulated;
  SocketcanConfiguration socketcan;   ///< of transport Socketcan
  SerialPortConfiguration port;       ///< of transport Serial
  SerialLineConfiguration serial;     ///< of type Silverlode, emulated or not
  std::uint32_t bitrate = 1'000'000;  ///< bit/s
  double sync_period = 0.010;         ///< s, period of the SYNC object and so of position feedback
  double sync_tolerance = 0.0005;     ///< s, later a SYNC is left out that is the time base of drives
  double heartbeat_period = 0.1;      ///< s, of the host's and the drives' heartbeats
  double heartbeat_timeout = 0.5;     ///< s without a heartbeat until the other side counts as lost
  double watch_at_rest = 0.0;         ///< s, the same of an EPOS at rest; 0: never
  double feedback_timeout = 0.5;      ///< s without a position from a drive in motion until the motion ends
  int host_node_id = 127;             ///< CANopen node id of this host
  double max_load = 0.6;              ///< share of the bit rate that motion records may fill, 0..1
  double sdo_timeout = 0.2;           ///< s
  double listen_before_start = 0.2;   ///< s without another master before this host talks to the drives
  bool refuse_other_masters = true;   ///< another master on the bus is a fault
  bool clock_discipline = true;       ///< the drives set their clocks by the host's (EPOS2: SYNC and 0x1013)

  /// There are drives on the bus whose time base is SYNC. Follows from the drives, is no parameter.
  bool isochronous = false;

  /// Every so many SYNCs are followed by a time stamp: as often as possible, yet not more often than each
  /// 10 ms, in which a drive 100 ppm off gets away by 1 us; 0: never.
  int time_stamp_period() const;
};

/// Reads `buses/<name>`. Throws like ParameterReader.
BusConfiguration parse_bus(const std::string& name, ParameterReader reader);

/// The rates that a SilverLode line and a CANopen bus can have, bit/s.
std::vector<std::uint32_t> serial_rates();
std::vector<std::uint32_t> can_rates();

}  // namespace interpolated_motion::hardware
