#pragma once

#include <array>
#include <cstdint>

namespace interpolated_motion::emulation {

/// NMT state as a heartbeat carries it (CiA 301).
enum class NmtState : std::uint8_t {
  BootUp = 0x00,
  Stopped = 0x04,
  Operational = 0x05,
  PreOperational = 0x7F
};

/// What an NMT command asks of the drive beyond a change of state.
enum class NmtAction { None, Entered, ResetNode, ResetCommunication };

/// NMT state machine of a slave, its heartbeat, node guarding and the watch over other nodes' heartbeats.
/// Time is the drive's own millisecond count.
class NmtSlave {
 public:
  static constexpr int kConsumers = 2;  ///< entries of 0x1016, as EPOS2's EDS has them

  /// PDOs are exchanged in Operational only, SDO is served in Pre-operational too, and in Stopped nothing is
  /// left but NMT and heartbeat. Before boot() nothing is: not communicating.
  NmtState state() const { return state_; }
  bool operational() const { return state_ == NmtState::Operational; }
  bool communicating() const { return state_ != NmtState::BootUp; }
  bool serves_sdo() const { return state_ == NmtState::PreOperational || operational(); }

  /// Initialisation begins: nothing is sent or heard until boot().
  void restart();

  /// Initialisation ends: Pre-operational. The caller sends the boot-up message.
  void boot() { state_ = NmtState::PreOperational; }

  /// Handles a command specifier addressed to this node. Entered: the state has changed.
  NmtAction command(std::uint8_t specifier);
  /// The drive leaves Operational by itself.
  void enter_pre_operational() { state_ = NmtState::PreOperational; }

  /// 0x1017, ms; 0 = no heartbeat. The first one is due at once.
  void set_producer_time(std::uint16_t ms, std::int64_t now_ms);

  /// True when a heartbeat is due at `now_ms`.
  bool heartbeat_due(std::int64_t now_ms);

  /// 0x1016:1 (consumer 0) or :2, node << 16 | ms. Watching begins with that node's first heartbeat.
  void set_consumer(int consumer, std::uint32_t value);

  /// A heartbeat of `node` has been seen. True when that node had been lost.
  bool on_heartbeat(std::uint8_t node, std::int64_t now_ms);

  /// 0x100C times 0x100D, ms; 0 = no life guarding. It begins with the first guarding request.
  void set_life_time(std::int64_t ms) { life_ms_ = ms; }

  /// Answer to a guarding request: toggle bit and state.
  std::uint8_t guard(std::int64_t now_ms);

  /// True once for each loss of a watched heartbeat or of life guarding.
  bool connection_lost(std::int64_t now_ms);

 private:
  struct Consumer {
    std::uint8_t node = 0;     ///< whose heartbeat; 0: nobody's
    std::int64_t time_ms = 0;  ///< longest pause between two heartbeats; 0: not watched
    std::int64_t last_ms = 0;  ///< when the last one came, own clock
    bool watching = false;     ///< one has come, and none has failed to come since
    bool lost = false;         ///< said once by connection_lost(), until the next heartbeat
  };

  NmtState state_ = NmtState::BootUp;
  std::int64_t producer_ms_ = 0;
  std::int64_t next_heartbeat_ms_ = 0;
  std::array<Consumer, kConsumers> consumers_{};
  std::int64_t life_ms_ = 0;
  std::int64_t last_guard_ms_ = 0;
  bool guarded_ = false;
  bool toggle_ = false;
};

}  // namespace interpolated_motion::emulation
