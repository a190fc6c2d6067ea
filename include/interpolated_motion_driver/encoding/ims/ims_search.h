#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "interpolated_motion_driver/encoding/ims/acceleration_funnel.h"
#include "interpolated_motion_driver/encoding/ims/ims_move.h"
#include "interpolated_motion_driver/encoding/ims/tick_samples.h"
#include "interpolated_motion_driver/interpolation/ims_profile.h"

namespace interpolated_motion::encoding {

/// A knot the search has found, with the segment that leads to it.
struct ImsCandidate {
  std::int64_t tick = 0;          ///< since the interpolated motion began
  interpolation::ImsState state;  ///< the drive's exact one at `tick`
  ImsMove move;                   ///< that leads here
  ImsFigures figures;             ///< of its execution
  double reach = 0.0;             ///< tick a segment from here can reach; the greater, the better
  double misfit = 0.0;            ///< distance from the path, counts; decides between equal reaches
  std::size_t parent = 0;         ///< where the segment starts: index in the generation before
};

/// The few best knots that take the same number of segments, best first.
struct ImsGeneration {
  /// Three: a fourth knot saves one segment in two hundred and costs its share of the time.
  static constexpr std::size_t kWidth = 3;

  std::array<ImsCandidate, kWidth> candidates;  ///< the first `size`, best first
  std::size_t size = 0;                         ///< of `candidates`, 0..kWidth
  std::int64_t longest_allowed = 0;  ///< ticks; what a retreat has left for the segments that lead here

  /// Appends; must not be called when full().
  void add(const ImsCandidate& candidate) { candidates[size++] = candidate; }
  bool full() const { return size == kWidth; }
  /// Whether a candidate of the same tick and state is among them, however it was reached.
  bool holds(const ImsCandidate& candidate) const;
  std::int64_t shortest() const;  ///< ticks, of the segments that lead here
};

/// Chooses the segments of a path: as few as a small search finds, each executed within its rules from the
/// drive's exact state before it.
///
/// Knots need not lie on the path: what counts is that the drive stays within the bound, and how far the next
/// segment can go. So a segment is a ramp with a constant acceleration through the funnel of what the bound
/// allows, knots are chosen by the reach of the funnel that opens behind them, and a knot is decided only
/// when kDepth generations after it are known. A dead end in between is left by going back to shorter
/// segments.
class ImsSearch {
 public:
  static constexpr std::size_t kDepth = 6;  ///< generations looked ahead before a knot is decided

  /// Ticks the search may look at, from the knot decided last.
  static std::int64_t window(const ImsRules& rules);

  /// Continues from `from` (only tick and state matter), where `samples` begin. `target`: counts, the path's
  /// final position, rounded.
  ImsSearch(TickSamples samples, const ImsRules& rules, std::int64_t target, const ImsCandidate& from);

  /// The knot decided last, at first the one to continue from.
  const ImsCandidate& knot() const { return generations_[0].candidates[0]; }
  bool finished() const { return finished(knot()); }  ///< at rest on the target, not before the path's end

  /// Goes on from knot() with ticks of another length (s of goal time).
  void restart(double seconds_per_tick);
  /// Takes back what restart() has changed since the knot was decided: the way on that was known then is
  /// known again. False when there is nothing to take back.
  bool take_back_restart();
  double seconds_per_tick() const { return seconds_per_tick_; }  ///< goal time, from knot() on

  /// Decides one more knot, not to be called when finished(). False: there is a dead end at dead_end().
  bool next(ImsCandidate& decided);

  /// The farthest knot from which no segment was found, after next() returned false.
  const ImsCandidate& dead_end() const { return dead_end_; }

  /// What the search was given, and may be read (or moved on) by the caller.
  const TickSamples& samples() const { return samples_; }
  TickSamples& samples() { return samples_; }
  const ImsRules& rules() const { return rules_; }
  std::int64_t target() const { return target_; }  ///< counts

 private:
  static constexpr std::size_t kMaxOffers = 512;

  bool finished(const ImsCandidate& candidate) const;
  bool at_rest_on_target(const interpolation::ImsState& state) const;
  bool arrived() const { return finished(generations_[depth_].candidates[0]); }
  bool grow();
  bool breed(const ImsGeneration& parents, double bound, ImsGeneration& children);
  bool retreat(int& retreats_left);
  ImsCandidate decide();
  void forget_generations();
  void expand(const ImsCandidate& from, std::size_t index, double bound, std::int64_t longest);
  bool offer_rest(const ImsCandidate& from, std::size_t index, double bound);
  void offer_landing(const ImsCandidate& from, std::size_t index, double bound);
  void offer_settling(const ImsCandidate& from, std::size_t index, double bound);
  void offer_ramps(const ImsCandidate& from, std::size_t index, double bound, std::int64_t longest);
  void offer_ramp(const ImsCandidate& from, std::size_t index, double bound, std::int64_t ticks,
                  double acceleration);
  void offer(const ImsCandidate& candidate, double bound);
  bool may_end(const ImsCandidate& candidate, double bound);
  bool may_settle(const interpolation::ImsState& state, std::int64_t tick, double bound, ImsMove& move);
  bool may_land(const interpolation::ImsState& state, std::int64_t tick, double bound, ImsMove& move);
  std::int64_t ticks_to_look(std::int64_t tick) const;
  void choose(const ImsGeneration& parents, ImsGeneration& children);
  double path_at(std::int64_t tick);
  void note_dead_end(const ImsGeneration& parents);

  TickSamples samples_;
  ImsRules rules_;
  std::int64_t target_;
  std::int64_t target_sum_;
  std::array<ImsGeneration, kDepth + 1> generations_;  ///< the first holds knot() alone
  std::size_t depth_ = 0;                              ///< generations known after knot()
  double seconds_per_tick_;
  /// What was known before the first restart() since knot() was decided.
  struct Known {
    std::array<ImsGeneration, kDepth + 1> generations;  ///< as `generations_` was
    std::size_t depth = 0;                              ///< as `depth_` was
    double seconds_per_tick = 0.0;                      ///< goal seconds in a tick, as they were
  };
  Known known_;
  bool restarted_ = false;
  std::array<ImsCandidate, kMaxOffers> offers_;  ///< not yet executed
  std::size_t offered_ = 0;
  AccelerationFunnel funnel_;
  AccelerationFunnel onward_;
  ImsCandidate dead_end_;
};

}  // namespace interpolated_motion::encoding
