#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/axis/silverlode/segment_registers.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_parameters.h"
#include "interpolated_motion_driver/emulation/epos/epos_parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/interpolation/ims_profile.h"
#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/protocol/silverlode/line_parameters.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"
#include "interpolated_motion_driver/trajectory/goal.h"
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
  silverlode::LineParameters line;
  transport::SerialWiring wiring = transport::SerialWiring::Rs485TwoWire;  ///< of an emulated line
  LineStartKind start = LineStartKind::Addressed;
  double start_lead =
      0.15;  ///< s, and kLeadOfDrive more for each drive: from the start command to the motion
  double status_period = 0.05;  ///< s, between two looks at one drive in motion
};

/// A bus and its protocol. What only one protocol knows is without meaning for the other.
struct BusConfiguration {
  std::string name;
  BusType type = BusType::Canopen;
  TransportKind transport = TransportKind::Emulated;
  SocketcanConfiguration socketcan;
  SerialPortConfiguration port;
  SerialLineConfiguration serial;
  std::uint32_t bitrate = 1'000'000;  ///< bit/s
  double sync_period = 0.010;         ///< s, period of the SYNC object and so of position feedback
  double heartbeat_period = 0.1;      ///< s, of the host's and the drives' heartbeats
  double heartbeat_timeout = 0.5;     ///< s without a heartbeat until the other side counts as lost
  double feedback_timeout = 0.5;      ///< s without a position from a drive in motion until the motion ends
  int host_node_id = 127;             ///< CANopen node id of this host
  double max_load = 0.6;              ///< share of the bit rate that motion records may fill, 0..1
  double sdo_timeout = 0.2;           ///< s
  bool clock_discipline = true;       ///< the drives set their clocks by the host's (EPOS2: SYNC and 0x1013)

  /// There are cyclic drives on the bus: SYNC is their time base. Follows from the drives, is no parameter.
  bool isochronous = false;

  /// Every so many SYNCs are followed by a time stamp: as often as possible, yet not more often than each
  /// 10 ms, in which a drive 100 ppm off gets away by 1 us; 0: never.
  int time_stamp_period() const;
};

/// What the emulated drive of a joint does differently from a perfect one.
struct EmulationConfiguration {
  bool missing = false;             ///< there is no such drive on the bus
  emulation::EposParameters drive;  ///< position in counts, whatever the joint's units
};

/// Which interpolator of which drive plays the motion.
enum class DriveType { EposIpm, SilverlodeIms, Cyclic };

/// What only SilverLode drives have.
struct SilverlodeConfiguration {
  int address = 0;  ///< 1..254
  interpolation::ImsScale scale;
  silverlode::DriveScale command_scale;
  std::string ims_arguments = "0 0";  ///< of IMS
  axis::SegmentQueue queue = axis::SegmentQueue::Fifo;
  int queue_depth = 0;  ///< segments of the FIFO; 0: measured at bring-up
  axis::SegmentRegisters segment_registers;
  emulation::SilverDustParameters emulated;
};

/// What only drives in the cyclic synchronous position mode have.
struct CyclicConfiguration {
  int interpolation_order = 3;     ///< of the drive's fine interpolation, 1..3
  double servo_period = 1e-3;      ///< s, between the samples of the fine interpolation
  double velocity_unit = 1.0;      ///< counts/s in one unit of 0x606C
  double acceleration_unit = 1.0;  ///< counts/s^2 in one unit of 0x6084 and 0x6085
  emulation::CyclicParameters emulated;
};

/// A joint's drive. What only one type of drive knows is without meaning for the others.
struct DriveConfiguration {
  std::string joint;
  std::string bus;
  DriveType type = DriveType::EposIpm;
  int node_id = 0;  ///< 1..127, on CANopen
  SilverlodeConfiguration silverlode;
  CyclicConfiguration cyclic;
  encoding::Transmission transmission;
  trajectory::JointLimits limits;  ///< URDF limits, tightened by the configuration
  double deviation_bound = 1.0;    ///< counts, worst deviation from the path at any drive sample
  /// counts, the same where the path is still being made; without meaning for cyclic drives
  double stream_deviation_bound = 8.0;
  double max_following_error = 0.1;  ///< rad, written to 0x6065
  double limit_margin = 1.2;  ///< 1..10; drive-side fault limits (0x607F, 0x60C5) = joint limits times this
  EmulationConfiguration emulation;
};

/// Supervision of goals, named and meant as by joint_trajectory_controller.
struct ConstraintConfiguration {
  struct Joint {
    double trajectory = 0.0;  ///< rad, path tolerance; 0: none
    double goal = 0.0;        ///< rad, goal tolerance; 0: none
  };
  double goal_time = 0.0;                    ///< s
  double stopped_velocity_tolerance = 0.01;  ///< rad/s
  std::map<std::string, Joint> joints;
};

struct Configuration {
  std::vector<std::string> joints;  ///< names and order of every published array
  std::vector<BusConfiguration> buses;
  std::vector<DriveConfiguration> drives;  ///< in the order of `joints`
  ConstraintConfiguration constraints;
  double stop_trajectory_duration = 0.0;
  bool allow_partial_joints_goal = false;
  double start_tolerance = 0.05;  ///< rad, of a goal's first point at t = 0 against the present position
  double commit_horizon = 2.0;    ///< s of motion kept in the drives' FIFOs
  double bring_up_timeout = 5.0;  ///< s for all drives to answer and be configured
  double settle_timeout = 0.5;    ///< s after the last record for the joints to settle, when goal_time is 0
  bool enable_on_start = true;
  motion::StreamParameters setpoints;
};

/// Reads the driver's part of the node's parameters (`joints`, `buses`, `drives`, `constraints`, ...).
/// `node_keys` are further top-level keys that the node itself reads. `urdf` holds limits by joint name;
/// joints that are not in it, or limits wider than the URDF's, are refused, as are unknown keys, wrong types
/// and values out of range: throws std::invalid_argument whose text names the parameter, the value, the
/// allowed range and what to do.
Configuration parse_configuration(const YAML::Node& parameters,
                                  const std::map<std::string, trajectory::JointLimits>& urdf,
                                  const std::vector<std::string>& node_keys = {});

}  // namespace interpolated_motion::hardware
