#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"
#include "interpolated_motion_driver/encoding/pvt/segment_fit.h"
#include "interpolated_motion_driver/interpolation/pvt_record.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// How much of a drive's FIFO may be used.
struct FeedLimits {
  std::size_t capacity = 64;  ///< records
  double horizon = 2.0;       ///< s of motion kept ahead
};

/// The records of one plan on their way into a drive's FIFO, with the time on the drive's clock at which each
/// is played. The record that ends the mode (time 0) is the last of them.
///
/// What is in the FIFO follows from what has been sent and how far the drive has played, so "full" is known
/// before it happens. Records are counted from the start of the plan; those played long ago are forgotten.
class RecordFeed {
 public:
  /// Records the FIFO must hold at any time, however short the horizon: the drive faults with fewer than two.
  static constexpr std::size_t kLeastAhead = 4;
  /// Places left free, for the uncertainty of the clock at a knot.
  static constexpr std::size_t kSpare = 2;

  /// Begins anew, nothing sent. The record with time 0 is put behind those of `stream`, which has none.
  void load(const encoding::PvtStream& stream, const FeedLimits& limits);
  /// Nothing counts as sent any more. Only before a motion, while no record has been forgotten.
  void rewind() { sent_ = 0; }

  /// The record to send next, if one is due: there is a place for it although the drive may have played no
  /// more than `least_played`, and it lies within the horizon of `played` (s on the drive's clock).
  std::optional<PvtRecord> next(double least_played, double played) const;
  /// The record that next() has given is on its way; once for each.
  void mark_sent();

  /// The records up to `until`, s on the drive's clock, will not be replaced, even if not sent yet.
  void commit(double until);
  /// Where the records lead that are sent or committed to, as the drive counts its samples from the start of
  /// the plan.
  encoding::PvtKnot committed_knot() const;
  bool all_committed() const { return committed() == size(); }
  /// The records behind committed_knot() are replaced by those of `stream`, which sets out from there. Not
  /// once all_committed().
  void replace_uncommitted(const encoding::PvtStream& stream, const FeedLimits& limits);
  /// A copy without the records behind committed_knot().
  RecordFeed committed_part() const;

  /// Records of the plan and of them those sent, the one with time 0 and the forgotten ones included;
  /// duration(): s on the drive's clock from the start to the last record, 0 without records.
  std::size_t size() const { return forgotten_ + records_.size(); }
  std::size_t sent() const { return sent_; }
  bool all_sent() const { return sent_ == size(); }
  double duration() const { return records_.empty() ? 0.0 : records_.back().end; }
  /// Time (s) at which record `index` has been played; of one that is forgotten, some time after that.
  double end(std::size_t index) const { return kept(index).end; }
  /// How many records have been played `elapsed` s after the start.
  std::size_t played(double elapsed) const;
  /// Seconds of motion in the FIFO.
  double time_ahead(double elapsed) const;
  /// Magnitude that the velocity does not exceed from `elapsed` on in the records sent so far, counts/s;
  /// `unit`: counts/s in one unit of a record's velocity.
  double fastest_ahead(double elapsed, double unit) const;
  std::int32_t start_position() const { return start_position_; }  ///< counts
  std::int32_t final_position() const;                             ///< counts

  /// When each record that has not been sent may and must cross the bus; `start`: goal time at which the
  /// drive starts, or would have started if it had always gone as fast as now.
  std::vector<RecordSlot> slots(GoalTime start) const;

 private:
  struct Entry {
    PvtRecord record;  ///< position in counts, velocity in the drive's unit
    double end = 0.0;  ///< s on the drive's clock
  };
  /// Sent records remembered, many times what a FIFO holds.
  static constexpr std::size_t kMemory = 1024;

  void append(const std::vector<PvtRecord>& records);
  std::size_t committed() const { return std::max(sent_, committed_); }
  const Entry& kept(std::size_t index) const;
  bool has_place(double least_played) const;
  bool is_within_horizon(double played) const;
  double dry(std::size_t count) const;

  FeedLimits limits_;
  std::int32_t start_position_ = 0;
  std::deque<Entry> records_;
  std::size_t forgotten_ = 0;  ///< records before those kept
  std::size_t sent_ = 0;
  std::size_t committed_ = 0;  ///< records, of commit(); may be fewer than those sent
  mutable std::size_t played_ =
      0;  ///< of records_, when it was asked last: mostly the next answer, or nearly
};

}  // namespace interpolated_motion::axis
