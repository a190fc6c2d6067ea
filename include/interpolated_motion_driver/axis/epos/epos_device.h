#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/cia402/cia402_device.h"
#include "interpolated_motion_driver/axis/epos/bring_up.h"
#include "interpolated_motion_driver/axis/epos/epos_parameters.h"
#include "interpolated_motion_driver/axis/epos/telemetry.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"

namespace interpolated_motion::axis {

/// A maxon EPOS drive: its settings, what bring-up has found out about it, and what it tells by its PDOs.
class EposDevice final : public Cia402Device {
 public:
  /// `master` and `node` must outlive the device. Throws std::invalid_argument, naming joint and parameter,
  /// when a limit is not finite.
  EposDevice(EposAxisParameters parameters, canopen::Master& master, canopen::NodeLink& node);

  std::string description() const override;
  std::vector<SdoSequence::Step> bring_up_steps(SdoSequence& sequence) override;
  std::vector<SdoSequence::Step> enable_steps() const override;
  std::vector<SdoSequence::Step> reset_steps() const override;
  bool has_reported(HostTime since) const override;
  std::uint16_t stop_word() const override;
  EposTelemetry& report() override { return telemetry_; }
  const EposTelemetry& report() const override { return telemetry_; }
  void take_position(std::int32_t position, HostTime now) override;
  const AxisFeedback& feedback() const override { return feedback_; }
  std::string text_of(const canopen::Emcy& emcy) const override;
  std::string fault_detail() const override;
  std::string lost_by_restart() const override { return "its FIFO and settings"; }

  /// As given to the constructor.
  canopen::Master& master() const { return master_; }
  canopen::NodeLink& node() const { return node_; }
  const EposAxisParameters& parameters() const { return parameters_; }
  /// What bring-up has found out, forgotten at the next. To be changed by what a motion shows (FifoWatch).
  EposFacts& facts() { return facts_; }
  const EposFacts& facts() const { return facts_; }
  /// Errors of the FIFO that the drive has told, since the start.
  std::uint32_t underruns() const { return underruns_; }
  std::uint32_t overflows() const { return overflows_; }

  /// Of the motor, counts/s, at `velocity` in the drive's unit.
  double counts_per_second(std::int32_t velocity) const;
  /// A drive may be silent for `heartbeat_timeout` before it counts as lost; where that is long since frames
  /// take their time to get here, so may be what is waited for, `usual` at least.
  HostDuration patience(HostDuration usual) const {
    return std::max(usual, parameters_.heartbeat_timeout / 2);
  }

 private:
  void on_tpdo(int number, const canopen::Frame& frame, HostTime time);
  void note_buffer_errors(cia402::BufferStatus before);
  std::string clock_text() const;

  const EposAxisParameters parameters_;
  canopen::Master& master_;
  canopen::NodeLink& node_;
  EposFacts facts_;
  EposTelemetry telemetry_;
  AxisFeedback feedback_;
  std::uint32_t underruns_ = 0;
  std::uint32_t overflows_ = 0;
};

}  // namespace interpolated_motion::axis
