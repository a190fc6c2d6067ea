#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/silverlode/segment_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/segment_registers.h"

namespace interpolated_motion::axis {

/// Segments through user registers of the drive (QCI-TD044, "Registers Used with Interpolated Motion"). Each
/// is written into a block of four registers with WRI; then one WRI to register 17 hands the block over: its
/// first register in the low word, 0 in the high word. The drive copies the block when the segment before it
/// is over, and sets the high word to 1. Blocks are used in turn, so that further segments are filled in
/// while one waits; with a single block each is written within the time of the one before it.
///
/// A block is handed over when the drive must have taken the one before it, by the model of its clock: else
/// that one would be skipped. It is filled again when the drive must have copied it. Writes may be repeated
/// as often as replies are lost, but for register 17: once the drive has taken a block, the same write would
/// make it play that block twice. So it is repeated only while the drive cannot have come that far; after
/// that register 17 itself is asked.
class RegisterDelivery : public SegmentDelivery {
 public:
  /// `registers` as refuse_segment_registers() allows.
  RegisterDelivery(const DeliveryContext& context, const SegmentRegisters& registers);

  /// Time of the line that one segment takes, s: all its writes.
  static double segment_time(const silverlode::LineMaster& line);

  std::string description() const override;
  std::size_t capacity() const override { return registers_.blocks; }
  Steps bring_up_steps() override;
  Steps clear_steps() override;
  double shortest_segment() const override;
  double record_bus_time() const override;
  double record_time() const override;
  std::size_t records_per_segment() const override { return kWrites; }
  SlotRule slot_rule(double horizon) const override;

  void begin() override;
  Failure offer(bool more, double rate, HostTime now) override;
  Failure take(const silverlode::Outcome& outcome, HostTime now) override;
  void give_up() override;
  std::size_t delivered() const override { return handed_over_; }

 private:
  static constexpr std::size_t kBlock = SegmentRegisters::kBlock;
  static constexpr std::size_t kWrites = kBlock + 1;  ///< of a segment: its registers, and register 17
  /// The command on its way.
  enum class Command { None, Fill, HandOver, HandOverAgain, Ask };
  /// The segment being written.
  struct Filling {
    std::array<std::int32_t, kBlock> values{};  ///< time, position, acceleration, velocity, as IMW has them
    std::size_t written = 0;                    ///< of `values`, acknowledged by the drive
  };

  std::int32_t control_of(std::size_t segment) const;
  std::int32_t stale_control() const;

  bool hand_over_due(HostTime now) const;
  Failure fill(double rate, HostTime now);
  void hand_over(Command command, HostTime now);
  void resolve_doubt(HostTime now);
  void withdraw_late_repetition(HostTime now);
  bool repetition_is_safe(HostDuration until_executed, HostTime now) const;
  HostTime needed_at() const;
  double reserve() const;
  void send_as(Command command, const silverlode::Request& request, HostTime deadline);

  Failure take_failure(Command command, const silverlode::Outcome& outcome);
  void take_filled();
  void take_handed_over();
  Failure take_control(const silverlode::Outcome& outcome);

  SegmentRegisters registers_;
  Command command_ = Command::None;
  std::optional<Filling> filling_;
  std::size_t handed_over_ = 0;  ///< segments
  bool in_doubt_ = false;        ///< whether the segment after those has been handed over
  int failures_ = 0;             ///< commands in a row without a reply, or refused
};

}  // namespace interpolated_motion::axis
