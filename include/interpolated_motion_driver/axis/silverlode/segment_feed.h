#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "interpolated_motion_driver/axis/silverlode/ims_approach.h"
#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"
#include "interpolated_motion_driver/interpolation/ims_segment.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// The segments of one path on their way into a drive's queue, encoded one by one as they are needed, so that
/// each can take the drive's clock into account as it is known by then.
///
/// Before the path go segments of waiting, in which the drive stands; after it goes the one with time 0,
/// which ends the interpolated motion. A segment leaves the queue when the drive begins it, so one is
/// executed while as many as the queue is deep wait: "full" is known before it happens.
class SegmentFeed {
 public:
  /// How a path is encoded, and how much of it is wanted in the drive.
  struct Manner {
    encoding::ImsEncoding encoding;
    double horizon = 0.5;  ///< s
  };

  /// Begins anew, nothing sent. `depth`: places of the drive's queue, >= 1. Throws as
  /// encoding::ImsEncoding::validate().
  void load(const trajectory::Path& path, const Manner& manner, std::int32_t start_counts, std::size_t depth);
  /// Whether there has been a load(): path(), next() and all that tells of knots need one before.
  bool loaded() const { return source_ != nullptr; }

  /// A path and its encoder, which refers to it.
  struct Source {
    /// Takes copies; encodes on from `from`. Not copied itself, since `encoder` refers to `path`.
    Source(const trajectory::Path& p, const Manner& manner, const encoding::ImsKnot& from);
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    trajectory::Path path;           ///< rad or m over goal time
    encoding::ImsEncoding encoding;  ///< with the bound that is in force
    double horizon;                  ///< s
    std::deque<BoundFrom> bounds;    ///< that are planned for later
    encoding::ImsEncoder encoder;    ///< where the segments given out so far lead
  };

  /// Where the segments encoded so far lead. From there on the path may still change.
  const encoding::ImsKnot& knot() const { return source_->encoder.knot(); }
  double bound() const { return source_->encoding.bound_counts; }  ///< counts, in force at the knot
  /// When the last segments before the knot begin, in goal time, as many as `most` of those sent; then those
  /// that have been encoded and not been sent; the knot itself.
  std::vector<double> begins_before_knot(std::size_t most) const;
  std::size_t unsent() const { return encoded_.size(); }  ///< segments encoded, not marked as sent
  /// From the knot on encodes `way_on`, made for it; the bound may be doubled up to `widest` counts where it
  /// proves too narrow. Not when ending().
  void take_way_on(std::unique_ptr<Source> way_on, double widest);
  /// Encodes on until the knot is at goal time `until` or later, as next() would, or as far as it goes.
  void commit(GoalTime until, double rate);

  /// A segment of waiting for `ticks` >= 1, to be sent next. Only before the first segment of the path.
  void wait(std::int64_t ticks);

  /// The segment to send next, the same until mark_sent(). A new one is encoded with `rate` goal seconds per
  /// second of the drive, or with the rate of the last one where `rate` leads into a dead end. Refused when
  /// the path cannot be followed from where the segments so far lead.
  Expected<ImsSegment, Refusal> next(double rate);
  /// The segment that next() has given has been written to the drive; once for each.
  void mark_sent();

  /// The segment with time 0, which ends the motion, has been sent too.
  bool all_sent() const { return terminated_; }
  /// Whether the segment that ends the motion has been given out.
  bool ending() const { return terminated_ || (!encoded_.empty() && encoded_.back().segment.time == 0); }
  std::size_t sent() const { return sent_; }  ///< segments, those of waiting and the last included
  /// Whether a place of the queue is free although the drive may have played no more than `least_elapsed`
  /// seconds. The drive has not started yet when `started` is false: then nothing has left the queue.
  bool has_place(double least_elapsed, bool started) const;
  /// Segments in the queue, that under execution not counted.
  std::size_t waiting(double elapsed, bool started) const;
  /// Seconds of the drive's clock from the start of the motion: where the queue ends, where the segment after
  /// the one executed at `elapsed` begins.
  double queue_end() const { return tick_ * static_cast<double>(end_tick_); }
  double next_begin(double elapsed) const;
  /// When the drive begins segment `number`, counted from 0, one of those sent last.
  double begin_of(std::size_t number) const;
  double duration() const { return queue_end(); }  ///< as queue_end(), s

  /// An instant of the drive's motion.
  struct Instant {
    double elapsed = 0.0;     ///< s, drive's clock
    ImsSegment segment;       ///< under execution then
    std::int32_t counts = 0;  ///< the demand then, as the drive's register has it
    double speed = 0.0;       ///< counts a tick, a magnitude
  };
  /// When `ticks_left` remain of a segment, of the one for which that comes nearest to `expected` seconds.
  std::optional<Instant> instant_of(std::int64_t ticks_left, double expected) const;

  /// The knot in seconds of the drive's clock, and in goal time.
  double knot_end() const;
  GoalTime knot_goal_time() const { return knot().goal_time; }
  /// Goal time of any instant of the drive's motion so far.
  GoalTime goal_time_at(double drive_seconds) const;
  /// The one that is encoded now.
  const trajectory::Path& path() const;
  double horizon() const { return source_->horizon; }            ///< s of motion wanted in the drive
  GoalTime start_goal_time() const { return start_goal_time_; }  ///< when the drive leaves its waiting
  std::int32_t final_counts() const { return final_counts_; }    ///< where it ends, rounded

 private:
  /// What the drive executes from tick `begin` on.
  struct Stretch {
    std::int64_t begin = 0;        ///< servo ticks since the start of the motion
    std::int64_t ticks = 0;        ///< its duration; 0 of the segment that ends the motion
    GoalTime goal_begin{0.0};      ///< goal time at `begin`
    double rate = 1.0;             ///< goal seconds per drive second
    ImsSegment segment;            ///< in the drive's numbers
    interpolation::ImsState from;  ///< where it begins
  };
  std::int64_t knot_tick() const;
  void encode_as(const encoding::ImsEncoding& encoding);
  void take_bound();
  std::optional<Refusal> encode_one(double rate);
  std::optional<Refusal> encode_next(double rate, Stretch& stretch);
  void take(std::unique_ptr<Source> source);
  std::size_t executing(double elapsed) const;
  Instant after(const Stretch& stretch, std::int64_t ticks) const;
  void forget_old_stretches();

  /// Stretches remembered: those of minutes, so that samples of the drive can be held against the path when
  /// the motion is over.
  static constexpr std::size_t kMemory = 4096;
  /// Of these, the ones that the drive may be executing: far more than any queue is deep.
  static constexpr std::size_t kRecent = 64;

  std::unique_ptr<Source> source_;
  double widest_ = 0.0;        ///< counts, up to where the bound may be doubled
  std::int64_t shortest_ = 0;  ///< ticks, down to which a segment may be short where none else is found
  GoalTime start_goal_time_{0.0};
  std::int32_t start_counts_ = 0;
  std::int32_t final_counts_ = 0;
  std::size_t depth_ = 0;
  double tick_ = 0.0;
  std::deque<Stretch> encoded_;        ///< the segments behind those sent
  ImsSegment last_;                    ///< encoded
  std::deque<Stretch> stretches_;      ///< of the segments sent, the last ones
  mutable std::size_t executing_ = 0;  ///< when it was asked last: mostly the next answer, or nearly
  std::size_t sent_ = 0;
  std::int64_t end_tick_ = 0;
  std::int64_t waited_ = 0;  ///< ticks before the path
  bool terminated_ = false;
};

}  // namespace interpolated_motion::axis
