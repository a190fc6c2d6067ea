#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/cia402/cia402_device.h"
#include "interpolated_motion_driver/axis/cyclic/bring_up.h"
#include "interpolated_motion_driver/axis/cyclic/cyclic_parameters.h"
#include "interpolated_motion_driver/axis/cyclic/setpoint_stream.h"
#include "interpolated_motion_driver/axis/cyclic/telemetry.h"
#include "interpolated_motion_driver/encoding/setpoint_certificate.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/protocol/cia402/identity.h"

namespace interpolated_motion::axis {

/// How paths go to a drive with these settings.
encoding::SetpointEncoding setpoint_encoding(const CyclicAxisParameters& parameters);

/// A CiA 402 drive for the cyclic synchronous position mode: its settings, what it tells by its PDOs, and the
/// target positions it gets. They go to it while its power stage is switched on, too, so that nothing moves
/// then.
class CyclicDevice final : public Cia402Device {
 public:
  /// `master`, which must be isochronous with the same period, and `node` must outlive the device. Throws
  /// std::invalid_argument, naming joint, parameter, value and range.
  CyclicDevice(const CyclicAxisParameters& parameters, canopen::Master& master, canopen::NodeLink& node);

  std::string description() const override;
  std::vector<SdoSequence::Step> bring_up_steps(SdoSequence& sequence) override;
  std::vector<SdoSequence::Step> enable_steps() const override;
  bool has_reported(HostTime since) const override { return telemetry_.status_time > since; }
  void on_started() override { setpoints_.rest(telemetry_.position); }
  void on_mode_selected() override { setpoints_.restart(); }
  void on_enabling(bool commanded) override;
  std::uint16_t stop_word() const override;
  CyclicTelemetry& report() override { return telemetry_; }
  const CyclicTelemetry& report() const override { return telemetry_; }
  void take_position(std::int32_t position, HostTime now) override;
  const AxisFeedback& feedback() const override { return feedback_; }
  std::string text_of(const canopen::Emcy& emcy) const override;
  std::string lost_by_restart() const override { return "its settings"; }

  canopen::Master& master() const { return master_; }
  canopen::NodeLink& node() const { return node_; }
  const CyclicAxisParameters& parameters() const { return parameters_; }
  SetpointStream& setpoints() { return setpoints_; }
  const SetpointStream& setpoints() const { return setpoints_; }
  const CyclicFacts& facts() const { return facts_; }
  /// Where the drive was told to stay when it was enabled, counts.
  std::int32_t enabled_at() const { return enabled_at_; }

 private:
  void on_tpdo(int number, const canopen::Frame& frame, HostTime time);

  const CyclicAxisParameters parameters_;
  canopen::Master& master_;
  canopen::NodeLink& node_;
  cia402::Identity identity_;
  CyclicFacts facts_;
  CyclicTelemetry telemetry_;
  AxisFeedback feedback_;
  SetpointStream setpoints_;
  std::int32_t enabled_at_ = 0;
};

}  // namespace interpolated_motion::axis
