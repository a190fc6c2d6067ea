#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/epos/epos_parameters.h"
#include "interpolated_motion_driver/emulation/epos/pvt_buffer.h"
#include "interpolated_motion_driver/emulation/epos/spline_segment.h"

namespace interpolated_motion::emulation {

/// What the drive's objects say about the motion that is allowed, in qc and ms.
struct InterpolationLimits {
  double velocity_warning = 0.0;      ///< 0x6081, qc/ms
  double velocity_error = 0.0;        ///< 0x607F, qc/ms
  double acceleration_warning = 0.0;  ///< 0x6083, qc/ms^2
  double acceleration_error = 0.0;    ///< 0x60C5, qc/ms^2
  double lowest_position = 0.0;       ///< 0x607D:1, qc
  double highest_position = 0.0;      ///< 0x607D:2, qc
  double velocity_unit = 0.0;         ///< qc/ms of one velocity unit of a record
  int underflow_level = 0;            ///< 0x20C4:2, records
  int overflow_level = 0;             ///< 0x20C4:3, records
};

/// Outcome of a sample, a start or a record.
enum class InterpolationEvent {
  None,
  Ended,
  Underflow,
  Overflow,
  VelocityError,
  AccelerationError,
  PositionLimit
};

/// Whether the drive has to go into its fault reaction.
inline bool is_error(InterpolationEvent event) {
  return event != InterpolationEvent::None && event != InterpolationEvent::Ended;
}

/// The Interpolated Position Mode of a drive ("EPOS3 Interpolated Position Mode", 4.3): buffer, state
/// "interpolation active" or "inactive", cubic interpolation at 1 ms, status word 0x20C4:1.
class InterpolatedPositionMode {
 public:
  /// `parameters` must outlive it. Empty, access disabled, inactive; set_limits() before records come.
  explicit InterpolatedPositionMode(const EposParameters& parameters) : parameters_(parameters) {}

  /// Settings that hold from now on.
  void set_limits(const InterpolationLimits& limits) { limits_ = limits; }

  /// Power-up: empty, access disabled.
  void reset();

  /// Transition I: the mode has been selected; the records are cleared.
  void select() { clear(); }

  /// 0x60C4:6: false clears the buffer and denies access, true grants it.
  void enable_access(bool enabled);
  bool access_enabled() const { return access_; }  ///< 0x60C4:6

  /// Appends a record. Overflow or PositionLimit when it is refused and that is a fault.
  InterpolationEvent push(const BufferedRecord& record);

  /// Transition III, at the drive's sample. `demand` is the present position demand, from which the first
  /// segment starts at rest.
  InterpolationEvent start(double demand);

  /// Transition IV by the controlword, halt without resumption, or a fault.
  void stop() { active_ = false; }

  /// State "interpolation active" (Table 4-25): the records are played.
  bool active() const { return active_; }

  /// The next 1 ms sample while active. `state` receives the demand (also together with an error).
  InterpolationEvent sample(MotionState& state);

  /// After a halt: continue from rest at `demand`.
  void resume(double demand);

  /// Error bits are cleared where the settings say so.
  void on_fault_reset();

  /// 0x20C4:1 (table 4-35); records in the buffer, 0..64 (0x60C4:4); EposSample::samples_since_start.
  std::uint16_t status() const;
  int fill() const { return buffer_.size(); }
  std::int64_t samples() const { return samples_; }

  /// As EposCounters has them, since this was made.
  std::uint64_t underflows() const { return underflows_; }
  std::uint64_t overflows() const { return overflows_; }
  int minimum_fill() const { return minimum_fill_; }

 private:
  void clear();
  InterpolationEvent overflow();
  InterpolationEvent underflow();
  InterpolationEvent next_segment(const MotionState& from);
  void aim_at(const MotionState& from, const BufferedRecord& record);
  InterpolationEvent finish_segment();
  InterpolationEvent check_motion(const MotionState& state);
  InterpolationEvent check_knots();
  InterpolationEvent check_demand(const MotionState& state);
  void note_fill();

  const EposParameters& parameters_;
  InterpolationLimits limits_;
  PvtBuffer buffer_;
  SplineSegment segment_;
  MotionState target_;
  int elapsed_ = 0;
  int duration_ = 0;
  bool target_queued_ = false;  ///< the record being approached still counts in the buffer
  bool access_ = false;
  bool active_ = false;
  std::uint16_t warnings_ = 0;
  std::uint16_t errors_ = 0;
  std::int64_t samples_ = -1;
  std::uint64_t underflows_ = 0;
  std::uint64_t overflows_ = 0;
  int minimum_fill_ = -1;
};

}  // namespace interpolated_motion::emulation
