#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "interpolated_motion_driver/encoding/pvt/path_samples.h"
#include "interpolated_motion_driver/encoding/pvt/segment_fit.h"

namespace interpolated_motion::encoding {

/// A knot the search has found, with the record that leads to it executed and within its rules.
struct KnotCandidate {
  PvtKnot knot;               ///< in the drive's own integers
  SegmentFigures figures;     ///< of the record that leads here
  std::int64_t duration = 0;  ///< of that record, ms
  std::int64_t reach = 0;     ///< sample a record from here can reach; the greater, the better
  double misfit =
      0.0;  ///< distance from the path's own position and velocity, counts; decides between equal reaches
  std::size_t parent = 0;  ///< where the record starts: index in the generation before
};

/// The few best knots that take the same number of records, best first.
class Generation {
 public:
  /// Two: a second knot saves few records but most dead ends; each more costs its share of the time.
  static constexpr std::size_t kWidth = 2;

  /// The candidates kept, best first; `i` < size() <= kWidth.
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const KnotCandidate& operator[](std::size_t i) const { return candidates_[i]; }

  /// Forgets all candidates.
  void clear() { size_ = 0; }
  /// Whether `candidate` would be kept; needs no figures.
  bool wants(const KnotCandidate& candidate) const;
  /// Puts a candidate that it wants() in its place, the best first; when full, the last one makes room.
  void add(const KnotCandidate& candidate);
  bool full() const { return size_ == kWidth; }
  /// Sample that the last candidate reaches; not to be called when empty.
  std::int64_t least_reach() const { return candidates_[size_ - 1].reach; }
  std::int64_t shortest() const;  ///< ms, of the records that lead here

  std::int64_t longest_allowed = 0;  ///< ms; what a retreat has left for the records that lead here

 private:
  std::array<KnotCandidate, kWidth> candidates_;
  std::size_t size_ = 0;
};

/// Chooses the knots of a path: as few records as a small search finds, each within its rules when executed
/// from the quantised knot before it.
///
/// A knot is worth what the record after it can reach, not how far it is itself: the longest record ends at
/// the edge of what is allowed, a bad place to start from. So each generation of knots is chosen by a look at
/// the record that would follow, over several lengths and roundings of position and velocity, and a knot is
/// decided only when kDepth generations after it are known. A dead end in between is left by going back to
/// shorter records.
class KnotSearch {
 public:
  static constexpr std::size_t kDepth = 6;  ///< generations looked ahead before a knot is decided

  /// Continues from `from`, which must be at or before samples.end(). `max_record_ms` in 1..255.
  KnotSearch(PathSamples samples, const SegmentRules& rules, std::int64_t max_record_ms, const PvtKnot& from);

  /// The knot decided last, at first the one to continue from.
  const PvtKnot& knot() const { return generations_[0][0].knot; }
  bool finished() const { return knot().sample >= samples_.end(); }  ///< at the path's end

  /// Makes the samples readable that next() may look at, and returns the last of them.
  std::int64_t look_ahead();

  /// Decides one more knot; call look_ahead() before, and not when finished(). False: there is a dead end at
  /// dead_end().
  bool next(KnotCandidate& decided);

  /// The farthest knot from which no record was found, after next() returned false.
  const PvtKnot& dead_end() const { return dead_end_; }

  /// What the search was given.
  const PathSamples& samples() const { return samples_; }
  const SegmentRules& rules() const { return rules_; }

 private:
  bool reached_end() const;
  bool grow();
  bool retreat(int& retreats_left);
  KnotCandidate decide();
  void breed(const Generation& parents, double bound, Generation& children);
  void expand(const KnotCandidate& from, std::size_t index, double bound, Generation& children);
  void offer_length(const SegmentFit& fit, const KnotCandidate& from, KnotCandidate candidate, double bound,
                    Generation& children);
  void offer(const KnotCandidate& from, KnotCandidate candidate, double bound, Generation& children);
  std::int64_t longest_segment(const SegmentFit& fit, const PvtKnot& from, std::int64_t longest);
  bool reaches(const SegmentFit& onward, const PvtKnot& knot, std::int64_t sample) const;
  std::int64_t reach_of(const SegmentFit& onward, const PvtKnot& knot);
  void note_dead_end(const Generation& parents);

  PathSamples samples_;
  SegmentRules rules_;
  std::int64_t max_record_;
  std::array<Generation, kDepth + 1> generations_;  ///< the first holds knot() alone
  std::size_t depth_ = 0;                           ///< generations known after knot()
  std::int64_t segment_guess_ = 64;                 ///< ms, where the search for the longest segment begins
  std::int64_t reach_guess_ = 0;                    ///< sample, where the search for a knot's reach begins
  PvtKnot dead_end_;
};

}  // namespace interpolated_motion::encoding
